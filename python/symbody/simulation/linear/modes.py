"""The modes of linear models: eigenvalues, frequencies, damping ratios and shapes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Linear
from symbody.errors import ArgumentError, notify
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import counted, described, with_known_names

from .complex_number import complex_number
from .eigenproblem import Cluster, spectrum
from .matrices import regular_pencil
from .mode import Mode

__all__ = ["Modes", "modes"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_WHERE = "modes"
_HEADER = (
    "mode",
    "eigenvalue [1/s]",
    "frequency [Hz]",
    "damping ratio",
    "time to half (double) [s]",
    "largest in",
)


@dataclass(frozen=True, eq=False)
class Modes:
    """The modes of a linear model, the fastest growing first; a pair of complex eigenvalues is one mode.

    Attributes:
        linear: the linear model.
        parameters: the values of the parameters.
        each: the modes; ``modes[k]`` is one of them.
        eigenvalues: all finite eigenvalues, in 1/s, as often as they occur, shape (n,).
        infinite: how many eigenvalues are infinite, because E is singular: conditions without dynamics.

    >>> from symbody import linearize, modes, newton_euler
    >>> from symbody.models import n_pendulum
    >>> model = n_pendulum(2)
    >>> modes(linearize(newton_euler(model.system)), model.parameters)[0]
    Mode(0 ± 2.3972i 1/s, 0.3815 Hz, damping ratio 0)
    """

    linear: Linear
    parameters: Mapping[Expr, ArrayLike]
    each: tuple[Mode, ...]
    eigenvalues: Complex
    infinite: int

    def __len__(self) -> int:
        return len(self.each)

    def __iter__(self) -> Iterator[Mode]:
        return iter(self.each)

    @overload
    def __getitem__(self, place: int) -> Mode: ...
    @overload
    def __getitem__(self, place: slice) -> tuple[Mode, ...]: ...
    def __getitem__(self, place: int | slice) -> Mode | tuple[Mode, ...]:
        """Return a mode by its place.

        Raises:
            ArgumentError: there is no such mode.
        """
        try:
            return self.each[place]
        except (IndexError, TypeError):
            raise ArgumentError(
                f"Modes: [{described(place).partition(' is ')[0]}] is not the place of a mode; expected a number below "
                f"{len(self.each)}, or modes.near(eigenvalue)"
            ) from None

    @with_known_names
    def near(self, eigenvalue: complex) -> Mode:
        """Return the mode whose eigenvalue is nearest to a value, in 1/s.

        Raises:
            ArgumentError: the value is not a finite number, or there are no modes.
        """
        s = complex_number(eigenvalue)
        if s is None:
            raise ArgumentError(
                f"Modes.near: {described(eigenvalue)}; expected an eigenvalue in 1/s, such as -0.8 + 4.5j"
            )
        if not self.each:
            raise ArgumentError("Modes.near: there are no modes: no eigenvalue is finite")
        return min(
            self.each, key=lambda mode: min(abs(mode.eigenvalue - s), abs(mode.eigenvalue - s.conjugate()))
        )

    @property
    def is_stable(self) -> bool:
        """Whether all modes decay. A marginal mode, such as the place of a vehicle, makes this False."""
        return all(mode.eigenvalue.real < 0 for mode in self.each)

    @property
    def frequencies(self) -> Array:
        """The natural frequencies |s| of the modes, in rad/s."""
        return np.array([mode.natural_frequency for mode in self.each])

    @property
    def damping_ratios(self) -> Array:
        """The damping ratios of the modes; NaN for s = 0."""
        return np.array([mode.damping_ratio for mode in self.each])

    @property
    def notes(self) -> tuple[str, ...]:
        """What to know about these modes: marginal, repeated, defective and infinite eigenvalues."""
        found = []
        seen = set()
        for mode in self.each:
            if mode.eigenvalue in seen:
                continue
            seen.add(mode.eigenvalue)
            if mode.multiplicity > 1:
                found.append(
                    _repetition(mode, sum(other.eigenvalue == mode.eigenvalue for other in self.each))
                )
        marginal = [mode for mode in self.each if mode.is_marginal]
        if marginal:
            found.append(_margin(self.linear, marginal))
        if self.infinite:
            found.append(
                f"E is singular: {counted(self.infinite, 'eigenvalue')} at infinity, of what has no mass"
            )
        return tuple(found)

    def __repr__(self) -> str:
        lines = [
            f"Modes({self.linear.name or 'of ' + ', '.join(map(str, self.linear.states))})",
            *(f"  {k}: {_value(mode):>26}  {mode.description}" for k, mode in enumerate(self.each)),
            *(f"  note: {note}" for note in self.notes),
        ]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        rows = [
            [
                mode.name or str(k),
                _value(mode),
                f"{mode.damped_hertz:.4g}",
                f"{mode.damping_ratio:.4g}",
                _halving(mode),
                _largest(mode),
            ]
            for k, mode in enumerate(self.each)
        ]
        title = f"Modes of {self.linear.name}" if self.linear.name else "Modes"
        return html_table(title, _HEADER, rows, "; ".join(self.notes))


@with_known_names
def modes(linear: Linear, parameters: Mapping[Expr, ArrayLike] | None = None) -> Modes:
    """Return the modes of a linear model: ``A0 phi = s E phi``.

    Eigenvalues that are zero up to rounding are zero, and those that coincide up to rounding are reported as repeated
    or, if they have fewer shapes, as defective.

    Args:
        linear: the linear model.
        parameters: a number for each parameter.

    Raises:
        ParameterError: a value is missing, has an unknown key, is not finite, or is not one number.
        ModelError: the values are no steady motion, or the pencil is singular: det(A0 - s E) = 0 for all s.

    >>> from symbody import Body, Force, System, functions_of_time, ground, linearize, newton_euler, symbols, translate
    >>> from symbody import time_derivative
    >>> x, (m, k, c) = functions_of_time("x"), symbols("m k c")
    >>> cart = Body(translate(x, 0, 0), m)
    >>> load = Force(ground, -k * x - c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)
    >>> linear = linearize(newton_euler(System([cart], [load], coordinates=[x])))
    >>> found = modes(linear, {m: 1, k: 100, c: 2})
    >>> found.eigenvalues.round(6)
    array([-1.-9.949874j, -1.+9.949874j])
    >>> round(found[0].damping_ratio, 9), round(found[0].natural_frequency, 9), found[0].shape
    (0.1, 10.0, {x: (1+0j)})
    """
    given = {} if parameters is None else parameters
    matrices = regular_pencil(linear, given, _WHERE, for_rows="root_locus or sweep")
    found = spectrum(matrices.E, matrices.A0)
    each = tuple(
        _mode(linear, given, cluster, k)
        for cluster in found.clusters
        if cluster.value.imag >= 0
        for k in range(cluster.vectors.shape[1])
    )
    values = np.array(
        [each.value for each in found.clusters for _ in range(each.multiplicity)], np.complex128
    )
    result = Modes(linear, dict(given), each, values, found.infinite)
    for mode in each:
        if mode.is_defective and mode.eigenvalue:
            notify(f"{_WHERE}: {_repetition(mode, 1)}")
    return result


def _mode(linear: Linear, parameters: Mapping[Expr, ArrayLike], cluster: Cluster, k: int) -> Mode:
    vector = cluster.vectors[:, k]
    n_s, n_v, _ = linear.counts
    scale = np.abs(vector).max()
    for start, end in ((0, n_s), (n_s, n_s + n_v), (n_s + n_v, len(vector))):
        part = vector[start:end]
        # the first one of the largest: their order shall not depend on rounding
        place = int(np.argmax(np.abs(part) > 0.999999 * np.abs(part).max(initial=0.0))) if len(part) else 0
        if len(part) and abs(part[place]) > 1e-9 * scale:
            vector = vector / part[place]
            break
    return Mode(
        linear,
        dict(parameters),
        cluster.value,
        cluster.multiplicity,
        cluster.is_defective,
        vector,
        cluster.shares[:, k],
    )


def _value(mode: Mode) -> str:
    s = mode.eigenvalue
    return f"{s.real:.6g} ± {s.imag:.6g}i" if s.imag else f"{s.real:.6g}"


def _halving(mode: Mode) -> str:
    if mode.eigenvalue.real > 0:
        return f"({mode.time_to_double:.4g})"
    return f"{mode.time_to_half:.4g}" if mode.eigenvalue.real < 0 else "–"


def _largest(mode: Mode) -> str:
    """Return the states with the largest shares, for a table; of a defective eigenvalue, those that move."""
    shares = mode.shares if np.isfinite(mode.shares).all() else np.abs(mode.state) / np.abs(mode.state).max()
    order = np.argsort(-np.round(shares, 6), kind="stable")[:3]
    return ", ".join(f"{mode.linear.states[k]} {shares[k]:.0%}" for k in order if shares[k] >= 0.05)


def _repetition(mode: Mode, shapes: int) -> str:
    value = _value(mode)
    if mode.is_defective:
        return (
            f"the eigenvalue {value} occurs {mode.multiplicity} times but has {counted(shapes, 'shape')}: it is "
            "defective, motions t exp(s t) occur, and participations are not defined"
        )
    times = f"the eigenvalue {value} occurs {mode.multiplicity} times"
    return f"{times}: combinations of its {shapes} shapes are shapes as well"


def _margin(linear: Linear, marginal: list[Mode]) -> str:
    still = [mode for mode in marginal if mode.eigenvalue == 0]
    listed = ", ".join(dict.fromkeys(_value(mode) for mode in marginal))
    cause = f", of {', '.join(map(str, linear.ignorable))}" if still and linear.ignorable else ""
    return f"marginal: {listed}{cause}; the linear model does not tell whether these motions grow in the nonlinear one"
