"""The interface of motions that can be drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.multibody import System, Variables
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described


class DrawableMotion(Protocol):
    """A motion: its N instants, and the values of any expression of the model at these.

    The result of `symbody.simulate` satisfies this, as does any object with these members.
    """

    @property
    def t(self) -> NDArray[np.float64]:
        """The instants, increasing, shape (N,)."""
        ...

    @property
    def system(self) -> Variables:
        """The system that moves."""
        ...

    def __getitem__(self, expression: Expr) -> NDArray[np.float64]:
        """Return the values of an expression, shape (N,)."""
        ...

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        """Return the values of several expressions, one row for each: shape (expressions, N)."""
        ...


@dataclass(frozen=True, eq=False)
class OneInstant:
    """What holds at one instant alone, as a motion: an equilibrium, a steady motion at its first instant, a structure.

    Attributes:
        found: has the `system`, the instant `t`, and `evaluate`, which returns one value for each expression.
    """

    found: Any

    @property
    def t(self) -> NDArray[np.float64]:
        return np.array([float(self.found.t)])

    @property
    def system(self) -> Variables:
        system: Variables = self.found.system
        return system

    def __getitem__(self, expression: Expr) -> NDArray[np.float64]:
        return np.asarray(self.evaluate([expression])[0])

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        """Return the values as a column."""
        return np.asarray(self.found.evaluate(expressions), dtype=np.float64).reshape(-1, 1)


@dataclass(frozen=True, eq=False)
class Structure:
    """A system in which nothing moves, at one instant.

    Attributes:
        system: the system, without coordinates.
        parameters: the values of its parameters.
        where: the function that the user called, for messages.
        t: the instant, in s.
    """

    system: System
    parameters: Mapping[Expr, float]
    where: str
    t: float = 0.0

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        """Return one value for each expression.

        Raises:
            ViewError: a parameter has no value.
        """
        missing = sorted(
            map(str, {leaf for each in expressions for leaf in each.free_symbols} - {*self.parameters})
        )
        if missing:
            raise ViewError(
                f"{self.where}, parameters: no value for {', '.join(missing)}; expected numbers for the symbols of a "
                f"structure, such as parameters={{{missing[0]}: 1.0}}"
            )
        values = [
            each.evaluate({leaf: self.parameters[leaf] for leaf in each.free_symbols}) for each in expressions
        ]
        return np.array(values, dtype=np.float64)


def drawable(found: Any, where: str, parameters: Mapping[Expr, float] | None = None) -> DrawableMotion:
    """Return what can be drawn: a motion as it is; an equilibrium, a steady motion or a structure as one instant.

    Args:
        found: the argument of the user.
        where: the function that was called, for messages.
        parameters: the values of the parameters of a structure.

    Raises:
        ViewError: parameters are given beside a motion, which has its own.
    """
    if isinstance(found, System) and not found.coordinates:
        return OneInstant(Structure(found, parameters or {}, where))
    if parameters is not None:
        raise ViewError(
            f"{where}, parameters: {described(found)} has its own values; expected parameters of a structure alone, "
            "which is a system without coordinates"
        )
    return OneInstant(found) if np.ndim(getattr(found, "t", [])) == 0 else found


def mechanism_of(motion: DrawableMotion, where: str = "animate") -> System:
    """Return the system that moves, with its bodies.

    Args:
        motion: the motion.
        where: the function that the user called, for messages.

    Raises:
        ViewError: it is no motion, or its equations were given without bodies.
    """
    if not (hasattr(motion, "t") and hasattr(motion, "system")):
        raise ViewError(
            f"{where}: motion = {described(motion)}; expected a motion, such as simulate(equations, ...) returns, an "
            "equilibrium or a steady motion"
        )
    if not isinstance(motion.system, System):
        raise ViewError(
            f"{where}: the equations of this motion were given without bodies, so that there is nothing to draw; plot "
            "shows its coordinates and speeds over time"
        )
    return motion.system
