"""The two faces of a frame: the chain of motions, from which velocities are made, and a 4x4 matrix.

An `Array` shows the matrix, and keeps the chain in `frame` as long as both say the same. Products, inverses and
substitutions act on the chain. Rewriting a matrix keeps its chain. What else changes a matrix makes it a plain one.
When a command asks for the frame of a plain matrix, such as one that ``read`` brings, its motions are found again from
its entries (`elementary_motions`); a matrix that is no product of them is one general motion.
"""

from __future__ import annotations

from collections.abc import Mapping

from symbody.errors import FrameError, WorksheetError
from symbody.geometry import Frame, ground
from symbody.symbolic import Expr, Matrix, number, symbol
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mechanics.elementary_motions import frame_of
from symbody.worksheet.mechanics.modes import Mechanics, mechanics
from symbody.worksheet.mechanics.small_variables import entered_frame, left
from symbody.worksheet.values.value import Array, Value

__all__ = [
    "chain",
    "current",
    "face",
    "ground_face",
    "is_frame",
    "product",
    "rewritten",
    "substituted",
]

GROUNDS = ("ground", "master_frame", "moving_frame")
_SIZE = 4
_LAST = (0, 0, 0, 1)


def face(modes: Mechanics, frame: Frame, kind: str | None = None) -> Array:
    """Return the array of a chain of motions: its matrix is of first order in small variables."""
    entries = left(modes, entered_frame(modes, frame).matrix.entries)
    return Array(_SIZE, _SIZE, list(entries), kind or modes.matrix_kind, frame=frame)


def ground_face(modes: Mechanics) -> Array:
    """Return the identity, which is shown by its name."""
    name = "ground" if modes.moving is None else "moving_frame"
    array = face(modes, ground)
    array.attributes = (symbol(name),)
    return array


def is_frame(value: Value) -> bool:
    """Return whether a value is a 4x4 matrix with 0, 0, 0, 1 in its last row."""
    return (
        isinstance(value, Array)
        and (value.rows, value.columns) == (_SIZE, _SIZE)
        and all(
            isinstance(entry, Expr) and entry == number(last)
            for entry, last in zip(value.entries[12:], _LAST, strict=True)
        )
    )


def chain(session: Session, value: Value, where: str) -> Frame:
    """Return the chain of a matrix, with what was assigned since; of a plain matrix, one general motion."""
    array = session.resolve(value)
    if not isinstance(array, Array) or (array.rows, array.columns) != (_SIZE, _SIZE):
        raise WorksheetError(
            f"{where}: {session.text(array)[:60]}; expected a frame, a 4x4 matrix such as translate(x, y, z) * "
            "rotate('Z', a)"
        )
    if isinstance(array.frame, Frame):
        return current(session, array.frame)
    entries = _scalars(session, array)
    if len(entries) != len(array.entries):
        raise WorksheetError(f"{where}: a matrix with entries that are no expressions; expected a frame")
    try:
        return frame_of(entries) or Frame(Matrix.from_entries(_SIZE, _SIZE, entries))
    except FrameError as fault:
        raise WorksheetError(f"{where}: {fault}") from fault


def _scalars(session: Session, array: Array) -> list[Expr]:
    """Return the entries that are expressions, with what was assigned since."""
    entries = [session.current(entry) for entry in array.entries]
    return [entry for entry in entries if isinstance(entry, Expr)]


def current(session: Session, frame: Frame) -> Frame:
    """Return a chain with the values of names that were assigned since it was made."""
    leaves = {leaf for motion in frame.motions for leaf in motion.leaves}
    values = {leaf: session.current(leaf) for leaf in sorted(leaves, key=str)}
    changed = {leaf: value for leaf, value in values.items() if isinstance(value, Expr) and value is not leaf}
    changed = {leaf: value for leaf, value in changed.items() if not value.same_form(leaf)}
    return frame.subs(changed) if changed else frame


def product(session: Session, a: Array, b: Array) -> Array | None:
    """Return the product of two frames by both faces; None where one of them is a plain matrix.

    The chain is that of both motions, where the axes of both are orthonormal: a matrix that may be none of a rotation
    is multiplied as it stands.
    """
    one, other = _motions(session, a), _motions(session, b)
    if one is None or other is None or not (one.is_rigid and other.is_rigid):
        return None
    return face(mechanics(session), one * other, a.kind)


def _motions(session: Session, array: Array) -> Frame | None:
    """Return the chain of a matrix, or the motions of which a plain one is the product."""
    if isinstance(array.frame, Frame):
        return current(session, array.frame)
    entries = _scalars(session, array) if is_frame(array) else []
    return frame_of(entries) if len(entries) == len(array.entries) else None


def rewritten(session: Session, before: Array, after: Array) -> Array:
    """Return a matrix in another form of the same value, with the chain of the one before."""
    del session
    after.frame = before.frame
    return after


def substituted(session: Session, before: Array, after: Array, mapping: Mapping[Expr, Expr]) -> Array:
    """Return a matrix after a substitution; the chain is kept if it says the same after it."""
    if isinstance(before.frame, Frame):
        frame = current(session, before.frame).subs(mapping)
        if face(mechanics(session), frame).entries == [session.current(entry) for entry in after.entries]:
            after.frame = frame
    return after
