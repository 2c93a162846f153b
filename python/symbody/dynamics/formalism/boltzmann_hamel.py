"""Lagrange's equations in any speeds [Hamel 1904; Greenwood 2003, sec. 4.2; Papastavridis 2002, ch. 3].

A frame that moves by velocities in its own axes, ``eta = (w, v)`` in its parent, has virtual displacements
``pi = (theta, s)`` in the same axes. Variation and rate don't commute; the difference holds the structure constants of
rigid motion, which are Hamel's coefficients of the twist:

    delta w = theta' + w x theta        delta v = s' + w x s + v x theta

With the kinetic energy T(q, q', eta, t), its momenta ``p = dT/dv`` and ``h = dT/dw``, and the potential V(q), the
principle of d'Alembert, ``delta T - delta V + delta A = 0`` between fixed ends, has the factors

    of s:       p' + w x p
    of theta:   h' + w x h + v x p
    of delta q: d/dt dT/dq' - dT/dq + dV/dq

The equation of a speed u_k is their sum, each times the virtual displacement per unit of u_k: ``dv/du_k``, ``dw/du_k``
and ``dq'/du_k``. In T, all six velocities of each frame are free. Speeds that are linked, as in rolling without
multipliers, enter afterwards, as they must: T in these speeds alone lacks momenta that Hamel's coefficients multiply.
So do rates that are written by speeds of the user's choice, ``q' = Y u + b``: ``dq'/du`` is Y (Maggi's equations).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, final

from symbody.dynamics.tree.given_twist import with_twists
from symbody.geometry import Frame
from symbody.geometry.component.twist import Twist
from symbody.multibody import System
from symbody.multibody.energy import kinetic_energy_at
from symbody.symbolic import (
    Expr,
    add3,
    cross3,
    dot3,
    gradient,
    number,
    substitute,
    symbol,
    time_derivative,
)

from .virtual_power import Held, along_speeds, power_of_loads, power_of_weight
from .weight_potential import potential


def moves_by_twists(system: System) -> bool:
    """Return whether a frame of a body moves by velocities that are not rates of its pose's coordinates."""
    return any(body.frame.moves_by_twist for body in system.bodies)


def residuals_in_quasi_velocities(system: System) -> tuple[Expr, ...]:
    """Return the residuals, one per speed, without the forces of constraints."""
    held = Held()
    factors = _factors(system)
    kinematics = system.kinematics
    power = -power_of_loads(system, held)
    if system.root.carrier is not None:
        power -= power_of_weight(system, held)
    for coordinate, factor in zip(system.coordinates, factors.of_coordinates, strict=True):
        power += held.stand_in(factor) * kinematics[time_derivative(coordinate)]
    for (w, v), (angular, linear) in zip(factors.twists, factors.of_twists, strict=True):
        power += dot3(held.stand_ins(angular), w) + dot3(held.stand_ins(linear), v)
    return held.released(along_speeds(power, system))


class Slopes(NamedTuple):
    """The derivatives of T - V, in which all rates and all six velocities of each moving frame are free.

    On a moving master frame, whose height is unknown, V is left out: weight is a load.

    Attributes:
        of_rates: dT/dq', one per coordinate.
        of_coordinates: d(T - V)/dq.
        twists: of the frames that move by velocities, ``(w, v)``, by the speeds.
        of_twists: ``(h, p)``, of each of these.
    """

    of_rates: tuple[Expr, ...]
    of_coordinates: tuple[Expr, ...]
    twists: tuple[Twist, ...]
    of_twists: tuple[Twist, ...]


