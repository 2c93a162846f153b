"""Hamilton's canonical equations [Goldstein, Poole & Safko 2002, ch. 8], in momenta of any speeds.

Poincare and Chetaev wrote them in quasi-velocities [Poincare 1901; Chetaev 1989, ch. 4; Rumyantsev 1998]. With the
speeds u of the system, ``q' = Y u + b`` and the twists ``eta = (w, v)`` of frames that move by velocities, the momenta
are

    p_k = dT/du_k = P . dq'/du_k + h . dw/du_k + l . dv/du_k        P = dT/dq', h = dT/dw, l = dT/dv

and d'Alembert's principle (`boltzmann_hamel.py`), each factor times its virtual displacement, gives their rates

    p_k' = Q_k + dL/dq . dq'/du_k - (w x h + v x l) . dw/du_k - (w x l) . dv/du_k
           + P . d/dt(dq'/du_k) + h . d/dt(dw/du_k) + l . d/dt(dv/du_k)

in which no acceleration is left. The last line vanishes where speeds are rates of coordinates: ``p' = dL/dq + Q``. All
P, h and l count, also those along velocities that kinematics makes dependent, as in rolling without multipliers. The
speeds are ``u = dH/dp`` of the Hamiltonian ``H = p . u - L``, which is ``T_2 - T_0 + V``.
"""

from __future__ import annotations

from collections.abc import Sequence

from symbody.dynamics.equations.canonical import CanonicalEquations
from symbody.dynamics.equations.constraint_force import with_multipliers
from symbody.dynamics.equations.independence import check_independent
from symbody.dynamics.equations.singular_mass import described_singularity
from symbody.errors import ExpressionError, ModelError
from symbody.geometry.given.argument import checked
from symbody.multibody import System
from symbody.multibody.energy import kinetic_energy_in_own_axes, potentials
from symbody.symbolic import (
    Expr,
    are_small,
    derivation,
    dot3,
    functions_of_time,
    gradient,
    jacobian,
    ldl_solve,
    number,
    substitute,
    time_derivative,
    without_idle_symbols,
)
from symbody.symbolic.given.arguments import brief

from .boltzmann_hamel import Slopes, gyroscopic, slopes_of_lagrangian
from .checked_tree import checked_tree
from .virtual_power import Held, along_speeds, power_of_loads, power_of_weight
from .weight_potential import potential

_WHERE = "hamilton"


@checked(ModelError)
def hamilton(system: System) -> CanonicalEquations:
    """Return Hamilton's equations: ``q' = Y dH/dp + b``, and the rates of the momenta ``p = dT/du``.

    The speeds u may be rates of coordinates, whose momenta are called p_q, or any others: those of moving and floating
    frames, and speeds of the user's choice. Their momenta are called p_u, and the equations are those of Poincare and
    Chetaev. The momenta are linear in the speeds, and solved for these. Their rates are taken at constant speeds, where
    ``-dH/dq = dL/dq``, so that the inverse of the mass matrix is not differentiated. Q are the generalised forces of
    the loads without a potential; constraints keep their multipliers. `CanonicalEquations.equations` are simulated and
    compiled.

    Raises:
        ModelError: a coordinate moves no mass, or loads contain accelerations.

    >>> from symbody import Body, System, Vector, ground, functions_of_time, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> found = hamilton(System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0)))
    >>> found, list(found.rates.values())
    (CanonicalEquations(theta, p_theta), [p_theta/(m*l**2), -g*l*m*sin(theta)])
    >>> found.hamiltonian
    p_theta**2/(2*m*l**2) - g*l*m*cos(theta)
    """
    _check_exact(system)
    check_independent(system)
    u, p = system.speeds, _momenta(system)
    with derivation(fresh=True):
        checked_tree(system, _WHERE)
        (kinetic,) = system.by_speeds([kinetic_energy_in_own_axes(system.bodies)])
        momenta = gradient(kinetic, u)
        speeds = dict(zip(u, without_idle_symbols(_solved(momenta, u, p)), strict=True))
        forces = _forces(system)
        _check_known(system, forces)
        needed = with_multipliers([-force for force in forces], system)
        changes = [-each for each in needed]
        moving = [*system.kinematics.values(), *changes, _energy(system, kinetic, p)]
        *values, hamiltonian = without_idle_symbols(substitute(moving, speeds))
        hamiltonian = sum(potentials(system.loads, system.bodies), start=hamiltonian)
        rates = dict(zip((*system.kinematics, *map(time_derivative, p)), values, strict=True))
        by_speeds = dict(zip(p, momenta, strict=True))
        rates |= _of_states(system.eliminating(speeds, by_speeds), rates)
    return CanonicalEquations(system, p, hamiltonian, rates, speeds, by_speeds)


