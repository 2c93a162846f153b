"""The results of a fit."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError
from symbody.simulation.motion.drawing import drawing_function
from symbody.simulation.motion.motion import Motion
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import brief, counted, described, with_known_names

from .identifiability import Information
from .residuals import Residuals
from .unknown import Unknown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Estimate", "Fit"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """The estimate of one unknown.

    Attributes:
        unknown: the parameter or initial value.
        value: its estimate.
        deviation: its standard deviation; infinite if the measurements don't determine it.
        low: the lower end of its confidence interval.
        high: the upper end.
    """

    unknown: Unknown
    value: float
    deviation: float
    low: float
    high: float


@dataclass(frozen=True, eq=False)
class Fit:
    """Estimates of parameters and initial values, as `fit` returns them.

    ``found[k]`` is the estimate of an unknown that the experiments share.

    Attributes:
        problem: the experiments and unknowns, as a function that has residuals.
        x: the estimates, in the order of the unknowns, shape (n,).
        known: what the measurements say of the unknowns.
        cost: half of the sum of squared residuals.
        residuals: the residuals, relative to the deviations of the measurements if these are given.
        confidence: the probability of the confidence intervals.
        evaluations: the number of points at which motions were computed.

    >>> import symbody as sb
    >>> x, u = sb.functions_of_time("x u")
    >>> free = sb.newton_euler(sb.System([sb.Body(sb.translate(x, 0, 0), 1)], coordinates=[x]))
    >>> thrown = sb.Experiment([sb.Measurement(x, [0, 1, 2], [0.01, 1.99, 4.01], deviation=0.01)])
    >>> found = sb.fit(free, thrown, unknown={x.diff(sb.t): 1.0})
    >>> [round(value, 4) for value in (found[x.diff(sb.t)], found.estimates[0].deviation)]
    [2.002, 0.0045]
    """

    problem: Residuals = field(repr=False)
    x: Array = field(repr=False)
    known: Information = field(repr=False)
    cost: float
    residuals: Array = field(repr=False)
    confidence: float
    evaluations: int

    @property
    def unknowns(self) -> tuple[Unknown, ...]:
        """The unknowns, those that the experiments share first."""
        return tuple(self.problem.unknowns)

    @property
    def freedom(self) -> int:
        """The number of measured values less that of unknowns."""
        return len(self.residuals) - len(self.x)

    @property
    def has_deviations(self) -> bool:
        """Whether the deviations of the measurements are given."""
        return self.problem.experiments[0].measurements[0].deviation is not None

    @property
    def variance(self) -> float:
        """The variance of the residuals, ``2 cost / freedom``: about 1 if the model and given deviations are right."""
        return 2 * self.cost / self.freedom if self.freedom else np.nan

    @cached_property
    def covariance(self) -> Array:
        """The covariance matrix of the estimates, shape (n, n); infinite variances for what is not determined."""
        return self.known.covariance * (1.0 if self.has_deviations else self.variance)

    @property
    def correlation(self) -> Array:
        """The correlations of the estimates, shape (n, n); NaN for what is not determined."""
        deviations = np.sqrt(np.diag(self.covariance))
        with np.errstate(invalid="ignore"):
            found = self.covariance / np.outer(deviations, deviations)
        found[np.isinf(deviations)] = np.nan
        found[:, np.isinf(deviations)] = np.nan
        return np.asarray(found)

    @cached_property
    def estimates(self) -> tuple[Estimate, ...]:
        """The estimates with confidence intervals by Student's distribution [Seber & Wild 1989]."""
        from scipy import stats  # noqa: PLC0415 - slow to load

        tail = 0.5 + self.confidence / 2
        factor = stats.norm.ppf(tail) if self.has_deviations else stats.t.ppf(tail, max(self.freedom, 1))
        deviations = np.sqrt(np.diag(self.covariance))
        return tuple(
            Estimate(unknown, float(x), float(s), float(x - factor * s), float(x + factor * s))
            for unknown, x, s in zip(self.unknowns, self.x, deviations, strict=True)
        )

    def __getitem__(self, name: Expr) -> float:
        """Return the estimate of an unknown that the experiments share, or that one of them has."""
        found = [float(x) for each, x in zip(self.unknowns, self.x, strict=True) if each.name == name]
        if len(found) != 1:
            given: object = name
            shown = brief(name) if isinstance(given, Expr) else described(name)
            hint = "; several experiments have it: see .estimates" if found else ""
            raise ArgumentError(
                f"fit[{shown}]: expected one of the unknowns {', '.join(map(str, self.unknowns))}{hint}"
            )
        return found[0]

    @with_known_names
    def given(self, experiment: int = 0) -> tuple[dict[Expr, float], dict[Expr, float]]:
        """Return the parameters and the initial values of an experiment, with the estimates: for `simulate`."""
        return self.problem.given(self.x, self._number(experiment, "fit.given"))

    @with_known_names
    def motion(self, experiment: int = 0) -> Motion:
        """Return the motion of an experiment with the estimates, at 1001 instants."""
        number = self._number(experiment, "fit.motion")
        instants = self.problem.experiments[number].instants
        return self.problem.motion(self.x, number, t=np.linspace(instants[0], instants[-1], 1001))

    def _number(self, experiment: object, place: str) -> int:
        count = len(self.problem.experiments)
        if isinstance(experiment, bool) or not isinstance(experiment, int) or not 0 <= experiment < count:
            raise ArgumentError(
                f"{place}: {described(experiment)}; expected the number of an experiment, from 0 to {count - 1}"
            )
        return experiment

    @with_known_names
    def plot(
        self, experiment: int = 0, *, title: str = "", path: str | os.PathLike[str] | None = None
    ) -> Figure:
        """Return a figure of what was measured in an experiment, of the fitted motion, and of the residuals.

        Args:
            experiment: the number of the experiment.
            title: the title.
            path: a file to write as well.

        Raises:
            ArgumentError: there is no such experiment.
            PictureError: the file can't be written.
        """
        number = self._number(experiment, "fit.plot")
        motion, rows = self.motion(number), []
        ends = [0, *self.problem.places]
        rest = iter(self.residuals[ends[number] : ends[number + 1]])
        for each in self.problem.experiments[number].measurements:
            residuals = np.array([next(rest) for _ in each.values])
            rows.append((each.expression, each.t, each.values, motion[each.expression], residuals))
        figure: Figure = drawing_function("plot_fit")(
            motion.t, rows, is_relative=self.has_deviations, title=title, path=path
        )
        return figure

    def _rows(self) -> Iterator[list[str]]:
        for each in self.estimates:
            yield [
                str(each.unknown),
                f"{each.value:.8g}",
                f"{each.deviation:.3g}",
                f"{each.low:.6g} to {each.high:.6g}",
            ]

    def __repr__(self) -> str:
        texts = ", ".join(f"{row[0]} = {row[1]} ± {row[2]}" for row in self._rows())
        return f"Fit({texts}; variance of the residuals {self.variance:.4g})"

    def _repr_html_(self) -> str:
        header = ["unknown", "estimate", "standard deviation", f"{100 * self.confidence:g} % confidence"]
        title = (
            f"Fit to {counted(len(self.residuals), 'value')}; variance of the residuals {self.variance:.4g}"
        )
        return html_table(title, header, list(self._rows()))
