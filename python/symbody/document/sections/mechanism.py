"""The mechanism: what it consists of, and a picture."""

from __future__ import annotations

from symbody.document.document import Block, Heading, Math, Picture, Table, prose
from symbody.document.formula import listed
from symbody.document.picture import drawing, no_picture
from symbody.document.subject import Subject
from symbody.errors import SymbodyError
from symbody.symbolic import latex
from symbody.symbolic.given.arguments import counted
from symbody.view.svg import sketch_svg


def mechanism(subject: Subject) -> list[Block]:
    """Return the section."""
    system = subject.system
    parts = [counted(len(system.bodies), "body"), counted(len(system.loads), "load")]
    if system.constraints:
        parts.append(counted(len(system.constraints), "constraint"))
    sentence = prose(f"The system has {', '.join(parts[:-1])} and {parts[-1]}.")
    return [Heading("Mechanism"), sentence, _picture(subject), *_bodies(subject)]


def _picture(subject: Subject) -> Block:
    """Return the drawing, or the reason for which there is none."""
    try:
        sketch = drawing(subject)
    except SymbodyError as error:
        if subject.is_chosen:
            raise
        return prose(no_picture(error))
    if subject.motion is not None:
        caption = f"The mechanism at t = {subject.motion.t[0]:g} s."
    elif subject.is_chosen:
        caption = "The mechanism at the reference position."
    else:
        caption = "The mechanism at a reference position; lengths and masses are 1."
    return Picture("mechanism", caption, sketch_svg(sketch), sketch)


def _bodies(subject: Subject) -> list[Block]:
    rows = []
    for number, body in enumerate(subject.system.bodies, start=1):
        cell = ("particle",) if body.is_particle else listed(body.moments)
        rows.append(((body.name or f"body {number}",), (Math(latex(body.mass)),), cell))
    return [Table(("body", "mass", "moments of inertia"), tuple(rows))]
