"""Compiled code that computes with intervals of doubles.

Importing this module teaches numba the type `Interval`, its operators and the functions of
`cap.sets.doubles` and its companions.  A float operand stands for itself, exactly.

The arithmetic has one text, `cap.sets.doubles`: a function without branches is executed once on
values that note what is done to them, and that is the code.  No instruction has a fast-math flag,
and nothing contracts a product and a sum to one operation; the tests look for both in what comes
out.  Division gives infinities and NaN instead of exceptions.
"""

import operator
import platform
from collections.abc import Callable
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
from numba import njit, types
from numba.core import cgutils
from numba.core.imputils import (
    lower_constant,
    lower_getattr_generic,
    lower_setattr_generic,
)
from numba.core.typing.templates import AttributeTemplate, infer_getattr
from numba.extending import (
    NativeValue,
    box,
    lower_builtin,
    make_attribute_wrapper,
    models,
    overload,
    register_jitable,
    register_model,
    type_callable,
    typeof_impl,
    unbox,
)
from numpy.typing import NDArray

from cap.errors import NotProved
from cap.sets import circular, decay, doubles
from cap.sets.doubles import Interval
from cap.sets.records import R, Record, assign, row_of

F = TypeVar("F", bound=Callable[..., Any])
IEEE = {"error_model": "numpy", "_nrt": False}  # no exceptions, and no arrays of its own


class _Type(types.Type):  # type: ignore[misc]
    def __init__(self) -> None:
        super().__init__(name="Interval")


INTERVAL = _Type()
DOUBLE = types.float64


@register_model(_Type)
class _Model(models.StructModel):  # type: ignore[misc]
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, [("mid", DOUBLE), ("rad", DOUBLE)])


for _field in ("mid", "rad"):
    make_attribute_wrapper(_Type, _field, _field)


class _Noted:
    """A double of the compiled code: an operation on it appends an instruction."""

    def __init__(self, builder: Any, value: Any) -> None:
        self.builder, self.value = builder, value

    def _other(self, x: Any) -> Any:
        return x.value if isinstance(x, _Noted) else self.value.type(float(x))

    def _done(self, name: str, *operands: Any) -> "_Noted":
        return _Noted(self.builder, getattr(self.builder, name)(*operands))

    def __add__(self, x: Any) -> "_Noted":
        return self._done("fadd", self.value, self._other(x))

    def __radd__(self, x: Any) -> "_Noted":
        return self._done("fadd", self._other(x), self.value)

    def __sub__(self, x: Any) -> "_Noted":
        return self._done("fsub", self.value, self._other(x))

    def __rsub__(self, x: Any) -> "_Noted":
        return self._done("fsub", self._other(x), self.value)

    def __mul__(self, x: Any) -> "_Noted":
        return self._done("fmul", self.value, self._other(x))

    def __rmul__(self, x: Any) -> "_Noted":
        return self._done("fmul", self._other(x), self.value)

    def __neg__(self) -> "_Noted":
        return self._done("fneg", self.value)

    def __abs__(self) -> "_Noted":
        kind = self.value.type
        function = self.builder.module.declare_intrinsic("llvm.fabs", [kind])
        return self._done("call", function, [self.value])

    def __gt__(self, x: Any) -> "_Noted":
        return self._done("fcmp_ordered", ">", self.value, self._other(x))

    def __lt__(self, x: Any) -> "_Noted":
        return self._done("fcmp_ordered", "<", self.value, self._other(x))


def _struct(context: Any, builder: Any, x: Interval) -> Any:
    proxy = cgutils.create_struct_proxy(INTERVAL)(context, builder)
    for name in ("mid", "rad"):
        end = getattr(x, name)
        value = end.value if isinstance(end, _Noted) else context.get_constant(DOUBLE, end)
        setattr(proxy, name, value)
    return proxy._getvalue()


def _executed(
    function: Callable[..., Any], context: Any, builder: Any, signature: Any, values: Any
) -> Any:
    """Append the instructions of a function without branches; return its result."""
    operands: list[Any] = []
    for kind, value in zip(signature.args, values, strict=True):
        if kind is INTERVAL:
            proxy = cgutils.create_struct_proxy(INTERVAL)(context, builder, value)
            operands.append(Interval(*(_Noted(builder, end) for end in (proxy.mid, proxy.rad))))
        elif function in OPERATORS.values():  # an operand that stands for itself
            operands.append(Interval(_Noted(builder, value), 0.0))  # type: ignore[arg-type]
        else:
            operands.append(_Noted(builder, value))
    result = function(*operands)
    return _struct(context, builder, result) if isinstance(result, Interval) else result.value


def _compile(symbol: Any, function: Callable[..., Any], result: Any, *kinds: Any) -> None:
    """Let compiled code use a function without branches, or the operator that stands for it."""

    def one(x: Any) -> Any:
        return result if (x,) == kinds else None

    def two(x: Any, y: Any) -> Any:
        return result if (x, y) == kinds else None

    type_callable(symbol)(lambda _context: one if len(kinds) == 1 else two)
    lower_builtin(symbol, *kinds)(partial(_executed, function))


