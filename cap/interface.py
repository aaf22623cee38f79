"""The Python interface: theorems proved, and certificates verified, as objects.

A `Verified` exists only of a certificate that the independent checker has just accepted.  Whatever
fails raises `BadInput` (the request makes no sense) or `NotProved` (which never says "false").
"""

import json
import math
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from inspect import Parameter, signature
from pathlib import Path
from typing import Any, Unpack

from cap.certificate import report, typeset
from cap.certificate.latex import macros
from cap.checker.kernel import shapes
from cap.checker.kernel.certificate import Certificate
from cap.checker.verdict import check, words
from cap.command.outcome import content, found, why
from cap.errors import BadInput, NotProved
from cap.files import replacing
from cap.keywords import Options, System
from cap.parameters import PAPER, Parameters, exact
from cap.words import digits, unread

__all__ = [
    "BadInput",
    "Enclosure",
    "NotProved",
    "Verified",
    "prove_theorem",
    "verify_certificate",
]

Pair = tuple[float, float]
_NOT_OPTIONS = ("theorem", "list", "all", "out", "own")  # of the command line alone


@dataclass(frozen=True, repr=False)
class Enclosure:
    """A claim about a real number: it lies in [lower, upper].  Both ends are exact.

    ``str`` gives the enclosure in the decimals of the certificate, ``repr`` the digits that both
    ends have in common, and the others of both: 0.1027[1..2] is [0.10271, 0.10272].
    """

    lower: Fraction
    upper: Fraction
    text: str = field(compare=False)

    @property
    def floats(self) -> Pair:
        """Doubles (a, b), rounded outwards: a <= lower and upper <= b."""
        return _outwards(self.lower, self.upper)

    @property
    def width(self) -> Fraction:
        """The difference upper - lower."""
        return self.upper - self.lower

    def __contains__(self, number: Fraction | float | str) -> bool:
        """Whether lower <= number <= upper; a float stands for itself, exactly."""
        return self.lower <= Fraction(number) <= self.upper

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return digits(*self.text.strip("[]").split(", "))

    def _repr_latex_(self) -> str:
        return f"${self!r}$"


@dataclass(frozen=True, repr=False, eq=False)
class Verified:
    """A theorem whose certificate the checker has accepted; ``print`` gives the checker's verdict.

    ``data`` is the certificate, byte for byte; ``steps`` are those of the checker's proof, in
    words; ``checked`` is what the checker has read.
    """

    data: bytes
    steps: tuple[str, ...]
    checked: Certificate

    @property
    def theorem(self) -> str:
        """The name of the theorem."""
        return self.checked.theorem

    @cached_property
    def sentence(self) -> str:
        """The theorem in the checker's words, with all that it assumes."""
        return words(self.checked)

    @cached_property
    def certificate(self) -> dict[str, Any]:
        """The certificate as it is stored: strings in lists and dictionaries."""
        stored: dict[str, Any] = json.loads(self.data)
        return stored

    @property
    def parameters(self) -> dict[str, Any]:
        """The exact parameters that the theorem has (two theorems are about all f).

        ``masses``, where it has them, is a tuple; a system is as the checker has read it.
        """
        return {name: getattr(self.checked.parameters, name) for name in self._names}

    @cached_property
    def claims(self) -> dict[str, Any]:
        """The claims, exactly, in the shape that ``certificates/FORMAT.md`` gives to them.

        An enclosure is an `Enclosure`, another number a `Fraction` (or an int); words are words.
        """
        claims: dict[str, Any] = _mapped(self.checked.claims, _exact)
        return claims

    @cached_property
    def floats(self) -> dict[str, Any]:
        """The claims in doubles: a pair (a, b), rounded outwards, for each enclosure or fraction.

        Of a bound or an exact number q, too, a <= q <= b.
        """
        floats: dict[str, Any] = _mapped(self.claims, _doubles)
        return floats

    def report(self) -> str:
        """Return the theorem as ``cap.prove`` prints it: its numbers in tables, what it cites."""
        return report.theorem(self.certificate)

    def latex(self, prefix: str = "", digits: int = 12) -> str:
        """Return macros for a paper: each number rounded outwards to so many digits."""
        return "\n".join(macros(self.checked, prefix or self.theorem, digits))

    def html(self) -> str:
        r"""Return the theorem typeset, as HTML with TeX between \( and \): as notebooks show it."""
        return typeset.page(self.checked, self.certificate)

    def _repr_html_(self) -> str:
        return self.html()

    def _repr_latex_(self) -> str:
        return typeset.paper(self.checked, self.certificate)

    def write(self, path: str | Path) -> None:
        """Write the certificate to a file, which is replaced, whole or not at all.

        Raises `OSError` if the file cannot be written.
        """
        with replacing(Path(path)) as file:
            file.write(self.data)

    def __str__(self) -> str:
        return f"VERIFIED: {self.sentence}"

    def __repr__(self) -> str:
        stated = dict(self.parameters)
        if "modes" in stated:
            return f"<Verified: {self.theorem} of a system with the state {stated['state']}>"
        if "masses" in stated:
            stated["masses"] = ", ".join(map(str, stated["masses"]))
        values = ", ".join(f"{name} = {q}" for name, q in stated.items())
        return f"<Verified: {self.theorem} at {values}>"

    @property
    def _names(self) -> list[str]:
        return list(self.certificate["parameters"])