def slopes_of_lagrangian(system: System) -> Slopes:
    """Return the derivatives of T - V by the speeds."""
    free, held = _FreeTwists(), Held()
    frames = [free.moved(body.frame) for body in system.bodies]
    bodies = zip(system.bodies, frames, strict=True)
    lagrangian = sum((kinetic_energy_at(body, frame) for body, frame in bodies), start=number(0))
    if system.root.carrier is None:
        lagrangian -= potential(system, held)
    rates = [time_derivative(q) for q in system.coordinates]
    slopes = gradient(lagrangian, [*rates, *system.coordinates, *free.velocities])
    slopes = system.by_speeds(substitute(held.released(slopes), free.given))
    n = len(rates)
    twists = [_twist(system.by_speeds((*w, *v))) for w, v in free.twists]
    return Slopes(slopes[:n], slopes[n : 2 * n], tuple(twists), tuple(_twists(slopes[2 * n :])))


class _Factors(NamedTuple):
    """The factors of virtual displacements in d'Alembert's principle.

    Attributes:
        of_coordinates: of the variation of each coordinate.
        twists: of the frames that move by velocities.
        of_twists: of the virtual displacements of each of these frames.
    """

    of_coordinates: tuple[Expr, ...]
    twists: tuple[Twist, ...]
    of_twists: tuple[Twist, ...]


def _factors(system: System) -> _Factors:
    slopes = slopes_of_lagrangian(system)
    n = len(slopes.of_rates)
    momenta = [entry for twist in slopes.of_twists for part in twist for entry in part]
    changes = system.rate([*slopes.of_rates, *momenta])
    of_coordinates = tuple(
        change - slope for change, slope in zip(changes, slopes.of_coordinates, strict=False)
    )
    pairs = zip(slopes.twists, slopes.of_twists, _twists(changes[n:]), strict=True)
    return _Factors(of_coordinates, slopes.twists, tuple(_factor(*each) for each in pairs))


def _factor(twist: Twist, momentum: Twist, change: Twist) -> Twist:
    """Return ``h' + w x h + v x p`` and ``p' + w x p``."""
    turning = gyroscopic(twist, momentum)
    return Twist(add3(change.angular, turning.angular), add3(change.linear, turning.linear))


def gyroscopic(twist: Twist, momentum: Twist) -> Twist:
    """Return ``w x h + v x p`` and ``w x p``: Hamel's coefficients of rigid motion, times velocities and momenta."""
    (w, v), (h, p) = twist, momentum
    return Twist(add3(cross3(w, h), cross3(v, p)), cross3(w, p))


def _twists(values: Sequence[Expr]) -> list[Twist]:
    return [_twist(values[k : k + 6]) for k in range(0, len(values), 6)]


def _twist(values: Sequence[Expr]) -> Twist:
    p, q, r, u, v, w = values
    return Twist((p, q, r), (u, v, w))


@final
class _FreeTwists:
    """Frames in which each given twist is replaced by six free velocities."""

    def __init__(self) -> None:
        self._by_frame: dict[bytes, tuple[Twist, Twist]] = {}
        """By the key of a frame that moves by velocities: its twist, and the free one."""

    @property
    def twists(self) -> tuple[Twist, ...]:
        """The given twists."""
        return tuple(given for given, _ in self._by_frame.values())

    @property
    def velocities(self) -> list[Expr]:
        """The free velocities, twist by twist, angular ones first."""
        return [v for _, free in self._by_frame.values() for v in (*free.angular, *free.linear)]

    @property
    def given(self) -> dict[Expr, Expr]:
        """The values of the free velocities."""
        values = [v for given, _ in self._by_frame.values() for v in (*given.angular, *given.linear)]
        return dict(zip(self.velocities, values, strict=True))

    def moved(self, frame: Frame) -> Frame:
        """Return a frame of the same pose whose twists are free."""
        return with_twists(frame, self._free)

    def _free(self, frame: Frame, given: Twist) -> Twist:
        if frame.key not in self._by_frame:
            names = (f"velocity {6 * len(self._by_frame) + k}" for k in range(6))  # no user can write these
            self._by_frame[frame.key] = given, _twist([symbol(name) for name in names])
        return self._by_frame[frame.key][1]
