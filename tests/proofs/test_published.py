"""Church and Fortin's tables: a sample of the rows proved and compared; what is refused."""

import json
from pathlib import Path

import pytest

from cap.command.prover import main
from cap.errors import BadInput
from cap.proofs.published import Verdict, rows, verdict
from cap.system.files import read

DATA = Path("examples/data/church-fortin")
TABLES = {  # parameters of a table, and its rows that are no orbits
    "a1.0-e1.0-E1.0": {"a": "1", "e": "1", "E": "1"},
    "a1.8-e0.75-E1.5": {"a": "1.8", "e": "0.75", "E": "1.5"},
    "a2.0-e0.5-E2.0": {"a": "2", "e": "0.5", "E": "2"},
    "a2.0-e0.778-E1.0": {"a": "2", "e": "0.778", "E": "1"},
    "a2.0-e0.8-E1.0": {"a": "2", "e": "0.8", "E": "1"},
    "a2.0-e0.81-E1.0": {"a": "2", "e": "0.81", "E": "1"},
    "a2.0-e0.89-E1.0": {"a": "2", "e": "0.8", "E": "1"},
}


def table(name, **changes):
    """Return the rows of a table, perhaps at other parameters."""
    return rows(read("examples/billiard.py", {**TABLES[name], **changes}), DATA / f"{name}.csv")


def test_the_tables_are_whole():
    """As many rows as are published."""
    assert sum(len(table(name)) for name in TABLES) == 3504


@pytest.mark.parametrize("name", TABLES)
def test_a_sample(name):
    """Every hundredth row is proved, is what is printed, and is unstable."""
    for row in table(name)[7::100]:
        found = verdict(row)
        assert found.proved
        assert found.places <= 1
        assert found.unstable == 2
        assert Verdict.decoded(found.encoded()) == found


def test_a_row_that_crosses_the_table():
    """Rows of the fifth table solve the equations, and are below the table in between."""
    first = verdict(table("a2.0-e0.8-E1.0")[0])
    assert not first.proved
    assert "the guard 'table' is negative" in first.reason


def test_a_label_that_is_wrong():
    """The rows of the last table are no orbits at the e of its label, but at e = 0.8."""
    found = verdict(table("a2.0-e0.89-E1.0", e="0.89")[0])
    assert not found.proved or found.places > 1e6


def test_a_number_changed(tmp_path):
    """Newton's iteration goes back to the orbit; the row is seen to differ."""
    text = (DATA / "a1.8-e0.75-E1.5.csv").read_text("utf-8").splitlines()[:3]
    path = tmp_path / "table.csv"
    path.write_text("\n".join(text).replace("2.699873969", "2.699873869"))
    system = read("examples/billiard.py")
    away = [verdict(row).places for row in rows(system, path)]
    assert 99 < away[0] < 101
    assert away[1] < 1


def test_the_command(tmp_path, capsys):
    """It says what became of the rows, goes on from a journal, and its status is that of all."""
    lines = (DATA / "a2.0-e0.8-E1.0.csv").read_text("utf-8").splitlines()
    path, journal = tmp_path / "table.csv", tmp_path / "journal"
    path.write_text("\n".join([lines[0], *lines[1:3], lines[10]]))
    words = ["periodic", "--model", "examples/billiard.py", "--set", "a=2,e=0.8,E=1", "--table"]
    assert main([*words, str(path), "--journal", str(journal)]) == 1
    first = capsys.readouterr()
    assert "row 1: NOT PROVED.  leg 1: the guard 'table' is negative" in first.err
    assert " of 3 rows proved, and accepted by the independent checker" in first.out
    kept = journal.read_text("utf-8").splitlines()
    assert len(kept) == 4
    assert main([*words, str(path), "--journal", str(journal)]) == 1
    assert capsys.readouterr() == first
    path.write_text("\n".join([lines[0], lines[10]]))
    assert main([*words, str(path), "--journal", str(journal)]) == 2
    assert "journal" in capsys.readouterr().err
    assert json.loads(kept[0])


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "has no rows"),
        ("t0,x0\n", "has no rows"),
        ("x0\n1\n", "has no column t0"),
        ("t0,x0,v0,w0\n1,2\n", "not as many numbers"),
        ("t0,x0,v0,w0\n1,2,3,4,5\n", "not as many numbers"),
        ("t0,x0,v0,w0\n1,2,3,four\n", "w0 is no number"),
        ("t0,x0,v0,w0\n1,2,3,1e99\n", "is not between"),
        ("t0,x0,v0,w0\n1,2,3,nan\n", "is not between"),
        ("t0,x0,v0\n1,2,3\n", "does not give y, w"),
        ("t0,x0,v0,w0,guard0\n1,2,3,4,roof\n", "needs a column guard0: one of table"),
        ("t0,x0,v0,w0,periods\n1,2,3,4,0\n", "takes a period, at least"),
    ],
)
def test_no_table(tmp_path, text, why):
    """Each is refused in a line."""
    path = tmp_path / "table.csv"
    path.write_text(text)
    with pytest.raises(BadInput, match=why) as refusal:
        rows(read("examples/billiard.py"), path)
    assert "\n" not in str(refusal.value)


@pytest.mark.slow
def test_a_whole_table():
    """All rows of the smallest one."""
    found = [verdict(row) for row in table("a2.0-e0.5-E2.0")]
    assert all(each.proved and each.places <= 1 and each.unstable == 2 for each in found)