OPERATORS = {
    operator.add: doubles.add,
    operator.sub: doubles.subtract,
    operator.mul: doubles.multiply,
}
for _symbol, _function in OPERATORS.items():
    for _kinds in ((INTERVAL, INTERVAL), (INTERVAL, DOUBLE), (DOUBLE, INTERVAL)):
        _compile(_symbol, _function, INTERVAL, *_kinds)
    _compile(_function, _function, INTERVAL, INTERVAL, INTERVAL)
_compile(operator.neg, doubles.negative, INTERVAL, INTERVAL)
_compile(Interval, Interval, INTERVAL, DOUBLE, DOUBLE)
_compile(doubles.square, doubles.square, INTERVAL, INTERVAL)
_compile(doubles.widened, doubles.widened, INTERVAL, INTERVAL, DOUBLE)
for _function in (doubles.upper, doubles.lower, doubles.magnitude):
    _compile(_function, _function, DOUBLE, INTERVAL)
for _function in (doubles.is_positive, doubles.is_negative):
    _compile(_function, _function, types.boolean, INTERVAL)
_compile(doubles.below, doubles.below, types.boolean, INTERVAL, INTERVAL)


def kernel(function: F) -> F:
    """Let compiled code call a function, which stays what it is for Python."""
    register_jitable(**IEEE)(function)
    return function


def compiled(function: F) -> F:
    """Compile a function that Python calls; it releases the interpreter lock.

    The code is kept for other processes, if there is somewhere to keep it: not if the package is
    installed where one may not write and there is no home directory.  numba does not notice changes
    of what is compiled into it: let `sources` be in its closure.
    """
    try:
        return cast(F, njit(function, cache=True, nogil=True, **IEEE))
    except RuntimeError:  # no locator of a cache
        return cast(F, njit(function, nogil=True, **IEEE))


def sources() -> str:
    """Return a digest of all that may be compiled: the arithmetic, and the flow of cells."""
    here = Path(__file__).parent
    files = sorted([*here.glob("*.py"), *(here.parent / "cells").glob("*.py")])
    return sha256(b"".join(file.read_bytes() for file in files)).hexdigest()


PROBE = np.array([1.0, 2.0**-53, 3 * 2.0**-54, 2.0**-1074, 2.0**-1022, 2.0**900])


@kernel
def rounds_to_nearest(probe: NDArray[np.float64]) -> bool:
    """Return whether the processor rounds to nearest, with gradual underflow, in this thread.

    ``probe`` is `PROBE`; of constants the compiler would do the sums itself.
    """
    one, half, more, least, normal, large = probe
    ties = one + half == one and one + more > one + half and one - more < one
    gradual = normal * 0.5 > 0 and least * large > 0 and least + least > least
    return bool(ties and gradual and -one - more < -one)


def require_ieee(found: bool) -> None:
    """Raise `NotProved` if the processor does not do what the bounds of errors assume."""
    if not found:
        reason = "the processor does not round to nearest, or flushes small numbers to zero"
        raise NotProved("arithmetic", reason, {"machine": platform.machine()})


for _function in (
    *(doubles.divide, doubles.sqrt, doubles.is_finite),
    *(doubles.between, doubles.hull, doubles.clipped),
    *(circular.sin_cos_of_double, circular.sin_cos, circular.shifted, circular.acos),
    *(circular._sine_tail, circular._cosine_tail, circular._near_acos),
    *(decay.relax, decay.relax_double, decay._halved, decay._series, decay._nothing),
):
    kernel(_function)

overload(decay.relaxed, jit_options=IEEE, strict=False)(
    lambda *operands: decay.relax if operands[1] is INTERVAL else decay.relax_double
)


def _quotient(*operands: Any) -> Any:
    def left(x, y):  # type: ignore[no-untyped-def]
        return doubles.divide(x, Interval(y, 0.0))

    def right(x, y):  # type: ignore[no-untyped-def]
        return doubles.divide(Interval(x, 0.0), y)

    patterns = {
        (INTERVAL, INTERVAL): doubles.divide,
        (INTERVAL, DOUBLE): left,
        (DOUBLE, INTERVAL): right,
    }
    return patterns.get(operands)


overload(operator.truediv, jit_options=IEEE, strict=False)(_quotient)


@typeof_impl.register(Interval)
def _type_of(_value: Any, _context: Any) -> Any:
    return INTERVAL


@unbox(_Type)
def _unboxed(_kind: Any, value: Any, c: Any) -> Any:
    """Take an interval from Python."""
    proxy = cgutils.create_struct_proxy(INTERVAL)(c.context, c.builder)
    for field in ("mid", "rad"):
        attribute = c.pyapi.object_getattr_string(value, field)
        setattr(proxy, field, c.unbox(DOUBLE, attribute).value)
        c.pyapi.decref(attribute)
    failed = cgutils.is_not_null(c.builder, c.pyapi.err_occurred())
    return NativeValue(proxy._getvalue(), is_error=failed)


