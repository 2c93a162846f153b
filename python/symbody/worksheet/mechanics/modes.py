"""The modes in which MBSymba's commands work: the release, a moving master frame, small variables."""

from __future__ import annotations

from dataclasses import dataclass, field

from symbody.geometry import Frame
from symbody.symbolic import Expr
from symbody.worksheet.evaluation.session import Session

__all__ = ["Mechanics", "mechanics"]


@dataclass
class Mechanics:
    """The modes of a session.

    Attributes:
        release: that of the package which was loaded: 3 is the one of 2004, whose name has no number.
        moving: the moving master frame on which all frames are hung, if there is one.
        speeds: the velocities of the moving frame as the sheet writes them, along its axes and about them.
        small: the variables that are small, and the values from which they deviate; zero for most.
        small_rates: derivatives that are small although their functions are not, with such values.
    """

    release: int = 6
    moving: Frame | None = None
    speeds: tuple[Expr, ...] = ()
    small: dict[Expr, Expr] = field(default_factory=dict)
    small_rates: dict[Expr, Expr] = field(default_factory=dict)

    @property
    def matrix_kind(self) -> str:
        """The kind of the matrices that commands return: releases before the sixth use those of the package linalg."""
        return "Matrix" if self.release > 5 else "matrix"


def mechanics(session: Session) -> Mechanics:
    """Return the modes of a session."""
    if session.mechanics is None:
        session.mechanics = Mechanics()
    modes: Mechanics = session.mechanics
    return modes
