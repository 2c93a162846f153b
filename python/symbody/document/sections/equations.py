"""The equations of motion, as `Equations.latex` prints them."""

from __future__ import annotations

from symbody.document.document import Block, Formula, Heading, prose
from symbody.document.subject import Subject
from symbody.symbolic.given.arguments import counted


def equations(subject: Subject) -> list[Block]:
    """Return the section."""
    found = subject.equations
    verb = "is" if len(found.residuals) == 1 else "are"
    sentence = f"There {verb} {counted(len(found.residuals), 'equation')} of motion"
    if found.constraints:
        sentence += f" and {counted(len(found.constraints), 'constraint')}"
    if found.states:
        sentence += f", with {counted(len(found.states), 'state')} beside the mechanics"
    if subject.is_large:
        summary = (
            f"{sentence}. They have {subject.cost.total} operations and are not printed here: "
            "equations.residuals contains them."
        )
        return [Heading("Equations of motion"), prose(summary)]
    return [Heading("Equations of motion"), prose(f"{sentence}."), Formula(found.latex())]
