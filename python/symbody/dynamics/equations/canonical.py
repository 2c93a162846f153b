"""Hamilton's canonical equations: coordinates and momenta as the state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from symbody.dynamics.display.canonical_page import CanonicalPage
from symbody.dynamics.display.summary import is_readable
from symbody.multibody import System
from symbody.symbolic import (
    Expr,
    Matrix,
    cost,
    derivation,
    identity,
    jacobian,
    time_derivative,
    without_idle_symbols,
)
from symbody.symbolic.expression.container import Container, contains, substituted
from symbody.symbolic.expression.latex_layout import displayed, one_formula

from .constraint_force import with_multipliers
from .equations import Assembly, Derived, Equations

_MOST = 60
"""The rates up to which they are written out."""


@dataclass(frozen=True, eq=False)
class CanonicalEquations:
    """Hamilton's equations ``q' = dH/dp, p' = -dH/dq + Q + phi_q^T lambda``, also in momenta of other speeds.

    Attributes:
        system: the system to which they belong.
        momenta: ``p = dT/du``, one function of time per speed u of the system, called p_q or p_u.
        hamiltonian: ``H = p . u - L``, a function of q, p and t; the energy, unless something is driven.
        rates: q' and p', then those of states, by q, p, t and the multipliers.
        speeds: the speeds u by the momenta, the same as ``dH/dp``.
        momenta_by_speeds: the momenta by the speeds, ``dT/du``.

    >>> from symbody import Body, System, functions_of_time, hamilton, symbols, time_derivative, translate
    >>> x, m = functions_of_time("x"), symbols("m")
    >>> free = hamilton(System([Body(translate(x, 0, 0), m)], coordinates=[x]))
    >>> free.momenta, free.rates[time_derivative(x)]
    ((p_x,), p_x/m)
    """

    system: System
    momenta: tuple[Expr, ...]
    hamiltonian: Expr
    rates: dict[Expr, Expr]
    speeds: dict[Expr, Expr]
    momenta_by_speeds: dict[Expr, Expr]

    @property
    def coordinates(self) -> tuple[Expr, ...]:
        """The coordinates q."""
        return self.system.coordinates

    @property
    def constraints(self) -> tuple[Expr, ...]:
        """The constraints, expressions that are zero: on positions, or on velocities, which are by the momenta."""
        return self._in_momenta.constraints

    @property
    def multipliers(self) -> tuple[Expr, ...]:
        """The multipliers, one per constraint."""
        return self.system.multipliers

    @cached_property
    def _in_momenta(self) -> System:
        """The system whose speeds are the momenta."""
        return self.system.eliminating(self.speeds, self.momenta_by_speeds)

    @cached_property
    def equations(self) -> Equations:
        """The same as `Equations` whose speeds are the momenta: to be simulated, compiled, written as code.

        Without constraints they are ``p' = f(q, p)``, with the identity as mass matrix. With constraints they are
        multiplied by ``W = du/dp``, the inverse of the mass matrix, so that the Jacobian of the constraints is
        by the momenta too: ``W p' = W f + (A W)^T lambda``.

        >>> from symbody import Body, System, functions_of_time, hamilton, symbols, translate
        >>> x, m = functions_of_time("x"), symbols("m")
        >>> hamilton(System([Body(translate(x, 0, 0), m)], coordinates=[x])).equations.kinematics
        {x': p_x/m}
        """
        system = self._in_momenta
        at_rest = dict.fromkeys(system.multipliers, 0)
        with derivation(fresh=True):
            changes = [time_derivative(p) for p in self.momenta]
            forces = Matrix([[self.rates[change].subs(at_rest)] for change in changes])
            W = identity(len(changes))
            if system.constraints:
                W = jacobian([*self.speeds.values()], self.momenta)
                forces = W @ forces
            pushes = (W @ Matrix([[change] for change in changes])).entries
            balance = [push - force for push, force in zip(pushes, forces.entries, strict=True)]
            residuals = with_multipliers(balance, system)
        assembly = Assembly(W, tuple(-force for force in forces.entries))
        balanced = Derived(without_idle_symbols(residuals))
        return Equations(system, balanced, Derived(assembly.without_idle_symbols()))

    def __repr__(self) -> str:
        states = ", ".join(map(str, (*self.coordinates, *self.momenta, *self.system.states)))
        return f"CanonicalEquations({states})"

    @cached_property
    def _page(self) -> CanonicalPage:
        return CanonicalPage(self._in_momenta, self.hamiltonian, self.rates)

    @property
    def _is_readable(self) -> bool:
        return len(self.rates) <= _MOST and is_readable((self.hamiltonian, *self.rates.values()))

    def description(self) -> str:
        """Return the Hamiltonian and the equations line by line: what `show` prints.

        Of equations that are too long, the sizes are returned.
        """
        return self._page.description() if self._is_readable else self._page.summary()

    def latex(self) -> str:
        """Return the Hamiltonian, the equations and the constraints in LaTeX; long ones are broken at terms."""
        return self._page.latex() if self._is_readable else self._page.summary_in_latex()

    @cached_property
    def _latex_of_notebook(self) -> str | None:
        """The equations in LaTeX if they are short enough to be read below a cell."""
        if cost([self.hamiltonian, *self.rates.values()]).total > _AT_ONCE:
            return None
        return None if self.description().count("\n") > _READABLE else displayed(one_formula(self.latex()))

    def _repr_latex_(self) -> str | None:
        return self._latex_of_notebook

    def _repr_html_(self) -> str | None:
        """Return the sizes of equations that are too long to be read."""
        return None if self._latex_of_notebook else self._page.summary_table()


_READABLE = 60
"""Lines up to which a notebook shows equations."""

_AT_ONCE = 500
"""Operations up to which a notebook writes equations out."""


def _parts(canonical: CanonicalEquations) -> tuple[object, ...]:
    kinds = (canonical.rates, canonical.speeds, canonical.momenta_by_speeds)
    return (canonical.hamiltonian, *(tuple(kind.values()) for kind in kinds))


def _rebuilt(canonical: CanonicalEquations, parts: Sequence[Any]) -> CanonicalEquations:
    """Return the equations in another form; they belong to the same system."""
    hamiltonian, *kinds = parts
    rates, speeds, momenta = (
        dict(zip(before, after, strict=True))
        for before, after in zip(
            (canonical.rates, canonical.speeds, canonical.momenta_by_speeds), kinds, strict=True
        )
    )
    return replace(canonical, hamiltonian=hamiltonian, rates=rates, speeds=speeds, momenta_by_speeds=momenta)


def _substituted(canonical: CanonicalEquations, mapping: Mapping[Any, Any]) -> CanonicalEquations:
    system = substituted(canonical.system, mapping)
    return _rebuilt(replace(canonical, system=system), substituted(_parts(canonical), mapping))


contains(
    CanonicalEquations,
    Container(
        _parts,
        _rebuilt,
        advice="its rates have one: diff(list(canonical.rates.values()), x)",
        subs=_substituted,
    ),
)
