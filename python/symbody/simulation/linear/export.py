"""State spaces for other programs: SciPy, python-control and MATLAB."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ModelError, ParameterError

if TYPE_CHECKING:
    from scipy.signal import StateSpace as SciPyStateSpace

__all__ = ["Exported", "control_system", "matlab_text", "scipy_system"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Exported:
    """One state space as other programs take it: with outputs, and with names as texts.

    Attributes:
        matrices: A, B, C and D.
        states: the names of the states.
        inputs: the names of the inputs.
        outputs: the names of the outputs; without outputs, those of the states, which are the outputs then.
        title: the name of the system.
    """

    matrices: tuple[Array, Array, Array, Array]
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    title: str

    @classmethod
    def of(
        cls,
        matrices: tuple[Array, Array, Array, Array],
        names: Sequence[Sequence[object]],
        title: str,
        where: str,
    ) -> Exported:
        """Return a state space with outputs.

        Args:
            matrices: A, B, C and D.
            names: those of states, inputs and outputs.
            title: the name of the system.
            where: the function that the user called, for messages.

        Raises:
            ParameterError: the matrices are those of several parameter sets.
            ModelError: there are no inputs.
        """
        A, B, C, D = matrices
        states, inputs, outputs = (tuple(map(str, each)) for each in names)
        if A.ndim > 2:
            raise ParameterError(
                f"{where}: the matrices are those of {int(np.prod(A.shape[:-2]))} parameter sets; expected one number "
                "for each parameter in state_space(linear, parameters)"
            )
        if not inputs:
            raise ModelError(
                f"{where}: the linear model has no inputs; expected some: give the system functions of time as inputs, "
                "or pass parameters as linearize(equations, inputs=[...])"
            )
        if not outputs:
            C, D, outputs = np.eye(len(states)), np.zeros((len(states), len(inputs))), states
        return cls((A, B, C, D), states, inputs, outputs, title)


def scipy_system(space: Exported) -> SciPyStateSpace:
    """Return SciPy's state space, which has no names."""
    from scipy.signal import StateSpace  # noqa: PLC0415 - slow to load, and needed here alone

    return StateSpace(*space.matrices)


def control_system(space: Exported) -> Any:
    """Return the state space of python-control, with the names of states, inputs and outputs.

    Raises:
        ModelError: python-control is not installed.
    """
    try:
        control = import_module("control")
    except ImportError:
        raise ModelError(
            "StateSpace.to_control: python-control is not installed; install it with pip install control, or use "
            "to_scipy() or to_matlab()"
        ) from None
    title = {"name": space.title} if space.title else {}
    return control.ss(
        *space.matrices,
        states=list(space.states),
        inputs=list(space.inputs),
        outputs=list(space.outputs),
        **title,
    )


def matlab_text(space: Exported) -> str:
    """Return MATLAB's commands that make the state space, with all digits."""
    names = ", ".join(
        f"'{kind}', {{{', '.join(map(_quoted, listed))}}}"
        for kind, listed in (
            ("StateName", space.states),
            ("InputName", space.inputs),
            ("OutputName", space.outputs),
        )
    )
    lines = [f"% {space.title or 'Linear model'}: x' = A x + B r, y = C x + D r"]
    lines += [f"{name} = {_rows(matrix)};" for name, matrix in zip("ABCD", space.matrices, strict=True)]
    return "\n".join([*lines, f"sys = ss(A, B, C, D, {names});", ""])


def _rows(matrix: Array) -> str:
    return "[" + "; ".join(" ".join(repr(float(entry)) for entry in row) for row in matrix) + "]"


def _quoted(name: str) -> str:
    doubled = name.replace("'", "''")
    return f"'{doubled}'"
