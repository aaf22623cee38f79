"""The figures of the paper: tables with reasons, pictures, and the rule by which numbers agree."""

import csv
import math
from dataclasses import replace
from fractions import Fraction

import matplotlib.image
import numpy as np
import pytest

from cap.audit.comparison import NOT_ROUNDED, Comparison, compared, value
from cap.audit.verdict import Outcome
from cap.errors import BadInput, NotProved
from cap.explore import paper as command
from cap.explore.arrays import load
from cap.floats import one_one
from cap.paper import (
    bifurcation,
    certified,
    continuation,
    forcing,
    sketches,
)
from cap.paper.figure import Run, figure, labelled, labels, markdown, percent
from cap.parameters import PAPER, at
from cap.proofs.census import census
from cap.runner import Runner

LABELS = labels()
PRINTED = {  # every figure label of the paper's source
    "fig:model-schematic", "fig:cover", "fig:impulse-bound", "fig:kam-gallery",
    "fig:decomp-schematic", "fig:multi-particle", "fig:orbit", "fig:KAM", "fig:bifurcation",
    "fig:sali", "fig:basin", "fig:continuation", "fig:coexist-main", "fig:hist-gallery-low",
    "fig:hist-gallery-high", "fig:hist-cont", "fig:hist-chatter",
}  # fmt: skip


def test_the_labels_are_those_of_the_paper():
    """Every figure of the paper has an entry, and no other."""
    assert set(LABELS) == PRINTED
    assert labelled("all") == list(LABELS)
    assert labelled("sali") == labelled("fig:sali") == ["fig:sali"]


@pytest.mark.parametrize("label", ["", "fig:", "fig:salt", "tab:jacobian", "All"])
def test_an_unknown_label_is_bad_input(label):
    """A label that the paper does not have is refused, with those that it has."""
    with pytest.raises(BadInput, match="the paper has no figure"):
        figure(label)


AGREE = {  # the rows that the paper gets right, whatever the size of the computation
    "fig:orbit": ["hit of the right wall", "trace of Phi'(P_*)", "rotation number"],
    "fig:impulse-bound": ["F = 0.95: trace of Phi'(P_*)", "F = 0.85: rotation number"],
    "fig:sali": ["cells in Omega_dissip", "regular cells of 484", "chaotic cells"],
    "fig:basin": ["the same with another integrator's rounding"],
    "fig:continuation": ["points with an elliptic (1,1) orbit", "(1,1) orbits at f = 0.55, R = 1"],
    "fig:coexist-main": ["focus: trace", "saddle: determinant", "saddle: larger multiplier"],
    "fig:hist-gallery-low": ["F = 4.5: determinant", "wall hits in 4 T at F = 4.5"],
    "fig:hist-gallery-high": ["F = 6: trace"],
    "fig:hist-chatter": ["(a) turn, t", "(a) releases up to t = 12"],
}
DIFFER = {  # and those that it gets wrong
    "fig:orbit": ["twist tau_1", "enclosure of entry 21", "non-sticking fixed points"],
    "fig:KAM": ["chain of period five"],
    "fig:bifurcation": ["f at which the branch ends", "rotation number 1/4"],
    "fig:basin": ["blue cells"],
    "fig:continuation": [
        "(1,1) orbits at f = 0.15, R = 2",
        "elliptic (1,1) orbit at (0.55, 1)",
        "another T-periodic orbit at f = 0.35, R = 1",
    ],
    "fig:coexist-main": ["T-periodic orbits at F = 3"],
    "fig:hist-gallery-high": ["F = 6: largest |v|", "F = 50: largest |v| in 1 T"],
    "fig:hist-cont": ["F = 0.65 and 0.85: orbits found below F_sc"],
    "fig:hist-chatter": ["(b) the two orbits", "time between events"],
    "fig:multi-particle": ["a collision preserves sum dv_i dx_i (Theorem multiparticle)"],
}


