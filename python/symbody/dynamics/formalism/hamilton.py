"""Hamilton's canonical equations [Goldstein, Poole & Safko 2002, ch. 8]: coordinates and momenta as the state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symbody.dynamics.equations.constraint_force import with_multipliers
from symbody.dynamics.equations.independence import check_independent
from symbody.errors import ExpressionError, ModelError
from symbody.geometry.given.argument import checked
from symbody.multibody import System, kinetic_energy
from symbody.symbolic import (
    Expr,
    derivation,
    functions_of_time,
    gradient,
    jacobian,
    ldl_solve,
    number,
    substitute,
    time_derivative,
)
from symbody.symbolic.given.arguments import brief

from .checked_tree import checked_tree
from .virtual_power import Held, power_of_loads
from .weight_potential import potential

_WHERE = "hamilton"


@dataclass(frozen=True, eq=False)
class CanonicalEquations:
    """Hamilton's equations ``q' = dH/dp, p' = -dH/dq + Q + phi_q^T lambda``.

    Attributes:
        system: the system to which they belong.
        momenta: p, one function of time per coordinate, called p_q.
        hamiltonian: ``H = p . q' - L``, a function of q, p and t; the energy, unless a frame is driven.
        rates: q', p' and, of states z beside the mechanics, z', by q, p, z, t and the multipliers.

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

    @property
    def coordinates(self) -> tuple[Expr, ...]:
        """The coordinates q."""
        return self.system.coordinates

    def __repr__(self) -> str:
        names = ", ".join(map(str, (*self.coordinates, *self.momenta)))
        return f"CanonicalEquations({names})"


@checked(ModelError)
def hamilton(system: System) -> CanonicalEquations:
    """Return Hamilton's equations of a system whose speeds are the rates of its coordinates.

    The momenta are ``p = dT/dq'``, linear in the rates, and solved for these. The rates of the momenta are taken at
    constant q', where ``-dH/dq = dL/dq``, so that the inverse of the mass matrix is not differentiated. Q are the
    generalised forces of the loads; constraints keep their multipliers.

    Raises:
        ModelError: a speed is not the rate of a coordinate, a coordinate moves no mass, or loads or rates of states
            hold accelerations.

    >>> from symbody import Body, System, Vector, ground, functions_of_time, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> found = hamilton(System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0)))
    >>> found, list(found.rates.values())
    (CanonicalEquations(theta, p_theta), [p_theta/(m*l**2), -g*l*m*sin(theta)])
    >>> found.hamiltonian
    p_theta**2/(2*m*l**2) - g*l*m*cos(theta)
    """
    _check(system)
    check_independent(system)
    n, u = len(system.coordinates), system.speeds
    momenta = _momenta(system)
    with derivation(fresh=True):
        checked_tree(system, _WHERE)
        held = Held()
        lagrangian = kinetic_energy(system) - potential(system, held)
        slopes = gradient(lagrangian, [*u, *system.coordinates])
        rates = dict(zip(u, _solved(slopes[:n], u, momenta), strict=True))
        loads = gradient(power_of_loads(system, held), u)
        forces = held.released(slope + load for slope, load in zip(slopes[n:], loads, strict=True))
        _check_known(system, forces)
        needed = with_multipliers([-force for force in forces], system)
        (energy,) = held.released([sum((p * v for p, v in zip(momenta, u, strict=True)), start=-lagrangian)])
        _check_states(system)
        *changes, hamiltonian = substitute([*(-each for each in needed), energy], rates)
        beside = zip(system.state_rates, substitute([*system.state_rates.values()], rates), strict=True)
    moved = {time_derivative(p): change for p, change in zip(momenta, changes, strict=True)}
    return CanonicalEquations(system, momenta, hamiltonian, rates | moved | dict(beside))


def _check(system: System) -> None:
    if system.has_quasi_velocities or system.root.carrier is not None:
        raise ModelError(
            f"hamilton: the speeds {brief(', '.join(map(str, system.speeds)))} are not the rates of the coordinates; "
            "momenta need frames of coordinates: use another formalism, such as newton_euler"
        )


def _momenta(system: System) -> tuple[Expr, ...]:
    names = [f"p_{q.name}" for q in system.coordinates]
    taken = {leaf.name for leaf in (*system.leaves, *system.multipliers)}
    clash = next((name for name in names if name in taken), None)
    if clash is not None:
        raise ModelError(
            f"hamilton: the momentum {clash} has the name of something in the system; rename that"
        )
    return tuple(functions_of_time(name) for name in names)


def _solved(slopes: Sequence[Expr], speeds: Sequence[Expr], momenta: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the rates of the coordinates by the momenta: ``M q' = p - dT/dq' at rest``."""
    drift = substitute(slopes, dict.fromkeys(speeds, number(0)))
    try:
        return ldl_solve(jacobian(slopes, speeds), [p - each for p, each in zip(momenta, drift, strict=True)])
    except ExpressionError as failure:
        raise ModelError(
            f"hamilton: the mass matrix of {', '.join(map(str, speeds))}: {failure}; give every coordinate some mass "
            "to move"
        ) from failure


def _check_states(system: System) -> None:
    for state, rate in system.state_rates.items():
        acceleration = next((a for a in system.accelerations if a in rate.free_symbols), None)
        if acceleration is not None:
            raise ModelError(
                f"hamilton: {state} holds the acceleration {acceleration}, which momenta don't give; use newton_euler"
            )


def _check_known(system: System, forces: Sequence[Expr]) -> None:
    for force in forces:
        acceleration = next((a for a in system.accelerations if a in force.free_symbols), None)
        if acceleration is not None:
            raise ModelError(
                f"hamilton: a load holds the acceleration {acceleration}, which momenta don't give; use newton_euler"
            )
