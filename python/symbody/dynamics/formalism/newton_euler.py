"""Newton-Euler: the equations of motion by recursion over the tree of frames [Luh, Walker & Paul 1980]."""

from __future__ import annotations

from symbody.dynamics.equations.constraint_force import in_shared_sums, with_multipliers
from symbody.dynamics.equations.equations import Assembly, Equations
from symbody.dynamics.equations.independence import check_independent
from symbody.dynamics.recursion.added_mass import with_added_mass
from symbody.dynamics.recursion.shortest_derivation import (
    mass_matrix_and_bias,
    residuals,
    shortest_derivation,
)
from symbody.errors import ModelError
from symbody.geometry.given.argument import checked
from symbody.multibody import System
from symbody.symbolic import (
    ENERGY,
    MOTION,
    Expr,
    derivation,
    truncated,
    without_idle_symbols,
)

from .checked_tree import check_rigid, checked_tree


@checked(ModelError)
def newton_euler(system: System) -> Equations:
    """Return the equations of motion by recursion over the tree of frames.

    The accelerations of the frames, in their own axes, are carried outwards, with weight as an acceleration of the
    root; the wrenches that cause them are carried inwards. The equation of a speed is the power of the wrenches on the
    motions that it drives, per unit of the speed (`recursion/recursive_newton_euler.py`, `forces_along_speeds.py`). The
    number of operations is proportional to the number of bodies.

    Raises:
        FrameError: a frame isn't rigid by itself, as in natural coordinates.

    >>> from symbody import Body, System, Vector, ground, functions_of_time, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    >>> newton_euler(pendulum).residuals, newton_euler(pendulum).mass_matrix
    ((l*m*(l*theta'' + g*sin(theta)),), Matrix([[m*l**2]]))
    """
    check_independent(system)
    with derivation(fresh=True, order=order_of(system)):
        check_rigid(checked_tree(system, "newton_euler"), "newton_euler")
    return Equations(system, _derive, _assemble)


def _derive(system: System) -> tuple[Expr, ...]:
    order = order_of(system)
    with derivation(fresh=True, order=order), shortest_derivation(system, residuals) as needed:
        found = truncated(with_multipliers(needed, system), MOTION)
    return in_shared_sums(without_idle_symbols(found), system)


def _assemble(system: System) -> Assembly:
    order = order_of(system)
    with derivation(fresh=True, order=order), shortest_derivation(system, mass_matrix_and_bias) as entries:
        found = Assembly.of_entries(entries, len(system.speeds))
        M = with_added_mass(found.mass_matrix, system)
        assembly = Assembly(M, found.bias).of_first_order(system)
    return assembly.without_idle_symbols()


def order_of(system: System) -> int:
    """Return the order to which small variables are kept in the recursion: the first, if axes of motions are given.

    Where rates are written by speeds, the partial twists are derivatives by speeds, which may be small.
    """
    return ENERGY if system.has_quasi_velocities else MOTION
