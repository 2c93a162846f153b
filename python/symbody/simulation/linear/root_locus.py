"""Root loci: the eigenvalues of a linear model over a parameter, by branches, with critical values."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Linear
from symbody.errors import ArgumentError, ParameterError
from symbody.simulation.given.values import finite_number
from symbody.simulation.motion.drawing import drawing_function
from symbody.simulation.steady_state.branch import Branch
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import described, with_known_names

from .branch_tracking import tracked
from .critical_value import CriticalValue, critical_values
from .modes import Modes, modes
from .parameter_family import Course, ParameterFamily, family_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["RootLocus", "root_locus"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_WHERE = "root_locus"
_NEAR = 0.5
"""The distance from an eigenvalue, relative to its size, up to which a name belongs to it."""


@dataclass(frozen=True, eq=False)
class RootLocus:
    """The eigenvalues of a linear model over a parameter.

    ``locus["weave"]`` are the branches with a name, shape (N, number of them).

    Attributes:
        family: the linear model over the parameter.
        values: the values of the parameter, increasing, shape (N,); where branches are hard to tell apart, there are
            more than those given.
        eigenvalues: the eigenvalues in 1/s, a column per branch, shape (N, n); those of ignorable coordinates, which
            are zero, are left out.
        names: the name of each branch; a pair has one name.

    >>> import numpy
    >>> from symbody import equations_of, functions_of_time, linearize, root_locus, symbols, time_derivative, Matrix
    >>> x, c = functions_of_time("x"), symbols("c")
    >>> linear = linearize(equations_of(Matrix([[1]]), [-4 * x - c * time_derivative(x)], [x]))
    >>> root_locus(linear, over={c: numpy.linspace(-1, 1, 11)})
    RootLocus(linear model, c from -1 to 1)
      c = 0: branch 1, flutter at 2 rad/s, grows below
    """

    family: ParameterFamily = field(repr=False)
    values: Array
    eigenvalues: Complex
    names: tuple[str, ...]

    @property
    def linear(self) -> Linear:
        """The linear model."""
        return self.family.linear

    @property
    def parameter(self) -> Expr:
        """The parameter."""
        return self.family.name

    @cached_property
    def critical(self) -> tuple[CriticalValue, ...]:
        """The values of the parameter at which a mode becomes stable or unstable, to rounding errors.

        They are found by what changes between two of the values: if a mode becomes unstable and stable again within
        one step, it is not seen.
        """
        return critical_values(self.family, self.values, self.eigenvalues)

    @with_known_names
    def critical_value(self, name: str) -> float:
        """Return the critical value of the branches with a name.

        Raises:
            ArgumentError: there is none, or there are several: see `critical`.
        """
        found = [each.value for each in self.critical if self.names[each.branch] == name]
        if len(found) == 1:
            return found[0]
        listed = ", ".join(f"{self._shown(each)} ({self.names[each.branch]})" for each in self.critical)
        count = f"the branches named {name!r} have {len(found)} critical values"
        expected = f"expected a name with one of {listed}" if listed else "no branch has any"
        raise ArgumentError(f"RootLocus.critical_value: {count}; {expected}")

    @with_known_names
    def modes_at(self, value: float) -> Modes:
        """Return the modes at a value of the parameter.

        Raises:
            ParameterError: the value is beyond those of the locus.
        """
        low, high = self.values[[0, -1]]
        if not low <= finite_number(self.parameter, value, "RootLocus.modes_at") <= high:
            raise ParameterError(
                f"RootLocus.modes_at: {self.parameter} = {value:.6g} is beyond the locus, which goes from {low:.6g} to "
                f"{high:.6g}"
            )
        return modes(self.linear, self.family.parameters_at(value))

    def __getitem__(self, name: str) -> Complex:
        """Return the branches with a name, shape (N, number of them).

        Raises:
            ArgumentError: no branch has it.
        """
        places = [k for k, each in enumerate(self.names) if each == name]
        if not places:
            raise ArgumentError(
                f"RootLocus: no branch is named {name!r}; expected one of {', '.join(dict.fromkeys(self.names))}"
            )
        return self.eigenvalues[:, places]

    def __repr__(self) -> str:
        low, high = self.values[[0, -1]]
        lines = [
            f"RootLocus({self.linear.name or 'linear model'}, {self.parameter} from {low:.6g} to {high:.6g})"
        ]
        lines += [
            f"  {self.parameter} = {self._shown(each)}: {self.names[each.branch]}, {each.kind}"
            f"{f' at {each.frequency:.6g} rad/s' if each.frequency else ''}, grows {each.grows}"
            for each in self.critical
        ]
        return "\n".join(lines if self.critical else [*lines, "  no critical values"])

    def _shown(self, critical: CriticalValue) -> str:
        """Return a critical value for a display, with zero for what is an error of rounding beside the range."""
        low, high = self.values[[0, -1]]
        return f"{critical.value if abs(critical.value) > 1e-12 * (high - low) else 0.0:.9g}"

    def _repr_html_(self) -> str:
        rows = [
            [
                self._shown(each),
                self.names[each.branch],
                each.kind,
                f"{each.frequency:.6g}",
                f"{each.grows} it",
            ]
            for each in self.critical
        ]
        header = [f"critical {self.parameter}", "branch", "kind", "frequency [rad/s]", "grows"]
        low, high = self.values[[0, -1]]
        return html_table(f"Root locus, {self.parameter} from {low:.6g} to {high:.6g}", header, rows)

    @with_known_names
    def plot(
        self,
        kind: str = "both",
        *,
        unit: str = "",
        real: tuple[float, float] | None = None,
        imaginary: tuple[float, float] | None = None,
        title: str = "",
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """Return the locus in the complex plane, and its real and imaginary parts over the parameter.

        Critical values are marked.

        Args:
            kind: ``"both"``, ``"plane"`` or ``"over"``.
            unit: the unit of the parameter.
            real: the limits of real parts, such as ``(-20, 5)``; by default, all are shown.
            imaginary: the limits of imaginary parts.
            title: the title.
            path: a file to write as well.
        """
        figure: Figure = drawing_function("plot_root_locus")(
            self, kind, unit=unit, real=real, imaginary=imaginary, title=title, path=path
        )
        return figure


@with_known_names
def root_locus(
    linear: Linear,
    parameters: Mapping[Expr, Course] | None = None,
    *,
    over: Mapping[Expr, ArrayLike],
    along: Branch | None = None,
    names: Mapping[str, tuple[float, complex]] | None = None,
) -> RootLocus:
    """Return the eigenvalues of a linear model over a parameter, by branches.

    Branches are followed by their eigenvectors through crossings; where real branches meet and become a pair, the one
    with the larger eigenvalue gets the positive imaginary part. A pair of critical values that are nearer to each
    other than the steps of the parameter is not seen: take steps narrower than what matters.

    Args:
        linear: the linear model.
        parameters: a number for each other parameter, or a function of the parameter, for those of a steady motion
            that changes with it.
        over: the parameter and its values, such as ``{v: numpy.linspace(1, 10, 500)}``.
        along: a branch of steady motions over the parameter, from `continuation`. The symbols in
            ``linearize(..., about={theta: theta0})`` take its values. It has one motion at each value: a branch that
            folds is cut there by ``continuation(..., limits=...)``.
        names: names of branches, each with a value of the parameter and an eigenvalue near it, such as
            ``{"weave": (5, -0.8 + 4.5j)}``.

    Raises:
        ArgumentError: an argument has the wrong kind, or a name is not near the values and an eigenvalue.
        ParameterError: a value is missing, `over` is not one parameter with several values, the parameter is given
            twice, or `along` has no motion or several at a value.
        ModelError: E is singular at one of them, or a motion is not steady.

    >>> import numpy
    >>> from symbody import linearize, newton_euler, symbols, time_derivative
    >>> from symbody.models import bicycle
    >>> model, v = bicycle(), symbols("v")
    >>> linear = linearize(newton_euler(model.system), about={time_derivative(model["x"]): v})
    >>> names = {"weave": (5, -0.8 + 4.5j), "capsize": (5, -0.3)}
    >>> locus = root_locus(linear, model.parameters, over={v: numpy.linspace(0.5, 10, 50)}, names=names)
    >>> round(locus.critical_value("weave"), 9), round(locus.critical_value("capsize"), 9)
    (4.292382536, 6.024262015)
    """
    family, values = family_of(linear, parameters, over, along, _WHERE)
    found, branches = tracked(family.eigenvectors, values)
    return RootLocus(family, found, branches, _names(found, branches, names))


def _names(
    values: Array, branches: Complex, given: Mapping[str, tuple[float, complex]] | None
) -> tuple[str, ...]:
    """Return a name for each branch: those given, and numbers by pairs at the last value.

    Raises:
        ArgumentError: a name is not given by a value of the parameter and an eigenvalue near one of them.
    """
    if given is not None and not isinstance(given, Mapping):
        raise ArgumentError(
            f"{_WHERE}, names: {described(given)}; expected a dictionary of names, each with a value of the parameter "
            "and an eigenvalue, such as {'weave': (5, -0.8 + 4.5j)}"
        )
    n = branches.shape[1]
    partner = [
        int(np.argmin(np.abs(branches[-1] - s.conjugate()))) if s.imag else k
        for k, s in enumerate(branches[-1])
    ]
    found = [""] * n
    for name, place in (given or {}).items():
        here, k = _named(values, branches, name, place)
        pair = int(np.argmin(np.abs(here - here[k].conjugate()))) if here[k].imag else k
        found[k] = found[pair] = name
    count = 0
    for k in range(n):
        if not found[k]:
            twin = found[partner[k]] if partner[k] < k else ""
            count += not twin
            found[k] = twin or f"branch {count}"
    return tuple(found)


def _named(values: Array, branches: Complex, name: str, place: tuple[float, complex]) -> tuple[Complex, int]:
    """Return the eigenvalues at the value that is nearest to the place of a name, and the branch that it names.

    Raises:
        ArgumentError: the place is not a value of the parameter and an eigenvalue near one of them.
    """
    where = f"{_WHERE}, names, {name}"
    try:
        value, s = float(place[0]), complex(place[1])
    except (TypeError, ValueError, IndexError):
        raise ArgumentError(
            f"{where}: {described(place)}; expected a value of the parameter and an eigenvalue, such as "
            "(5, -0.8 + 4.5j)"
        ) from None
    if not values[0] <= value <= values[-1]:
        raise ArgumentError(
            f"{where}: {value:.6g} is not within the values of the parameter, from {values[0]:.6g} to {values[-1]:.6g}"
        )
    nearest = int(np.argmin(np.abs(values - value)))
    here = branches[nearest]
    k = int(np.argmin(np.abs(here - s)))
    if not abs(here[k] - s) <= _NEAR * max(abs(s), abs(here[k])) + 1e-6 * np.abs(here).max():
        raise ArgumentError(
            f"{where}: {s:.4g} is far from every eigenvalue at {values[nearest]:.6g}; the nearest is {here[k]:.4g}"
        )
    return here, k