@box(_Type)
def _boxed(_kind: Any, value: Any, c: Any) -> Any:
    """Give an interval to Python."""
    proxy = cgutils.create_struct_proxy(INTERVAL)(c.context, c.builder, value)
    made = c.pyapi.unserialize(c.pyapi.serialize_object(Interval))
    ends = [c.box(DOUBLE, end) for end in (proxy.mid, proxy.rad)]
    result = c.pyapi.call_function_objargs(made, ends)
    for used in (*ends, made):
        c.pyapi.decref(used)
    return result


@lower_constant(_Type)
def _constant(context: Any, builder: Any, _kind: Any, value: Interval) -> Any:
    return _struct(context, builder, value)


class _RecordType(types.Type):  # type: ignore[misc]
    """The type of the records of a class: in compiled code they are addresses."""

    def __init__(self, record: type[Record]) -> None:
        self.record = record
        super().__init__(name=f"{record.__module__}.{record.__qualname__}")


register_model(_RecordType)(models.OpaqueModel)


@typeof_impl.register(Record)
def _type_of_record(value: Record, _context: Any) -> Any:
    return _RecordType(type(value))


@unbox(_RecordType)
def _unboxed_record(_kind: Any, value: Any, c: Any) -> Any:
    """Take the address of a record from Python, which keeps its memory."""
    attribute = c.pyapi.object_getattr_string(value, "address")
    address = c.unbox(types.uintp, attribute).value
    c.pyapi.decref(attribute)
    failed = cgutils.is_not_null(c.builder, c.pyapi.err_occurred())
    return NativeValue(c.builder.inttoptr(address, cgutils.voidptr_t), is_error=failed)


def _kind(field: Any) -> Any:
    if issubclass(field, Record):
        return _RecordType(field)
    return {Interval: INTERVAL, float: DOUBLE, int: types.int64}[field]


@infer_getattr
class _Fields(AttributeTemplate):  # type: ignore[misc]
    key = _RecordType

    def generic_resolve(self, record: Any, name: str) -> Any:
        field = record.record.FIELDS.get(name)
        return None if field is None else _kind(field.kind)


def _address(builder: Any, memory: Any, place: int, kind: Any) -> Any:
    """Return the address of a field, as that of numbers of its kind."""
    at = cgutils.pointer_add(builder, memory, 8 * place)
    return at if kind is None else builder.bitcast(at, kind.as_pointer())


@lower_getattr_generic(_RecordType)
def _read(context: Any, builder: Any, record: Any, memory: Any, name: str) -> Any:
    kind, place = record.record.FIELDS[name]
    if issubclass(kind, Record):
        return _address(builder, memory, place, None)
    number = context.get_value_type(types.int64 if kind is int else DOUBLE)
    if kind is not Interval:
        return builder.load(_address(builder, memory, place, number))
    proxy = cgutils.create_struct_proxy(INTERVAL)(context, builder)
    proxy.mid = builder.load(_address(builder, memory, place, number))
    proxy.rad = builder.load(_address(builder, memory, place + 1, number))
    return proxy._getvalue()


@lower_setattr_generic(_RecordType)
def _written(context: Any, builder: Any, signature: Any, values: Any, name: str) -> Any:
    (memory, value), record = values, signature.args[0]
    kind, place = record.record.FIELDS[name]
    number = context.get_value_type(types.int64 if kind is int else DOUBLE)
    if kind is not Interval:
        builder.store(value, _address(builder, memory, place, number))
        return
    proxy = cgutils.create_struct_proxy(INTERVAL)(context, builder, value)
    builder.store(proxy.mid, _address(builder, memory, place, number))
    builder.store(proxy.rad, _address(builder, memory, place + 1, number))


@type_callable(assign)
def _assigned(_context: Any) -> Any:
    def typed(target: Any, source: Any) -> Any:
        same = isinstance(target, _RecordType) and target == source
        return types.void if same else None

    return typed


@lower_builtin(assign, _RecordType, _RecordType)
def _copied(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    size = context.get_constant(types.intp, 8 * signature.args[0].record.SIZE)
    cgutils.raw_memcpy(builder, values[0], values[1], size, 1)
    return context.get_dummy_value()


def rows(kind: type[R]) -> Callable[[NDArray[np.float64], int], R]:
    """Return `row_of` a kind of records, for Python and compiled code."""
    function = row_of(kind)

    @type_callable(function)
    def _typed(_context: Any) -> Any:
        def typed(table: Any, k: Any) -> Any:
            fits = isinstance(table, types.Array) and isinstance(k, types.Integer)
            return _RecordType(kind) if fits else None

        return typed

    @lower_builtin(function, types.Array, types.Integer)
    def _pointed(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        array = context.make_array(signature.args[0])(context, builder, values[0])
        stride = builder.extract_value(array.strides, 0)
        k = context.cast(builder, values[1], signature.args[1], types.intp)
        start = builder.bitcast(array.data, cgutils.voidptr_t)
        return cgutils.pointer_add(builder, start, builder.mul(stride, k))

    return function
