"""The page to play with, without a browser: what is read, what is shown, what is escaped."""

import time
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from bokeh.document import Document
from bokeh.events import Tap

import cap
from cap.errors import BadInput
from cap.explore.play.controls import LIMITS, Controls, _decimal
from cap.explore.play.page import Page
from cap.explore.play.prover import News, Proof
from cap.explore.play.sea import GREY, Sea
from cap.explore.play.worlds import Oscillator
from cap.parameters import PAPER

STORED = Path(__file__).parents[2] / "certificates"


@pytest.fixture(scope="module")
def page():
    """Return the page of a tab, in a document."""
    page = Page(Oscillator(PAPER))
    page.show(Document())
    return page


def test_sliders_write_exact_numbers():
    """A multiple of 1/1000, and not the double next to it; texts may be any number."""
    changed = []
    controls = Controls(PAPER, lambda: changed.append(1))
    f = controls._each[list(LIMITS).index("f")]
    f.slider.value = 0.1 + 0.2
    assert (f.text.value, controls.read().f, len(changed)) == ("0.3", Fraction(3, 10), 1)
    f.text.value = "1/7"
    assert (controls.read().f, f.slider.value, len(changed)) == (Fraction(1, 7), 1 / 7, 2)


@pytest.mark.parametrize("text", ["", "x", "1e9", "-1", "__import__('os')", "7"])
def test_no_number_past_the_limits(text):
    """What is typed is a number within the limits of the page, or an error in one line."""
    controls = Controls(PAPER, lambda: None)
    controls._each[list(LIMITS).index("f")].text.value = text
    with pytest.raises(BadInput):
        controls.read()


@pytest.mark.parametrize(("value", "text"), [(0.1, "0.1"), (3.0, "3"), (0.0, "0"), (-2.5, "-2.5")])
def test_decimals(value, text):
    """The shortest."""
    assert _decimal(value) == text


def test_the_portrait_fills_and_ends():
    """More pixels each time; the colours are those of what is listed."""
    sea = Sea(PAPER)
    sea.fill()
    first = int((sea.raster > 0).sum())
    sea.fill()
    assert int((sea.raster > 0).sum()) > first > 0
    assert {kind.partition(":")[0] for _, kind in sea.lines()} >= {"chaotic", "never turns"}
    assert len(set(sea.colours.tolist()) - {GREY}) > 1


def test_attractors_are_marked():
    """Each state of a cycle that attracts, where the walls are not elastic."""
    sea = Sea(replace(PAPER, F=Fraction(3), e=Fraction(4, 5)))
    x, _, colours = sea.marks()
    assert len(x) == sum(end.period for end in sea.ends) > 0
    assert colours[0] in [colour for colour, _ in sea.lines()]


def test_a_click(page):
    """Shows the orbit from there; the mass moves along it."""
    page._tapped(Tap(page.portrait, x=0.5, y=1.0))
    assert page.mass.told.text.startswith("orbit of (x, v) = (0.5, 1)")
    before = page.mass._now.data["x"]
    page.mass.move(0.1)
    assert page.mass._now.data["x"] != before
    page._tapped(Tap(page.portrait, x=50.0, y=1.0))
    assert page.mass.told.text.startswith("no orbit starts at (50.0, 1.0)")


@pytest.mark.parametrize("words", ["journal=x", "out=x", "f=1", "digits", "=1", "executor=1"])
def test_what_may_not_be_asked_for(page, words):
    """No file is named from the page, and nothing is given twice."""
    page.theorem.more.value = words
    page.theorem.prove()
    assert "There is nothing to prove" in page.theorem.result.text
    page.theorem.more.value = ""


def test_what_strangers_say_is_escaped(page):
    """As text."""
    page.theorem._finish(News("failed", "<script>alert(1)</script>"))
    assert "<script>" not in page.theorem.result.text
    assert "&lt;script&gt;" in page.theorem.result.text


@pytest.mark.parametrize("name", ["elliptic", "capture", "periodic-5", "saddle", "particles"])
def test_a_theorem_typeset(name):
    """Its words and its numbers, and what it cites; nothing of them is markup of its own."""
    verified = cap.verify_certificate(STORED / f"{name}.json")
    page, paper = verified._repr_html_(), verified._repr_latex_()
    assert f"Theorem ({verified.theorem})" in page
    assert page.count("<li>") == page.count("</li>") > 2
    assert page.count("<tr>") == paper.count("\\\\\n") > 2
    assert page.count(r"\(") == page.count(r"\)")
    assert all(cited["reference"][:9] in page for cited in verified.certificate["cites"])


def test_enclosures_are_short():
    """The digits in common, and the others of both ends; all of it is what was claimed."""
    x = cap.verify_certificate("elliptic").claims["x"]
    assert str(x) == "[0.10027988984419672814745886317534, 0.10027988984419672814745886317535]"
    assert repr(x) == "0.1002798898441967281474588631753[4..5]"
    assert x._repr_latex_() == f"${x!r}$"


def told(proof, kind):
    """Wait for the end of a proof; return its last news, which must be of this kind."""
    end = time.monotonic() + 120
    while time.monotonic() < end:
        for news in proof.news():
            if news.kind != "progress":
                proof.stop()
                assert news.kind == kind
                return news
        time.sleep(0.1)
    raise TimeoutError


@pytest.mark.slow
def test_a_proof_in_a_process():
    """Proved, with the certificate; not proved; bad input; and killed."""
    assert "VERIFIED" in told(Proof("saddle", {}), "proved").words
    assert "elastic" in told(Proof("saddle", {"e": "1/2"}), "bad input").words
    proof = Proof("conservative", {})
    proof._process.kill()
    assert "killed" in told(proof, "failed").words