def prove_theorem(
    theorem: str,
    *,
    executor: Executor | None = None,
    progress: Callable[[str], None] = lambda _: None,
    **options: Unpack[Options],
) -> Verified:
    """Prove a theorem, and let the checker verify it; of several orbits found, the first.

        prove_theorem("elliptic", f="9/20")
        prove_theorem("periodic", F=3, orbit=(0.4, -0.67), digits=60)
        prove_theorem("branch", lowest="2/5", executor=ProcessPoolExecutor(2))
        prove_theorem("attractor", lowest="0.389", highest="0.391")  # `entropies`

    ``options`` are those of ``cap.prove THEOREM --help``, by their names.  Parameters (F, omega,
    f, l, r, e, mu; default: the paper's) are exact: strings as on the command line, integers or
    fractions; a float is refused, as 0.4 is not 2/5.  So are ``masses``, one string or a pair.
    ``orbit`` (x, v), from which Newton's method starts, may be floats.  Others: ``epsilon``,
    ``digits``; and what the theorem declares, as ``period`` or ``jobs``; ``lowest`` and ``highest``
    are a range of f (--from, --to).  ``executor``, any of `concurrent.futures`' kind, does what
    ``jobs`` processes would do in a theorem that takes ``jobs``; compiled code runs in ``jobs``
    threads all the same, and the checker in processes of its own.  ``progress`` is told, in a few
    words, how far a long proof is.

    Raises `BadInput` if the request makes no sense or no orbit is found, and `NotProved`, which
    carries the sets, if a step of the proof does not succeed: the theorem may still be true.
    """
    return proved(theorem, dict(options), progress, executor)


def proved(
    theorem: str,
    options: dict[str, Any],
    progress: Callable[[str], None],
    executor: Executor | None = None,
) -> Verified:
    """Prove a theorem with options by name, as `prove_theorem` does."""
    from cap.certificate import writer  # noqa: PLC0415 (the prover: only who proves loads it)
    from cap.command.prover_options import Asked  # noqa: PLC0415
    from cap.proofs import theorems  # noqa: PLC0415

    asked = Asked.of(_namespace(theorem, options), progress)
    stated = theorems.THEOREMS[theorem]
    first = stated.search(asked.request).candidates[0]

    def tell(words: str, part: float | None) -> None:
        progress(words if part is None else f"{words}: {part:.0%}")

    runner = asked.runner(tell, executor)
    certificate = theorems.accepted(stated, asked.setting(first, runner))
    return verified(writer.dumps(certificate).encode())


def verify_certificate(path: str | Path) -> Verified:
    """Let the checker verify the certificate in a file, or a stored one by its bare name.

    Nothing of the prover is loaded, nor any library.  Raises `BadInput` if the file cannot be
    read, and `NotProved`, with the checker's reason, if it rejects the certificate: what that
    states may still be true.
    """
    try:
        data = content(found(str(path)))
    except (OSError, ValueError) as error:
        raise BadInput(unread(path, error)) from None
    return verified(data)


