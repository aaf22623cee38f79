"""A system from a file: FILE.json as `cap.system.form` writes it, or FILE.py.

FILE.py has one public function, of the parameters, that returns a `cap.System`; if it has several,
FILE.py:NAME names one.  The function is called with exact numbers, `Fraction`.  Reading the file
runs it, so it is the user's own, as any program that one runs.  Whatever goes wrong there is told
in one line (`BadInput`), with the line of the file.
"""

from __future__ import annotations

import inspect
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from numbers import Rational
from pathlib import Path
from types import FunctionType, ModuleType
from typing import TypeVar

from cap.errors import BadInput
from cap.parameters import exact
from cap.system import form
from cap.system.model import System
from cap.system.planar import Map

MOST = 200  # characters of a message that is not ours
Model = Callable[..., object]
Values = Mapping[str, str | Fraction | int]
Read = tuple[System, dict[str, Fraction]]
Result = TypeVar("Result")


@dataclass(frozen=True)
class Loaded:
    """A system from the file ``path``, with the ``values`` of all its parameters."""

    path: str
    system: System
    values: Mapping[str, Fraction]

    def settings(self, *, but: tuple[str, ...] = ()) -> str:
        """Return the values as ``A=6/5,e=1/2``."""
        return ",".join(f"{name}={q}" for name, q in self.values.items() if name not in but)


def planar(path: str | Path, values: Values | None = None) -> Map:
    """Return the planar map that the function of a file FILE.py returns.  Raises `BadInput`."""
    file, name = _named(str(path))
    if file.suffix == ".json":
        raise BadInput(f"a map is FILE.py or FILE.py:FUNCTION: {path}")
    return _returned(_text(file), file, name, values or {}, Map)[0]


def stem(path: str) -> str:
    """Return what a file with a system or a map is called: FUNCTION, or FILE without its ending."""
    return Path(path.rpartition(":")[2] if ".py:" in path else path).stem


def read(path: str | Path, values: Values | None = None) -> System:
    """Return the system in a file with values of its parameters, exact: "6/5", "1.2", numbers.

    Those that are not given have the function's defaults; JSON has none.  Raises `BadInput`.
    """
    return load(path, values).system


def load(path: str | Path, values: Values | None = None) -> Loaded:
    """Return the system in a file as `read` does, with the values of its parameters."""
    file, name = _named(str(path))
    text = _text(file)
    of = _from_json if file.suffix == ".json" else _made
    return Loaded(str(path), *of(text, file, name, values or {}))


def assigned(text: str) -> dict[str, str]:
    """Return the values of parameters in words as ``A=6/5,e=1/2``."""
    found = dict[str, str]()
    for part in filter(None, text.split(",")):
        name, equal, value = (word.strip() for word in part.partition("="))
        if not equal or not name or not value:
            raise BadInput(f"write values of parameters as NAME=VALUE,NAME=VALUE: {part!r}")
        if name in found:
            raise BadInput(f"the parameter {name} has two values")
        found[name] = value
    return found


def _named(path: str) -> tuple[Path, str]:
    """Return the file, and the name of a function in it, or none."""
    file, colon, name = path.rpartition(":")
    named = bool(colon) and file.endswith(".py")
    found = Path(file if named else path)
    if found.suffix not in (".py", ".json"):
        raise BadInput(f"a model is FILE.py, FILE.py:FUNCTION or FILE.json: {path}")
    if named and not name.isidentifier():
        raise BadInput(f"not a name of a function: {path}")
    return found, name if named else ""


def _text(file: Path) -> str:
    """Return the text of a file."""
    try:
        return file.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise BadInput(f"{file}: not a text in UTF-8") from None
    except OSError as error:
        raise BadInput(f"cannot read {file}: {error.strerror}") from None


def _from_json(text: str, file: Path, _name: str, values: Values) -> Read:
    """Return the system in JSON, with numbers in place of all its parameters."""
    try:
        system = form.loads(text)
        given = _numbers(values, dict.fromkeys(system.parameters))
        return system.at(given), given
    except BadInput as error:
        raise BadInput(f"{file}: {error}") from None


