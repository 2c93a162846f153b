"""Lagrange's equations: of a Lagrangian, and of a system."""

from __future__ import annotations

from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.equations.independence import check_independent
from symbody.dynamics.recursion.added_mass import with_added_mass
from symbody.errors import ModelError
from symbody.geometry.given.argument import checked
from symbody.multibody import System
from symbody.multibody.coordinate import check_function_of_time
from symbody.multibody.energy import kinetic_energy_in_own_axes
from symbody.symbolic import (
    ENERGY,
    MOTION,
    Expr,
    Matrix,
    derivation,
    gradient,
    jacobian,
    time_derivative,
    time_derivatives,
    truncated,
)

from .boltzmann_hamel import moves_by_twists, residuals_in_quasi_velocities
from .derived import derived
from .virtual_power import Held, power_of_loads
from .weight_potential import potential


@checked(ModelError)
def lagrange(L: Expr, q: Expr) -> Expr:
    """Return ``d/dt dL/dq' - dL/dq``; the equation of motion subtracts the generalised force.

    Args:
        L: the Lagrangian ``T - V``, a function of time, coordinates and their first derivatives.
        q: the coordinate, a function of time.

    >>> from symbody import functions_of_time, symbols
    >>> x, (k, m) = functions_of_time("x"), symbols("k m")
    >>> lagrange(m * time_derivative(x) ** 2 / 2 - k * x**2 / 2, x) == m * time_derivative(x, 2) + k * x
    True
    """
    check_function_of_time(q, "lagrange: the coordinate")
    with derivation(order=ENERGY):
        momentum, force = gradient(L, [time_derivative(q), q])
        return truncated([time_derivative(momentum) - force], MOTION)[0]


@checked(ModelError)
def lagrange_equations(system: System) -> Equations:
    """Return the equations of motion by differentiating ``T - V``: ``d/dt dL/dq' - dL/dq - Q - phi_q^T lambda``.

    Q are the generalised forces of the loads, and lambda the multipliers of the constraints phi in
    ``L + sum(lambda phi)``. Where frames move by velocities in their own axes, as floating ones do, and for speeds of
    the user's choice, the equations are those of Boltzmann and Hamel (`boltzmann_hamel.py`). If all frames are rigid,
    the recursion of `newton_euler` is derived first. Expressions of equal value then take its form: both derivations
    give the same nodes if, and only if, they agree.

    >>> from symbody import Body, System, Vector, ground, functions_of_time, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    >>> lagrange_equations(pendulum).residuals
    (l*m*(l*theta'' + g*sin(theta)),)
    """
    check_independent(system)
    return derived(system, _residuals, "lagrange_equations", inertia=_inertia)


def _inertia(system: System) -> Matrix:
    (energy,) = system.by_speeds([kinetic_energy_in_own_axes(system.bodies)])
    momenta = gradient(energy, system.speeds)
    return with_added_mass(jacobian(momenta, system.speeds), system)


def _residuals(system: System) -> tuple[Expr, ...]:
    if system.chosen or moves_by_twists(system):
        return residuals_in_quasi_velocities(system)
    n = len(system.coordinates)
    speeds = [time_derivative(q) for q in system.coordinates]
    held = Held()
    lagrangian = kinetic_energy_in_own_axes(system.bodies) - potential(system, held)
    slopes = gradient(lagrangian, [*speeds, *system.coordinates])
    rates = time_derivatives(slopes[:n])
    loads = gradient(power_of_loads(system, held), speeds)
    forces = held.released(slope + load for slope, load in zip(slopes[n:], loads, strict=True))
    return tuple(rate - force for rate, force in zip(rates, forces, strict=True))
