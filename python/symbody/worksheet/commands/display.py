"""The command show: objects with their fields."""

from __future__ import annotations

from dataclasses import replace

from symbody.geometry import ground
from symbody.symbolic import Expr, symbol
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import kind_of
from symbody.worksheet.values.value import Array, Reference, Relation, String, Table, Unevaluated, Value

__all__ = ["COMMANDS"]

_ORDER = (
    "frame",
    "acting",
    "shape",
    "compliance",
    "FORCE",
    "TORQUE",
    "coords",
    "comps",
    "mass",
    "inertia",
    "expr",
    "reacting",
    "applied",
)
"""The order of fields where they are printed; that of Maple's tables can't be reproduced."""
_UNNAMED = "TT"
"""How a frame that no name holds is shown, if it is to be shown by a name."""


def show(session: Session, thing: Value, *options: Value) -> Value:
    """show(obj [, 'synthetic']): an object with its fields; 'synthetic' shows frames by their names."""
    by_name = any(_word(option).startswith("synt") for option in options)
    for option in options:
        if not _word(option).startswith("synt"):
            text = _word(option) if isinstance(option, String | Expr) else session.text(option)[:60]
            session.notices.append(f"show: the option {text} is not known; expected 'synthetic'")
    found = session.resolve(thing)
    if kind_of(found) == "":
        return _plain(session, found)
    shown = _fields(session, found, by_name=by_name)
    return Relation("=", symbol(thing.name), shown) if isinstance(thing, Reference) else shown


def _word(option: Value) -> str:
    return option.text if isinstance(option, String) else str(option)


def _plain(session: Session, value: Value) -> Value:
    """Return what isn't an object in full: a frame as its matrix."""
    if isinstance(value, Array):
        entries = [session.current(entry) for entry in value.entries]
        return replace(value, entries=entries, attributes=(), frame=None)
    return session.current(value)


def _fields(session: Session, table: Value, *, by_name: bool) -> Unevaluated:
    assert isinstance(table, Table)
    named = {key[0].name: value for key, value in table.entries.items() if isinstance(key[0], Expr)}
    order = [name for name in _ORDER if name in named] + sorted(named.keys() - {*_ORDER, "obj"})
    fields = [
        Relation("=", symbol(name), _field(session, name, named[name], by_name=by_name)) for name in order
    ]
    if (
        mechanics(session).release < 4 and not by_name
    ):  # that of 2004 leaves out the ground, unless names are asked for
        fields = [each for each in fields if each.right != symbol("ground")]
    return Unevaluated(symbol(kind_of(table)), tuple(fields))


def _field(session: Session, name: str, value: Value, *, by_name: bool) -> Value:
    if name == "frame":
        return _frame(session, value, by_name=by_name)
    found = session.resolve(value)
    if name in {"acting", "reacting"} and isinstance(found, Array):  # the ground, or the moving frame
        return _frame(session, value, by_name=True)
    if kind_of(found):  # a body or a point: by its name, or as it stands
        return symbol(value.name) if isinstance(value, Reference) else _fields(session, found, by_name=True)
    return _plain(session, found)


def _frame(session: Session, value: Value, *, by_name: bool) -> Value:
    array = session.resolve(value)
    name = array.attributes[0] if isinstance(array, Array) and array.attributes else None
    is_ground = isinstance(array, Array) and array.frame == ground and not isinstance(value, Reference)
    if is_ground and (name is None or name == symbol("ground")):
        return frame_face.ground_face(mechanics(session)).attributes[0]
    if name is not None:
        return name
    if not by_name:
        return _plain(session, array)
    if isinstance(value, Reference):
        return symbol(value.name)
    names = [name for name, held in session.names.items() if held is array]
    return symbol(names[0] if names else _UNNAMED)


COMMANDS: dict[str, Command] = {"show": show}
