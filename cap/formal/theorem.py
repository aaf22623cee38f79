"""The Coq file of a certificate: its numbers, the computation, the theorem; and it in words."""

from collections.abc import Callable, Sequence
from typing import Any

from cap.checker.kernel.certificate import Certificate
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved
from cap.formal.hints import BOX_BITS, DEPTH, PIECES, Hints, hints
from cap.formal.syntax import JET, interval, jet, number, pair_of_numbers, real, record

PARAMETERS = {"F": "F", "w": "omega", "f": "f", "l": "l", "r": "r"}
KINDS = ("elliptic", "saddle")  # in Statement.v and Data.v

Term = Callable[[Sequence[str]], str]
Fields = list[tuple[str, str]]

_STATED = r"""(** * An orbit: the numbers of a certificate, decided in Coq's kernel

    Written by cap.formal.  To be read: Statement.v, and the theorem here.  No other file of this
    library is loaded before it, so that all words in it are those of Statement.v. *)

From Coq Require Import Reals.
From Cap Require Import Statement.
Open Scope R_scope.

Definition theorem : Prop := {kind}_orbit {parameters} {claims}.

(** The proof *)

From Cap Require Data Check Checked.

Module Computed.
Import Data Check Checked.

Definition numbers : {kind}_data := {data}.

(** Where to look: hints, which do not occur in the theorem. *)

Definition where_to_look : hints := {hints}.
"""
_PROOF = r"""
Lemma computed : passed ({kind}_tests numbers where_to_look) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Definition proof := {kind}_checked numbers where_to_look computed.

End Computed.

Theorem proved : theorem.
Proof. exact Computed.proof. Qed.

Set Printing Width 200.
Print Assumptions proved.
"""
_FAILURES = r"""
Eval vm_compute in failures ({kind}_tests numbers where_to_look).
End Computed.
"""
_ORBIT = (
    "x'' = F cos(omega t) - f sgn x' with F = {F}, omega = {omega}, f = {f} and elastic walls at "
    "{l} and {r}: there is a motion of period T = 2 pi/omega that hits each wall once per period, "
    "and never stops, with a least speed in {least_speed}; from each state (x, v) in {box} at t = "
    "0 a motion that never stops goes to T, and all motions from it end in one state; this map Phi "
    "has one and only one fixed point in that box, with x in {x}, v in {v}; in a neighbourhood of "
    "it Phi is infinitely often differentiable and preserves area; "
)
_WORDS = {
    "elliptic": "its Taylor coefficients there are those of the certificate, up to degree 3; the "
    "fixed point is elliptic with trace in {trace}, and has no resonance of order at most four; in "
    "its Birkhoff normal form z exp(i (Theta + tau_1 |z|^2)) + O(|z|^4) is Theta in "
    "{rotation_angle}, the rotation number |Theta|/(2 pi) in {rotation_number}, and tau_1 in "
    "{twist}, not zero; if Moser's twist theorem holds, then the fixed point is stable, and every "
    "neighbourhood of it contains invariant closed curves around it",
    "saddle": "its derivative there is that of the certificate, with trace in {trace} and the real "
    "eigenvalues m in {outer}, |m| > 1, and 1/m in {inner}: a hyperbolic saddle",
}


def theorem(certificate: Certificate) -> str:
    """Return the Coq file that proves the theorem; raise `NotProved` if it is not of this kind."""
    return _stated(certificate) + _PROOF.format(kind=certificate.theorem)


def failures(certificate: Certificate) -> str:
    """Return the Coq file that prints which tests of Check.v fail."""
    return _stated(certificate) + _FAILURES.format(kind=certificate.theorem)


def words(certificate: Certificate) -> str:
    """Return what the theorem says, in one line."""
    claims = certificate.claims
    shown = {name: str(claim) for name, claim in claims.items()}
    shown["box"] = " x ".join(str(claims["box"][name]) for name in "xv")
    if "multipliers" in claims:
        shown["outer"], shown["inner"] = map(str, claims["multipliers"])
    said = _ORBIT + _WORDS[certificate.theorem]
    return said.format_map(shown | certificate.parameters._asdict())


