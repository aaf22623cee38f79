"""Names of certificates tell what they are about; no other file is ever replaced."""

import json
from fractions import Fraction
from pathlib import Path

import pytest
from support import proving

from cap.certificate import naming
from cap.certificate.writer import stored
from cap.checker.theorems import load
from cap.checker.verdict import check
from cap.errors import BadInput
from cap.parameters import PAPER, Parameters
from cap.proofs.theorems import THEOREMS

STORED = Path(__file__).parents[2] / "certificates"
P_STAR = (0.10027989, 0.54194331)


def run(capsys, tmp_path, *words):
    """Prove quickly into a folder; return the status, what was written, and what was said."""
    status, out, err = proving(capsys, *words, "--digits", "8", "--out", str(tmp_path))
    return status, out, err


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (("elliptic",), "elliptic.json"),
        (("elliptic", "--f", "9/20", "--order", "5"), "elliptic-f=9_20.json"),
        (("elliptic", "--f", "0.45"), "elliptic-f=9_20.json"),
        (("elliptic", "--f", "0.40", "--l", "-1"), "elliptic.json"),
        (("elliptic", "--orbit", "0.56", "1.07"), "elliptic-x=0.559163-v=1.06697.json"),
        (("elliptic", "--orbit", "0.1", "0.54"), "elliptic-x=0.10028-v=0.541943.json"),
        (("saddle", "--l=-7/3", "--r=-1/3"), "saddle-l=-7_3-r=-1_3.json"),
        (("capture", "--mu", "1/10"), "capture-mu=1_10.json"),
        (("capture", "--orbit", "0.99", "0.01"), "capture-x=0.99-v=0.01.json"),
        (("symmetric", "--f", "11/20"), "symmetric-f=11_20.json"),
        (("pitchfork", "--F", "2"), "pitchfork-F=2.json"),
        (
            ("periodic", "--period", "2", "--orbit", "-0.7079", "0.5912"),
            "periodic-period=2-x=-0.707937-v=0.591154.json",
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else " ".join(value),
)
def test_names(capsys, tmp_path, words, name):
    """The theorem, the parameters that are not the paper's, and what was asked for besides."""
    status, out, err = run(capsys, tmp_path, *words)
    assert (status, err) == (0, "")
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert f"{tmp_path / name}" in out


def test_the_range_of_a_branch():
    """Its ends are part of the name; f is not, nor is the f that stands for all."""
    about = {"from": "1/3", "to": "2/5"}
    assert naming.name("branch", PAPER, about) == "branch-from=1_3-to=2_5.json"
    other = Parameters(*map(Fraction, ("3", "2", "1", "1/4", "11/10")))
    assert naming.name("branch", other, {}) == "branch-F=3-omega=2-l=1_4-r=11_10.json"
    assert naming.name("symmetric", other, {}).startswith("symmetric-F=3-omega=2-f=1-")


def test_long_names_are_digests():
    """Parameters of two hundred digits give a name that a folder can have, and each its own."""
    long = [Parameters(*map(Fraction, ("1", "1", f"1/{10**60 + k}", "-1", "1"))) for k in (1, 2)]
    names = {naming.name("elliptic", p, {"x": "0.1"}) for p in long}
    assert len(names) == 2
    assert all(len(name) < 128 and name.startswith("elliptic-") for name in names)


@pytest.mark.slow
def test_all_orbits_have_names_of_their_own(capsys, tmp_path):
    """``--all`` writes each, whatever is there already."""
    for _ in range(2):
        assert run(capsys, tmp_path, "elliptic", "--all")[0] == 0
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["elliptic-x=0.10028-v=0.541943.json", "elliptic-x=0.559163-v=1.06697.json"]