def test_verdicts_are_known_of_figures_that_there_are():
    """So each is looked at with its figure."""
    assert {*AGREE, *DIFFER} <= {*LABELS}


SOON = ("fig:cover", "fig:orbit", "fig:decomp-schematic", "fig:sali", "fig:bifurcation")


@pytest.mark.slow
@pytest.mark.parametrize(
    "label",
    [pytest.param(label, marks=[pytest.mark.slow] * (label not in SOON)) for label in LABELS],
)
def test_a_figure_has_numbers_reasons_and_a_picture(label, tmp_path):
    """In its smallest size every row says what, and why not; what is known to be right or wrong in
    the paper comes out so; the picture has the size asked for and is not empty."""
    compared = figure(label).compared(Run(Runner(1), quick=True))
    assert compared.complete
    assert len(compared.rows) >= 3
    for row in compared.rows:
        assert row.what
        assert row.paper
        assert row.ours
        assert row.agrees or row.reason, row
        assert "nan" not in row.ours, row
    verdicts = {row.what: row.agrees for row in compared.rows}
    assert len(verdicts) == len(compared.rows)
    assert all(verdicts[name] for name in AGREE.get(label, ()))
    assert not any(verdicts[name] for name in DIFFER.get(label, ()))
    picture = figure(label).picture(compared, dpi=40)
    file = tmp_path / "picture.png"
    picture.savefig(file)
    pixels = matplotlib.image.imread(file)
    width, height = figure(label).size
    assert pixels.shape[:2] == (round(40 * height), round(40 * width))
    assert np.ptp(pixels[..., :3]) > 0.5
    assert (pixels[..., :3].min(axis=-1) < 0.9).mean() > 0.005


def row(found, **entries):
    """Compare a row with one number that is found."""
    return compared({"what": "x", "value": "x", "paper": "1", **entries}, {"x": found})


def test_a_number_agrees_if_it_is_rounded():
    """What is cut off is imprecise, unless the paper has dots; others do not agree."""
    assert value("0.207", 0.20666)[1] is Outcome.CONFIRMED
    off = row(103.3055, paper="103.30")
    assert (off.agrees, off.outcome, off.reason) == (False, Outcome.IMPRECISE, NOT_ROUNDED)
    assert row(103.3055, paper="103.30", cut=True).agrees
    assert not row(103.3055, paper="103.20", cut=True).agrees
    assert value("3.14", ["3.1415", "3.1416"])[1] is Outcome.CONFIRMED
    assert value("3.15", ["3.1415", "3.1416"])[1] is Outcome.IMPRECISE
    assert value("0.467", 0.465904)[1] is Outcome.CORRECTED
    assert value("0.467", math.nan)[1] is Outcome.CORRECTED
    assert row(0.1134, paper="-0.42", why="sign of {x}").reason == "sign of 0.1134"
    assert row(0.5, paper="0.5", why="why", note="a remark").reason == "a remark"
    assert value("0.5", 0.5)[0] == "0.5000"
    assert value("14.4", 14.3774)[0] == "14.3774"


def test_proved_numbers_and_enclosures():
    """Both ends of what is proved must say the same, or lie inside."""
    assert value("0.287", ["0.28695", "0.28696"])[0] == "0.286950 (proved)"
    assert value("0.287", ["0.2895", "0.2896"])[1] is Outcome.CORRECTED
    with pytest.raises(NotProved, match="undecided"):
        value("0.287", ["0.28695", "0.2896"])
    assert row(["0.15", "0.2"], paper="[0.1, 0.3]").agrees
    assert not row(["0.09999", "0.10001"], paper="[0.1, 0.1]").agrees


