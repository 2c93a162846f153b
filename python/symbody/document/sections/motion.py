"""The motion: coordinates and speeds over time."""

from __future__ import annotations

from symbody.document.document import Block, Heading, Picture, prose
from symbody.document.subject import Subject
from symbody.symbolic import Expr
from symbody.view.animation import thinned
from symbody.view.plot import plot
from symbody.view.svg import figure_svg


def motion(subject: Subject) -> list[Block]:
    """Return the section; nothing without a motion."""
    found = subject.motion
    if found is None:
        return []
    sentence = f"The motion lasts from t = {found.t[0]:g} s to {found.t[-1]:g} s."
    units: dict[Expr | str, str] = dict(subject.units.items())
    figure = plot(thinned(found), units=units)
    picture = Picture("motion", "Coordinates and speeds over time.", figure_svg(figure), figure)
    return [Heading("Motion"), prose(sentence), picture]
