"""The mechanism: what it consists of, and a picture."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from symbody.document.document import NO_BREAK, Block, Heading, Math, Picture, Table, Words, prose
from symbody.document.formula import listed
from symbody.document.picture import drawn_motion, no_picture
from symbody.document.subject import Subject
from symbody.dynamics.display.row import written
from symbody.errors import SymbodyError
from symbody.geometry import Vector
from symbody.multibody import Body, System
from symbody.multibody.element.element import Element, is_along_line, terms_of_law
from symbody.multibody.load import Action
from symbody.multibody.quantity.role import in_order, units_of_names
from symbody.symbolic import Expr, cost, free_symbols, latex, listing
from symbody.symbolic.expression.latex_layout import LINE, width
from symbody.symbolic.given.arguments import brief, counted
from symbody.symbolic.given.wording import joined_by_and
from symbody.view import DrawableMotion
from symbody.view.sketch import sketch
from symbody.view.svg import sketch_svg


def mechanism(subject: Subject) -> list[Block]:
    """Return the section; nothing for equations that were given without bodies."""
    system = subject.mechanism
    if system is None:
        return []
    sizes = {"body": system.bodies, "load": system.loads, "constraint": system.constraints}
    parts = [counted(len(each), noun) for noun, each in sizes.items() if each]
    sentence = prose(f"The system has {joined_by_and(parts)}.")
    return [Heading("Mechanism"), sentence, *_picture(subject), _bodies(system), *_loads(subject, system)]


def _picture(subject: Subject) -> list[Block]:
    """Return the drawing and its numbers, or the reason for which there is none."""
    try:
        drawn = drawn_motion(subject)
        sketched = sketch(drawn)
    except SymbodyError as error:
        if subject.is_chosen:
            raise
        return [prose(no_picture(error))]
    return [
        Picture("mechanism", _caption(subject), sketch_svg(sketched), sketched),
        *_numbers(subject, drawn),
    ]


def _caption(subject: Subject) -> str:
    if subject.motion is not None:
        return f"The mechanism at t = {subject.motion.t[0]:g} s."
    if subject.guess is not None:
        return "The mechanism at the start of a typical motion, with the numbers of the model."
    if subject.is_chosen:
        return "The mechanism at the reference position."
    return "The mechanism with lengths and angles that were chosen for this picture; masses are 1."


def _numbers(subject: Subject, drawn: DrawableMotion) -> list[Block]:
    """Return the sentence that tells the numbers of the picture: those that place the bodies."""
    names = _placing(subject)
    if not names:
        return []
    system = subject.mechanism
    units = {} if system is None else units_of_names(system)
    units |= subject.units
    values = [f"{row[0] + 0.0:.4g}" for row in drawn.evaluate(names)]
    words: list[str | Math] = []
    pairs = zip(names, values, strict=True)
    for (value, unit), group in groupby(pairs, key=lambda pair: (pair[1], units.get(pair[0], ""))):
        alike = " = ".join(latex(name) for name, _ in group)
        words += [Math(f"{alike} = {value}"), f"{NO_BREAK}{unit.replace(' ', NO_BREAK)}, " if unit else ", "]
    words[-1] = str(words[-1]).removesuffix(", ") + "."
    return [prose("It is drawn with ", *words)]


def _placing(subject: Subject) -> list[Expr]:
    """Return the coordinates and parameters that place bodies and the ends of springs, in their order."""
    system = subject.mechanism
    if system is None:
        return []
    poses = (body.frame.pose for body in system.bodies)
    entries = [entry for rows, at in poses for entry in (*rows[0], *rows[1], *rows[2], *at)]
    ends = (end for load in system.loads if isinstance(load, Element) for end in load.ends)
    entries += [entry for end in ends for entry in end.coordinates]
    leaves = free_symbols([*entries, *system.position_constraints])
    symbols = sorted((leaf for leaf in leaves if leaf.kind == "symbol"), key=in_order)
    return [*(q for q in system.coordinates if q in leaves), *symbols]


def _bodies(system: System) -> Block:
    rows = []
    for body, name in _names(system).items():
        cell = ("particle",) if body.is_particle else listed(body.moments)
        rows.append(((name,), (Math(latex(body.mass)),), cell))
    return Table(("body", "mass", "moments of inertia"), tuple(rows))


def _names(system: System) -> dict[Body, str]:
    """Return the bodies with their names, or their numbers."""
    return {body: body.name or f"body {number}" for number, body in enumerate(system.bodies, start=1)}


def _loads(subject: Subject, system: System) -> list[Block]:
    """Return the actions of all loads, and gravity; an action and its opposite, the reaction, have one row."""
    names, taken = _names(system), {leaf.name for leaf in system.leaves}
    rows, has_names = list[tuple[Words, ...]](), False
    for number, load in enumerate(system.loads, start=1):
        name = load.name or f"load {number}"
        members = [
            names.get(each.body, each.body.name or "a body outside the system") for each in load.actions
        ]
        if is_along_line(load):
            law = (Math(written(listing(terms_of_law(load, taken), "latex")[1])),)
            rows.append(((name,), ("force",), law, ("its line",), (joined_by_and(members),)))
            continue
        for action, on in _without_reactions(load.actions, members):
            kind = "force" if action.is_force else "torque"
            components = subject.equations.display.in_names_of_forces(action.vector.components)
            has_names = has_names or components != action.vector.components
            vector = Vector(action.vector.frame, *components)
            rows.append(_load_row(name, kind, vector, on, _axes(vector, names)))
    gravity = system.gravity
    if gravity is not None:
        rows.append(_load_row("gravity", "acceleration", gravity, "all bodies", _axes(gravity, names)))
    defined = [prose("The names of forces are defined with the equations of motion.")] if has_names else []
    table = Table(("load", "kind", "components", "in the axes of", "on"), tuple(rows))
    return [table, *defined] if rows else []


def _without_reactions(actions: Sequence[Action], members: Sequence[str]) -> Iterator[tuple[Action, str]]:
    """Yield the actions, and on what each acts; a reaction at the same point belongs to its action."""
    left = [*zip(actions, members, strict=True)]
    while left:
        action, on = left.pop(0)
        reaction = next((each for each in left if _is_reaction(each[0], action)), None)
        if reaction is not None:
            left.remove(reaction)
            on = f"{on}, and its opposite on {reaction[1]}"
        yield action, on


def _is_reaction(action: Action, other: Action) -> bool:
    opposite = tuple(-each for each in other.vector.components)
    return (action.vector.frame, action.vector.components, action.point) == (
        other.vector.frame,
        opposite,
        other.point,
    )


def _load_row(name: str, kind: str, vector: Vector, on: str, axes: str) -> tuple[Words, ...]:
    """Return a row of the table of loads.

    Args:
        name: what the load is called.
        kind: force, torque or acceleration.
        vector: its components are shown.
        on: what it acts on.
        axes: what the axes of the components are called.
    """
    return (name,), (kind,), _components(vector), (axes,), (on,)


def _components(vector: Vector) -> Words:
    """Return the components of a vector, or their operations if they don't fit a line of a table."""
    if sum(width(latex(component)) for component in vector.components) <= LINE:
        return listed(vector.components)
    return (f"expressions of {counted(cost(vector.components).total, 'operation')}",)


def _axes(vector: Vector, names: Mapping[Body, str]) -> str:
    """Return what the axes are called: by the name of the frame, or of a body with these axes."""
    frame = vector.frame
    if frame.name or frame.parent is None:
        return brief(frame)
    rows = frame.pose.rows
    bodies = (name for body, name in names.items() if body.frame.pose.rows == rows)
    text = str(frame)
    return next(bodies, text if len(text) <= _LONGEST_NAME else "a chain of frames")


_LONGEST_NAME = 40
"""The letters of a frame in a table."""