def test_counts_words_and_runs():
    """Counts are compared exactly, runs by their range; words hold, or not."""
    assert row(3, paper="3").agrees
    assert not row(4, paper="3").agrees
    assert row([161, 164, 166], paper="165").agrees
    assert not row([161, 164], paper="165").agrees
    assert row([-13.6, -12.8], paper="-13.4").ours == "-13.60 to -12.80 in 2 runs"
    parts = {"ends": [1.5, 2.5], "of": {"1/4": "hit"}, "none": False}
    for holds in (
        "ends[0] < ends[1]",
        "ends[1] >= 2.5",
        'of[1/4] == "hit"',
        "none != 1",
        "of[1/4]",
    ):
        said = {"what": "c", "paper": "yes", "ours": "{of[1/4]}", "holds": holds}
        assert compared(said, parts).agrees
        assert not compared(said | {"holds": "none"}, parts).agrees
        assert not compared(said | {"holds": "ends[0] > ends[1]"}, parts).agrees
    words = {"what": "c", "paper": "yes", "ours": "{n} of 3", "holds": "all", "why": "{n}"}
    assert compared(words, {"n": 3, "all": True}).agrees
    said = compared(words, {"n": 2, "all": False})
    assert (said.agrees, said.ours, said.reason) == (False, "2 of 3", "2")
    assert not compared(words | {"unstated": True}, {"n": 3, "all": True}).agrees
    assert percent(1, 3) == "33.3%"
    assert percent(1, 0) == "none"


def test_a_table_is_markdown():
    """Bars inside cells are escaped."""
    lines = markdown([Comparison("|v|", "1 | 2", "3", Outcome.REFUTED, "why")])
    assert lines[-1] == "| \\|v\\| | 1 \\| 2 | 3 | **no** | why |"
    assert all(line.count("|") - line.count("\\|") == 6 for line in lines)


def test_the_closed_form_gives_the_proved_orbit():
    """State, trace and twist from the closed form are those of the theorem."""
    own = certified.theorem("elliptic", (0.1003, 0.5419))
    delta = one_one.asymmetry(0.4, 2.0)
    alpha, way, speed = one_one.state(-delta, 2.0)
    assert alpha == pytest.approx(0.4, abs=1e-14)
    assert 1 - way == pytest.approx(float(own["x"][0]), abs=1e-13)
    assert speed == pytest.approx(float(own["v"][0]), abs=1e-13)
    assert one_one.pair_member(delta, 2.0).trace == pytest.approx(float(own["trace"][0]))
    assert one_one.twist(delta, 2.0) == pytest.approx(float(own["twist"][0]), rel=1e-9)
    way, speed = one_one.symmetric_state(0.4, 2.0, 1)
    assert (1 - way, speed) == pytest.approx((0.34352606, 0.7753195), abs=1e-7)
    assert math.isnan(one_one.asymmetry(0.5, 2.0))  # above the pitchfork


def test_the_map_agrees_with_the_census():
    """The map in floats has the orbits that are proved, with their types."""
    run = Run(Runner(1), quick=True)
    small = continuation.mapped(12, run)
    kinds = small.kinds()
    for i in (2, 6, 9):
        for j in (3, 7):
            members = {
                member.name: member.kind[0]
                for member in census(Fraction(float(small.f[j])), Fraction(float(small.R[i])))
            }
            words = "".join(members.get(name, "-") for name in continuation.NAMES)
            assert kinds[i, j] == words


def test_the_landmarks_of_the_branch():
    """Resonances, the end and the zero of the twist are where they are in floats."""
    marks = bifurcation.landmarks()
    assert float(marks.resonances["1/4"][0]) == pytest.approx(0.41519716267356)
    assert float(marks.end[0]) == pytest.approx(0.34782975492277)
    zero = one_one.root(lambda delta: one_one.twist(delta, 2.0), 0.35, 0.37)
    ends = [float(end) for end in marks.twist]
    assert ends == pytest.approx([one_one.pair_member(zero, 2.0).alpha] * 2, abs=1e-9)


def test_the_search_of_the_paper_filters_as_it_says():
    """Slow fixed points and strange determinants are dropped."""
    found = forcing.grid_newton(at(F="1.5"), 3)
    assert found
    assert all(abs(each.v) > 0.05 and 0.1 <= each.determinant <= 5 for each in found)


