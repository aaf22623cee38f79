"""The commands ``cap.prove periodic --model FILE`` and ``elliptic --model FILE``: orbits of a
system of one's own.

Candidates are found by the float engine of the model, or come from a state; each is proved by its
contacts (`cap.proofs.contacts`), and its twist if asked for (`cap.proofs.contact_elliptic`).
"""

import argparse
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from cap.certificate import naming
from cap.command import own_command, own_orbit, own_refusals, own_table
from cap.command.console import Parser, protected
from cap.command.output import writable, writable_into
from cap.command.progress import Progress, answered
from cap.command.proving import proved
from cap.errors import BadInput
from cap.floats.models.periodic import Closed, Met, search
from cap.option import integer
from cap.proofs import contact_elliptic, contacts
from cap.system.files import assigned, read, stem
from cap.system.model import System
from cap.words import printable

PERIODIC = ("periodic", "contacts")
ELLIPTIC = ("elliptic", "contact_elliptic")
OTHERS = {
    "own_attractor": ("attractor", "contact_attractor"),
    "own_basin": ("basin", "contact_basin"),
    "own_branch": ("branch", "contacts_branch"),
    "own_capture": ("capture", "contact_capture"),
    "own_family": ("family", "contacts_family"),
    "own_horseshoe": ("horseshoe", "contact_horseshoe"),
}
"""The modules of other commands and their names: they are loaded when they are asked for."""


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    named = words[0] if words and not words[0].startswith("-") else ""
    for module, names in OTHERS.items():
        if named in names:
            found: Callable[[Sequence[str]], int] = import_module(f"cap.command.{module}").main
            return found(words)
    options = parser(named).parse_args([protected(word) for word in words])
    progress = Progress()

    def run() -> int:
        if options.theorem not in (*PERIODIC, *ELLIPTIC):
            raise BadInput(own_refusals.why(options.theorem))
        asked = Asked.of(options)
        if options.table is None:
            return _run(asked, progress)
        if options.journal is not None:
            writable(options.journal)
        return own_table.proved(
            asked.system, options.table, asked.digits, options.jobs, options.journal, progress
        )

    return answered(run, progress)


PROVERS = {"contacts": contacts.prove, "contact_elliptic": contact_elliptic.prove}
ABOUT = {
    "periodic": "Prove periodic orbits of a system of your own by their contacts: that there "
    "is one near each candidate, which contacts it has and that it has no others, and its "
    "multipliers.  Orbits that rest after infinitely many contacts are not proved.",
    "elliptic": "Prove elliptic periodic orbits of a system of your own, with a state of two "
    "variables and a clock, where flights and contacts preserve area: the orbit with its contacts, "
    "as `periodic` does, its angle, no resonance of order at most four, and its twist, which is "
    "not zero: by Moser's theorem there are invariant curves around it, and it is stable.",
}
EXAMPLES = {
    "periodic": "Examples: python -m cap.prove periodic --model examples/ball.py --set A=6/5,e=1/2 "
    "--all;  python -m cap.prove periodic --model examples/ball.py --orbit 2.0 -2.6 "
    "--mode fly --out /tmp",
    "elliptic": "Example: python -m cap.prove elliptic --model examples/ball.py --set A=2/5,e=1",
}


def parser(named: str = "periodic") -> Parser:
    """Return the parser of these commands."""
    theorem = "elliptic" if named in ELLIPTIC else "periodic"
    p = own_command.begun(theorem, "--model", ABOUT[theorem], EXAMPLES[theorem])
    own_orbit.add(p)
    p.add_argument("--all", action="store_true", help="prove every orbit that is found")
    p.add_argument(
        "--table",
        type=Path,
        metavar="FILE",
        help="prove the orbit of each row of a CSV file and compare it with the row; columns t0, "
        "x0, .., t1, .. are times and states just before contacts, periods those of the clock; "
        "no certificate is kept",
    )
    p.add_argument(
        "--journal",
        type=Path,
        metavar="FILE",
        help="a file of the rows that are done, from which an interrupted --table goes on",
    )
    p.add_argument("--digits", default="10", metavar="N", help="digits claimed (default 10)")
    return own_command.ended(p, "processes for --table")


