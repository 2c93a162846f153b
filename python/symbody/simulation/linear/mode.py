"""Modes: one natural motion of a linear model."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import inf, log, nan, pi
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Linear
from symbody.errors import ArgumentError, ModelError
from symbody.multibody import Body
from symbody.simulation.motion.drawing import NotebookPage, drawing_function
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import described, with_known_names

from .eigenvalue_slope import eigenvalue_slope
from .matrices import Recovery, recovery
from .participation import bodies_of, mass_matrices
from .swing import Swing, visible_amplitude

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Mode"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_SWINGS = 4
"""The swings of an animation."""
_INSTANTS = 50
"""The instants of a swing."""


@dataclass(frozen=True, eq=False)
class Mode:
    """A natural motion ``x(t) = Re(a phi exp(s t))``; a pair of complex eigenvalues is one mode.

    The shape is scaled so that the largest deviation of an independent coordinate is 1; in a mode that moves no
    coordinate, that of a speed, or else of a state. Lengths in m and angles in rad count alike.

    Attributes:
        linear: the linear model.
        parameters: the values of the parameters.
        eigenvalue: s, in 1/s; of a pair, that with the positive imaginary part.
        multiplicity: how often s occurs.
        is_defective: whether s has fewer shapes than its multiplicity; then ``t exp(s t)`` occurs, too.
        state: phi, by the order of `linear.states`.
        shares: the participation of each state, in the same order.
        name: a name by the user.

    >>> from symbody import equations_of, functions_of_time, linearize, modes, time_derivative, Matrix
    >>> x = functions_of_time("x")
    >>> linear = linearize(equations_of(Matrix([[1]]), [-4 * x - 0.4 * time_derivative(x)], [x]))
    >>> mode = modes(linear)[0]
    >>> round(mode.damping_ratio, 6), round(mode.time_to_half, 6), round(mode.participation[x], 6)
    (0.1, 3.465736, 0.5)
    """

    linear: Linear = field(repr=False)
    parameters: Mapping[Expr, ArrayLike] = field(repr=False)
    eigenvalue: complex
    multiplicity: int
    is_defective: bool
    state: Complex = field(repr=False)
    shares: Array = field(repr=False)
    name: str = ""

    @property
    def natural_frequency(self) -> float:
        """|s|, in rad/s."""
        return abs(self.eigenvalue)

    @property
    def damped_frequency(self) -> float:
        """The imaginary part of s, in rad/s; zero if the mode doesn't oscillate."""
        return abs(self.eigenvalue.imag)

    @property
    def natural_hertz(self) -> float:
        """|s| / (2 pi), in Hz."""
        return self.natural_frequency / (2 * pi)

    @property
    def damped_hertz(self) -> float:
        """The imaginary part of s over 2 pi, in Hz."""
        return self.damped_frequency / (2 * pi)

    @property
    def period(self) -> float:
        """The time of one oscillation, in s; infinite if the mode doesn't oscillate."""
        return 2 * pi / self.damped_frequency if self.damped_frequency else inf

    @property
    def damping_ratio(self) -> float:
        """``-Re(s) / |s|``: 1 for a mode that decays without oscillation, negative if it grows; NaN for s = 0."""
        return -self.eigenvalue.real / abs(self.eigenvalue) + 0.0 if self.eigenvalue else nan

    @property
    def time_to_half(self) -> float:
        """The time in which the amplitude halves, ``ln 2 / -Re(s)``, in s; infinite if it doesn't decay."""
        return log(2) / -self.eigenvalue.real if self.eigenvalue.real < 0 else inf

    @property
    def time_to_double(self) -> float:
        """The time in which the amplitude doubles, ``ln 2 / Re(s)``, in s; infinite if it doesn't grow."""
        return log(2) / self.eigenvalue.real if self.eigenvalue.real > 0 else inf

    @property
    def is_marginal(self) -> bool:
        """Whether it neither decays nor grows: the real part of s is zero, to rounding."""
        return self.eigenvalue.real == 0

    @cached_property
    def shape(self) -> dict[Expr, complex]:
        """The deviations of all coordinates, dependent ones as well."""
        return dict(zip(self.linear.system.coordinates, self._deviations.tolist(), strict=False))

    @cached_property
    def speeds(self) -> dict[Expr, complex]:
        """The deviations of all speeds, dependent ones as well."""
        n = len(self.linear.system.coordinates)
        return dict(zip(self.linear.variables[n:], self._deviations[n:].tolist(), strict=True))

    @property
    def participation(self) -> dict[Expr, float]:
        """The share of each state in the mode, ``|w_k phi_k|`` with the left vector w, with sum 1.

        They don't depend on units [Perez-Arriaga, Verghese & Schweppe 1982]. For a defective eigenvalue, w and phi
        are orthogonal, and the shares are NaN.
        """
        return dict(zip(self.linear.states, self.shares.tolist(), strict=True))

    @with_known_names
    def sensitivity(self, by: Expr, together: Mapping[Expr, float] | None = None) -> complex:
        """Return the derivative of the eigenvalue by a parameter, ``ds/dp = w^H (dA0 - s dE) phi / (w^H E phi)``.

        w is the left vector [Lancaster 1964]. The real part is the change of growth, the imaginary part that of the
        frequency in rad/s. If the parameter moves the steady motion, linearize about symbols, such as
        ``{q: q0}``: their derivatives follow from the conditions of this motion.

        Args:
            by: the parameter p.
            together: the derivatives by p of other parameters that change with it, such as a speed that was chosen.

        Raises:
            ParameterError: a name is not a parameter of the linear model.
            ModelError: the eigenvalue is repeated, or the reference motion does not stay steady when p changes.

        >>> from symbody import equations_of, functions_of_time, linearize, modes, symbols, Matrix
        >>> x, k = functions_of_time("x"), symbols("k")
        >>> linear = linearize(equations_of(Matrix([[1]]), [-k * x], [x]))
        >>> round(modes(linear, {k: 4})[0].sensitivity(by=k).imag, 9)
        0.25
        """
        if self.multiplicity > 1:
            raise ModelError(
                f"Mode.sensitivity: the eigenvalue {self.eigenvalue:.6g} is repeated, and has no derivative; expected "
                "a simple one"
            )
        return eigenvalue_slope(self.linear, self.parameters, self.eigenvalue, by, together)

    @property
    def kinetic_energies(self) -> dict[Body, float]:
        """The share of each body in the kinetic energy of the deviations of the speeds, ``u* M_b u``, with sum 1.

        Raises:
            ModelError: the equations were given without bodies.
            ParameterError: a mass or an inertia that the eigenvalues don't depend on has no value.
        """
        bodies = bodies_of(self.linear, "Mode.kinetic_energies")
        matrices = mass_matrices(self.linear, self.parameters, "Mode.kinetic_energies")
        u = np.array([*self.speeds.values()])
        energies = np.einsum("i,bij,j->b", u.conj(), matrices, u).real
        whole = energies.sum()
        shares = energies / whole if whole > 0 else np.full(len(bodies), nan)
        return dict(zip(bodies, shares.tolist(), strict=True))

    @cached_property
    def _recovery(self) -> Recovery:
        return recovery(self.linear, self.parameters, where="Mode")

    @property
    def _deviations(self) -> Complex:
        return np.asarray(self._recovery.matrix @ self.state)

    @with_known_names
    def motion(self, amplitude: float | None = None) -> Swing:
        """Return the mode as a motion about the reference position, as `plot` and `animate` of the view take it.

        An oscillation is shown without its decay or growth. One that doesn't oscillate is shown for three time
        constants; a marginal one swings slowly. Independent coordinates swing as the shape says, and dependent ones so
        that loops close at each instant.

        Args:
            amplitude: the factor of the shape; by default, bodies turn by up to 20 degrees, or move by 0.15 of the
                size of the mechanism.
        """
        about, shape = self._recovery.about, self._deviations
        if amplitude is None:
            amplitude = visible_amplitude(self.linear, self.parameters, about, shape)
        if (
            isinstance(amplitude, bool)
            or not isinstance(amplitude, Real)
            or not np.isfinite(float(amplitude))
        ):
            raise ArgumentError(f"Mode.motion: amplitude={described(amplitude)}; expected a finite number")
        s = self.eigenvalue
        if s.imag or not s:
            omega = abs(s.imag) or 2 * pi
            instants = np.linspace(0, _SWINGS * 2 * pi / omega, _SWINGS * _INSTANTS + 1)
            phasors = np.exp(1j * omega * instants)
        else:
            instants = np.linspace(0, 3 / abs(s.real), _SWINGS * _INSTANTS + 1)
            phasors = np.exp(s.real * instants - max(3 * np.sign(s.real), 0.0)) + 0j
        deviations = (amplitude * np.outer(shape, phasors)).real
        return Swing(self.linear, self.parameters, instants, about, deviations).closed()

    @with_known_names
    def animate(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        amplitude: float | None = None,
        title: str = "",
        **options: Any,
    ) -> NotebookPage | Path:
        """Return a page on which the mechanism swings in the mode, or write it; see `motion` and `Motion.animate`.

        Args:
            path: the file, whose name ends in .html; without one, a notebook shows the page.
            amplitude: the factor of the shape; by default, it is chosen so that the mode is visible.
            title: the title; by default, the mode with its frequency.
            options: what else to draw, such as shapes, as in `Motion.animate`.
        """
        bodies_of(self.linear, "Mode.animate")
        page: NotebookPage | Path = drawing_function("animate")(
            self.motion(amplitude), path, title=title or self.title, **options
        )
        return page

    @with_known_names
    def plot(
        self, *, least: float = 0.01, title: str = "", path: str | os.PathLike[str] | None = None
    ) -> Figure:
        """Return a compass plot: the phasors of the coordinates, lengths and angles apart.

        Args:
            least: the modulus below which a phasor is left out, relative to the largest one.
            title: the title; by default, the mode with its frequency.
            path: a file to write as well.
        """
        figure: Figure = drawing_function("plot_mode")(self, least=least, title=title, path=path)
        return figure

    @property
    def title(self) -> str:
        """The system, the name, and the eigenvalue in words."""
        system = self.linear.name or "mode"
        name = f"{system}, {self.name}" if self.name else system
        return f"{name}: {self.description}"

    @property
    def description(self) -> str:
        """What it does: its frequency and its damping ratio, or its time to half or double."""
        s = self.eigenvalue
        if s.imag:
            return f"{self.damped_hertz:.4g} Hz, damping ratio {self.damping_ratio:.3g}"
        if s.real:
            time, verb = (self.time_to_half, "halves") if s.real < 0 else (self.time_to_double, "doubles")
            return f"{verb} in {time:.3g} s"
        return "neither grows nor decays"

    def __repr__(self) -> str:
        s = self.eigenvalue
        value = f"{s.real:.6g} ± {s.imag:.6g}i" if s.imag else f"{s.real:.6g}"
        return f"Mode({self.name + ': ' if self.name else ''}{value} 1/s, {self.description})"

    def _repr_html_(self) -> str:
        rows = [
            [str(q), f"{abs(value):.4g}", f"{np.degrees(np.angle(value)):.1f}"]
            for q, value in self.shape.items()
        ]
        return html_table(repr(self), ["coordinate", "modulus", "phase in degrees"], rows)
