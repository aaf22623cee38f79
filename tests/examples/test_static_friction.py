"""Den Hartog's oscillator with a static friction above the kinetic one: its map of releases."""

import pytest

from cap.command.prover import main

WORDS = ["attractor", "--model", "examples/den_hartog.py", "--set"]


@pytest.mark.slow
def test_one_motion_attracts(tmp_path, capsys):
    """At omega = 1/2, f = 1/10, s = 1/5 the certificate is accepted, and written."""
    out = tmp_path / "one.json"
    assert main([*WORDS, "omega=1/2,f=1/10,excess=1/10", "--out", str(out)]) == 0
    assert "G has exactly one fixed point" in capsys.readouterr().out
    assert out.exists()


def test_where_it_does_not_know(capsys):
    """At omega = 7/5, f = s = 1/5 no interval is found, and nothing is claimed."""
    assert main([*WORDS, "omega=7/5,f=1/5"]) != 0
    said = capsys.readouterr()
    assert "no interval of releases is found" in said.out + said.err
