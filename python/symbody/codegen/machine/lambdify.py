"""Expressions as fast functions of NumPy arrays."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen.llvm.jit import is_available, lanes
from symbody.codegen.machine.compile_threshold import is_worth_compiling
from symbody.codegen.machine.machine_code import MachineCode
from symbody.errors import ArgumentError, ExpressionError, ParameterError, SymbodyError
from symbody.symbolic import Expr, Matrix
from symbody.symbolic.expression.encoding import Encoded, decode, encode
from symbody.symbolic.given.arguments import brief, counted, described, expression, with_known_names
from symbody.symbolic.numeric.deficiency import noting, report
from symbody.symbolic.numeric.tape import Tape

__all__ = ["CompiledFunction", "lambdify"]

#: A structure of outputs: one expression, a sequence of expressions, a matrix, or a sequence of these.
Outputs = Any


@dataclass(frozen=True)
class _Shape:
    """The part of the flat outputs that makes one result: its place and its leading dimensions."""

    start: int
    count: int
    dimensions: tuple[int, ...]


@dataclass(frozen=True)
class CompiledFunction:
    """A function of the arguments given to :func:`lambdify`, which broadcasts over their trailing axes.

    Attributes:
        arguments: variables, or tuples of variables, as they were given.
        expressions: all outputs, in one tuple.
        shapes: the parts of the outputs that make the results.
        compile: whether all calls run in machine code, or none; by the number of points, if it is None.
        threads: how many threads share the points of a call.
        equation_names: the names of the equations of linear systems in notices.

    >>> from symbody import lambdify, symbols
    >>> x, y = symbols("x y")
    >>> f = lambdify([x, y], x * y)
    >>> f.expressions
    (x*y,)
    >>> f([1.0, 2.0], 3.0)
    array([3., 6.])
    """

    arguments: tuple[tuple[Expr, ...] | Expr, ...]
    expressions: tuple[Expr, ...]
    shapes: tuple[_Shape, ...] | _Shape
    compile: bool | None = None
    threads: int = 1
    equation_names: tuple[str, ...] = ()

    @cached_property
    def tape(self) -> Tape:
        """The straight-line code of the expressions, made once."""
        return Tape(_flat(self.arguments), self.expressions)

    @cached_property
    def machine_code(self) -> MachineCode:
        """The machine code of the expressions, for loops outside Python; compiled at its first use."""
        return MachineCode(tuple(_flat(self.arguments)), self.expressions)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the expressions, all in one encoding; where they are read, the code is made again."""
        leaves = _flat(self.arguments)
        counts = tuple(None if isinstance(a, Expr) else len(a) for a in self.arguments)
        options = (self.shapes, self.compile, self.threads, self.equation_names)
        return _decoded, (counts, encode([*leaves, *self.expressions]), options)

    def __call__(self, *values: ArrayLike) -> Any:
        """Evaluate the expressions; an argument that was a list takes an array with one row per variable."""
        inputs = self._columns(values)
        batch = _batch([column.shape for column in inputs])
        points = int(np.prod(batch))
        flat = [
            np.ascontiguousarray(c if c.size == 1 else np.broadcast_to(c, batch)).reshape(-1) for c in inputs
        ]
        outputs = self._evaluated(flat, points).reshape((self.tape.outputs, *batch))
        if isinstance(self.shapes, _Shape):
            return _cut(outputs, self.shapes)
        return tuple(_cut(outputs, shape) for shape in self.shapes)

    def at_few_points(self, *values: ArrayLike) -> Any:
        """Evaluate the expressions at any number of points as at one: to the same digits."""
        return self.as_at(1)(*values)

    def as_at(self, points: int) -> CompiledFunction:
        """Return the function that runs at any number of points what this one runs at so many, to the same digits."""
        if self.compile is not None or self.is_compiled_for(points):
            return self if self.compile is not None else self._compiled
        return self._uncompiled

    @cached_property
    def _compiled(self) -> CompiledFunction:
        made = replace(self, compile=True)
        vars(made).update(tape=self.tape, machine_code=self.machine_code)
        return made

    @cached_property
    def _uncompiled(self) -> CompiledFunction:
        made = replace(self, compile=False)
        vars(made)["tape"] = self.tape
        return made

    def _evaluated(self, columns: list[NDArray[np.float64]], points: int) -> NDArray[np.float64]:
        """Return the outputs, a row for each."""
        if not self.tape.factorizations:
            return self._unreported(columns, points)
        with noting() as found:
            out = self._unreported(columns, points)
        report(found, self.equation_names)
        return out

    def _unreported(self, columns: list[NDArray[np.float64]], points: int) -> NDArray[np.float64]:
        out = np.empty((self.tape.outputs, points))
        if not self.is_compiled_for(points):
            self.tape.evaluate_columns(columns, points, out.reshape(-1))
        elif points < lanes():
            states = np.stack(np.broadcast_arrays(*columns, np.empty(points)), axis=-1)
            rows = np.empty((points, self.tape.outputs))
            self.machine_code.evaluate(np.ascontiguousarray(states), rows)
            out = np.ascontiguousarray(rows.T)
        else:
            self.machine_code.evaluate_columns(columns, points, out, self.threads)
        return out

    def is_compiled_for(self, points: int) -> bool:
        """Return whether a call with so many points runs in machine code."""
        if self.compile is None:
            is_worth = is_worth_compiling(sum(self.tape.operations), points)
            return points > 0 and (is_worth or bool(self.tape.factorizations)) and is_available()
        return points > 0 and self.compile

    def _columns(self, values: Sequence[ArrayLike]) -> list[NDArray[np.float64]]:
        if len(values) != len(self.arguments):
            raise ParameterError(
                f"the function takes {counted(len(self.arguments), 'argument')}, found {len(values)}"
            )
        columns: list[NDArray[np.float64]] = []
        for argument, value in zip(self.arguments, values, strict=True):
            array = _real(argument, value)
            if isinstance(argument, Expr):
                columns.append(array)
                continue
            if array.ndim == 0 or array.shape[0] != len(argument):
                raise ParameterError(
                    f"the argument {_named(argument)} takes an array of {counted(len(argument), 'row')}, "
                    f"found shape {array.shape}"
                )
            columns.extend(array)
        return columns


