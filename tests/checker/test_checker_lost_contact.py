"""Where a contact is lost as its speed goes to 0: what is true of it, and lies, each rejected."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import pytest
from branches import certificate
from own_systems import rejected

from cap.certificate.writer import dumps
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.lost_contact import LostContact
from cap.checker.system.model import Guard, Mode, Model
from cap.checker.system.passage import Contact
from cap.checker.system.polynomial import ONE, Polynomial, variable
from cap.checker.verdict import check, words

pytestmark = pytest.mark.usefixtures("legs_followed_once")

BESIDE = "does not contain the enclosure computed"
x, v, e = map(variable, "xve")


def lost(name):
    """Return what a certificate claims of its lost contact."""
    (end,) = certificate(name)["claims"]["lost"]
    return end


def test_a_wall_as_far_as_the_spring_reaches():
    """The gap is the amplitude of the motion without the wall, to 20 digits."""
    low, high = map(Fraction, lost("wall")["at"])
    with mpmath.workdps(40):
        w, d = mpmath.mpf(5) / 2, mpmath.mpf(1) / 20
        R = 1 / mpmath.sqrt((1 - w * w) ** 2 + (2 * d * w) ** 2)
        assert mpmath.mpf(low.numerator) / low.denominator < R
        assert mpmath.mpf(high.numerator) / high.denominator > R
    assert high - low < Fraction(1, 10**19)


def test_two_curves_meet():
    """Orbits with one contact more begin where those without it graze: there, and then."""
    (graze,) = certificate("graze")["claims"]["grazes"]
    end = lost("thrice")
    for key in ("at", "time"):
        (a, b), (c, d) = ([Fraction(q) for q in each[key]] for each in (graze, end))
        assert max(a, c) < min(b, d)
        assert max(b, d) - min(a, c) < Fraction(1, 10**18)


def test_the_sentence():
    """It says which contact is lost, what that means, and where the parameter goes."""
    said = words(check(dumps(certificate("wall")).encode(), lambda _: None))
    assert "at which the speed of contact 1 is 0, with gap in [0.19026059766179763" in said
    assert "the contact leaves the state as it is" in said
    assert "the guard would rise through 0 at this contact" in said
    assert "gap takes on it all values in [0.189, 0.190260597]" in said


def test_a_certificate_without_any_is_as_before():
    """The lists are left out."""
    given = certificate("graze")
    assert "lost" not in given["claims"]
    assert "lost" not in given["hints"]


def moved(key):
    """Return what moves an interval by its width."""

    def change(given):
        end = given["claims"]["lost"][0]
        a, b = map(Fraction, end[key])
        end[key] = [str(b), str(2 * b - a)]

    return change


def of(part, key, value):
    """Return what changes an entry."""
    return lambda given: given[part]["lost"][0].__setitem__(key, value)


def short_beside(given):
    """Let the short cell lie where the contact is not yet lost."""
    (end,) = given["claims"]["lost"]
    shift = Fraction(1, 10**22) * (1 if Fraction(end["short"]["slope"][-1]) > 0 else -1)
    rate = [Fraction(q) for q in end["short"]["slope"]]
    end["short"]["ends"] = [str(Fraction(q) + shift) for q in end["short"]["ends"]]
    end["short"]["centre"] = [
        str(Fraction(c) + shift * r) for c, r in zip(end["short"]["centre"], rate, strict=True)
    ]


def longer(given):
    """Let the piece end beyond the zero of another cell."""
    ends = given["claims"]["lost"][0]["piece"]["ends"]
    a, b = map(Fraction, ends)
    ends[0], ends[1] = str(a - 30 * (b - a)), str(b + 30 * (b - a))


def elsewhere(given):
    """Let the piece go on from a cell that it does not meet."""
    cell = int(given["claims"]["lost"][0]["cell"])
    far = 0 if cell > len(given["claims"]["cells"]) / 2 else len(given["claims"]["cells"]) - 1
    given["claims"]["lost"][0]["cell"] = str(far)


INSIDE = "K does not lie in the interior of the box of a cell"
LIES = {
    "no such contact": ("wall", of("claims", "contact", "2"), "no such contact to be lost"),
    "another contact": ("thrice", of("claims", "contact", "2"), "a guard may|may not be monotone"),
    "the last contact": ("thrice", of("claims", "contact", "3"), "a guard may|may not be monotone"),
    "on no cell": ("wall", of("claims", "cell", "4000"), r"lost\[0\] is on no cell"),
    "another cell": ("wall", elsewhere, "is not certain to be one curve with its cell"),
    "another place": ("wall", moved("at"), BESIDE),
    "another time": ("wall", moved("time"), BESIDE),
    "a longer piece": ("wall", longer, INSIDE),
    "a short cell beside": ("wall", short_beside, f"{INSIDE}|{BESIDE}|may not change|not certain"),
    "no preconditioner": ("wall", of("hints", "piece", [["0"] * 3] * 3), INSIDE),
    "no short preconditioner": ("wall", of("hints", "short", [["0"] * 3] * 3), INSIDE),
    "no cuts": ("wall", of("hints", "cuts", [{}]), "no cuts, and no Lemma M, for wall"),
    "one piece": ("wall", of("hints", "cuts", [{"wall": []}]), "0 at both ends of a piece"),
    "no hints": ("wall", lambda given: given["hints"].pop("lost"), "hints.lost are not those"),
    "no claim": ("wall", lambda given: given["claims"].pop("lost"), "hints.lost are not those"),
    "a wider range": (
        "wall",
        lambda given: given["claims"].update(range=["0.189", "0.1903"]),
        "may not go through all of claims.range",
    ),
}


@pytest.mark.parametrize("what", LIES)
def test_lies(what):
    """Each is rejected for its own reason."""
    name, change, reason = LIES[what]
    given = certificate(name)
    change(given)
    rejected(given, reason)


def on_zero(*_):
    """Return an interval around 0."""
    return Interval.enclosing(-1, 1, 96)


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("change", on_zero, r"lost\[0\]: what comes to 0 may not be monotone"),
        ("speed", on_zero, r"lost\[0\]: what comes to 0 may not change its sign"),
        (
            "speed",
            lambda *_: Interval.enclosing(-2, -1, 96),
            "what comes to 0 may not change its sign",
        ),
    ],
)
def test_what_is_needed_of_the_speed(monkeypatch, name, value, reason):
    """It is monotone and changes its sign."""
    given = certificate("wall")
    monkeypatch.setattr(LostContact, name, value)
    rejected(given, reason)


def test_the_sign_of_the_speed(monkeypatch):
    """It is 0 where the speed may be 0."""
    for low, high, sign in ((-2, -1, 1), (1, 2, -1), (-1, 2, 0), (0, 2, 0), (-2, 0, 0)):
        u = Interval.enclosing(low, high, 96)
        monkeypatch.setattr(LostContact, "speed", lambda *_, u=u: u)
        assert LostContact.__new__(LostContact).sign([]) == sign


def test_a_short_cell_beside_its_piece(monkeypatch):
    """The short cell lies on the piece."""
    given, theorem = certificate("wall"), "cap.checker.theorems.contacts_branch.ContactsBranch"
    monkeypatch.setattr(f"{theorem}.lies", lambda *_: False)
    rejected(given, r"lost\[0\] is not certain to be on its piece")


# what is needed of the reset


class Curve:
    """A curve of orbits with one contact, x = 0, of a mode with x' = v."""

    def __init__(self, reset, *, divisor=ONE, to="m", zeros=1, moved=False):
        self.model = Model(
            ("x", "v", "e"),
            Fraction(1),
            {
                mode: Mode(
                    {"x": v, "v": ONE, "e": Polynomial({})},
                    {"floor": Guard(x, reset, (to,), divisor)},
                )
                for mode in ("m", "k")
            },
        )
        self.contacts, self.equations, self.orbit = [Contact("m", "floor", to)], self, self
        self.count, self.moved = zeros, moved
        self.n, self.passages, self.flights = 3, [self], self
        self.pi = interval(3)

    def is_moved(self, _k):
        """Return whether a symmetry moves the flight."""
        return self.moved

    def zeros(self, _k):
        """Return how often the guard vanishes after the contact."""
        return {"floor": self.count}

    def guard(self, _k):
        """Return the guard of the contact."""
        return self.model.modes["m"].guards["floor"]

    def expanded(self, w):
        """Return the unknowns."""
        return w

    def places(self, _k):
        """Return where those of the contact stand."""
        return 0, 0

    def start(self, w, _k):
        """Return its time."""
        return w[0]

    def clock(self, _t):
        """Return cos and sin."""
        return interval(1), interval(0)


