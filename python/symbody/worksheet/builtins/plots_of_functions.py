"""Drawings of functions beside ``plot``: logarithmic axes, polar ones, curves and surfaces in space, level lines."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.builtins.plots import curves_of, is_span, plot, point_shape, span_of
from symbody.worksheet.drawing.options import number_of, plot_options, styled
from symbody.worksheet.drawing.pieces import Piece
from symbody.worksheet.evaluation.at_numbers import to_be_evaluated, value_at
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import decimal
from symbody.worksheet.values.value import Listed, Plot, Relation, String, Value

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")

__all__ = ["COMMANDS", "PACKAGES"]

_POINTS, _GRID, _FINE = 200, 30, 80


def _logarithmic(axes: str, usage: str) -> Command:
    """Return the command that plots with logarithmic axes."""

    def drawn(session: Session, *arguments: Value) -> Value:
        made = plot(session, *arguments, logarithmic=axes)
        assert isinstance(made, Plot)
        return Plot(made.kind, made.data, (*made.options, ("logarithmic", String(axes))))

    drawn.__doc__ = usage
    return drawn


def polarplot(session: Session, *arguments: Value) -> Value:
    """plots[polarplot](r, theta = a..b): a curve by its radius, in Cartesian axes."""
    what, *rest = arguments
    options = plot_options(session, rest)
    spans = [each for each in rest if is_span(each)]
    curves = []
    for piece in curves_of(session, what, spans[0] if spans else None, options, whole_turn=True):
        angle, radius = piece.points.T
        curves.append(Piece("curve", np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])))
    return Plot("curves", tuple(styled(session, curves, options)), tuple(options.items()))


def spacecurve(session: Session, *arguments: Value) -> Value:
    """plots[spacecurve]([x, y, z], s = a..b): a curve in space; or by its points, [[x, y, z], ...]."""
    spans = [each for each in arguments[1:] if is_span(each)]
    what = session.current(session.resolve(arguments[0])) if arguments else None
    if not spans or not isinstance(what, Listed):
        return point_shape(session, *arguments)
    options = plot_options(session, list(arguments))
    variable, first, last = span_of(session, spans[0], what)
    columns = [_values(session, each, [variable], [np.linspace(first, last, _POINTS)]) for each in what.items]
    curves = styled(session, [Piece("curve", np.column_stack(columns))], options)
    return Plot("curves", tuple(curves), tuple(options.items()))


def plot3d(session: Session, *arguments: Value) -> Value:
    """plot3d(f, x = a..b, y = c..d), or plot3d([x, y, z], u = .., v = ..): a surface."""
    what, options = to_be_evaluated(session, arguments[0]), plot_options(session, list(arguments[1:]))
    (x, first), (y, second) = _two_spans(session, arguments, "plot3d", _GRID)
    u, v = (each.ravel() for each in np.meshgrid(first, second))
    if isinstance(what, Listed):
        columns = [_values(session, each, [x, y], [u, v]) for each in what.items]
        labels = ("", "", "")
    else:
        columns = [u, v, _values(session, what, [x, y], [u, v])]
        labels = (str(x or ""), str(y or ""), "")
    piece = Piece("surface", np.column_stack(columns), labels, rows=len(second))
    return Plot("curves", tuple(styled(session, [piece], options)), tuple(options.items()))


def implicitplot(session: Session, *arguments: Value) -> Value:
    """plots[implicitplot](f = g, x = a..b, y = c..d): the curve on which an equation holds."""
    what, options = to_be_evaluated(session, arguments[0]), plot_options(session, list(arguments[1:]))
    (x, first), (y, second) = _two_spans(session, arguments, "implicitplot", _FINE)
    value = what.left - what.right if isinstance(what, Relation) else what  # type: ignore[operator]
    u, v = np.meshgrid(first, second)
    heights = _values(session, value, [x, y], [u.ravel(), v.ravel()]).reshape(u.shape)
    curves = [Piece("curve", line) for line in _level_lines(u, v, heights)]
    return Plot("curves", tuple(styled(session, curves, options)), tuple(options.items()))


def _level_lines(
    u: NDArray[np.float64], v: NDArray[np.float64], heights: NDArray[np.float64]
) -> Sequence[NDArray[np.float64]]:
    """Return the lines on which heights are zero."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - loaded for the first drawing

    segments: Sequence[NDArray[np.float64]] = Figure().add_subplot().contour(u, v, heights, [0.0]).allsegs[0]
    return [each for each in segments if len(each) > 1]


def _two_spans(
    session: Session, arguments: tuple[Value, ...], where: str, count: int
) -> list[tuple[Expr | None, NDArray[np.float64]]]:
    spans = [each for each in arguments[1:] if is_span(each)]
    if len(spans) < 2:
        raise WorksheetError(f"{where}: expected two ranges, such as x = 0..1, y = 0..1")
    found = [span_of(session, each, arguments[0]) for each in spans[:2]]
    return [(variable, np.linspace(first, last, count)) for variable, first, last in found]


def _values(
    session: Session, what: Value, variables: list[Expr | None], columns: list[NDArray[np.float64]]
) -> NDArray[np.float64]:
    """Return the values of an expression, or of a function of as many numbers; nan where there is none."""
    made = []
    for numbers in zip(*columns, strict=True):
        session.limits.check()
        made.append(_value(session, what, variables, [float(each) for each in numbers]))
    return np.array(made)


def _value(session: Session, what: Value, variables: list[Expr | None], numbers: list[float]) -> float:
    try:
        if isinstance(what, Expr):
            named = zip(variables, numbers, strict=True)
            return value_at(session, what, {x: value for x, value in named if x is not None})
        return number_of(session, session.call(what, tuple(map(decimal, numbers))))
    except (SymbodyError, ArithmeticError):
        return math.nan


PACKAGES: dict[str, dict[str, Command]] = {
    "plots": {
        "logplot": _logarithmic("y", "plots[logplot](f, x = a..b): a plot with a logarithmic y axis."),
        "semilogplot": _logarithmic(
            "x", "plots[semilogplot](f, x = a..b): a plot with a logarithmic x axis."
        ),
        "loglogplot": _logarithmic("xy", "plots[loglogplot](f, x = a..b): a plot with logarithmic axes."),
        "polarplot": polarplot,
        "spacecurve": spacecurve,
        "implicitplot": implicitplot,
    },
}
COMMANDS: dict[str, Command] = {"plot3d": plot3d}