@dataclass(frozen=True)
class Asked:
    """What is asked for; all of it makes sense."""

    theorem: str
    system: System
    words: list[str]
    periods: int
    every: bool
    state: list[float]
    mode: str | None
    digits: int
    out: Path

    @classmethod
    def of(cls, options: argparse.Namespace) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        values = assigned(options.set)
        system = read(options.file, values)
        state = own_orbit.state(options, system)
        alone = options.all or state or options.period != "1"
        if options.table is not None and (alone or options.theorem in ELLIPTIC):
            raise BadInput("--table goes with none of --all, --orbit, --period, elliptic")
        if options.table is None and (options.journal or options.jobs != 1):
            raise BadInput("--jobs and --journal go with --table")
        periods = own_orbit.periods(options, system)
        if options.all and (state or options.out.suffix == ".json"):
            raise BadInput(
                "--all goes neither with --orbit nor with one file as --out: name a directory"
            )
        theorem = ELLIPTIC[1] if options.theorem in ELLIPTIC else PERIODIC[1]
        return cls(
            theorem,
            system,
            [theorem, stem(options.file), *own_command.valued(values)],
            periods,
            options.all,
            state,
            options.mode,
            integer(options.digits, "digits", (6, 100)),
            options.out,
        )

    def path(self, orbit: Closed) -> Path:
        """Return where the certificate of an orbit goes."""
        if self.out.suffix == ".json":
            return self.out
        at = [f"{name}={q:.6g}" for name, q in zip(("t", *self.system.state), orbit.guess)]  # noqa: B905
        return self.out / naming.short([*self.words, *at])


def _run(asked: Asked, progress: Progress) -> int:
    """Find orbits, and prove them."""
    if asked.out.suffix == ".json":
        writable(asked.out)
    else:
        writable_into(asked.out, ".json")
    contacts.as_parameters(asked.system)
    if asked.theorem in ELLIPTIC:
        contact_elliptic.refuse(asked.system)
    orbits, lines = _found(asked, progress)
    for orbit in orbits if asked.out.suffix != ".json" else ():
        listed = [contact._asdict() for contact in orbit.itinerary.contacts]
        own_command.free(asked.path(orbit), contacts.as_parameters(asked.system), listed)
    progress.clear()
    print("\n".join([*map(printable, lines), ""]), flush=True)
    return max(_proved(asked, orbit, progress) for orbit in orbits)


def _found(asked: Asked, progress: Progress) -> tuple[list[Closed], list[str]]:
    """Return the orbits to be proved, and what was found, in words."""
    if asked.state:
        orbit = own_orbit.closed(asked.system, asked.state, asked.mode, asked.periods)
        return [orbit], ["Newton's method leads to:", f"  {orbit.shown()}"]
    met = search(asked.system, asked.periods, progress.tell)
    if not met.orbits:
        also = "".join(f"; {line}" for line in _others(met))
        raise BadInput(
            f"no isolated orbit with a contact was found that closes after {asked.periods} "
            f"period{'s' if asked.periods > 1 else ''} of the clock "
            f"(a state near one can be given with --orbit){also}"
        )
    count = len(met.orbits)
    wanted = _elliptic(met.orbits) if asked.theorem in ELLIPTIC else met.orbits
    chosen = wanted if asked.every else wanted[:1]
    which = "all" if asked.every else "the first" if count > 1 else "it"
    which += " that is elliptic" if asked.theorem in ELLIPTIC and count > 1 else ""
    heading = (
        f"Found {count} orbit{'s' if count > 1 else ''} (those that attract first); "
        f"proving {which}:"
    )
    listed = [f"  {k}  {orbit.shown()}" for k, orbit in enumerate(met.orbits, 1)]
    return chosen, [heading, *listed, *(f"Besides, {line}." for line in _others(met))]


def _elliptic(orbits: Sequence[Closed]) -> list[Closed]:
    """Return the elliptic ones; raise `BadInput`, with the reason, if there are none."""
    wanted = [orbit for orbit in orbits if orbit.elliptic]
    if not wanted:
        lost = contact_elliptic.why_not(orbits[0].itinerary)
        reason = lost or orbits[0].shown()
        count = f"{len(orbits)} orbit{'s that were' if len(orbits) > 1 else ' that was'} found"
        raise BadInput(f"none of the {count} is elliptic: {reason}")
    return wanted


def _others(met: Met) -> Iterable[str]:
    """Give what else was met, in words."""
    for n, count in sorted(met.periods.items()):
        ends = "states end at orbits that attract and close" if count > 1 else "state ends at one"
        periods = "period" if n == 1 else "periods"
        yield f"{count} {ends} after {n} {periods} (--period {n})"
    if met.neutral:
        k = len(met.neutral)
        yield (
            f"{k} with a multiplier that is 1 up to rounding, as {met.neutral[0].shown()}: "
            + ("a family of orbits, it seems (see `family --model`); " if k > 2 else "")
            + "an orbit that is not isolated is not proved by its contacts"
        )
    if met.captured:
        yield (
            f"{met.captured} of {met.settled} states end where infinitely many contacts accumulate "
            "in a period: such orbits are not proved by contacts"
        )


def _proved(asked: Asked, orbit: Closed, progress: Progress) -> int:
    """Prove an orbit, write its certificate and print it; return the status."""
    progress.tell("proving", None)

    def prove() -> dict[str, Any]:
        return PROVERS[asked.theorem](orbit.itinerary, orbit.guess, asked.digits)

    return proved(asked.theorem, prove, asked.path(orbit), progress, about=orbit.shown())