def _named(argument: tuple[Expr, ...] | Expr) -> str:
    if isinstance(argument, Expr):
        return str(argument)
    return "[" + ", ".join(map(str, argument[:8])) + (", ...]" if len(argument) > 8 else "]")


def _real(argument: tuple[Expr, ...] | Expr, value: ArrayLike) -> NDArray[np.float64]:
    """Return an array of doubles; NumPy would take None for nan, texts for numbers, and drop imaginary parts."""
    try:
        array = np.asarray(value)
        if array.dtype.kind in "iuf" or (array.dtype.kind == "O" and all(x is not None for x in array.flat)):
            return array.astype(np.float64, copy=False)
    except OverflowError:
        raise ParameterError(
            f"the argument {_named(argument)} takes doubles; found a number beyond the largest of them, 1.8e308"
        ) from None
    except (ValueError, TypeError, SymbodyError):
        pass
    raise ArgumentError(f"the argument {_named(argument)} takes real numbers, found {value!r}")


def _batch(shapes: Sequence[tuple[int, ...]]) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        found = ", ".join(map(str, dict.fromkeys(shapes)))
        raise ParameterError(
            f"the arguments have values of the shapes {found}, which don't broadcast; "
            "expected the same number of points for each"
        ) from None


def _cut(outputs: NDArray[np.float64], shape: _Shape) -> Any:
    part = outputs[shape.start : shape.start + shape.count]
    result = part.reshape((*shape.dimensions, *outputs.shape[1:]))
    return result[()] if result.ndim == 0 else result


