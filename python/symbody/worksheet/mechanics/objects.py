"""Objects of MBSymba, which are tables with a field ``obj``, and the objects of symbody that they stand for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.errors import WorksheetError
from symbody.geometry import Frame, Point, Vector, ground
from symbody.symbolic import Expr, Matrix, number, symbol
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import Mechanics, mechanics
from symbody.worksheet.mechanics.shortest import shortest
from symbody.worksheet.mechanics.small_variables import entered, entered_frame, left, left_frame, result
from symbody.worksheet.printing.print import text_of
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Builtin,
    Listed,
    MapleSet,
    Plot,
    ProcedureValue,
    Quoted,
    Range,
    Reference,
    Relation,
    String,
    Table,
    Unevaluated,
    Value,
)
from symbody.worksheet.values.value import Sequence as Several

if TYPE_CHECKING:
    from symbody import multibody
    from symbody.multibody import Body, Load, left_place
else:
    multibody = Deferred("symbody.multibody")
    left_place = Deferred("symbody.multibody.left_place")

__all__ = [
    "Reader",
    "computed",
    "described",
    "face_of",
    "fields_of",
    "get",
    "is_object",
    "kind_of",
    "made",
    "members",
    "put",
    "table_of_vector",
    "vector_entries",
    "written",
]

Triple = tuple[Expr, Expr, Expr]

# --- tables ---


def get(table: Table, name: str) -> Value | None:
    """Return a field of an object, or None."""
    return table.entries.get((symbol(name),))


def put(table: Table, name: str, value: Value) -> None:
    """Set a field of an object."""
    table.entries[symbol(name),] = value


def made(kind: str, **fields: Value | None) -> Table:
    """Return a new object of a kind, with its fields; those that are None are left out."""
    table = Table()
    for name, value in fields.items():
        if value is not None:
            put(table, name, value)
    put(table, "obj", symbol(kind))
    return table


def kind_of(value: Value) -> str:
    """Return POINT, VECTOR, BODY, ...; an empty text for what is no object."""
    tag = get(value, "obj") if isinstance(value, Table) else None
    return tag.name if isinstance(tag, Expr) and tag.kind == "symbol" else ""


def refuse_object(session: Session, where: str, value: Value) -> None:
    """Refuse an object where a command would change its fields, its frame among them, into something else.

    Raises:
        WorksheetError: the value is an object.
    """
    kind = kind_of(session.resolve(value))
    if kind:
        raise WorksheetError(
            f"{where}: {session.text(value)[:60]} is a {kind}; expected an expression: comp_XYZ(v) are the components "
            "of a VECTOR, velocity(v) is its derivative"
        )


def is_object(value: Value) -> bool:
    """Return whether a value is an object of MBSymba."""
    return bool(kind_of(value))


def column(entries: Sequence[Expr], last: int, modes: Mechanics) -> Array:
    """Return three coordinates and a 1, or three components and a 0, as a column."""
    return Array(4, 1, [*entries, number(last)], modes.matrix_kind)


def vector_entries(session: Session, table: Table, name: str, where: str) -> Triple:
    """Return the first three entries of a field, with what was assigned since."""
    array = session.resolve(get(table, name) or number(0))
    if isinstance(array, Listed):
        array = Array(len(array.items), 1, list(array.items))
    if not isinstance(array, Array) or len(array.entries) < 3:
        raise WorksheetError(f"{where}: the field {name} of a {kind_of(table)} is no column of three entries")
    found = [session.current(entry) for entry in array.entries[:3]]
    if not all(isinstance(entry, Expr) for entry in found):
        raise WorksheetError(f"{where}: the field {name} of a {kind_of(table)} holds more than expressions")
    x, y, z = (entry for entry in found if isinstance(entry, Expr))
    return x, y, z


def table_of_vector(session: Session, vector: Vector, frame: Value | None = None) -> Table:
    """Return the table of a vector that was computed in the modes of the session.

    Args:
        session: the session.
        vector: the vector.
        frame: the frame as the sheet knows it, in whose axes the components are; ground by default.
    """
    modes = mechanics(session)
    shown = frame_face.ground_face(modes) if frame is None else frame
    return made("VECTOR", frame=shown, comps=column(result(modes, vector.components), 0, modes))


# --- reading ---


@dataclass
class Reader:
    """What one command reads: each table becomes one object of symbody, in the modes of the session.

    Attributes:
        session: the session.
        where: the command, for messages.
        hung: whether frames are hung on the moving master frame, if there is one.
    """

    session: Session
    where: str
    hung: bool = True
    _bodies: dict[int, Body] = field(default_factory=dict)

    @property
    def modes(self) -> Mechanics:
        """The modes of the session."""
        return mechanics(self.session)

    @property
    def root(self) -> Frame:
        """The frame to which all others belong."""
        moving = self.modes.moving if self.hung else None
        return ground if moving is None else moving

    def scalar(self, value: Value) -> Expr:
        """Return an expression with the small variables marked."""
        found = self.session.current(value)
        if not isinstance(found, Expr):
            raise WorksheetError(f"{self.where}: {described(found)}; expected an expression")
        return entered(self.modes, (found,))[0]

    def triple(self, values: Sequence[Value]) -> Triple:
        """Return three expressions, given one by one or as one list."""
        items = tuple(values)
        if len(items) == 1 and isinstance(inner := self.session.current(items[0]), Listed | Several | Array):
            items = tuple(inner.entries if isinstance(inner, Array) else inner.items)
        if len(items) != 3:
            raise WorksheetError(f"{self.where}: {len(items)} components; expected three")
        x, y, z = (self.scalar(item) for item in items)
        return x, y, z

    def object(self, value: Value, *kinds: str) -> Table:
        """Return the table of an object of one of some kinds."""
        table = self.session.resolve(value)
        if isinstance(table, Table) and kind_of(table) in kinds:
            return table
        raise WorksheetError(f"{self.where}: {described(table)}; expected a {' or a '.join(kinds)}")

    def frame(self, value: Value) -> Frame:
        """Return the frame of a matrix, or of an object that has one."""
        return self.placed(frame_face.chain(self.session, self.frame_value(value), self.where))

    def placed(self, frame: Frame) -> Frame:
        """Return a chain of the sheet in the modes of the session."""
        chain = entered_frame(self.modes, frame)
        return chain if self.root == ground else self.root * chain

    def frame_value(self, value: Value) -> Value:
        """Return the frame as the sheet holds it: a matrix, its name, or the field of an object."""
        found = self.session.resolve(value)
        if isinstance(found, Table) and kind_of(found):
            return get(found, "frame") or frame_face.ground_face(self.modes)
        return value

    def chain(self, value: Value) -> Frame:
        """Return the chain of a frame, without modes."""
        return frame_face.chain(self.session, self.frame_value(value), self.where)

    def point(self, value: Value) -> Point:
        """Return a point; the origin of a frame or of a body."""
        table = self.session.resolve(value)
        if not isinstance(table, Table) or kind_of(table) == "BODY":
            return Point(self.frame(value), 0, 0, 0)
        table = self.object(value, "POINT")
        entries = vector_entries(self.session, table, "coords", self.where)
        return Point(self.frame(table), *entered(self.modes, entries))

    def vector(self, value: Value) -> Vector:
        """Return a vector; that of a force or a torque."""
        table = self.object(value, "VECTOR", "FORCE", "TORQUE")
        entries = entered(self.modes, vector_entries(self.session, table, "comps", self.where))
        frame, known = self.frame(table), table.memory
        if isinstance(known, Vector) and known.frame == frame and known.components == entries:
            return known  # it may know the points between which it goes
        return Vector(frame, *entries)

    def body(self, value: Value) -> Body:
        """Return a body; the same one each time in a command."""
        table = self.object(value, "BODY")
        if id(table) not in self._bodies:
            inertia = self._inertia(table)
            mass = self._constant(table, "mass", get(table, "mass") or number(0))
            name = self._name(value)
            self._bodies[id(table)] = multibody.Body.of_inertia(self.frame(table), mass, inertia, name=name)
        return self._bodies[id(table)]

    def _inertia(self, table: Table) -> Matrix:
        array = self.session.resolve(get(table, "inertia") or number(0))
        if not isinstance(array, Array) or (array.rows, array.columns) != (3, 3):
            raise WorksheetError(f"{self.where}: the field inertia of a BODY is no 3x3 matrix")
        J = Matrix.from_entries(3, 3, [self._constant(table, "inertia", entry) for entry in array.entries])
        for i, j in ((1, 0), (2, 0), (2, 1)):
            if J[i, j] != J[j, i]:
                a, b = (self.session.text(entry)[:40] for entry in (J[i, j], J[j, i]))
                raise WorksheetError(
                    f"{self.where}: the inertia of a BODY isn't symmetric: its entry {i + 1}, {j + 1} is {a}, and its "
                    f"entry {j + 1}, {i + 1} is {b}"
                )
        return J

    def _constant(self, table: Table, name: str, value: Value) -> Expr:
        found = self.scalar(value)
        if found.depends_on_time:
            raise WorksheetError(
                f"{self.where}: the {name} of a {kind_of(table)} is {self.session.text(found)[:40]}, which depends on "
                "time; expected a constant: make several bodies of parts that move relative to each other"
            )
        return found

    def load(self, value: Value) -> Load | None:
        """Return a force or a torque; None for one that acts on no body, but on the master frame alone."""
        table = self.object(value, "FORCE", "TORQUE")
        vector = self.vector(table)
        on, reaction = self._side(table, "acting"), self._side(table, "reacting")
        if on is None:
            on, reaction, vector = reaction, None, -vector
        if on is None or on is reaction:
            return None
        name = self._name(value)
        if kind_of(table) == "TORQUE":
            return multibody.Torque(vector, on=on, reaction=reaction, name=name)
        return multibody.Force(vector, at=self._place(table, name), on=on, reaction=reaction, name=name)

    def _place(self, table: Table, name: str) -> Point:
        """Return the point at which a force acts. One that was saved without its point has only its name."""
        value = get(table, "applied") or table
        if isinstance(self.session.resolve(value), Expr | Reference):
            raise WorksheetError(
                f"{self.where}: the force {name or '?'} is applied at {self.session.text(value)[:40]}, which has no "
                "value; expected a point: save it with the force, or assign it first"
            )
        return self.point(value)

    def _side(self, table: Table, name: str) -> Body | None:
        value = get(table, name)
        if value is None or kind_of(self.session.resolve(value)) != "BODY":
            return None
        known = list(self._bodies.values())
        body = self.body(value)
        if body in known or isinstance(value, Reference):
            return body
        # A file that was read holds a copy of the body in each load on it, if the body was an entry of a table.
        return next((each for each in known if _are_alike(each, body)), body)

    def bodies_and_loads(self, value: Value) -> tuple[list[Body], list[Load]]:
        """Return what a set or a list holds; forces on bodies that aren't in it are skipped, with a message."""
        items = members(self.session, value)
        bodies = [self.body(item) for item in items if self._is(item, "BODY")]
        loads = []
        for item in items:
            if self._is(item, "BODY"):
                continue
            self.check_object(item)
            kind = kind_of(self.session.resolve(item))
            load = self.load(item) if kind in {"FORCE", "TORQUE"} else None
            if load is not None and any(action.body in bodies for action in load.actions):
                loads.append(load)
            else:
                name = self._name(item) or "?"
                self.session.lines.append(f"<{name}> {kind} is not valid: it must be applied to a BODY")
                if kind == "TIRE":
                    self.session.notice(
                        f"{self.where}: the tyre {name} is left out, because it is no load; expected its force and "
                        f"torque, tire_forces({name}), in the set"
                    )
        for force, where in left_place.left_places(bodies, loads):
            self.session.notice(
                f"{self.where}: the force {force.name or '?'} acts on {force.on.name or 'a body'} at {where}, from "
                "which the body moves away; expected a point of the body: make_POINT with its frame; if the force "
                "shall stay there, give the body that exerts it as the last argument of make_FORCE"
            )
        return bodies, loads

    def check_object(self, value: Value) -> None:
        """Refuse a member of a system that is no object: a body by a misspelt name would be missing in the result."""
        found = self.session.resolve(value)
        if not kind_of(found):
            raise WorksheetError(f"{self.where}: {described(found)}; expected a BODY, a FORCE or a TORQUE")

    def _name(self, value: Value) -> str:
        """Return the name of an object, or that of the entry of a table, ``F[1]``; an empty text for one without."""
        if isinstance(value, Reference):
            return value.name
        for name, held in self.session.names.items():
            if isinstance(held, Table) and not kind_of(held):
                for key, entry in held.entries.items():
                    if entry is value:
                        return f"{name}[{', '.join(self.session.text(each) for each in key)}]"
        return ""

    def _is(self, value: Value, kind: str) -> bool:
        return kind_of(self.session.resolve(value)) == kind


