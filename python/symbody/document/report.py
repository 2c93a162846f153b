"""Reports: one call, one document."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

from symbody.document.document import Block, Document
from symbody.document.formats.html import html
from symbody.document.formats.markdown import markdown
from symbody.document.formats.notebook import notebook
from symbody.document.formats.tex import tex
from symbody.document.given import parameters_of, position_of, title_of, units_of
from symbody.document.picture import derived
from symbody.document.sections.checks import checks
from symbody.document.sections.energies import energies
from symbody.document.sections.equations import equations
from symbody.document.sections.kinematics import kinematics
from symbody.document.sections.mechanism import mechanism
from symbody.document.sections.motion import motion as motion_section
from symbody.document.sections.nomenclature import nomenclature
from symbody.document.sections.size import size
from symbody.document.start import Start, start_of
from symbody.document.subject import Subject
from symbody.dynamics import Equations
from symbody.dynamics.display.names_of_formulas import names_told_apart
from symbody.errors import ReportError
from symbody.models import ClassicSystem
from symbody.multibody import System, Variables
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief, with_known_names
from symbody.view import DrawableMotion
from symbody.view.whole_file import write_whole

FORMATS: Mapping[str, Callable[[Document], str]] = {
    ".html": html,
    ".ipynb": notebook,
    ".md": markdown,
    ".tex": tex,
}
"""The formats by the suffix of the file."""

SECTIONS: tuple[Callable[[Subject], list[Block]], ...] = (
    mechanism,
    nomenclature,
    kinematics,
    energies,
    equations,
    size,
    checks,
    motion_section,
)
"""The sections in their order."""


@with_known_names
def report(
    model: Equations | System | ClassicSystem,
    path: str | os.PathLike[str],
    *,
    motion: DrawableMotion | None = None,
    parameters: Mapping[Expr, float] | None = None,
    position: Mapping[Expr, float] | None = None,
    units: Mapping[Expr, str] | None = None,
    title: str = "",
) -> Path:
    """Write a model as one document: picture, names, kinematics, energies, equations, sizes, and proved checks.

    The document depends on the model alone: it has no date, and the same call writes the same bytes. Equations of more
    than 1000 operations, or two pages, are summarised.

    Args:
        model: the equations of motion, or a system, whose equations are derived; of a model of `symbody.models`, the
            picture has its numbers and the start of its motion.
        path: the file; its suffix is the format: ``.html``, ``.md``, ``.tex`` or ``.ipynb``. Its folder is made if
            necessary.
        motion: a motion, which is plotted; its first instant is the reference position.
        parameters: without a motion, values of parameters for the picture.
        position: without a motion, values of coordinates for the picture.
        units: the units of symbols, such as ``{k: "N/m"}``; those of masses, angles and lengths are known.
        title: the title; by default the name of the system.

    Raises:
        ReportError: an argument has the wrong kind, or the suffix is not a format.
        ParameterError: a key is not a variable of the model, or a value is not finite.
        ArgumentError: a value is not a number.
        PictureError: the file can't be written; its previous content is still there.

    >>> import tempfile
    >>> import symbody as sb
    >>> theta, (m, l, g) = sb.functions_of_time("theta"), sb.symbols("m l g")
    >>> bob = sb.Body(sb.rotate("Z", theta) * sb.translate(0, -l, 0), m, name="bob")
    >>> pendulum = sb.System([bob], coordinates=[theta], gravity=sb.Vector(sb.ground, 0, -g, 0), name="Pendulum")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     print(report(pendulum, Path(folder) / "pendulum.md").read_text().splitlines()[0])
    # Pendulum
    """
    file, write = _format(path)
    heading, equations = title_of(title), _equations(model)
    known = parameters_of(equations, parameters)
    places = position_of(equations.system, position)
    start = start_of(model, known, places) if isinstance(model, ClassicSystem) else Start(known, places, None)
    subject = Subject(
        equations,
        _motion(motion, equations.system),
        start.parameters,
        start.position,
        units_of(equations, units),
        start.guess,
    )
    with names_told_apart(subject.system):
        blocks = tuple(block for section in SECTIONS for block in section(subject))
    text = write(Document(heading or subject.system.name or "Multibody system", blocks))
    return write_whole(
        file, lambda temporary: temporary.write_text(text, encoding="utf-8", newline="\n"), where="report"
    )


def _format(path: object) -> tuple[Path, Callable[[Document], str]]:
    """Return the file, and the function that prints its format."""
    if not isinstance(path, str | os.PathLike):
        raise ReportError(f"report: {path!r} is not a path; expected one, such as 'model.html'")
    file = Path(path)
    known = FORMATS.get(file.suffix.lower())
    if known is None:
        raise ReportError(
            f"report: {file} ends in {file.suffix!r}, which is not a format; expected one of {', '.join(FORMATS)}"
        )
    return file, known


def _equations(model: object) -> Equations:
    """Return the equations of motion, derived if the model is a system."""
    if isinstance(model, Equations):
        return model
    if isinstance(model, ClassicSystem):
        return derived(model.system)
    if not isinstance(model, System):
        raise ReportError(
            f"report: {brief(model)} is not a model; expected a system, equations of motion such as "
            "newton_euler(system), or a model of symbody.models"
        )
    return derived(model)


def _motion(motion: DrawableMotion | None, system: Variables) -> DrawableMotion | None:
    """Return the motion, which must be one of the same system."""
    if motion is None:
        return None
    if getattr(motion, "system", None) is not system:
        raise ReportError(
            f"report: {brief(motion)} is not a motion of {brief(system)}; expected one, such as "
            "simulate(equations, parameters, initial, t=(0, 1))"
        )
    return motion
