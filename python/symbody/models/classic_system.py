"""Classic systems: a system, numbers for it, and where it comes from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from symbody.errors import ModelError
from symbody.multibody import System
from symbody.symbolic import Expr

_WHERE = "ClassicSystem"


@dataclass(frozen=True, eq=False)
class ClassicSystem:
    """A well-known system in symbols, with numbers for which it can be simulated, in SI units and rad.

    Attributes:
        system: the system, all of whose dimensions are symbols.
        source: the publication that the system, or its numbers, are taken from.
        parameters: values of all parameters.
        initial: coordinates and rates at the first instant of a typical motion; others are zero or follow.
        inputs: values of the inputs, such as the torques of motors; these are functions of time.
        guess: where closed loops are near the first instant.

    >>> from symbody import newton_euler
    >>> from symbody.models import n_pendulum
    >>> pendulum = n_pendulum(1)
    >>> newton_euler(pendulum.system).residuals
    (l1*m1*(l1*theta1'' + g*sin(theta1)),)
    >>> pendulum.parameters[pendulum["l1"]]
    1.0
    """

    system: System
    source: str
    parameters: Mapping[Expr, float]
    initial: Mapping[Expr, float]
    inputs: Mapping[Expr, float] = field(default_factory=dict)
    guess: Mapping[Expr, float] = field(default_factory=dict)

    @property
    def names(self) -> dict[str, Expr]:
        """Return the coordinates, speeds, states, inputs and parameters by their names."""
        system = self.system
        leaves = (*system.coordinates, *system.speeds, *system.states, *self.inputs, *self.parameters)
        return {str(leaf): leaf for leaf in leaves}

    def __getitem__(self, name: str) -> Expr:
        """Return the symbol or function of time of a name."""
        names = self.names
        if name not in names:
            raise ModelError(f"{_WHERE}: nothing is called {name!r}; the names are {', '.join(names)}")
        return names[name]

    def __repr__(self) -> str:
        return f"{_WHERE}({self.system})"