@with_known_names
def lambdify(
    arguments: Expr | Sequence[Expr | Sequence[Expr]],
    expressions: Outputs,
    *,
    compile: bool | None = None,  # noqa: A002 - what it does
    threads: int = 1,
    equation_names: Sequence[str] = (),
) -> CompiledFunction:
    """Return a fast function of the arguments that evaluates the expressions.

    Calls at many points (2000, plus 200 000 divided by the operations of the function) run in machine code, several
    points at a time, and so do functions with linear systems. Other calls are evaluated without compilation, which
    would take as long as fifty of them or more. Earlier calls make no difference, so equal calls have equal results;
    the two ways agree to rounding. A loop of many calls at few points is faster with ``compile=True``.
    A linear system of deficient rank gets its minimum-norm solution, and a notice that names the equations that follow
    from others, or contradict them.

    Args:
        arguments: variables, or lists of variables. For a variable, the function takes a number or an array; for a
            list of n variables, an array of shape (n, ...), one row per variable. The shapes of the variables'
            values are broadcast to one shape, the batch.
        expressions: the structure of the results. For an expression, an array of shape (*batch,); for a list of n
            expressions, (n, *batch); for a ``Matrix`` or a NumPy array of expressions, its shape and the batch; for a
            list of lists, matrices and arrays, a tuple with an array for each, lists of equal length included.
        compile: whether all calls run in machine code, or none; by default, the size of the call decides.
        threads: how many threads share the points of a call.
        equation_names: the names of the equations of linear systems in notices.

    Returns:
        The function. It takes one positional value per argument and returns arrays of doubles; a number where the
        batch has the shape () and the result is one expression.

    Raises:
        ParameterError: an expression contains a variable that is not an argument.
        ArgumentError: an argument is not a variable, or a variable is given more than once.

    >>> from symbody import cos, lambdify, symbols
    >>> x, a = symbols("x a")
    >>> f = lambdify([x, a], [a * x, cos(x)])
    >>> f([0.0, 1.0], 2.0)
    array([[0.        , 2.        ],
           [1.        , 0.54030231]])
    """
    structure = tuple(map(_argument, [arguments] if isinstance(arguments, Expr) else _listed(arguments)))
    _check_single(structure)
    outputs, shapes = _flatten(expressions)
    _check_threads(threads)
    function = CompiledFunction(
        structure, tuple(outputs), shapes, compile, threads, tuple(map(str, equation_names))
    )
    function.tape  # noqa: B018 - made now, so that a variable without a value is found now
    return function


def _check_threads(threads: int) -> None:
    if type(threads) is not int or threads < 1:
        raise ArgumentError(f"lambdify, threads: {threads!r}; expected a whole number from 1")


def _listed(arguments: object) -> list[Any]:
    if isinstance(arguments, str) or not isinstance(arguments, Iterable):
        raise ArgumentError(f"lambdify, arguments: {described(arguments)}; expected a list of variables")
    return list(arguments)


def _argument(argument: object) -> tuple[Expr, ...] | Expr:
    if isinstance(argument, Expr) and argument.is_variable:
        return argument
    if isinstance(argument, Iterable) and not isinstance(argument, str):
        listed = tuple(argument)
        if all(isinstance(leaf, Expr) and leaf.is_variable for leaf in listed):
            return listed
    raise ArgumentError(
        f"lambdify, arguments: {brief(repr(argument))} is not a variable; "
        "expected symbols, functions of time, their derivatives, or lists of these"
    )


def _check_single(arguments: Iterable[tuple[Expr, ...] | Expr]) -> None:
    """Raise an error for a variable that is given more than once, since its value would be ambiguous."""
    twice = [str(leaf) for leaf, count in Counter(_flat(arguments)).items() if count > 1]
    if twice:
        verb = "is" if len(twice) == 1 else "are"
        raise ArgumentError(
            f"lambdify, arguments: {' and '.join(twice)} {verb} given more than once; expected each variable once, by "
            "itself or in one of the lists"
        )


def _flat(arguments: Iterable[tuple[Expr, ...] | Expr]) -> list[Expr]:
    return [leaf for a in arguments for leaf in ((a,) if isinstance(a, Expr) else a)]


def _is_scalar(item: object) -> bool:
    return isinstance(item, str | Mapping) or not isinstance(item, Iterable)


def _scalar(item: object) -> Expr:
    return expression(item, "lambdify, expressions")


def _flatten(expressions: Outputs) -> tuple[list[Expr], tuple[_Shape, ...] | _Shape]:
    if isinstance(expressions, Matrix):
        return list(expressions.entries), _Shape(0, len(expressions.entries), expressions.shape)
    if isinstance(expressions, np.ndarray):
        return [_scalar(item) for item in expressions.flat], _Shape(0, expressions.size, expressions.shape)
    if _is_scalar(expressions):
        return [_scalar(expressions)], _Shape(0, 1, ())
    items = list(expressions)
    if all(_is_scalar(item) for item in items):
        return [_scalar(item) for item in items], _Shape(0, len(items), (len(items),))
    outputs: list[Expr] = []
    shapes: list[_Shape] = []
    for item in items:
        part, shape = _flatten(item)
        if not isinstance(shape, _Shape):
            raise ExpressionError("lambdify takes lists of expressions and matrices, one level deep")
        shapes.append(_Shape(len(outputs), shape.count, shape.dimensions))
        outputs.extend(part)
    return outputs, tuple(shapes)


def _decoded(counts: Iterable[int | None], encoded: Encoded, options: tuple[Any, ...]) -> CompiledFunction:
    made = iter(decode(encoded))
    arguments = tuple(next(made) if n is None else tuple(islice(made, n)) for n in counts)
    return CompiledFunction(arguments, tuple(made), *options)
