"""The kinematics of a system: its coordinates and speeds, and the rates of coordinates that the speeds give."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

from symbody.errors import ModelError
from symbody.geometry.component.triple import Rate
from symbody.geometry.motion.floating import by_speeds, known_rates, rate_by
from symbody.symbolic import Expr, substitute, time_derivative, time_derivatives

from .coordinate import check_function_of_time, check_single

__all__ = ["SystemKinematics"]


class SystemKinematics:
    """The coordinates q and speeds u of a system, with ``q' = Y(q, t) u + b(q, t)``.

    The rates of most coordinates are speeds themselves. Those of others are written by quasi-velocities, as in
    floating frames, or where the user has chosen speeds.
    """

    coordinates: tuple[Expr, ...]
    quasi_velocities: tuple[Expr, ...]
    coordinate_rates: Mapping[Expr, Expr]
    """The coordinates whose rates are not speeds, and these rates by the speeds."""
    eliminated: Mapping[Expr, Expr]
    """The speeds that were eliminated, by the others; empty for most systems."""

    @cached_property
    def driving(self) -> tuple[Expr, ...]:
        """The quasi-velocities, then the coordinates whose rates are speeds: the freedoms of the motion."""
        return self.quasi_velocities + tuple(q for q in self.coordinates if q not in self.coordinate_rates)

    @cached_property
    def speeds(self) -> tuple[Expr, ...]:
        """The speeds, one per equation of motion: the quasi-velocities, then rates of coordinates."""
        n = len(self.quasi_velocities)
        return self.quasi_velocities + tuple(time_derivative(q) for q in self.driving[n:])

    @cached_property
    def accelerations(self) -> tuple[Expr, ...]:
        """The rates of the speeds."""
        return tuple(time_derivative(u) for u in self.speeds)

    @cached_property
    def state_names(self) -> tuple[Expr, ...]:
        """The names by which a state may be given: coordinates, speeds, and rates of coordinates."""
        rates = (time_derivative(q) for q in self.coordinates)
        return tuple(dict.fromkeys((*self.coordinates, *self.speeds, *rates)))

    @property
    def has_quasi_velocities(self) -> bool:
        """Whether some speed is not the rate of a coordinate, or some rate not a speed."""
        return self.driving != self.coordinates

    @property
    def kinematics(self) -> dict[Expr, Expr]:
        """The rates of all coordinates by the speeds."""
        rates = (time_derivative(q) for q in self.coordinates)
        return {rate: self.known_rates.get(rate, rate) for rate in rates}

    @cached_property
    def known_rates(self) -> dict[Expr, Expr]:
        """The rates of coordinates that are not speeds, by the speeds: the nontrivial part of the kinematics."""
        return known_rates(self.coordinate_rates)

    @cached_property
    def rate(self) -> Rate:
        """The time derivative, with these rates put in."""
        if self.eliminated:
            return lambda values: self.by_speeds(time_derivatives(values))
        return rate_by(self.coordinate_rates)

    def by_speeds(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions with the rates of coordinates, of any order, written by the speeds and their rates."""
        written = substitute(tuple(expressions), self.eliminated) if self.eliminated else expressions
        return by_speeds(self.coordinate_rates, written)

    def _check_unknowns(self) -> None:
        if not self.driving:
            raise ModelError(
                "System: no coordinates; give the functions of time that describe the motion, in order"
            )
        for coordinate in self.coordinates:
            check_function_of_time(coordinate, "System: the coordinate")
        for speed in self.quasi_velocities:
            check_function_of_time(speed, "System: the speed")
        check_single(self.coordinates, "the coordinate")
        check_single(self.quasi_velocities, "the speed")
        for speed in self.quasi_velocities:
            if speed in self.coordinates:
                raise ModelError(
                    f"System: {speed} is both a coordinate and a speed; the rates of coordinates are speeds anyway: "
                    "leave it out of one of them"
                )