def interval(a, b=None):
    """Return an interval."""
    return Interval.enclosing(Fraction(a), Fraction(a if b is None else b), 60)


W = [interval(0), interval(0), interval(-1, 1), interval("0.5", "0.9")]


def confirm(reset, **how):
    """Confirm what is needed of the contact over a box, where e is between 1/2 and 9/10."""
    LostContact(Curve(reset, **how), 0).confirm(W)


def test_resets_that_lose_a_contact():
    """The speed is turned, by a number, by a variable that is positive, or over a divisor."""
    confirm({"v": v * Fraction(-1, 2)})
    confirm({"v": v * e * -1})
    confirm({"v": v * -1}, divisor=e + 1)
    confirm({"v": Polynomial({})})


@pytest.mark.parametrize(
    ("reset", "how", "reason"),
    [
        ({"v": v * e * -1}, {"to": "k"}, "leads to another mode"),
        ({"v": v * -1}, {"moved": True}, "a symmetry moves the flight"),
        ({"v": v * -1}, {"zeros": 0}, "may not vanish after it"),
        ({"v": v * -1, "x": x + e}, {}, "a contact of speed 0 may move x"),
        ({"v": v * -1 + 1}, {}, "a contact of speed 0 may move v"),
        ({"v": v * -1, "e": e * 2}, {}, "a contact of speed 0 may move e"),
        ({"v": v * Fraction(1, 2)}, {}, "a contact may not turn the speed"),
        ({"v": v * (e + Fraction(-3, 5))}, {}, "a contact may not turn the speed"),
        ({"v": v * -1}, {"divisor": e + Fraction(-3, 5)}, "a contact of speed 0|may not turn"),
        ({"v": v * -1}, {"divisor": e * -1}, "may not turn the speed"),
        ({}, {}, "a contact may not turn the speed"),
    ],
)
def test_resets_that_may_not(reset, how, reason):
    """Each is refused for its own reason."""
    with pytest.raises(Rejected, match=reason):
        confirm(reset, **how)


def test_division():
    """A product is divided by its factors, and what is none is not."""
    a, b = x * v * 2 + e + 1, v * v + x * e * Fraction(-1, 3)
    assert (a * b).divided(b) == a
    assert (a * b + 1).divided(b) is None
    assert Polynomial({}).divided(a) == Polynomial({})
    assert a.divided(Polynomial({})) is None
    assert (variable("x") * 3).divided(Polynomial({(): Fraction(2)})) == x * Fraction(3, 2)


def test_division_ends():
    """A quotient of more than so many terms is not looked for."""
    many = sum((variable(f"y{k}") * variable("z") for k in range(150)), Polynomial({}))
    assert many.divided(variable("z")) is None
