"""Orbits of any system in doubles, many at once, with all their events in exact order.

The function that follows them is compiled from the model (`cap.floats.models.source`) when it is
first used, and kept for the next time; or it is interpreted, with the same result.  Guards must be
affine in the state, cos wt and sin wt, up to terms that are quadratic in time on each flight.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.errors import BadInput
from cap.files import replacing
from cap.floats.engine.compiled import announced
from cap.floats.models import roots
from cap.floats.models.source import IMPORTS, Source
from cap.floats.models.spectrum import Floats, evaluated
from cap.process import at_home
from cap.system.model import System
from cap.system.polynomial import COS, SIN, variable

OUTSIDE = 8
"""A bit of flags beside those of `cap.floats.models.source`: it began outside its mode."""
MOST = 2000  # events in a period
AT_ONCE = 200_000  # orbits times periods followed in a call: a signal is noticed between two
PLAIN = """
def njit(function=None, **_):
    return function or njit
"""
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Ends:
    """Where N orbits end.

    ``states`` (N, n), nan for an orbit that is lost; ``modes`` (N,), indices; ``counts`` (N, W) of
    the events by name, the last one is capture; ``flags`` (N,), see `OUTSIDE`; ``log`` (E, 4 + n)
    lists events: orbit, time, which, the mode and the state after it.
    """

    states: Floats
    modes: Integers
    counts: Integers
    flags: Integers
    log: Floats
    path: Floats


class Engine:
    """The flow of a system without free parameters.

    ``modes`` and ``words`` are the names of modes and of events, ``exponentials`` those of modes,
    and ``free`` tells in which modes orbits may begin.  ``interpreted`` it is not compiled, which
    takes half a minute for two masses, and grows: for few orbits.  Raises `BadInput` for a system
    that floats do not follow, and says why.
    """

    def __init__(self, system: System, *, interpreted: bool = False) -> None:
        if system.parameters:
            raise BadInput(f"floats need numbers for {', '.join(system.parameters)}")
        source = Source(system)
        self.system, self.modes = system, source.modes
        self.words = (*source.words, "capture")
        self._follow = (_interpreted if interpreted else _compiled)(source.text)
        self._numbers = source.numbers
        self.exponentials = source.exponentials
        self.free = np.array([is_free(system, name) for name in system.modes])

    def follow(
        self,
        states: ArrayLike,
        modes: Sequence[str] | Integers | None = None,
        *,
        periods: int = 1,
        phase: float = 0.0,
        log: int = 0,
        every: bool = False,
    ) -> Ends:
        """Follow orbits from states (N, n) at the angle ``phase`` of the clock.

        If no ``modes`` are given, each begins in the first one where no guard is negative and
        nothing rests: every position changes with its velocity.  `BadInput` if there is none.  At
        most ``log`` events are listed; with ``every`` the states after each period are told.
        """
        starts = np.ascontiguousarray(states, dtype=float)
        if starts.ndim != 2 or starts.shape[1] != len(self.system.state):
            raise BadInput(f"give states as rows of {', '.join(self.system.state)}")
        if not np.isfinite(starts).all():
            raise BadInput("a state is not finite")
        begun = self.begun(starts, modes, phase)
        inside = self.inside(starts, phase, np.unique(begun))
        N, n = starts.shape
        ends, last = np.empty((N, n)), np.empty(N, dtype=np.int64)
        counts = np.zeros((N, len(self.words)), dtype=np.int64)
        flags = np.where(inside[begun, np.arange(N)], 0, OUTSIDE)
        lines = np.full((log, 4 + n), np.nan)
        path = np.full((N if every else 0, periods, n), np.nan)
        some, used = (N if log else max(1, AT_ONCE // max(1, periods))), 0
        for k in range(0, N, some or 1):
            part = slice(k, k + some)
            arrays = ends[part], last[part], counts[part], flags[part], lines, path[part]
            given = self._numbers, starts[part], begun[part], phase, periods, MOST
            used = self._follow(*given, *arrays)
        return Ends(ends, last, counts, flags, lines[:used], path)

    def inside(
        self, states: Floats, phase: float = 0.0, asked: Integers | None = None
    ) -> NDArray[np.bool_]:
        """Return (M, N) whether the guards of each mode are not negative at the states.

        Of other modes than those ``asked``, if given, it is False.
        """
        values = {**dict(zip(self.system.state, states.T, strict=True)), COS: np.cos(phase)}
        values[SIN] = np.sin(phase)
        inside = np.zeros((len(self.modes), len(states)), dtype=bool)
        for k in range(len(self.modes)) if asked is None else asked:
            inside[k] = True
            for guard in self.system.modes[self.modes[k]].guards.values():
                inside[k] &= evaluated(guard.value, values) >= 0
        return inside

    def begun(
        self,
        states: Floats,
        modes: Sequence[str] | Integers | None = None,
        phase: float = 0.0,
    ) -> Integers:
        """Return the indices of the modes in which orbits begin."""
        if modes is None:
            free = self.inside(states, phase) & self.free[:, np.newaxis]
            lost = ~free.any(axis=0)
            if lost.any():
                raise BadInput(self._nowhere(states[np.argmax(lost)], phase))
            return np.asarray(np.argmax(free, axis=0), dtype=np.int64)
        known = {name: k for k, name in enumerate(self.modes)}
        unknown = [name for name in modes if isinstance(name, str) and name not in known]
        if unknown:
            raise BadInput(f"no mode {unknown[0]!r}: there are {', '.join(self.modes)}")
        found = np.array([known.get(m, m) for m in modes], dtype=np.int64)
        if len(found) != len(states):
            raise BadInput(f"{len(found)} modes for {len(states)} states")
        return found

    def _nowhere(self, state: Floats, phase: float) -> str:
        """Return why an orbit begins in no mode where nothing rests."""
        values = {**dict(zip(self.system.state, state.tolist(), strict=True)), COS: np.cos(phase)}
        values[SIN] = np.sin(phase)
        why = [
            f"in {mode} the guard {name} is {value:.4g}"
            for (mode, each), free in zip(self.system.modes.items(), self.free, strict=True)
            for name, guard in each.guards.items()
            if free and (value := float(evaluated(guard.value, values))) < 0
        ]
        told = ", ".join(f"{z} = {q:.6g}" for z, q in zip(self.system.state, state, strict=True))
        at = " at t = 0" if not phase else ""
        return (
            f"the state {told} lies in no mode in which nothing rests{at}: "
            f"{'; '.join([*why[:4], *(['...'] if why[4:] else [])]) or 'name its mode'} "
            "(guards are positive inside their mode)"
        )


def is_free(system: System, mode: str) -> bool:
    """Return whether in a mode each position z has z' = v with its velocity v."""
    speeds = ((z, system.velocity_of(z)) for z in system.state)
    return all(v is None or system.modes[mode].field[z] == variable(v) for z, v in speeds)


