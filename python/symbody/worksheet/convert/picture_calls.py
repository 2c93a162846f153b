"""Commands that draw: curves, surfaces and points; Matplotlib says the same."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.numbers_calls import number_text, range_of, residual_text
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.shapes import SHAPES, is_animated, picture_of, points_of
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["PICTURES"]

Call: TypeAlias = Callable[[Writer, Arguments], str]

_PLANE, _SPACE = "plt.subplots()[1]", 'plt.figure().add_subplot(projection="3d")'


def _curve(method: str = "plot", spaced: str = "linspace") -> Call:
    """Return the writer of curves of an expression, or of several; ``method`` says which axes are logarithmic."""

    def write(text: Writer, arguments: Arguments) -> str:
        points = arguments[0].items if isinstance(arguments[0], syntax.SetDisplay) else arguments[:1]
        with contextlib.suppress(NoText):
            return picture_of(text, [points_of(text, each) for each in points])
        places, values = _samples(text, arguments, spaced)
        return f"{_PLANE}.{method}({places}, {values})"

    return write


def _samples(text: Writer, arguments: Arguments, spaced: str) -> tuple[str, str]:
    """Return the places of a range, and the values of what is drawn there."""
    variable, first, last = range_of(text, arguments[1:])
    whole = text.text(arguments[0])
    places = f"np.{spaced}({first}, {last}, 200)"
    found = text.value(whole)
    if isinstance(found, list) and all(isinstance(each, Expr) for each in found):
        return places, f"np.transpose(sb.lambdify([{variable}], {whole})({places}))"
    if not isinstance(found, Expr):
        raise NoText("plot")
    return places, f"sb.lambdify([{variable}], {whole})({places})"


def _motion_curve(text: Writer, arguments: Arguments) -> str:
    """Return the curve of expressions along a motion."""
    motion = text.text(arguments[0])
    axes = arguments[1] if len(arguments) > 1 else None
    if isinstance(axes, syntax.ListDisplay) and all(
        isinstance(each, syntax.ListDisplay) and len(each.items) == 2 for each in axes.items
    ):
        curves = [each for one in axes.items if isinstance(one, syntax.ListDisplay) for each in one.items]
        return f"{_PLANE}.plot({', '.join(f'{grouped(motion)}[{text.text(each)}]' for each in curves)})"
    if not isinstance(axes, syntax.ListDisplay) or len(axes.items) not in {2, 3}:
        raise NoText("odeplot")
    columns = ", ".join(f"{grouped(motion)}[{text.text(each)}]" for each in axes.items)
    if len(axes.items) == 3:
        return f"{_SPACE}.plot({columns})"
    return f"{_PLANE}.plot({columns})"


def _space_curve(text: Writer, arguments: Arguments) -> str:
    """Return the curve of three expressions."""
    variable, first, last = range_of(text, arguments[1:])
    whole = text.text(arguments[0])
    if not _is_triple(text, whole):
        raise NoText("spacecurve")
    return f"{_SPACE}.plot(*sb.lambdify([{variable}], {whole})(np.linspace({first}, {last}, 200)))"


def _is_triple(text: Writer, whole: str) -> bool:
    found = text.value(whole)
    return isinstance(found, list) and len(found) == 3


def _surface(text: Writer, arguments: Arguments) -> str:
    """Return the surface of an expression over a rectangle, or of three expressions of two parameters."""
    variables, grid = _grid(text, arguments[1:])
    whole = text.text(arguments[0])
    values = f"sb.lambdify([{variables}], {whole})(*{grid})"
    if _is_triple(text, whole):
        return f"{_SPACE}.plot_surface(*{values})"
    if not isinstance(text.value(whole), Expr):
        raise NoText("plot3d")
    return f"{_SPACE}.plot_surface(*{grid}, {values})"


def _implicit_curve(text: Writer, arguments: Arguments) -> str:
    """Return the curve of an equation between two variables: where the difference of its sides is zero."""
    variables, grid = _grid(text, arguments[1:])
    residual = residual_text(text, arguments[0])
    return f"{_PLANE}.contour(*{grid}, sb.lambdify([{variables}], {residual})(*{grid}), levels=[0])"


def _grid(text: Writer, arguments: Arguments) -> tuple[str, str]:
    """Return the variables of two ranges, and the places where values are drawn."""
    if len(arguments) < 2:
        raise NoText("grid")
    (x, *across), (y, *along) = (range_of(text, arguments[k : k + 1]) for k in (0, 1))
    spaced = [f"np.linspace({first}, {last}, 50)" for first, last in (across, along)]
    return f"{x}, {y}", f"np.meshgrid({', '.join(spaced)})"


def _points(place: str) -> Call:
    """Return the writer of points in the plane or in space."""

    def write(text: Writer, arguments: Arguments) -> str:
        points = arguments[0]
        if not isinstance(points, syntax.ListDisplay):
            raise NoText("pointplot")
        rows = []
        for point in points.items:
            if not isinstance(point, syntax.ListDisplay):
                raise NoText("pointplot")
            rows.append(f"[{', '.join(number_text(text, each) for each in point.items)}]")
        return f'{place}.plot(*np.transpose([{", ".join(rows)}]), "o")'

    return write


def _together(text: Writer, arguments: Arguments) -> str:
    """Return curves that are drawn elsewhere, in one picture."""
    first = arguments[0]
    nodes = first.items if isinstance(first, syntax.ListDisplay | syntax.SetDisplay) else arguments
    shown = [node for node in nodes if not isinstance(node, syntax.Infix)]
    pictures = [text.text(node) for node in shown]
    if is_animated(arguments):
        return text.text(first) if len(shown) == 1 else f"[{', '.join(pictures)}]"
    if not pictures or not all(_are_curves(text.value(each)) for each in pictures):
        return picture_of(text, pictures)
    lines = ", ".join(f"*{each}" for each in pictures)
    return f"{_PLANE}.plot(*[values for line in [{lines}] for values in line.get_data()])"


def _are_curves(value: object) -> bool:
    """Whether a value is what ``plot`` of Matplotlib gives in the plane."""
    return isinstance(value, list) and bool(value) and all(type(each).__name__ == "Line2D" for each in value)


PICTURES: Mapping[str, Call] = {
    **SHAPES,
    "plot": _curve(),
    "logplot": _curve("semilogy"),
    "semilogplot": _curve("semilogx", "geomspace"),
    "loglogplot": _curve("loglog", "geomspace"),
    "odeplot": _motion_curve,
    "spacecurve": _space_curve,
    "plot3d": _surface,
    "implicitplot": _implicit_curve,
    "display": _together,
    "pointplot": _points(_PLANE),
    "pointplot3d": _points(_SPACE),
}
"""Writers by the names of commands."""