def _are_alike(one: Body, other: Body) -> bool:
    """Whether two bodies move in the same way, and have the same mass and inertia."""
    return (one.frame, one.mass, one.inertia) == (other.frame, other.mass, other.inertia)


def members(session: Session, value: Value) -> tuple[Value, ...]:
    """Return the items of a set or a list, sets among them taken apart, and each object once; else the value."""
    found = session.resolve(value)
    if isinstance(found, Listed | MapleSet | Several):
        items = [each for item in found.items for each in members(session, item)]
        seen: dict[int, Value] = {}
        for k, item in enumerate(items):
            table = session.resolve(item)
            seen.setdefault(id(table) if isinstance(table, Table) else -1 - k, item)
        return tuple(seen.values())
    return (value,)


_WORDS: dict[type, str] = {
    Array: "matrix",
    Listed: "list",
    MapleSet: "set",
    Several: "sequence",
    Expr: "expression",
    Reference: "name without a value",
    Boolean: "truth value",
    Builtin: "command",
    Plot: "drawing",
    ProcedureValue: "procedure",
    Quoted: "quoted expression",
    Range: "range",
    Relation: "relation",
    String: "text",
}
"""What each kind of value is called in messages; objects and calls have words of their own (`described`)."""


def described(value: Value) -> str:
    """Return what a value is, in a word with its article."""
    if isinstance(value, Table):
        return f"a {kind_of(value) or 'table'}"
    if isinstance(value, Expr):
        return f"an expression, {str(value)[:60]}"
    if isinstance(value, Unevaluated):
        return f"a call that nobody knows, {text_of(value)[:60]}"
    word = _WORDS[type(value)]
    return f"an {word}" if word[0] in "aeiou" else f"a {word}"