def test_the_wave():
    """The triangular wave at simple values."""
    q = np.array([0.0, 0.25, 1.0, 1.75, 2.0, 3.5])
    assert sketches.wave(q) == pytest.approx([0, 0.25, 1, 0.25, 0, 0.5])


def test_the_command_writes_a_picture_or_a_table(tmp_path, capsys):
    """The suffix of the file decides what is written."""
    heard = []
    picture, table, text = (tmp_path / f"one.{kind}" for kind in ("svg", "csv", "md"))
    for path in (picture, table, text):
        assert command.run("cover", [path], lambda *words: heard.append(words), quick=True) == 0
    printed = capsys.readouterr().out
    assert "## fig:cover" in printed
    assert "| what | paper | ours | agrees? |" in printed
    assert picture.read_text("utf-8").startswith("<?xml")
    with table.open(newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    assert rows[0] == ["what", "paper", "ours", "agrees", "reason"]
    assert len(rows) == 6
    assert text.read_text("utf-8").startswith("A number agrees")


def test_the_data_of_a_picture_can_be_read_again(tmp_path, capsys):
    """The archive has the table and the numbers of the picture."""
    path = tmp_path / "one.npz"
    assert command.run("fig:cover", [path], lambda _words, _part: None, quick=True) == 0
    archive = load(path)
    assert len(archive["rows"]["what"]) == len(archive["rows"]["reason"]) == 5
    assert archive["parameters"] == PAPER
    assert archive["data"]["q"].shape == archive["data"]["orbit"]["t"].shape


@pytest.mark.slow
def test_the_command_writes_all_into_a_directory(tmp_path, capsys, monkeypatch):
    """Pictures and one table are written, and the times said."""
    chosen = ["fig:cover", "fig:multi-particle"]
    monkeypatch.setattr(command, "labelled", lambda _label: chosen)
    assert command.run("all", [tmp_path / "new"], lambda _words, _part: None, quick=True) == 0
    names = {path.name for path in (tmp_path / "new").iterdir()}
    assert names == {"cover.png", "cover.pdf", "multi-particle.png", "multi-particle.pdf",
                     "comparison.md"}  # fmt: skip
    assert "fig:cover: " in capsys.readouterr().err


@pytest.mark.parametrize(("label", "name"), [("cover", "x.txt"), ("nothing", "x.png")])
def test_bad_requests(label, name, tmp_path):
    """A file of no known kind, or no such figure, is bad input."""
    with pytest.raises(BadInput):
        command.run(label, [tmp_path / name], lambda _words, _part: None)


@pytest.mark.slow
def test_an_interrupt_keeps_what_is_done(tmp_path, capsys, monkeypatch):
    """The tables of what is done before are written, and the status says so."""

    def interrupted(_run):
        raise KeyboardInterrupt

    def stopping(label):
        one = figure(label)
        return one if label == "fig:cover" else replace(one, data="interrupted")

    monkeypatch.setattr(sketches, "interrupted", interrupted, raising=False)
    monkeypatch.setattr(command, "labelled", lambda _label: ["fig:cover", "fig:multi-particle"])
    monkeypatch.setattr(command, "figure", stopping)
    assert command.run("all", [tmp_path], lambda _words, _part: None) == command.INTERRUPTED
    assert "interrupted in fig:multi-particle" in capsys.readouterr().err
    assert "fig:cover" in (tmp_path / "comparison.md").read_text("utf-8")
    assert not (tmp_path / "multi-particle.png").exists()


def test_what_is_not_proved_is_said(capsys, monkeypatch):
    """The other figures go on, and the status is 1."""

    def failing(_run):
        raise NotProved("Lemma 1", "not certain")

    monkeypatch.setattr(sketches, "cover", failing)
    assert command.run("fig:cover", [], lambda _words, _part: None) == 1
    assert "fig:cover: not proved: Lemma 1" in capsys.readouterr().err


def test_parameters_but_for_some():
    """Parameters are exact."""
    assert at(F="3").F == 3
    assert at() == PAPER