def test_the_same_again(capsys, tmp_path):
    """Left alone if it is the same; replaced by one about the same with other digits."""
    assert "(written;" in run(capsys, tmp_path, "saddle")[1]
    before = (tmp_path / "saddle.json").read_bytes()
    assert "(unchanged;" in run(capsys, tmp_path, "saddle")[1]
    assert (tmp_path / "saddle.json").read_bytes() == before
    _, out, _ = proving(capsys, "saddle", "--digits", "12", "--out", str(tmp_path))
    assert "(replaced;" in out
    assert json.loads((tmp_path / "saddle.json").read_text("utf-8"))["digits"] == "12"
    check((tmp_path / "saddle.json").read_bytes(), lambda _step: None)


@pytest.mark.parametrize("other", ["parameters", "orbit", "theorem", "no certificate", "empty"])
def test_another_file_is_not_replaced(capsys, tmp_path, other):
    """Said before the proof, with what to do; a file that is named is replaced."""
    path = tmp_path / "saddle.json"
    words = {
        "parameters": ("saddle", "--f", "9/20"),
        "orbit": ("saddle", "--orbit", "0.3435", "0.7753"),
        "theorem": ("elliptic",),
    }
    if other in words:
        proving(capsys, *words[other], "--digits", "8", "--out", str(path))
    else:
        path.write_text({"no certificate": '{"my": "notes"}', "empty": ""}[other])
    before = path.read_bytes()
    status, out, err = run(capsys, tmp_path, "saddle")
    assert status == 2
    assert "Theorem" not in out
    assert err.startswith(f"error: there is another file at {path}: move it away, or name")
    assert err.count("\n") == 1
    assert path.read_bytes() == before
    assert proving(capsys, "saddle", "--digits", "8", "--out", str(path))[0] == 0
    assert path.read_bytes() != before


ONE_MASS = [name for name in THEOREMS if "masses" not in load(name).PARAMETERS]


@pytest.mark.parametrize("theorem", [name for name in ONE_MASS if name != "persistence"])
def test_no_stored_certificate_is_in_the_way(theorem):
    """At the paper's parameters the name is free, or that of a certificate about just that.

    (There `persistence` has nothing to prove.)
    """
    path = STORED / naming.name(theorem, PAPER, {})
    old = stored(path)
    claims = old.claims if old else {}
    closed, there = "box" not in claims, [PAPER.r, 0]  # as searched for, and for a capture
    state = [sum(claims[z][:2]) / 2 for z in "xv"] if "x" in claims else there
    naming.free(path, theorem, PAPER, (0.0, 0.0) if closed else tuple(map(float, state)))


def test_masses(tmp_path):
    """They are part of the name, and of what a certificate is about."""
    path, masses = STORED / "particles_saddle.json", (Fraction(1), Fraction(9, 10))
    words = {"masses": "1,9/10"}
    assert naming.name("particles_saddle", PAPER, words) == "particles_saddle-masses=1,9_10.json"
    naming.free(path, "particles_saddle", PAPER, (0.0, 0.0), masses)
    for other in ((), (Fraction(1), Fraction(1)), masses[::-1]):
        with pytest.raises(BadInput, match="another file"):
            naming.free(path, "particles_saddle", PAPER, (0.0, 0.0), other)
    naming.free(tmp_path / "none.json", "particles_saddle", PAPER, (0.0, 0.0), masses)


def test_what_is_about_the_same(capsys, tmp_path):
    """The same theorem, parameters and orbit: states within a millionth."""
    path = tmp_path / "a.json"
    proving(capsys, "elliptic", "--digits", "8", "--out", str(path))
    naming.free(path, "elliptic", PAPER, P_STAR)
    naming.free(tmp_path / "none.json", "saddle", PAPER, P_STAR)
    away = [(P_STAR[0] + 1e-5, P_STAR[1]), (P_STAR[0], P_STAR[1] - 1e-5)]
    for theorem, state in [("saddle", P_STAR), *(("elliptic", z) for z in away)]:
        with pytest.raises(BadInput, match="another file"):
            naming.free(path, theorem, PAPER, state)