# --- writing ---


def computed(session: Session, kind: str, entries: Triple, frame: Value, **fields: Value | None) -> Table:
    """Return an object that a command has found: its three entries are in a short form."""
    x, y, z = shortest(entries)
    return written(session, kind, (x, y, z), frame, **fields)


def written(session: Session, kind: str, entries: Triple, frame: Value, **fields: Value | None) -> Table:
    """Return an object with three coordinates or components that were computed in the modes of the session."""
    modes = mechanics(session)
    name, last = ("coords", 1) if kind == "POINT" else ("comps", 0)
    array = column(left(modes, entries), last, modes)
    return made(kind, **{"frame": frame, name: array, **fields})


def fields_of(table: Table, *names: str) -> dict[str, Value | None]:
    """Return some fields of an object, to be given to another one."""
    return {name: get(table, name) for name in names}


def face_of(session: Session, frame: Frame) -> Value:
    """Return the array of a chain that was computed in the modes of the session."""
    modes = mechanics(session)
    motions = left_frame(modes, frame)
    if motions.ancestor != ground:
        motions = _from_ground(motions)
    return frame_face.ground_face(modes) if motions == ground else frame_face.face(modes, motions)


def _from_ground(frame: Frame) -> Frame:
    result = ground
    for motion in frame.motions:
        result = result.then(motion)
    return result
