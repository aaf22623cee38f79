"""What numba is told of intervals: how they lie in memory, what is done with them.

An interval is two doubles.  The arithmetic has one text, `cap.sets.doubles`: a function without
branches is executed once on values that append an instruction for each operation on them, and that
is the code.  No instruction has a fast-math flag.
"""

import operator
from collections.abc import Callable
from functools import partial
from typing import Any

from numba import types
from numba.core import cgutils
from numba.core.imputils import lower_constant
from numba.extending import (
    NativeValue,
    box,
    lower_builtin,
    make_attribute_wrapper,
    models,
    register_model,
    type_callable,
    typeof_impl,
    unbox,
)

from cap.sets import doubles
from cap.sets.doubles import Interval


class IntervalType(types.Type):
    """The type of intervals."""

    def __init__(self) -> None:
        super().__init__(name="Interval")


INTERVAL = IntervalType()
DOUBLE = types.float64


@register_model(IntervalType)
class _Model(models.StructModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, [("mid", DOUBLE), ("rad", DOUBLE)])


for _field in ("mid", "rad"):
    make_attribute_wrapper(IntervalType, _field, _field)


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
        function = self.builder.module.declare_intrinsic("llvm.fabs", [self.value.type])
        return self._done("call", function, [self.value])

    def __gt__(self, x: Any) -> "_Noted":
        return self._done("fcmp_ordered", ">", self.value, self._other(x))

    def __lt__(self, x: Any) -> "_Noted":
        return self._done("fcmp_ordered", "<", self.value, self._other(x))


def _ends(context: Any, builder: Any, value: Any) -> Any:
    """Return the two doubles of an interval, or of a new one."""
    return cgutils.create_struct_proxy(INTERVAL)(context, builder, value)


def _struct(context: Any, builder: Any, x: Interval) -> Any:
    """Return the code's value for an interval of noted doubles or constants."""
    proxy = _ends(context, builder, None)
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
            ends = _ends(context, builder, value)
            operands.append(Interval(*(_Noted(builder, end) for end in (ends.mid, ends.rad))))
        elif function in OPERATORS.values():  # an operand that stands for itself
            operands.append(Interval(_Noted(builder, value), 0.0))
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


OPERATORS: dict[Any, Callable[..., Any]] = {
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


@typeof_impl.register(Interval)
def _type_of_interval(_value: Interval, _context: Any) -> Any:
    return INTERVAL


@lower_constant(IntervalType)
def _constant(context: Any, builder: Any, _kind: Any, value: Interval) -> Any:
    return _struct(context, builder, value)


@unbox(IntervalType)
def _taken(_kind: Any, value: Any, c: Any) -> Any:
    """Take an interval from Python."""
    ends = _ends(c.context, c.builder, None)
    for field in ("mid", "rad"):
        attribute = c.pyapi.object_getattr_string(value, field)
        setattr(ends, field, c.unbox(DOUBLE, attribute).value)
        c.pyapi.decref(attribute)
    failed = cgutils.is_not_null(c.builder, c.pyapi.err_occurred())
    return NativeValue(ends._getvalue(), is_error=failed)


@box(IntervalType)
def _given(_kind: Any, value: Any, c: Any) -> Any:
    """Give an interval to Python."""
    ends = _ends(c.context, c.builder, value)
    made = c.pyapi.unserialize(c.pyapi.serialize_object(Interval))
    numbers = [c.box(DOUBLE, end) for end in (ends.mid, ends.rad)]
    result = c.pyapi.call_function_objargs(made, numbers)
    for used in (*numbers, made):
        c.pyapi.decref(used)
    return result
