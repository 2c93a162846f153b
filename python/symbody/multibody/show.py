"""Objects as text, in the notation of MBSymba."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from math import inf
from textwrap import wrap
from typing import Annotated, Any, Protocol, TypeAlias, runtime_checkable

from symbody.errors import ModelError
from symbody.geometry import Frame, Point, Vector, ground
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, Matrix, cost, free_symbols, time_derivative
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.calculus.shown_form import ShownForms
from symbody.symbolic.expression.container import text_of
from symbody.symbolic.expression.text_layout import ends, hanging, listed, names_text
from symbody.symbolic.given.arguments import brief, counted

from .body import Body
from .constraint import Constraint
from .load import Action, Load
from .system import System


@runtime_checkable
class Described(Protocol):
    """A thing that describes itself, such as equations of motion."""

    def description(self) -> str: ...


@runtime_checkable
class Tabled(Protocol):
    """A thing that a notebook shows as a table, such as a motion; as text, it is what it prints."""

    def _repr_html_(self) -> str | None: ...


@runtime_checkable
class Array(Protocol):
    """An array of NumPy, which isn't loaded for this."""

    flat: Any
    ndim: int


Shown: TypeAlias = Annotated[
    Frame
    | Point
    | Vector
    | Body
    | Load
    | System
    | Described
    | Tabled
    | Expr
    | int
    | float
    | Matrix
    | list[object]
    | tuple[object, ...]
    | dict[object, object]
    | Array,
    "an expression, a frame, point, vector, matrix, body, load, system, equations of motion, or what holds them: "
    "a list, a tuple, a dictionary, an array",
]


@checked(ModelError)
def show(thing: Shown, *, synthetic: bool = False) -> None:
    """Print an object with all its fields.

    Args:
        thing: an expression, a frame, point, vector, matrix, body, load, system or equations of motion; a list, a tuple
            or a dictionary of these; or what a notebook shows as a table, such as a motion.
        synthetic: whether to print frames by their names alone.

    >>> from symbody import Point, ground, show
    >>> show(Point(ground, 1, 2, 0, name="A"))
    A = POINT(frame = ground, coords = [1, 2, 0])
    >>> show({"x": 1, "places": [2, 3]})
    x = 1
    places = [2, 3]
    """
    sys.stdout.write(describe(thing, synthetic=synthetic) + "\n")


@checked(ModelError)
def describe(thing: Shown, *, synthetic: bool = False) -> str:
    """Return what `show` prints.

    Args:
        thing: an expression, a frame, point, vector, matrix, body, load, system or equations of motion; a list, a tuple
            or a dictionary of these; or what a notebook shows as a table, such as a motion.
        synthetic: whether to show frames by their names alone.

    >>> from symbody import Vector, describe, ground
    >>> describe(Vector(ground, 1, 2, 0, name="v"))
    'v = VECTOR(frame = ground, comps = [1, 2, 0])'
    """
    style = _Style(synthetic)
    return (
        _described(thing, style)
        if isinstance(thing, Point | Vector | Body | Load)
        else _laid_out(thing, style)
    )


@dataclass(frozen=True)
class _Style:
    """How things are written: frames by their names alone or not, and components in forms for the reader."""

    synthetic: bool
    reader: Reader = field(default_factory=Reader)
    forms: ShownForms = field(default_factory=ShownForms)
    longest: float = inf
    """The operations of an expression, or of the motions of a frame, up to which it is written out."""
    frames: Mapping[bytes, str] = field(default_factory=dict)
    """The names of the frames that are shown by them, by their keys."""

    def text(self, value: Expr) -> str:
        """Return an expression as text, in its form for the reader if that is shorter; of a long one, its size."""
        operations = cost(value).total if self.longest < inf else 0
        if operations > self.longest:
            return f"({counted(operations, 'operation')})"
        return min(str(value), str(self.reader(value)), key=len)


def _laid_out(thing: Shown, style: _Style) -> str:
    """Return a thing as text in lines that are no longer than a page is wide, as far as that is possible."""
    if isinstance(thing, Point | Vector | Body | Load):
        head = f"{thing.name} = " if thing.name else ""
        texts = [f"{field} = {value}" for field, value in _fields(thing, style)]
        return listed(texts, f"{head}{type(thing).__name__.upper()}(", ")")
    if isinstance(thing, Matrix):
        style.forms.read_together(thing.entries)
    text = text_of(thing, lambda part: _laid_out(part, style))
    if text is not None:
        return text
    return hanging(str(style.forms(thing))) if isinstance(thing, Expr) else _described(thing, style)


