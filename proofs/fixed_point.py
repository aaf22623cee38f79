"""The theorems on a fixed point P* of Φⁿ: their setting, and the way in which each is proved.

Φ is the stroboscopic map of x'' = F cos ωt - f sgn x' - μ x', l < x < r; v -> -e v at the walls.

    Lemma 1      P* exists near a guess, and its orbit has the events guessed
    conclusion   what the theorem says of P*: its type, its multipliers, its twist
    Lemma 2      P* is alone in a box, all orbits from which have these events
                 what the theorem says of sets in the box: a remainder, a basin

`proof_of` goes this way; a theorem adds its conclusion.  `cap.proofs.orbit` has the claims on the
orbit.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

from cap.certificate.writer import Pair, Rounding, Units, window
from cap.errors import BadInput, NotProved
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.maps import fixed_point
from cap.maps.fixed_point import FixedPoint, Neighbourhood, Reach, Start
from cap.option import Option
from cap.parameters import Parameters
from cap.particles.guess import Guess
from cap.proofs import certified
from cap.proofs.certified import Content
from cap.runner import Runner
from cap.sets import interval


@dataclass(frozen=True)
class Setting:
    """The parameters of a theorem, the guess that it starts from, and how sharp it is to be.

    ``digits`` are claimed, ``guard`` more are computed; ``widest``: P* is to be the only one in a
    box as large as can be found, not just in some.  ``progress`` is told, in a few words, how
    far a long proof is; ``runner`` does what can be done in pieces.  ``options`` are those of the
    theorem that are given, by name.
    """

    parameters: Parameters
    guess: Start | Guess
    digits: int
    guard: int = 15
    widest: bool = True
    progress: Callable[[str], None] = field(default=lambda _: None, compare=False)
    runner: Runner = field(default_factory=Runner, compare=False)
    options: Mapping[str, Any] = field(default_factory=dict)

    def of(self, option: Option) -> Any:
        """Return the value of an option that the theorem declares; without one its default."""
        return self.options.get(option.name, option.default)

    @property
    def start(self) -> Start:
        """The guess, of an orbit of one mass."""
        if not isinstance(self.guess, Start):
            raise BadInput("the guess is about several masses, the theorem about one")
        return self.guess

    @property
    def particles(self) -> Guess:
        """The guess, of an orbit of several masses."""
        if not isinstance(self.guess, Guess):
            raise BadInput("the theorem is about several masses: give them, as --masses 1,9/10")
        return self.guess

    @property
    def units(self) -> Units:
        """The natural units."""
        return Units.of(self.parameters)

    @property
    def rounding(self) -> Rounding:
        """How claims are rounded."""
        return Rounding(self.digits)

    @property
    def scale(self) -> tuple[Fraction, Fraction]:
        """The natural units of the state (x, v)."""
        return self.units.length, self.units.speed

    @property
    def precise(self) -> int:
        """Digits of the fixed point that are computed, relative to the natural units."""
        return self.digits + self.guard

    @property
    def bits(self) -> int:
        """Working precision: what cancels are the walls' distance from 0, and F/ω², against R."""
        p = self.parameters
        large = max(abs(p.l), abs(p.r), p.F / p.omega**2) / p.R
        return bits(self.precise + max(0, interval.decade(large))) + 80

    @property
    def checker_bits(self) -> int:
        """Precision for the checker, of derivatives up to the third order."""
        return self.checker_bits_to(3)

    def checker_bits_to(self, order: int) -> int:
        """Precision for the checker, whose rounding is absolute: the least unit decides.

        Derivatives up to this order have powers of the units.
        """
        units = self.units
        least = min(*self.scale, units.time, units.force, 1 / units.speed, 1 / units.area)
        return self.bits + bits(max(0, -interval.decade(least)) * order) + 40


Proof = Callable[[Fraction], dict[str, Any]]
"""What is left to do of a proof when all that does not depend on the size of the box is done.

Called with the part of the largest box found that is to be claimed, less than 1, so that a looser
arithmetic can follow, it returns the certificate, or raises `NotProved`.
"""


@dataclass(frozen=True)
class Located:
    """P*, proved to exist: what the lemmas of all these theorems start from."""

    setting: Setting
    osc: Oscillator[Any]
    point: FixedPoint

    @classmethod
    def of(cls, setting: Setting) -> "Located":
        """Prove Lemma 1, at the current precision."""
        osc = oscillator(setting.parameters)
        return cls(setting, osc, lemma_1_fixed_point(osc, setting))

    @cached_property
    def reach(self) -> Reach:
        """The half-widths of the largest rectangle found with which Lemma 2 succeeds, or of one."""
        search = fixed_point.some_neighbourhood
        if self.setting.widest:
            search = fixed_point.largest_neighbourhood
        return search(self.osc, self.point, self.setting.scale).reach