def exact_parameters(**parameters: Unpack[System]) -> Parameters:
    """Return the parameters of the oscillator; those that are not given are the paper's.

    Raises `BadInput` unless they are exact, and those of an oscillator.
    """
    values = PAPER.strings()
    for name, value in parameters.items():
        if name not in values:
            raise BadInput(f"there is no parameter {name!r}: one of {', '.join(values)}")
        if value is not None:
            values[name] = _word(name, value)
    return Parameters(*map(exact, values.values()))


def verified(data: bytes) -> Verified:
    """Let the checker verify a certificate; raise `NotProved` with its reason if it rejects it."""
    steps: list[str] = []
    try:
        checked = check(data, steps.append)
    except Exception as reason:  # whatever goes wrong, nothing is proved
        raise NotProved("checker", f"the certificate is rejected: {why(reason)}") from reason
    return Verified(data, tuple(steps), checked)


def _listed(function: Callable[..., Verified]) -> None:
    """Let the signature of a function list its keywords, for those who look them up."""
    stated = signature(function)
    own = [p for p in stated.parameters.values() if p.kind is not Parameter.VAR_KEYWORD]
    more = [
        Parameter(name, Parameter.KEYWORD_ONLY, default=None, annotation=kind)
        for name, kind in Options.__annotations__.items()
    ]
    setattr(function, "__signature__", stated.replace(parameters=[*own, *more]))  # noqa: B010


_listed(prove_theorem)


def _namespace(theorem: str, options: dict[str, Any]) -> Any:
    """Return the options as the command line would have them."""
    from cap.command.prover_parser import options_of, parser  # noqa: PLC0415 (the prover)
    from cap.proofs.theorems import THEOREMS  # noqa: PLC0415

    namespace = parser().parse_args([])
    namespace.theorem = theorem
    known = [name for name in vars(namespace) if name not in _NOT_OPTIONS]
    names = {o.keyword: o for o in options_of({theorem} & THEOREMS.keys()).values()}
    if options.keys() - known - names.keys():
        names = {o.keyword: o for o in options_of(THEOREMS).values()}
    for name, value in options.items():
        if name not in known and name not in names:
            raise BadInput(f"there is no option {name!r}: one of {', '.join([*known, *names])}")
        if value is not None and name in known:
            setattr(namespace, name, _word(name, value))
        elif value is not None:
            namespace.own[names[name].name] = _word(name, value)
    return namespace


def _word(name: str, value: Any) -> Any:
    """Return the value of an option as the command line would have it."""
    if name == "orbit":
        return _state(value)
    if isinstance(value, tuple | list):
        return ",".join(_word(name, part) for part in value)
    if isinstance(value, float) and not math.isfinite(value):
        raise BadInput(f"{name} = {value!r} is no number: write a decimal or a fraction, as text")
    if isinstance(value, float):
        raise BadInput(f'{name} = {value!r} is a binary double: write "{value!r}", or a fraction')
    return str(value)


def _state(value: Any) -> list[str]:
    """Return a state as words; floats are read again as the same floats."""
    try:
        x, v = value
    except (TypeError, ValueError):
        raise BadInput(f"orbit must be a pair (x, v): {value!r}") from None
    return [repr(float(z)) if isinstance(z, float) else str(z) for z in (x, v)]


def _mapped(value: Any, leaf: Callable[[Any], Any]) -> Any:
    """Return nested dictionaries and lists with each leaf mapped."""
    if isinstance(value, dict):
        return {key: _mapped(part, leaf) for key, part in value.items()}
    if isinstance(value, list):
        return [_mapped(part, leaf) for part in value]
    return leaf(value)


def _exact(claim: Any) -> Any:
    if isinstance(claim, shapes.Enclosure):
        return Enclosure(claim.lower, claim.upper, str(claim))
    return claim


def _doubles(claim: Any) -> Any:
    if isinstance(claim, Fraction):
        return _outwards(claim, claim)
    return claim.floats if isinstance(claim, Enclosure) else claim


def _outwards(lower: Fraction, upper: Fraction) -> Pair:
    return _below(lower), 0.0 - _below(-upper)


def _below(q: Fraction) -> float:
    """Return the largest double that is at most q, or -inf."""
    try:
        nearest = float(q)  # correctly rounded
    except OverflowError:
        return math.nextafter(math.inf, 0) if q > 0 else -math.inf
    return nearest if Fraction(nearest) <= q else math.nextafter(nearest, -math.inf)
