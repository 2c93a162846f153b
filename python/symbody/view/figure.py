"""Figures: shown by notebooks, with titles, and written to files."""

from __future__ import annotations

import os
from io import BytesIO
from pathlib import Path

from matplotlib.figure import Figure

from symbody.errors import ViewError
from symbody.symbolic import Expr
from symbody.view.whole_file import file_of, write_whole

__all__ = ["NotebookFigure", "finished", "save", "symbol_of", "with_unit"]


class NotebookFigure(Figure):
    """A figure that a notebook shows as a picture, also without ``%matplotlib inline``."""

    def _repr_png_(self) -> bytes:
        content = BytesIO()
        self.savefig(content, format="png", dpi=100)
        return content.getvalue()


def save(figure: Figure, path: str | os.PathLike[str]) -> Path:
    """Write a figure to a file, as a whole or not at all; the suffix is the format.

    Args:
        figure: the figure.
        path: the file.

    Raises:
        PictureError: the file can't be written.
        ViewError: the suffix is not a format.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(Figure(), Path(folder) / "empty.svg").name
    'empty.svg'
    """
    file = file_of(path, "motion.png")
    kind = file.suffix.removeprefix(".").lower()
    known = figure.canvas.get_supported_filetypes()
    if kind not in known:
        raise ViewError(
            f"plot: {file} ends in {kind!r}; expected a format such as {', '.join(sorted(known))}"
        )
    content = BytesIO()  # the writer reports a full disk; the formats have other names for it
    figure.savefig(content, format=kind, dpi=150)
    return write_whole(file, lambda temporary: temporary.write_bytes(content.getvalue()))


def finished(figure: Figure, title: str, path: str | os.PathLike[str] | None) -> Figure:
    """Return a figure with its title, if it has one, and write it to a file, if one is given."""
    if title:
        figure.suptitle(title)
    if path is not None:
        save(figure, path)
    return figure


def with_unit(name: str, unit: str) -> str:
    """Return the label of an axis or a curve.

    >>> with_unit("x", "m"), with_unit("x", "")
    ('x [m]', 'x')
    """
    return f"{name} [{unit}]" if unit else name


def symbol_of(expression: Expr) -> str:
    """Return an expression in mathematical type if it is short and matplotlib can typeset it."""
    text = str(expression)
    latex = expression.latex()
    return f"${latex}$" if len(text) <= 40 and not {"begin", "text"} & set(latex.split("\\")) else text[:60]
