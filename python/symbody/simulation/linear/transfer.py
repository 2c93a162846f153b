"""Linear models with numbers, from inputs to outputs: what frequency and time responses have in common."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Linear
from symbody.errors import ModelError, notify
from symbody.symbolic import Expr, time_derivative

from .finite_part import finite_part
from .matrices import Pencil, check_linear, regular_pencil

__all__ = ["Transfer", "transfer"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_ROUNDED = 1e-9


@dataclass(frozen=True, eq=False)
class Transfer:
    """A linear model with numbers, from inputs to outputs.

    Attributes:
        linear: the linear model.
        matrices: E, A0, B0, C0, C1 and D0.
        inputs: the inputs but for those that are rates of others.
    """

    linear: Linear
    matrices: Pencil
    inputs: tuple[Expr, ...]

    @property
    def orders(self) -> list[tuple[int, int]]:
        """For each input of the model, rates included: the place of the input, and the order of the rate."""
        found = []
        for r in self.linear.inputs:
            order, base = 0, {each: k for k, each in enumerate(self.inputs)}
            while r not in base:
                base = {time_derivative(each): k for each, k in base.items()}
                order += 1
            found.append((base[r], order))
        return found

    @property
    def eigenvalues(self) -> Complex:
        """The finite eigenvalues of the modes that are not ignorable, in 1/s."""
        kept = [k for k, x in enumerate(self.linear.states) if x not in self.linear.ignorable]
        E, A0 = (each[np.ix_(kept, kept)] for each in (self.matrices.E, self.matrices.A0))
        part = finite_part(E, A0)
        return np.linalg.eigvals(part.A).astype(np.complex128) if part else np.empty(0, np.complex128)

    def warn_if_unstable(self, where: str, consequence: str) -> None:
        """Warn if a mode grows.

        Args:
            where: the function that the user called.
            consequence: what that means for the result.
        """
        s = self.eigenvalues
        scale = float(np.abs(s).max(initial=0.0))
        growing = s[s.real > _ROUNDED * scale]
        if len(growing):
            worst = growing[np.argmax(growing.real)]
            value = f"{worst.real:.6g}" + (f" ± {abs(worst.imag):.6g}i" if worst.imag else "")
            notify(f"{where}: the system is unstable, with the eigenvalue {value} 1/s: {consequence}")


def transfer(linear: Linear, parameters: Mapping[Expr, ArrayLike] | None, where: str) -> Transfer:
    """Return a linear model with numbers, whose inputs and outputs are there.

    Args:
        linear: the linear model.
        parameters: a number for each parameter.
        where: the function that the user called, for messages.

    Raises:
        ArgumentError: this is no linear model.
        ModelError: it has no inputs or no outputs, or its pencil is singular.
        ParameterError: a value is missing, or is not one number.
    """
    check_linear(linear, where)
    if not linear.inputs:
        raise ModelError(
            f"{where}: the linear model has no inputs; expected functions of time that occur in loads or constraints: "
            "linearize(..., inputs=[F])"
        )
    if not linear.outputs:
        raise ModelError(
            f"{where}: the linear model has no outputs; name them: linearize(..., outputs=[{linear.states[0]}])"
        )
    matrices = regular_pencil(linear, parameters, where)
    inputs = tuple(r for r in linear.inputs if not _is_rate(r, linear.inputs))
    return Transfer(linear, matrices, inputs)


def _is_rate(r: Expr, inputs: tuple[Expr, ...]) -> bool:
    return r.kind == "time_function" and any(
        each != r and each.kind == "time_function" and each.name == r.name and each.order < r.order
        for each in inputs
    )
