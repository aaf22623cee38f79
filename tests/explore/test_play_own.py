"""The page to play with, about a model of two variables, without a browser."""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from bokeh.document import Document
from bokeh.events import Tap

from cap.checker.verdict import check
from cap.errors import BadInput, NotProved
from cap.explore import explorer
from cap.explore.play.controls import OwnControls
from cap.explore.play.own_sea import OwnSea, confirm
from cap.explore.play.own_theorem import OwnTheorem, prove
from cap.explore.play.page import Page
from cap.explore.play.sea import EMPTY
from cap.explore.play.worlds import world
from cap.floats.models.subject import Subject
from cap.system.files import load

EXAMPLES = Path(__file__).parents[2] / "examples"


def model(name, **values):
    """Return an example at values of its parameters."""
    return Subject(load(EXAMPLES / f"{name}.py", values))


@pytest.fixture(scope="module")
def page():
    """Return the page of a tab about the ball, in a document."""
    page = Page(world(model("ball")))
    page.show(Document())
    return page


def test_parameters_of_the_file(page):
    """Each has a slider; the model is read again at exact values, and not if nothing changed."""
    controls = OwnControls(model("ball"), lambda: None)
    assert [control.name for control in controls._each] == ["A", "e", "g"]
    assert controls._each[0].limits == (0, Fraction(18, 5))
    before = controls.read()
    assert controls.read() is before
    controls._each[0].text.value = "13/10"
    assert controls.read().loaded.values["A"] == Fraction(13, 10)
    controls._each[1].text.value = "3/2"  # within the limits, and no restitution
    with pytest.raises(BadInput, match="restitution"):
        controls.read()


def test_the_portrait_fills(page):
    """The pixels have the colours of the ends that are listed; what attracts is marked."""
    sea = OwnSea(model("ball"))
    for _ in range(5):
        sea.fill()
    shown = set(np.unique(sea.raster)) - {EMPTY}
    assert shown <= set(sea.colours.tolist())
    assert len(shown) == len(list(sea.lines())) == 2
    marked = np.column_stack(sea.marks()[:2])
    assert np.abs(marked - [2.0585768, -2.631429]).max(axis=1).min() < 1e-6


def test_a_part_that_is_looked_at():
    """Seeds lie there."""
    box = 1.5, 2.5, -3.0, -2.0
    sea = OwnSea(model("ball"), box)
    assert sea.box == box
    assert (sea.states >= [1.5, -3.0]).all()
    assert (sea.states <= [2.5, -2.0]).all()


def test_a_click(page):
    """The orbit of the state has its events and its walls, and goes on."""
    page._tapped(Tap(page.portrait, x=2.0585768, y=-2.631429))
    assert page.state == (2.0585768, -2.631429)
    assert "table  fly -> fly" in page.mass.told.text
    assert len(page.mass._walls.data["z"]) == 1
    page.mass.move(0.1)
    assert page.mass._now.data["t"][0] > 0


def test_a_click_under_the_table(page):
    """It is said in a line."""
    page._tapped(Tap(page.portrait, x=-100.0, y=0.0))
    assert page.mass.told.text.count("\n") == 0
    assert "mode" in page.mass.told.text


def test_a_proof():
    """Of the orbit near a state, and of what a search finds; the certificate stands by itself."""
    told = []
    asked = {"model": str(EXAMPLES / "ball.py"), "values": {"A": Fraction(13, 10)}}
    near = prove("contacts", {**asked, "orbit": [2.2, -2.6], "digits": "12"}, told.append)
    assert near.certificate["digits"] == "12"
    check(near.data, lambda _: None)
    assert "VERIFIED" in str(near)
    assert any("proving" in words for words in told)
    assert json.loads(prove("contacts", asked, told.append).data)["claims"]["unstable"] == "0"


@pytest.mark.parametrize(
    ("more", "why"),
    [
        ({"digits": "0"}, "digits"),
        ({"period": "x"}, "period"),
        ({"orbit": [0.0, 0.0]}, "infinitely many contacts accumulate"),
    ],
)
def test_no_proof(more, why):
    """One line says why."""
    asked = {"model": str(EXAMPLES / "ball.py"), "values": {}}
    with pytest.raises((BadInput, NotProved), match=why):
        prove("contacts", {**asked, **more}, lambda _: None)


@pytest.mark.parametrize("text", ["journal=/tmp/x", "jobs=2", "model=a.py", "digits", "__x__=1"])
def test_options_that_are_none(text):
    """Nothing is taken from the page but digits and periods."""
    panel = OwnTheorem(lambda: (model("ball"), None))
    panel.more.value = text
    panel.prove()
    assert "There is nothing to prove" in panel.result.text


@pytest.mark.parametrize(
    ("name", "why"),
    [("coupled_masses", "two variables: this one has p, q, u, v"), ("clock", "with a clock")],
)
def test_what_the_page_is_not_about(name, why, capsys):
    """One line, and status 2."""
    with pytest.raises(BadInput, match=why):
        confirm(model(name))
    words = ["play", "--model", str(EXAMPLES / f"{name}.py"), "--no-browser"]
    assert explorer.main(words) == 2
    assert capsys.readouterr().err.startswith("error: the page is about models")
