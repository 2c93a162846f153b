"""Options of drawings: for the whole drawing, or for each of its curves."""

from __future__ import annotations

from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.drawing.pieces import Piece
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import Listed, Range, Relation, String, Value

__all__ = ["number_of", "plot_options", "range_of", "styled"]


def plot_options(session: Session, arguments: list[Value]) -> dict[str, Value]:
    """Return options by name; one that changes nothing here is told."""
    found: dict[str, Value] = {}
    for each in arguments:
        if not isinstance(each, Relation) or each.operator != "=":
            continue
        name = str(each.left)
        if isinstance(each.right, Range) and name != "view":
            continue
        if name not in OPTIONS and name not in _IGNORED:
            session.notice(f"plot: the option {name} is not known, and is ignored")
        found["labels" if name == "label" else name] = (
            _view(session, each.right) if name == "view" else each.right
        )
    return found


def _view(session: Session, value: Value) -> Value:
    """Return the ranges of the option ``view``, in numbers."""
    found = session.resolve(value)
    if isinstance(found, Listed):
        return Listed(tuple(range_of(session, each) for each in found.items))
    return range_of(session, found)


def styled(session: Session, curves: list[Piece], options: dict[str, Value]) -> list[Piece]:
    """Return curves as options say: one value for all of them, or a list with one for each."""
    return [_styled(session, piece, options, place) for place, piece in enumerate(curves)]


def _styled(session: Session, piece: Piece, options: dict[str, Value], place: int) -> Piece:
    width = _chosen(session, options.get("thickness"), place)
    return replace(
        piece,
        color=piece.color or _color(session, options, place),
        name=_chosen(session, options.get("legend"), place),
        line=_LINES.get(_chosen(session, options.get("linestyle"), place).lower(), "solid"),
        width=float(width) if width.replace(".", "", 1).isdigit() else None,
    )


def _chosen(session: Session, value: Value | None, place: int) -> str:
    """Return the text of an option, or of its item for one of several curves; nothing where there is none."""
    if value is None:
        return ""
    found = session.resolve(value)
    if isinstance(found, Listed):
        found = session.resolve(found.items[place]) if place < len(found.items) else String("")
    return found.text if isinstance(found, String) else session.text(found)


OPTIONS = frozenset(
    {
        *(
            "title",
            "labels",
            "label",
            "legend",
            "color",
            "colour",
            "linestyle",
            "thickness",
            "view",
            "scaling",
        ),
        *("gridlines", "axes", "style", "numpoints", "frames", "insequence"),
    }
)
"""Options of drawings that have an effect here."""
_IGNORED = frozenset(
    {
        *("symbol", "symbolsize", "font", "titlefont", "labelfont", "axesfont", "tickmarks", "xtickmarks"),
        *(
            "ytickmarks",
            "adaptive",
            "discont",
            "resolution",
            "sample",
            "filled",
            "transparency",
            "orientation",
        ),
        *(
            "projection",
            "shading",
            "light",
            "lightmodel",
            "ambientlight",
            "grid",
            "coords",
            "labeldirections",
        ),
        *("legendstyle", "size", "background", "caption", "refine", "paraminfo", "trace"),
    }
)
"""Options of Maple that are a matter of looks, and have no effect here."""
_LINES = {
    "1": "solid",
    "2": "dotted",
    "3": "dashed",
    "4": "dashdot",
    "solid": "solid",
    "dot": "dotted",
    "dash": "dashed",
    "dashdot": "dashdot",
    "longdash": "dashed",
}


def _color(session: Session, options: dict[str, Value], place: int = 0) -> str:
    return _chosen(session, options.get("color", options.get("colour")), place).lower()


def range_of(session: Session, span: Value) -> Value:
    """Return the range of ``y = a..b``, in numbers."""
    found = span.right if isinstance(span, Relation) else span
    if not isinstance(found, Range):
        return found
    return Range(decimal(number_of(session, found.start)), decimal(number_of(session, found.stop)))


def number_of(session: Session, value: Value) -> float:
    """Return a number of a drawing."""
    found = session.current(value)
    number = as_float(found) if isinstance(found, Expr) else None
    if number is None:
        raise WorksheetError(
            f"plot: {session.text(found)[:60]} is no number; give all names in drawings a value"
        )
    return number
