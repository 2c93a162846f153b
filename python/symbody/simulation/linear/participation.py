"""The kinetic energies of bodies in a mode: the quadratic forms that bodies contribute to the mass matrix."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import lambdify
from symbody.dynamics import Linear
from symbody.errors import ModelError
from symbody.multibody import Body, System, kinetic_energy
from symbody.simulation.given.values import parameter_values
from symbody.symbolic import Expr, Matrix, derivation, free_symbols, gradient, jacobian, substitute, t

__all__ = ["bodies_of", "mass_matrices"]

Array = NDArray[np.float64]


def bodies_of(linear: Linear, what: str) -> tuple[Body, ...]:
    """Return the bodies of a linear model.

    Args:
        linear: the linear model.
        what: what needs them, for messages.

    Raises:
        ModelError: its equations were given without bodies.
    """
    if isinstance(linear.system, System):
        return linear.system.bodies
    raise ModelError(
        f"{what}: the equations of this linear model were given without bodies; expected those of a System with bodies"
    )


def mass_matrices(linear: Linear, parameters: Mapping[Expr, ArrayLike], where: str) -> Array:
    """Return the second derivatives of the kinetic energy of each body by the speeds: (bodies, n, n).

    ``u^T M_b u / 2`` is the energy of the deviations u of the speeds; the sum of all M_b is the mass matrix.

    Args:
        linear: the linear model.
        parameters: the values of the parameters.
        where: the function that the user called, for messages.

    Raises:
        ModelError: there are no bodies.
        ParameterError: a value is missing.
    """
    bodies = bodies_of(linear, where)
    found = _mass_matrices(linear)
    names = tuple(sorted(free_symbols([entry for matrix in found for entry in matrix.entries]), key=str))
    values = parameter_values(names, parameters, where=where, beside=linear.variables)
    n = len(linear.system.speeds)
    rows = lambdify([*names], [*found])(*values) if found else []
    return np.array([np.broadcast_to(row, (n, n)) for row in rows]).reshape(len(bodies), n, n)


@lru_cache(maxsize=16)
def _mass_matrices(linear: Linear) -> tuple[Matrix, ...]:
    system = linear.system
    assert isinstance(system, System)
    speeds = [*system.speeds]
    found = []
    with derivation():
        for body in system.bodies:
            (energy,) = system.by_speeds([kinetic_energy(body)])
            hessian = jacobian(gradient(energy, speeds), speeds)
            found.append(
                Matrix.from_entries(
                    len(speeds), len(speeds), substitute(substitute([*hessian.entries], linear.about), {t: 0})
                )
            )
    return tuple(found)
