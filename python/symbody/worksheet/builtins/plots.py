"""Drawings: plot, display, and the pieces of plottools."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.commands.frames import rotate, translate
from symbody.worksheet.drawing.moved import scaled_drawing
from symbody.worksheet.drawing.options import number_of, plot_options, range_of, styled
from symbody.worksheet.drawing.pieces import Piece, pieces_of
from symbody.worksheet.evaluation.at_numbers import to_be_evaluated, value_at
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.complex_number import as_complex, has_i
from symbody.worksheet.values.numeric import decimal
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Boolean,
    Builtin,
    Listed,
    MapleSet,
    Plot,
    ProcedureValue,
    Range,
    Relation,
    Sequence,
    String,
    Unevaluated,
    Value,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")


__all__ = ["COMMANDS", "PACKAGES", "curves_of", "is_span", "plot", "point_shape", "span_of"]

_POINTS = 100


def plot(session: Session, *arguments: Value, logarithmic: str = "") -> Value:
    """plot(f, x = a..b [, options]): curves of expressions, of lists of points, or of [f, g, t = a..b]."""
    if not arguments:
        raise WorksheetError("plot: expected an expression and a range, such as plot(sin(x), x = 0..1)")
    what, *rest = arguments
    options = plot_options(session, rest)
    spans = [each for each in rest if is_span(each)]
    span, others = spans[0] if spans else None, spans[1:]
    if others and "view" not in options:
        options["view"] = range_of(session, others[0])
    found = to_be_evaluated(session, what) if not _is_function(session, what) else what
    curves = styled(
        session, curves_of(session, found, span, options, logarithmic="x" in logarithmic), options
    )
    return Plot("curves", tuple(curves), tuple(options.items()))


def is_span(value: Value) -> bool:
    """Whether an argument is a range, or that of a variable."""
    return isinstance(value, Range) or (isinstance(value, Relation) and isinstance(value.right, Range))


def _is_function(session: Session, value: Value) -> bool:
    return isinstance(session.resolve(value), ProcedureValue | Builtin)


def curves_of(
    session: Session,
    what: Value,
    span: Value | None,
    options: dict[str, Value],
    *,
    logarithmic: bool = False,
    whole_turn: bool = False,
) -> list[Piece]:
    """Return the curves of an expression, a function, a list of points, or of several of them.

    Args:
        session: the session.
        what: what is drawn.
        span: the variable with its range.
        options: the options of the drawing.
        logarithmic: whether the places are evenly spaced on a logarithmic axis.
        whole_turn: whether the range is a whole turn where none is given.
    """
    points = _points(session, what)
    if points is not None:
        kind = "points" if str(options.get("style", "")).lower() == "point" else "curve"
        return [Piece(kind, points)]
    if isinstance(what, Listed | MapleSet | Sequence):
        last = what.items[-1] if what.items else None
        if isinstance(what, Listed) and len(what.items) == 3 and last is not None and is_span(last):
            return [_parametric(session, what, options)]
        same = {"logarithmic": logarithmic, "whole_turn": whole_turn}
        return [piece for item in what.items for piece in curves_of(session, item, span, options, **same)]
    variable, first, last_value = span_of(session, span, what)
    if span is None and whole_turn:
        first, last_value = 0.0, 2 * math.pi
    spaced = np.geomspace if logarithmic and first > 0 else np.linspace
    x = spaced(first, last_value, _count(session, options))
    y = np.array([_at(session, what, variable, each) for each in x])
    return [Piece("curve", np.column_stack([x, y]), (str(variable or ""), session.text(what)[:60]))]


def _parametric(session: Session, what: Listed, options: dict[str, Value]) -> Piece:
    """Return the curve of [f, g, t = a..b]."""
    f, g, span = what.items
    variable, first, last = span_of(session, span, f)
    times = np.linspace(first, last, _count(session, options))
    columns = [[_at(session, each, variable, time) for time in times] for each in (f, g)]
    return Piece("curve", np.array(columns).T)


def _count(session: Session, options: dict[str, Value]) -> int:
    count = int(number_of(session, options["numpoints"])) if "numpoints" in options else _POINTS
    session.limits.check_items(count)
    return max(count, 2)


def span_of(session: Session, span: Value | None, what: Value) -> tuple[Expr | None, float, float]:
    """Return the variable of a range, or of an expression with one variable, and the ends."""
    variable: Expr | None = None
    if isinstance(span, Relation):
        if isinstance(span.left, Expr):
            variable = span.left
        span = span.right
    if variable is None and isinstance(what, Expr):
        free = sorted(what.free_symbols, key=str)
        variable = free[0] if len(free) == 1 else None
    if not isinstance(span, Range):
        return variable, -10.0, 10.0
    return variable, number_of(session, span.start), number_of(session, span.stop)


def _at(session: Session, what: Value, variable: Expr | None, x: float) -> float:
    """Return the value of an expression, or of a function, at a number; nothing is drawn where there is none."""
    session.limits.check()
    try:
        if isinstance(what, Expr) and has_i(what):
            number = as_complex(what if variable is None else what.subs({variable: decimal(x)}))
            return math.nan if number is None or number.imag else number.real
        if isinstance(what, Expr):
            return value_at(session, what, {} if variable is None else {variable: x})
        found = session.current(session.call(what, (decimal(x),)))
        return float(found.evaluate({})) if isinstance(found, Expr) else math.nan
    except (SymbodyError, ArithmeticError):
        return math.nan


def _points(session: Session, value: Value) -> NDArray[np.float64] | None:
    """Return the points of a list of points, or of a matrix of two or three columns; None for what is none."""
    found = session.resolve(value)
    if isinstance(found, Array) and found.columns in {2, 3}:
        numbers = [number_of(session, each) for each in found.entries]
        return np.array(numbers).reshape(found.rows, found.columns)
    if not isinstance(found, Listed) or not found.items:
        return None
    rows = [session.current(session.resolve(each)) for each in found.items]
    if not all(isinstance(row, Listed) and len(row.items) in {2, 3} for row in rows):
        return None
    if any(is_span(item) for row in rows if isinstance(row, Listed) for item in row.items):
        return None
    return np.array(
        [[number_of(session, item) for item in row.items] for row in rows if isinstance(row, Listed)]
    )


def display(session: Session, *arguments: Value) -> Value:
    """plots[display]([p, q, ...] [, insequence = true]): drawings over each other, or one after the other."""
    made = tuple(_current_drawing(session, each) for each in arguments)
    if any(_waits(each) for each in made):
        return Unevaluated(Builtin("display", display), made)
    plots = [each for argument in made for each in _plots(session, argument)]
    options = plot_options(session, list(arguments))
    moves = options.get("insequence") == Boolean(truth=True)
    data = tuple(plots) if moves else tuple(piece for each in plots for piece in pieces_of(each))
    inner = {name: value for each in plots for name, value in each.options}
    return Plot("animation" if moves else "curves", data, tuple((inner | options).items()))


def _current_drawing(session: Session, value: Value) -> Value:
    """Return drawings as they are now: shapes whose names have values by now are drawn."""
    found = session.resolve(value)
    if isinstance(found, Listed | MapleSet | Sequence):
        return Listed(tuple(_current_drawing(session, each) for each in found.items))
    return session.current(found) if isinstance(found, Unevaluated) else value


def _waits(value: Value) -> bool:
    """Whether a drawing holds shapes that have no numbers yet."""
    if isinstance(value, Listed):
        return any(map(_waits, value.items))
    return isinstance(value, Unevaluated) and isinstance(value.function, Builtin)


def _plots(session: Session, value: Value) -> list[Plot]:
    found = session.resolve(value)
    if isinstance(found, Listed | MapleSet | Sequence):
        return [each for item in found.items for each in _plots(session, item)]
    return [found] if isinstance(found, Plot) else []


def animate(session: Session, what: Value, *arguments: Value) -> Value:
    """plots[animate](f, [arguments], q = a..b), or animate(f(x, q), x = .., q = a..b): a drawing that moves."""
    spans = [each for each in arguments if isinstance(each, Relation) and isinstance(each.right, Range)]
    if not spans:
        raise WorksheetError("animate: expected a range of the variable that moves, such as q = 0..1")
    options = plot_options(session, list(arguments))
    variable, first, last = span_of(session, spans[-1], what)
    count = int(number_of(session, options.get("frames", decimal(25.0))))
    session.limits.check_items(count)
    pictures = []
    for value in np.linspace(first, last, max(count, 2)):
        mapping = {} if variable is None else {variable: decimal(float(value))}
        inner = next((each for each in arguments if isinstance(each, Listed)), None)
        if inner is None:
            shown = plot(session, _with(session, what, mapping), *spans[:-1])
        else:
            shown = session.call(what, tuple(_with(session, each, mapping) for each in inner.items))
        pictures += _plots(session, shown)
    return Plot("animation", tuple(pictures), tuple(options.items()))


def _with(session: Session, value: Value, mapping: dict[Expr, Expr]) -> Value:
    found = session.current(value)
    if isinstance(found, Expr):
        return found.subs(mapping) if mapping else found
    if isinstance(found, Listed):
        return Listed(tuple(_with(session, each, mapping) for each in found.items))
    if isinstance(found, Relation):
        return Relation(found.operator, found.left, _with(session, found.right, mapping))
    if isinstance(found, Range):
        return Range(_with(session, found.start, mapping), _with(session, found.stop, mapping))
    return found


def textplot(session: Session, what: Value, *arguments: Value) -> Value:
    """plots[textplot]([x, y, text]): a text at a place, or several of them."""
    found = session.current(what)
    items = list(found.items) if isinstance(found, Listed | MapleSet) else []
    if items and all(isinstance(each, Listed) for each in items):
        return Plot("curves", tuple(p for each in items for p in pieces_of(_one_text(session, each))))
    return _one_text(session, found)


def _one_text(session: Session, value: Value) -> Plot:
    items = value.items if isinstance(value, Listed) else ()
    if len(items) < 3:
        raise WorksheetError("textplot: expected [x, y, text]")
    *place, text = items
    shown = text.text if isinstance(text, String) else session.text(text)
    return Plot(
        "curves", (Piece("text", np.array([[number_of(session, each) for each in place]]), (shown,)),)
    )


# --- plottools ---


def _is_open(session: Session, value: Value) -> bool:
    """Whether a place or a size contains names without a value."""
    found = session.current(session.resolve(value))
    if isinstance(found, Expr):
        return not found.is_constant
    if isinstance(found, Range):
        return any(_is_open(session, each) for each in (found.start, found.stop))
    parts = found.entries if isinstance(found, Array) else getattr(found, "items", ())
    return any(_is_open(session, each) for each in parts)


def _shape(
    kind: str, outline: Callable[[Session, tuple[Value, ...]], NDArray[np.float64]], usage: str
) -> Command:
    def shape(session: Session, *arguments: Value) -> Value:
        plain = tuple(each for each in arguments if not isinstance(each, Relation))
        if any(_is_open(session, each) for each in plain):
            return Unevaluated(Builtin(usage.partition("(")[0], shape), arguments)
        options = plot_options(session, list(arguments))
        try:
            points = outline(session, plain)
        except (IndexError, ValueError) as fault:
            raise WorksheetError(f"expected {usage}") from fault
        return Plot("curves", tuple(styled(session, [Piece(kind, points)], options)), tuple(options.items()))

    shape.__doc__ = usage
    return shape


def _place(session: Session, value: Value) -> NDArray[np.float64]:
    found = session.resolve(value)
    items = found.items if isinstance(found, Listed) else found.entries if isinstance(found, Array) else ()
    return np.array([number_of(session, each) for each in items])


def _polyline(session: Session, arguments: tuple[Value, ...]) -> NDArray[np.float64]:
    points = _points(session, arguments[0])
    return np.array([_place(session, each) for each in arguments[:2]]) if points is None else points


def _arc(session: Session, arguments: tuple[Value, ...]) -> NDArray[np.float64]:
    center = _place(session, arguments[0])
    radius = (
        number_of(session, arguments[1]) if len(arguments) > 1 and isinstance(arguments[1], Expr) else 1.0
    )
    angles = np.linspace(0, 2 * math.pi, 49)
    ring = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    if len(center) == 2:
        return ring + center
    flat = np.column_stack([ring, np.zeros(len(ring))])
    rings = [center + flat, center + flat[:, [0, 2, 1]], center + flat[:, [2, 0, 1]]]
    return np.concatenate(rings)


def _half(session: Session, arguments: tuple[Value, ...]) -> NDArray[np.float64]:
    """Return the points of an arc by its centre, its radius and the range of the angle."""
    center, radius = _place(session, arguments[0]), number_of(session, arguments[1])
    span = arguments[2] if len(arguments) > 2 else Range(decimal(0.0), decimal(2 * math.pi))
    if not isinstance(span, Range):
        raise IndexError
    angles = np.linspace(number_of(session, span.start), number_of(session, span.stop), 49)
    return center + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def _ellipse(session: Session, arguments: tuple[Value, ...]) -> NDArray[np.float64]:
    center, *axes = _place(session, arguments[0]), *(number_of(session, each) for each in arguments[1:3])
    angles = np.linspace(0, 2 * math.pi, 49)
    return center + np.column_stack([axes[0] * np.cos(angles), axes[1] * np.sin(angles)])


def _listed(session: Session, arguments: tuple[Value, ...]) -> NDArray[np.float64]:
    """Return points, or the points (1, y1), (2, y2), .. of numbers."""
    points = _points(session, arguments[0])
    if points is not None:
        return points
    values = _place(session, arguments[0])
    return np.column_stack([np.arange(1, len(values) + 1), values])


def _direction(session: Session, arguments: tuple[Value, ...]) -> NDArray[np.float64]:
    """Return the ends of an arrow by its vector, from a point or from the origin."""
    *base, vector = (_place(session, each) for each in arguments[:2])
    start = base[0] if base else np.zeros(len(vector))
    return np.array([start, start + vector])


def transform(session: Session, function: Value) -> Value:
    """plottools[transform](f): what moves each point of a drawing to f(x, y) or f(x, y, z), which is a list."""

    def moved(session: Session, drawing: Value) -> Value:
        found = session.resolve(drawing)
        if not isinstance(found, Plot):
            raise WorksheetError("transform: expected a drawing")
        pieces = [
            replace(piece, points=np.array([_image(session, function, point) for point in piece.points]))
            for piece in pieces_of(found)
        ]
        return Plot("curves", tuple(pieces), found.options)

    return Builtin("transform", moved)


def scale(session: Session, drawing: Value, *factors: Value) -> Value:
    """plottools[scale](p, x, y), plottools[scale](p, x, y, z): a drawing stretched along the axes."""
    found = session.resolve(drawing)
    if not isinstance(found, Plot) or not factors:
        raise WorksheetError("scale: expected a drawing and a factor for each axis")
    return scaled_drawing(session, found, factors)


def _image(session: Session, function: Value, point: NDArray[np.float64]) -> NDArray[np.float64]:
    session.limits.check()
    return _place(session, session.current(session.call(function, tuple(decimal(float(x)) for x in point))))


def _rectangle(session: Session, arguments: tuple[Value, ...]) -> NDArray[np.float64]:
    (a, b), (c, d) = (_place(session, each) for each in arguments[:2])
    return np.array([[a, b], [c, b], [c, d], [a, d], [a, b]])


point_shape = _shape("curve", _polyline, "spacecurve([[x, y, z], ...])")
COMMANDS: dict[str, Command] = {"plot": plot}
_PLOTS: dict[str, Command] = {
    "display": display,
    "display3d": display,
    "animate": animate,
    "arrow": _shape("curve", _direction, "arrow([x, y, z], [vx, vy, vz])"),
    "textplot": textplot,
    "textplot3d": textplot,
    "pointplot": _shape("points", _polyline, "pointplot([[x, y], ...])"),
    "pointplot3d": _shape("points", _polyline, "pointplot3d([[x, y, z], ...])"),
    "listplot": _shape("curve", _listed, "listplot([y1, y2, ...]) or listplot([[x, y], ...])"),
    "polygonplot": _shape("area", _polyline, "polygonplot([[x, y], ...])"),
    "setoptions": lambda session, *arguments: NULL,
    "setoptions3d": lambda session, *arguments: NULL,
}
_TOOLS: dict[str, Command] = {
    "line": _shape("curve", _polyline, "line([x, y], [x, y])"),
    "curve": _shape("curve", _polyline, "curve([[x, y], ...])"),
    "polygon": _shape("area", _polyline, "polygon([[x, y], ...])"),
    "point": _shape("points", lambda s, a: np.atleast_2d(_place(s, a[0])), "point([x, y])"),
    "disk": _shape("area", _arc, "disk([x, y], radius)"),
    "circle": _shape("curve", _arc, "circle([x, y], radius)"),
    "sphere": _shape("curve", _arc, "sphere([x, y, z], radius)"),
    "rectangle": _shape("area", _rectangle, "rectangle([x1, y1], [x2, y2])"),
    "arrow": _shape("curve", _polyline, "arrow([x, y], [x, y], width, head width, head length)"),
    "cylinder": _shape("curve", _polyline, "cylinder([x, y, z], [x, y, z], radius)"),
    "arc": _shape("curve", _half, "arc([x, y], radius, a..b)"),
    "ellipse": _shape("curve", _ellipse, "ellipse([x, y], a, b)"),
    "transform": transform,
    "rotate": rotate,
    "translate": translate,
    "scale": scale,
}
PACKAGES: dict[str, dict[str, Command]] = {"plots": _PLOTS, "plottools": _TOOLS}
