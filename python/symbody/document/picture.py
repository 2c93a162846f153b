"""The picture of a mechanism: at the first instant of a motion, or at the reference position."""

from __future__ import annotations

import warnings
from html import escape

from symbody.document.reference_position import still
from symbody.document.subject import Subject
from symbody.dynamics import Equations, lagrange_equations, newton_euler
from symbody.errors import FrameError, ModelNotice, SymbodyError
from symbody.multibody import System
from symbody.symbolic.given.arguments import counted
from symbody.view import DrawableMotion
from symbody.view.animation import thinned
from symbody.view.sketch import sketch
from symbody.view.svg import sketch_svg

MOST = 30
"""The bodies up to which a notebook draws a system at once: half a second."""


def drawn_motion(subject: Subject) -> DrawableMotion:
    """Return the motion whose first instant is drawn: the given one, or the reference position.

    Raises:
        SymbodyError: no position satisfies the constraints.
    """
    return still(subject) if subject.motion is None else thinned(subject.motion)


def no_picture(error: SymbodyError) -> str:
    """Return the sentence that stands for a picture."""
    return f"There is no picture, because the reference position was not found. {error}."


def picture(system: System) -> str:
    """Return the picture of a system in HTML, for notebooks; or the reason for which there is none.

    >>> from symbody import Body, functions_of_time, translate
    >>> x = functions_of_time("x")
    >>> picture(System([Body(translate(x, 0, 0), 1, name="cart")], coordinates=[x])).startswith("<figure")
    True
    """
    if len(system.bodies) > MOST:
        many = counted(len(system.bodies), "body")
        return f"<p>A system of {many} is not drawn at once; report(system, 'model.html') draws it.</p>"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ModelNotice)  # of the derivation, for which nobody asked
            svg = sketch_svg(sketch(drawn_motion(Subject(derived(system), None, {}, {}, {}))))
    except SymbodyError as error:
        return f"<p>{escape(no_picture(error))}</p>"
    return f"<figure>{svg}</figure>"


def derived(system: System) -> Equations:
    """Return the equations of motion: by newton_euler, or by lagrange_equations if frames aren't rigid."""
    try:
        return newton_euler(system)
    except FrameError:
        return lagrange_equations(system)