def _check_exact(system: System) -> None:
    """Check that no variables are small: a momentum is small only if it vanishes in the reference motion."""
    marked = sorted((leaf for leaf in system.leaves if are_small([leaf])), key=str)
    if marked:
        names = f"{brief(', '.join(map(str, marked)))} {'is' if len(marked) == 1 else 'are'}"
        raise ModelError(
            f"hamilton: {names} small, but which momenta are small is not known; use "
            "lagrange_equations, or variables that are not marked as small, and taylor of the result"
        )


def _forces(system: System) -> tuple[Expr, ...]:
    """Return the rates of the momenta, without the forces of constraints."""
    slopes, held = slopes_of_lagrangian(system), Held()
    power = power_of_loads(system, held)
    if system.root.carrier is not None:
        power += power_of_weight(system, held)
    for slope, rate in zip(slopes.of_coordinates, system.kinematics.values(), strict=True):
        power += held.stand_in(slope) * rate
    for twist, momentum in zip(slopes.twists, slopes.of_twists, strict=True):
        turning = gyroscopic(twist, momentum)
        power -= dot3(held.stand_ins(turning.angular), twist.angular)
        power -= dot3(held.stand_ins(turning.linear), twist.linear)
    forces = system.by_speeds(held.released(along_speeds(power, system)))
    return tuple(a + b for a, b in zip(forces, _transport(system, slopes), strict=True))


def _transport(system: System, slopes: Slopes) -> tuple[Expr, ...]:
    """Return ``P . d/dt(dq'/du)`` and the like: where velocities per unit of a speed change, momenta do."""
    velocities = [*system.kinematics.values()]
    velocities += [component for twist in slopes.twists for part in twist for component in part]
    momenta = [*slopes.of_rates]
    momenta += [component for twist in slopes.of_twists for part in twist for component in part]
    partial = jacobian(velocities, system.speeds)
    changes, n = system.rate(partial.entries), len(system.speeds)
    return tuple(
        sum((p * change for p, change in zip(momenta, changes[k::n], strict=True)), start=number(0))
        for k in range(n)
    )


def _energy(system: System, kinetic: Expr, momenta: Sequence[Expr]) -> Expr:
    """Return ``H = p . u - L = (p - p_0) . u / 2 - T_0 + V``; p_0 and T_0 are momenta and energy at zero speeds."""
    held, u = Held(), system.speeds
    energy = number(0) if system.root.carrier is not None else potential(system, held)
    resting, *drift = substitute([kinetic, *gradient(kinetic, u)], dict.fromkeys(u, number(0)))
    for p, rest, speed in zip(momenta, drift, u, strict=True):
        energy += (p - rest) * speed / 2
    (energy,) = held.released([energy - resting])
    return energy


def _of_states(system: System, rates: dict[Expr, Expr]) -> dict[Expr, Expr]:
    """Return the rates of states by the momenta; those of momenta may be in them."""
    names = tuple(system.state_rates)
    values = substitute(system.by_speeds([*system.state_rates.values()]), rates)
    return dict(zip(names, values, strict=True))


def _momenta(system: System) -> tuple[Expr, ...]:
    names = [f"p_{each.name}" for each in system.driving]
    taken = {leaf.name for leaf in (*system.leaves, *system.multipliers)}
    clash = next((name for name in names if name in taken), None)
    if clash is not None:
        raise ModelError(
            f"hamilton: the momentum {clash} has the name of something in the system; rename that"
        )
    return tuple(functions_of_time(name) for name in names)


def _solved(slopes: Sequence[Expr], speeds: Sequence[Expr], momenta: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the speeds by the momenta: ``M u = p - dT/du at rest``."""
    drift = substitute(slopes, dict.fromkeys(speeds, number(0)))
    M = jacobian(slopes, speeds)
    try:
        return ldl_solve(M, [p - each for p, each in zip(momenta, drift, strict=True)])
    except ExpressionError as failure:
        found = described_singularity(M, speeds) or (
            f"the mass matrix of {', '.join(map(str, speeds))}: {failure}; give every coordinate some mass to move"
        )
        raise ModelError(f"hamilton: {found}") from failure


def _check_known(system: System, forces: Sequence[Expr]) -> None:
    for force in forces:
        acceleration = next((a for a in system.accelerations if a in force.free_symbols), None)
        if acceleration is not None:
            raise ModelError(
                f"hamilton: a load holds the acceleration {acceleration}, which momenta don't give; use newton_euler"
            )
