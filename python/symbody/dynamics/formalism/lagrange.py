"""Lagrange's equations: of a Lagrangian, and of a system."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import final

from symbody.dynamics.equations.constraint_force import with_multipliers
from symbody.dynamics.equations.equations import Assembly, Equations
from symbody.dynamics.equations.independence import check_independent
from symbody.dynamics.recursion.added_mass import with_added_mass
from symbody.dynamics.recursion.mass_matrix import mass_matrix
from symbody.dynamics.recursion.recursive_newton_euler import at_rest, bias, recursive_newton_euler
from symbody.dynamics.recursion.shortest_tree import mass_matrix_and_bias, shortest_tree
from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree, given_twist
from symbody.errors import ModelError
from symbody.geometry.component.triple import NULL, Triple
from symbody.geometry.given.argument import checked
from symbody.multibody import Body, System, kinetic_energy
from symbody.multibody.coordinate import check_function_of_time
from symbody.multibody.load import action_velocity
from symbody.symbolic import (
    Expr,
    Matrix,
    add3,
    derivation,
    dot3,
    gradient,
    jacobian,
    number,
    scale3,
    substitute,
    symbol,
    time_derivative,
    time_derivatives,
    without_idle_symbols,
)
from symbody.symbolic.given.arguments import brief

from .checked_tree import checked_tree


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
    with derivation():
        momentum, force = gradient(L, [time_derivative(q), q])
        return time_derivative(momentum) - force


@checked(ModelError)
def lagrange_equations(system: System) -> Equations:
    """Return the equations of motion by differentiating ``T - V``: ``d/dt dL/dq' - dL/dq - Q - phi_q^T lambda``.

    Q are the generalised forces of the loads, and lambda the multipliers of the constraints phi in
    ``L + sum(lambda phi)``. If all frames are rigid, the recursion of `newton_euler` is derived first. Expressions of
    equal value then take its form: both derivations give the same nodes if, and only if, they agree.

    >>> from symbody import Body, System, Vector, ground, functions_of_time, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    >>> lagrange_equations(pendulum).residuals
    (l*m*(l*theta'' + g*sin(theta)),)
    """
    _check_no_quasi_velocities(system)
    check_independent(system)
    with derivation(fresh=True):
        tree = checked_tree(system, "lagrange_equations")
        if tree.is_rigid:
            recursive_newton_euler(system, shortest_tree(system, recursive_newton_euler))
        residuals = system.by_speeds(with_multipliers(_residuals(system), system))
    return Equations(system, without_idle_symbols(residuals), _assemble)


def _check_no_quasi_velocities(system: System) -> None:
    frames = (frame for body in system.bodies for frame in body.frame.chain)
    moved = next((frame for frame in frames if given_twist(frame) is not None), None)
    if moved is not None:
        raise ModelError(
            f"lagrange_equations: {brief(moved)} moves by velocities in its own axes, which are not rates of "
            "coordinates; use newton_euler"
        )


def _assemble(system: System) -> Assembly:
    with derivation(fresh=True):
        if frame_tree(system).is_rigid:
            tree = shortest_tree(system, mass_matrix_and_bias)
            bias(system, tree)
            with_added_mass(mass_matrix(system, tree), system)
        momenta = _momenta(system)
        M = with_added_mass(jacobian(momenta, [time_derivative(q) for q in system.coordinates]), system)
        rest = Matrix([system.by_speeds(_residuals(system))]).subs(at_rest(system)).entries
        assembly = Assembly(M, tuple(entry + 0 for entry in rest))  # the sum takes the value's node
    return assembly.without_idle_symbols()


def _residuals(system: System) -> tuple[Expr, ...]:
    n = len(system.coordinates)
    speeds = [time_derivative(q) for q in system.coordinates]
    held = _Held()
    lagrangian = kinetic_energy(system) - _potential(system, held)
    slopes = gradient(lagrangian, [*speeds, *system.coordinates])
    rates = time_derivatives(slopes[:n])
    loads = gradient(_power(system, held), speeds)
    forces = held.released(slope + load for slope, load in zip(slopes[n:], loads, strict=True))
    return tuple(rate - force for rate, force in zip(rates, forces, strict=True))


def _momenta(system: System) -> tuple[Expr, ...]:
    return gradient(kinetic_energy(system), [time_derivative(q) for q in system.coordinates])


def _potential(system: System, held: _Held) -> Expr:
    """Return ``-g . sum(m r_G)``; the sum is carried from the bodies down to the root, so its length is linear."""
    if system.gravity is None:
        return number(0)
    gravity = system.gravity.projected(system.root).components
    return -dot3(held.stand_ins(gravity), _mass_moment(frame_tree(system), system.bodies))


def _mass_moment(tree: FrameTree, bodies: Sequence[Body]) -> Triple:
    """Return ``sum(m r_G)`` in the axes of the root."""
    masses: list[Expr] = [number(0)] * len(tree.frames)
    moments: list[Triple] = [NULL] * len(tree.frames)
    for body in bodies:
        masses[tree.index(body.frame)] += body.mass
    for k in range(len(tree.frames) - 1, 0, -1):
        motion, parent = tree.motions[k], tree.parents[k]
        masses[parent] += masses[k]
        moved = add3(motion.to_parent(moments[k]), scale3(masses[k], motion.displacement))
        moments[parent] = add3(moments[parent], moved)
    return moments[0]


def _power(system: System, held: _Held) -> Expr:
    """Return the power of the loads."""
    power = number(0)
    for action in frame_tree(system).actions:
        velocity, axes = action_velocity(action)
        power += dot3(held.stand_ins(action.components(axes)), velocity)
    return power


@final
class _Held:
    """Symbols substituted for forces while power and potential are differentiated: forces are held constant."""

    def __init__(self) -> None:
        self._values: dict[Expr, Expr] = {}

    def stand_ins(self, components: Triple) -> Triple:
        x, y, z = components
        return self._stand_in(x), self._stand_in(y), self._stand_in(z)

    def _stand_in(self, component: Expr) -> Expr:
        if not component.depends_on_time:
            return component
        stand_in = symbol(f"held {len(self._values)}")  # a name that no user can write
        self._values[stand_in] = component
        return stand_in

    def released(self, expressions: Iterable[Expr]) -> tuple[Expr, ...]:
        return substitute(tuple(expressions), self._values) if self._values else tuple(expressions)