def _stated(certificate: Certificate) -> str:
    """Return the theorem, and the numbers and the hints of its proof."""
    if certificate.theorem not in KINDS:
        raise NotProved("theorem", "this library of Coq is about elliptic orbits and saddles alone")
    if len(certificate.claims["hit_times"]) != 2:
        raise NotProved("theorem", "this library of Coq is about one hit of each wall per period")
    parameters = _parameters(certificate)
    numbers = [(f"{name}_", number(text)) for name, text in parameters]
    return _STATED.format(
        kind=certificate.theorem,
        parameters=" ".join(real(text) for _, text in parameters),
        claims=record(_claims(certificate, "", [], interval)),
        data=record(_claims(certificate, "_", numbers, pair_of_numbers)),
        hints=record(_hints(hints(certificate))),
    )


def _parameters(certificate: Certificate) -> Fields:
    """Return the parameters with their names in Coq."""
    values = certificate.parameters._asdict()
    return [(name, str(values[key])) for name, key in PARAMETERS.items()]


def _claims(certificate: Certificate, end: str, parameters: Fields, term: Term) -> Fields:
    """Return the fields of the claims in Statement.v, or with ``end`` "_" of those in Data.v."""
    kind, c = certificate.theorem, certificate.claims
    ends = {"box_x": c["box"]["x"], "box_v": c["box"]["v"], "least_speed": c["least_speed"]}
    for name, key in (("hit", "hit_times"), ("speed", "hit_speeds"), ("forcing", "hit_forcing")):
        ends |= {f"{name}_{n}": claim for n, claim in enumerate(c[key], start=1)}
    orbit = parameters + _fields(ends | {"trace": c["trace"]}, end, term)
    name = "of_orbit" if kind == "elliptic" else "of_saddle"
    more = _elliptic(c, end, term) if kind == "elliptic" else _saddle(c, end, term)
    return [(name + end, record(orbit, "    ")), *more]


def _elliptic(c: dict[str, Any], end: str, term: Term) -> Fields:
    """Return the fields that an elliptic orbit has."""
    fields = []
    for name, row in zip("xv", c["jacobian"], strict=True):
        entries = [c[name], *row, *(c["taylor"][name][power] for power in JET)]
        fields.append((f"taylor_{name}{end}", jet([claim.text for claim in entries], term)))
    last = {"angle": c["rotation_angle"], "rotation": c["rotation_number"], "twist": c["twist"]}
    return fields + _fields(last, end, term)


def _saddle(c: dict[str, Any], end: str, term: Term) -> Fields:
    """Return the fields that a saddle has."""
    entries = [c["x"], c["v"], *c["jacobian"][0], *c["jacobian"][1], *c["multipliers"]]
    names = ("state_x", "state_v", "x_x", "x_v", "v_x", "v_v", "outer", "inner")
    return _fields(dict(zip(names, entries, strict=True)), end, term)


def _fields(claims: dict[str, Enclosure], end: str, term: Term) -> Fields:
    """Return fields that are intervals."""
    return [(name + end, term(claim.text)) for name, claim in claims.items()]


def _hints(found: Hints) -> Fields:
    """Return the fields of ``hints`` in Data.v."""
    ranges = {"d_": found.delta, "window_1": found.windows[0], "window_2": found.windows[1]}
    ranges["d_box"] = found.box_delta
    sizes = {"pieces": PIECES, "depth": DEPTH, "bits": found.bits, "box_bits": BOX_BITS}
    pairs = [(name, pair_of_numbers(ends)) for name, ends in ranges.items()]
    return [("kind_", found.kind), *pairs, *((name, str(n)) for name, n in sizes.items())]