def _numbers(values: Values, known: Mapping[str, object]) -> dict[str, Fraction]:
    """Return the numbers of all known parameters: given, or by default (None: there is none)."""
    listed = ", ".join(n if q is None else f"{n} = {_line(str(q))}" for n, q in known.items())
    for name in values:
        if name not in known:
            raise BadInput(f"no parameter {name}: there are {listed or 'none'}")
    for name, default in known.items():
        if name not in values and default is None:
            raise BadInput(f"the parameter {name} needs a value: there are {listed}")
    try:
        given = {name: _exact(value, name) for name, value in values.items()}
    except BadInput as error:
        raise BadInput(f"{error}; the parameters are {listed}") from None
    return {name: given[name] if name in given else _exact(q, name) for name, q in known.items()}


def _made(text: str, file: Path, name: str, values: Values) -> Read:
    """Return the system that the function of a file returns, and its arguments."""
    system, numbers = _returned(text, file, name, values, System)
    if system.parameters:
        names = ", ".join(system.parameters)
        raise BadInput(f"{file}: make {names} an argument of the function, not of the System")
    return system, numbers


def _returned(
    text: str, file: Path, name: str, values: Values, kind: type[Result]
) -> tuple[Result, dict[str, Fraction]]:
    """Return what the function of a file returns, of this kind, and its arguments."""
    module = ModuleType(file.stem)
    module.__file__ = str(file)
    _run(lambda: exec(compile(text, str(file), "exec"), module.__dict__), file)  # noqa: S102
    model = _function(module, file, name)
    try:
        numbers = _arguments(model, values)
    except BadInput as error:
        raise BadInput(f"{file}: {model.__name__}: {error}") from None
    made = _run(lambda: model(**numbers), file)
    if not isinstance(made, kind):
        returned = type(made).__name__
        raise BadInput(f"{file}: {model.__name__} returns no cap.{kind.__name__}, but {returned}")
    return made, numbers


def _function(module: ModuleType, file: Path, name: str) -> FunctionType:
    """Return the one public function made in a file, or that of this name."""
    here = {
        key: value
        for key, value in vars(module).items()
        if isinstance(value, FunctionType) and value.__module__ == module.__name__
    }
    public = [key for key in here if not key.startswith("_")]
    if name and name not in here:
        raise BadInput(f"{file}: no function {name}: there are {', '.join(public) or 'none'}")
    if not name and not public:
        raise BadInput(f"{file}: no public function that could return a system")
    if not name and len(public) > 1:
        raise BadInput(f"{file}: several functions: name one, as {file}:{public[0]} of {public}")
    return here[name or public[0]]


def _arguments(model: FunctionType, values: Values) -> dict[str, Fraction]:
    """Return the values of all parameters of a function, given or by default."""
    found = inspect.signature(model).parameters
    for parameter in found.values():
        if parameter.kind not in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY):
            raise BadInput(f"{parameter} is no parameter with a name: write each one")
    none = inspect.Parameter.empty
    return _numbers(values, {n: None if q.default is none else q.default for n, q in found.items()})


def _exact(value: object, name: str) -> Fraction:
    """Return an exact number."""
    if isinstance(value, str):
        try:
            return exact(value)
        except BadInput as error:
            raise BadInput(f"{name}: {error}") from None
    if isinstance(value, Rational) and not isinstance(value, bool):
        return Fraction(int(value.numerator), int(value.denominator))
    if isinstance(value, float):
        raise BadInput(f'{name} = {value} is a binary double: write "{value}", or a fraction')
    raise BadInput(f"{name} is no exact number: {_line(repr(value))}")


def _run(work: Callable[[], Result], file: Path) -> Result:
    """Run code of the user; say in one line what fails there, and where."""
    try:
        return work()
    except SyntaxError as error:
        place = f"{file}:{error.lineno}" if error.lineno else str(file)
        raise BadInput(f"{place}: not Python: {_line(error.msg)}") from None
    except (Exception, SystemExit) as error:  # noqa: BLE001 (any code may stand there)
        kind = [] if isinstance(error, BadInput) else [type(error).__name__]
        said = [_line(str(error))] if str(error) else []
        raise BadInput(": ".join([_place(error, file), *kind, *said])) from None


def _place(error: BaseException, file: Path) -> str:
    """Return the file with the last line of it that ran."""
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if frame.filename == str(file)]
    return f"{file}:{lines[-1]}" if lines else str(file)


def _line(text: str) -> str:
    """Return a text as one line, not a long one."""
    words = " ".join(text.split())
    return words if len(words) <= MOST else words[: MOST - 3] + "..."