def _described(thing: Shown, style: _Style) -> str:
    """Return a thing as text; other things than systems and equations on one line."""
    if isinstance(thing, Described):
        return thing.description()
    if isinstance(thing, System):
        return _system(thing, style)
    name = getattr(thing, "name", "")
    fields = _fields(thing, style)
    if not fields:
        return _frame(thing, style) if isinstance(thing, Frame) else str(thing)
    body = _record(type(thing).__name__, fields)
    return f"{name} = {body}" if name else body


def _record(kind: str, fields: Iterable[tuple[str, str]]) -> str:
    return f"{kind.upper()}({', '.join(f'{field} = {value}' for field, value in fields)})"


def _fields(thing: Shown, style: _Style) -> list[tuple[str, str]]:
    match thing:
        case Point():
            return [
                ("frame", _frame(thing.frame, style)),
                ("coords", _list(map(style.text, thing.coordinates))),
            ]
        case Vector():
            return [
                ("frame", _frame(thing.frame, style)),
                ("comps", _list(map(style.text, thing.components))),
            ]
        case Body():
            frame = _frame(thing.frame, style)
            return [
                ("frame", frame),
                ("mass", style.text(thing.mass)),
                ("inertia", _rows(thing.inertia, style)),
            ]
        case Load():
            return _values(thing.fields, style)
        case _:
            return []


def _values(fields: Mapping[str, object], style: _Style) -> list[tuple[str, str]]:
    return [(field, _value(value, style)) for field, value in fields.items()]


def _value(value: object, style: _Style) -> str:
    """Return a field of a load as text."""
    match value:
        case Frame():
            return _frame_of_load(value, style)
        case Point():
            coordinates = _list(map(style.text, value.coordinates))
            fields = [("frame", _frame_of_load(value.frame, style)), ("coords", coordinates)]
            return value.name or _record("point", fields)
        case Body():
            return _body(value)
        case Action():
            kind = "force" if value.is_force else "torque"
            return _record(kind, _values(value.fields, style))
        case Expr():
            return style.text(value)
        case tuple():
            return _list(_value(entry, style) for entry in value)
        case _:
            return str(value)


def _system(system: System, style: _Style) -> str:
    """Return the parts of a system, with sizes of long expressions and the coordinates on which a long frame depends.

    For a system of many parts, the text contains the first and last parts of each kind, and how to see the others.
    Lines are broken between words; `show` of a body or a load prints all of it.
    """
    frames = _named_frames(system)
    style = replace(style, longest=_LONGEST, frames={frame.key: frame.name for frame in frames})
    kinds = [_of_frames(frames, style), *_kinds(system, style)]
    is_long = sum(len(kind.parts) for kind in kinds) > _MANY
    counts = (counted(len(kind.parts), kind.noun) for kind in kinds if kind.parts and is_long)
    head = "SYSTEM" if not system.name else f"{system.name} = SYSTEM"
    lines = [f"coordinates: {names_text(system.coordinates, _MOST_NAMES)}"]
    if system.quasi_velocities:
        kind = "momenta" if system.momenta else "quasi-velocities"
        lines.append(f"{kind}: {names_text(system.quasi_velocities, _MOST_NAMES)}")
    *others, constraints = (kind.lines(is_long=is_long) for kind in kinds)
    lines += [line for each in others for line in each]
    if system.gravity is not None:
        lines.append(f"gravity: {_described(system.gravity, style)}")
    lines += constraints
    first = f"{head}: {', '.join(counts)}" if is_long else head
    return "\n".join([first, *(row for line in lines for row in _broken(line))])


@dataclass(frozen=True)
class _Kind:
    """The parts of one kind in a system.

    Attributes:
        noun: the kind in the singular.
        parts: the parts.
        line: the function that writes one of them.
        advice: how to see one of them, with a placeholder for its index.
    """

    noun: str
    parts: Sequence[Any]
    line: Callable[[Any], str]
    advice: str

    def lines(self, *, is_long: bool) -> list[str]:
        """Return a line for each part; if there are many, for the first and last ones, and one for the others."""
        shown = ends(self.parts) if is_long else self.parts
        return [self._between(len(shown) - 1) if part is None else self.line(part) for part in shown]

    def _between(self, written: int) -> str:
        left = counted(len(self.parts) - written, f"more {self.noun}")
        return f"... {left}: {self.advice.format(written // 2)}"


