"""Drawings that are moved: ``rotate``, ``translate`` and ``scale`` of plottools."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.errors import WorksheetError
from symbody.worksheet.drawing.options import number_of
from symbody.worksheet.drawing.pieces import pieces_of
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.value import Listed, Plot, Value

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")

__all__ = ["rotated_drawing", "scaled_drawing", "translated_drawing"]


def translated_drawing(session: Session, drawing: Plot, arguments: tuple[Value, ...]) -> Plot:
    """translate(p, x, y), translate(p, x, y, z): a drawing displaced."""
    shift = np.array([number_of(session, each) for each in arguments])
    return _moved("translate", drawing, lambda points: points + _fitting("translate", shift, points))


def scaled_drawing(session: Session, drawing: Plot, arguments: tuple[Value, ...]) -> Plot:
    """scale(p, x, y), scale(p, x, y, z), with a point behind the factors: a drawing stretched about it."""
    factors, center = _split(session, arguments)
    by = np.array([number_of(session, each) for each in factors])
    about = np.zeros(len(by)) if center is None else _point(session, center)
    return _moved("scale", drawing, lambda points: about + (points - about) * _fitting("scale", by, points))


def rotated_drawing(session: Session, drawing: Plot, arguments: tuple[Value, ...]) -> Plot:
    """rotate(p, a), rotate(p, a, [x, y]): a plane drawing turned; rotate(p, a, b, c): about x, then y, then z.

    Raises:
        WorksheetError: the turn is about a line in space.
    """
    turns, center = _split(session, arguments)
    angles = [number_of(session, each) for each in turns]
    if len(angles) not in {1, 3}:
        raise WorksheetError(
            "rotate: expected a drawing and an angle, or a drawing in space and three angles"
        )
    axes = [2] if len(angles) == 1 else [0, 1, 2]
    size = 2 if len(angles) == 1 else 3
    turn = np.eye(3)
    for axis, angle in zip(axes, angles, strict=True):
        turn = _turn(axis, angle) @ turn
    about = np.zeros(size) if center is None else _point(session, center)
    plane = turn[:size, :size]
    return _moved(
        "rotate", drawing, lambda points: (points - _fitting("rotate", about, points)) @ plane.T + about
    )


def _turn(axis: int, angle: float) -> NDArray[np.float64]:
    """Return the matrix of a rotation about a coordinate axis."""
    turn = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn[i, i] = turn[j, j] = np.cos(angle)
    turn[j, i] = np.sin(angle)
    turn[i, j] = -turn[j, i]
    return turn


def _moved(command: str, drawing: Plot, move: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> Plot:
    """Return a drawing with all points moved; each picture of an animation is moved alike."""
    if drawing.kind == "animation":
        pictures = tuple(_moved(command, each, move) for each in drawing.data if isinstance(each, Plot))
        return Plot("animation", pictures, drawing.options)
    pieces = tuple(replace(piece, points=move(piece.points)) for piece in pieces_of(drawing))
    return Plot("curves", pieces, drawing.options)


def _fitting(command: str, values: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    if len(values) != points.shape[1]:
        raise WorksheetError(
            f"{command}: {len(values)} values for a drawing in {points.shape[1]} dimensions; expected one a dimension"
        )
    return values


def _split(session: Session, arguments: tuple[Value, ...]) -> tuple[tuple[Value, ...], Value | None]:
    """Return numbers and the point behind them."""
    is_about = bool(arguments) and isinstance(session.current(arguments[-1]), Listed)
    return (arguments[:-1], arguments[-1]) if is_about else (arguments, None)


def _point(session: Session, value: Value) -> NDArray[np.float64]:
    found = session.current(value)
    items = found.items if isinstance(found, Listed) else ()
    return np.array([number_of(session, each) for each in items])