class Around(NamedTuple):
    """A ``part`` of the largest rectangle found: the ``box`` claimed in it, with Lemma 2 proved."""

    part: Fraction
    proved: Neighbourhood
    box: dict[str, Pair]


Conclusion = Callable[[Located], Callable[[Around], Content]]
"""What a theorem says more of P*.

What does not depend on the size of the box is proved at once, the rest when the box is known.
"""


class Form(NamedTuple):
    """How theorems speak of orbits: the claims, the hint on the events, and the parameters."""

    claims: Callable[[Located, Around], dict[str, Any]]
    windows: str
    parameters: Callable[[Parameters], dict[str, str]]


def proof_of(theorem: str, setting: Setting, form: Form, conclusion: Conclusion) -> Proof:
    """Prove a theorem on P* up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    parameters = form.parameters(setting.parameters)
    with interval.workprec(setting.bits):
        orbit = Located.of(setting)
        conclude = conclusion(orbit)
        reach = orbit.reach

    def whole(part: Fraction) -> dict[str, Any]:
        with interval.workprec(setting.bits):
            proved, box = lemma_2_uniqueness(orbit.osc, orbit.point, _times(part, reach))
            around = Around(part, proved, box)
            claims, hints = conclude(around)
            content = form.claims(orbit, around) | claims, _hints(orbit, around, form) | hints
            return assembled(theorem, setting, parameters, content)

    return whole


def _times(part: Fraction, reach: Reach) -> Reach:
    return part * reach[0], part * reach[1]


def _hints(orbit: Located, around: Around, form: Form) -> dict[str, Any]:
    """Return what the checker needs and does not trust."""
    setting, point, exact = orbit.setting, orbit.point, interval.exact_decimal
    return {
        "bits": str(setting.checker_bits),
        "centre": [exact(value) for value in point.hint.centre],
        "radius": exact(point.reach[0] / setting.units.length),
        "preconditioner": [[exact(value) for value in row] for row in point.hint.matrix],
        form.windows: [window(event.window) for event in around.proved.expected],
    }


def assembled(
    theorem: str,
    setting: Setting,
    parameters: dict[str, str],
    content: Content,
) -> dict[str, Any]:
    """Return a certificate from its claims and hints."""
    return certified.assembled(theorem, parameters, setting.digits, content)


def settled(theorem: str, setting: Setting, parameters: dict[str, str], content: Content) -> Proof:
    """Return the proof of a certificate where there is no box whose size is left to choose."""
    proved = assembled(theorem, setting, parameters, content)
    return lambda _part: proved


def bits(digits: int) -> int:
    """Return how many bits hold as many decimal digits, log2(10) < 10/3 each."""
    return digits * 10 // 3 + 1


def lemma_1_fixed_point(osc: Oscillator[Any], setting: Setting) -> FixedPoint:
    """*Statement.* Φⁿ has a fixed point P* near the guess; its orbit has the itinerary guessed.

    *Computed.* A tiny rectangle S around a refined guess: the itinerary over S (each event exists,
    is the only one in its window and transverse, and nothing else happens), (Φⁿ)' over S by
    flights and saltation matrices, and Krawczyk's inclusion K(S) in the interior of S.
    """
    return fixed_point.prove(osc, setting.start, setting.precise, setting.scale)


def lemma_2_uniqueness(
    osc: Oscillator[Any], point: FixedPoint, reach: Reach
) -> tuple[Neighbourhood, dict[str, Pair]]:
    """*Statement.* P* is the only fixed point in an explicit box, and all orbits from the box
    have the same itinerary.

    *Computed.* As in Lemma 1 over Taylor models, on the rectangle of half-widths ``reach``.  The
    box contains P*, so the one fixed point of the rectangle is in the box.
    """
    around = fixed_point.neighbourhood(osc, point, reach)
    box = {}
    for name, centre, half, where in zip("xv", point.hint.centre, reach, point.box, strict=True):
        box[name] = inside(centre, half)
        lower, upper = interval.ends(where)
        if not Fraction(box[name][0]) < lower <= upper < Fraction(box[name][1]):
            raise NotProved("Lemma 2", "P* may leave the box", {name: where, "box": box[name]})
    return around, box


def inside(centre: Fraction, half: Fraction) -> Pair:
    """Return short decimals [lower, upper] inside [centre - half, centre + half]."""
    places = max(0, 3 - interval.decade(half))
    scale = 10**places
    lower, upper = -(-(centre - half) * scale // 1), (centre + half) * scale // 1
    return [interval.decimal(Fraction(end, scale), places) for end in (lower, upper)]