@lru_cache(maxsize=32)
def _compiled(text: str) -> Callable[..., Any]:
    """Return the function of a source, compiled when it is first called, and kept."""
    library = Path(roots.__file__).read_text(encoding="utf-8")
    digest = sha256((text + library).encode()).hexdigest()
    path = _folder() / f"model_{digest[:16]}.py"
    if at_home():
        with suppress(OSError):  # a full disk, a home that is read-only: it is not kept
            path.parent.mkdir(parents=True, exist_ok=True)
            if not path.exists() or path.read_text(encoding="utf-8") != text:
                with replacing(path) as file:
                    file.write(text.encode())
    module = sys.modules.setdefault(path.stem, ModuleType(path.stem))  # where what is kept looks
    module.__file__ = str(path)
    exec(compile(text, str(path), "exec"), module.__dict__)  # noqa: S102 (our own source, not read)
    return announced(module.__dict__["follow"], digest)


@lru_cache(maxsize=32)
def _interpreted(text: str) -> Callable[..., Any]:
    """Return the function of a source as plain Python, on its floats: those of numpy are slow."""
    library = Path(roots.__file__).read_text(encoding="utf-8")
    names: dict[str, Any] = {"__name__": "interpreted"}
    parts = library.replace("from numba import njit\n", PLAIN), text.replace(IMPORTS, PLAIN)
    for part in parts:
        exec(compile(part, "interpreted", "exec"), names)  # noqa: S102 (our own source, not read)
    follow = names["follow"]

    def plain(K: Floats, starts: Floats, modes: Integers, *others: Any) -> int:
        try:
            return int(follow(K.tolist(), starts.astype(object), modes.tolist(), *others))
        except (ArithmeticError, ValueError) as error:  # where numba has inf or nan
            raise BadInput(f"floats do not follow an orbit: {error}") from None

    return plain


def _folder() -> Path:
    """Return the folder of what is made from models, in the user's cache directory."""
    home = os.environ.get("XDG_CACHE_HOME") or Path("~/.cache").expanduser()
    return Path(home) / "cap" / "models"