def _kinds(system: System, style: _Style) -> list[_Kind]:
    """Return the parts of a system by kind, in the order in which they are shown: constraints last."""
    written = system.coordinates if system.momenta else system.chosen
    rates = [(time_derivative(q), system.coordinate_rates[q]) for q in written]
    conditions = [*zip(system.multipliers, system.conditions, strict=True)]
    return [
        _Kind(
            "kinematic rate",
            rates,
            lambda pair: f"kinematics: {pair[0]} = {style.text(pair[1])}",
            "show(system.kinematics)",
        ),
        _Kind(
            "state",
            [*system.state_rates.items()],
            lambda pair: f"state: {pair[0]} = {style.text(pair[1])}",
            "show(system.state_rates)",
        ),
        _Kind(
            "body",
            system.bodies,
            lambda body: f"body: {_described(body, style)}",
            "show(system.bodies[{}])",
        ),
        _Kind(
            "load",
            system.loads,
            lambda load: f"load: {_described(load, style)}",
            "show(system.loads[{}])",
        ),
        _Kind(
            "constraint",
            conditions,
            lambda pair: _condition(pair[0], pair[1], style),
            "show(system.constraints[{}])",
        ),
    ]


def _of_frames(frames: Sequence[Frame], style: _Style) -> _Kind:
    """Return the named frames, each with the motions that lead to it from the last named one before it."""
    return _Kind(
        "frame", frames, lambda frame: f"frame: {frame.name} = {_motions(frame, style)}", "show(frame)"
    )


def _named_frames(system: System) -> list[Frame]:
    """Return the frames with names of their own on which bodies and loads of a system are, inner ones first."""
    vectors = [action.vector.frame for action in system.actions]
    points = [action.point.frame for action in system.actions if action.point is not None]
    found = dict[bytes, Frame]()
    for frame in (*(body.frame for body in system.bodies), *vectors, *points):
        named = [each for each in _to_root(frame) if each.name and each.parent is not None]
        found.update((each.key, each) for each in reversed(named) if each.key not in found)
    names = Counter(frame.name for frame in found.values())
    return [frame for frame in found.values() if names[frame.name] == 1]


def _to_root(frame: Frame | None) -> Iterator[Frame]:
    while frame is not None:
        yield frame
        frame = frame.parent


def _condition(multiplier: Expr, constraint: Constraint, style: _Style) -> str:
    return f"{constraint.label}: {style.text(constraint.condition)} = 0, multiplier {multiplier}"


_MANY, _MOST_NAMES = 30, 100
"""The largest numbers of parts in a system, and of names of one kind, that are all shown."""


def _broken(line: str) -> list[str]:
    """Return a line of a system in pieces, if it is long."""
    return wrap(
        line,
        _LINE,
        initial_indent="    ",
        subsequent_indent=" " * 8,
        break_long_words=False,
        break_on_hyphens=False,
    )


_LINE = 110
"""The most characters of a line."""


def _body(body: Body) -> str:
    return body.name or f"BODY(mass = {body.mass})"


def _frame(frame: Frame, style: _Style) -> str:
    if frame.parent is None or (style.synthetic and frame.name):
        return frame.name
    if style.longest < inf:
        return style.frames.get(frame.key) or _motions(frame, style)
    return _rows(frame.matrix, style)


def _motions(frame: Frame, style: _Style) -> str:
    """Return the motions that lead to a frame from the last one that is shown by its name.

    Of many or long ones, the coordinates on which the frame depends are returned.
    """
    motions = [frame.motion]
    for start in islice(_to_root(frame), 1, None):
        if start.parent is None or start.key in style.frames:
            break
        motions.append(start.motion)
    variables = [variable for motion in motions if motion is not None for variable in motion.variables]
    if len(motions) > _MOST_MOTIONS or cost(variables).total > style.longest:
        moving = [leaf for leaf in free_symbols(variables) if leaf.kind == "time_function"]
        return f"{frame.name or 'FRAME'}({brief(', '.join(sorted(map(str, moving), key=_by_number)))})"
    name = style.frames.get(start.key, "" if start == ground else start.name)
    return " * ".join([*([name] if name else []), *map(str, reversed(motions))])


_MOST_MOTIONS = 12
"""The most motions of a frame that are written out among others in a system."""


def _frame_of_load(frame: Frame, style: _Style) -> str:
    """Return the name of a frame, or the motions that lead to it, which are easier to read in a load than a matrix."""
    if frame.parent is None or style.longest < inf:
        return _frame(frame, style)
    return frame.name or str(frame)


_LONGEST = 40
"""The operations of an expression or of the motions of a frame that is written out among others in a system."""


def _by_number(name: str) -> tuple[str, int, str]:
    """Return the place of a name: q2 before q10."""
    stem = name.rstrip("0123456789")
    return stem, int(name[len(stem) :] or 0), name


def _rows(matrix: Matrix, style: _Style) -> str:
    columns = matrix.shape[1]
    entries = list(map(style.text, matrix.entries))
    return _list(_list(entries[start : start + columns]) for start in range(0, len(entries), columns))


def _list(entries: Iterable[str]) -> str:
    return f"[{', '.join(entries)}]"
