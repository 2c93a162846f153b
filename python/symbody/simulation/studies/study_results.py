"""The results of a study."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError
from symbody.simulation.batch.case_ends import CaseEnds, FailedCase
from symbody.simulation.batch.cases import Cases
from symbody.simulation.batch.run_cases import run_cases
from symbody.simulation.batch.runs import Runs
from symbody.simulation.given.extra import loaded
from symbody.simulation.given.options import instants_of
from symbody.simulation.motion.drawing import drawing_function
from symbody.simulation.motion.motion import Motion
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import counted, described, with_known_names
from symbody.symbolic.given.similar_name import did_you_mean

from .accumulation import Accumulation
from .measure_summary import COLUMNS, summary_of
from .plan import PLACE, Plan
from .proportion import Proportion, proportion_above

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Study"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Study:
    """The results of many motions, as `study` returns them: numbers for each case, statistics over time.

    In the shapes below, k is the number of cases, N that of instants. ``study[name]`` is a measure of all cases, of
    shape (k,), NaN for motions that failed.

    Attributes:
        plan: the model, the measures, the outputs and the statistics.
        cases: the parameters and initial values of the cases.
        found: what was computed.
        units: the units of measures, outputs and parameters, by name.

    >>> import symbody as sb
    >>> x = sb.functions_of_time("x")
    >>> free = sb.newton_euler(sb.System([sb.Body(sb.translate(x, 0, 0), 1)], coordinates=[x]))
    >>> given = {"cases": {x.diff(sb.t): [1, 2, 3]}, "measures": {"end": sb.measures.final(x)}, "outputs": {"x": x}}
    >>> found = sb.study(free, t=(0, 2), **given)
    >>> found["end"].round(9), found.over_time("x")["mean"][-1].round(9).item()
    (array([2., 4., 6.]), 4.0)
    >>> found.summary()["end"]["maximum case"]
    2.0
    """

    plan: Plan = field(repr=False)
    cases: Cases = field(repr=False)
    found: Accumulation = field(repr=False)
    units: Mapping[str, str] = field(repr=False, default_factory=dict)

    def __len__(self) -> int:
        """Return the number of cases."""
        return self.cases.count

    @property
    def t(self) -> Array:
        """The instants, shape (N,), in s."""
        return self.plan.task.instants

    @property
    def parameters(self) -> Mapping[Expr, Array]:
        """The parameters, shape (k,) each."""
        return self.cases.parameters

    @property
    def initial(self) -> Mapping[Expr, Array]:
        """The given initial values, shape (k,) each."""
        return self.cases.initial

    @property
    def measures(self) -> dict[str, Array]:
        """The numbers of the measures by name, shape (k,) each."""
        return dict(self.found.values)

    def __getitem__(self, name: str) -> Array:
        """Return a measure of all cases, shape (k,)."""
        return self._values(name, f"study[{name!r}]")

    def _values(self, name: object, place: str) -> Array:
        known = self.found.values
        if not isinstance(name, str) or name not in known:
            meant = did_you_mean([str(name)], list(known))
            is_output = name in self.plan.outputs
            hint = f"; study.over_time({name!r}) has the statistics of this output" if is_output else ""
            raise ArgumentError(
                f"{place}: {described(name)}; expected one of the measures {', '.join(known) or '(there are none)'}"
                f"{hint}{meant and f'; {meant}'}"
            )
        return known[name]

    @with_known_names
    def over_time(self, output: str) -> dict[str, Array]:
        """Return the statistics of an output at all instants, by name: arrays of shape (N,).

        They count the cases without a gap: after an interruption, those before the first one that was not run.

        Raises:
            ArgumentError: there is no such output.
        """
        known = self._over_time
        if output not in known:
            raise ArgumentError(
                f"study.over_time: {described(output)}; expected one of the outputs "
                f"{', '.join(known) or '(there are none)'}"
            )
        return dict(known[output])

    @cached_property
    def _over_time(self) -> dict[str, dict[str, Array]]:
        return self.found.over_time()

    def summary(self) -> dict[str, dict[str, float]]:
        """Return mean, standard deviation, extremes and exact quantiles of each measure over all cases.

        ``unknown`` counts the cases without a value: those that failed, were not run, or have none, such as motions
        that never settle.
        """
        return {name: summary_of(values) for name, values in self.found.values.items()}

    @with_known_names
    def probability(self, measure: str, above: float, *, confidence: float = 0.95) -> Proportion:
        """Return the probability that a measure is above a level, with its confidence interval [Wilson 1927].

        Cases without a value do not count. The interval is that of independent cases: of Sobol or Latin hypercube
        samples, it is on the safe side.

        Args:
            measure: the name of the measure.
            above: the level.
            confidence: the probability that the interval contains the true value.

        Raises:
            ArgumentError: there is no such measure, no case has a value, the level is no number, or the confidence is
                not between 0 and 1.
        """
        return proportion_above(self._values(measure, "study.probability"), measure, above, confidence)

    def covariance(self) -> Array:
        """Return the covariance matrix of all measures, in the order of `measures`, over cases that have them all."""
        rows = np.array([*self.found.values.values()])
        return np.atleast_2d(np.cov(rows[:, np.isfinite(rows).all(axis=0)]))

    @property
    def ends(self) -> CaseEnds:
        """How the cases ended."""
        found = self.found
        return CaseEnds(self.cases, found.status, found.t_reached, lambda case: found.messages.get(case, ""))

    @property
    def completed(self) -> NDArray[np.bool_]:
        """Whether each case reached the last instant or a terminal event, shape (k,)."""
        return self.ends.completed

    @property
    def failures(self) -> list[FailedCase]:
        """The cases that failed, with their parameters."""
        return [self.ends.failure(case) for case in self.ends.failed.tolist()]

    @property
    def not_run(self) -> NDArray[np.intp]:
        """The cases that were not run because the study was interrupted."""
        return self.ends.not_run

    @property
    def notices(self) -> list[str]:
        """What is to be known of the motions, such as that some are stiff: of all cases, also of earlier calls."""
        return self.found.tally.notices(len(self), PLACE)

    @with_known_names
    def motion(self, case: int) -> Motion:
        """Return the motion of one case, computed again: of the worst one, say.

        Args:
            case: the number of the case, from 0.

        Raises:
            ArgumentError: there is no such case, or it has no motion.
        """
        if not hasattr(case, "__index__") or not 0 <= case < len(self):
            raise ArgumentError(
                f"study.motion: {described(case)}; expected one of the {len(self)} cases, from 0"
            )
        instants, measured = self.t, {at for each in self.plan.measures.values() for at in each.instants}
        if {*instants[1:-1].tolist()} <= measured:  # nobody has asked for the motion in between
            instants = np.union1d(instants, instants_of((float(self.t[0]), float(self.t[-1]))))
        own = self.plan.task.events[: self.plan.own_events]
        task = replace(self.plan.task, instants=instants, events=own)
        one = self.cases.subset(np.array([case]))
        return Runs(task, one, run_cases(task, one)).motion(0)

    @property
    def dataset(self) -> Any:
        """The file of the study as an ``xarray.Dataset``, which is read when it is used.

        Raises:
            ArgumentError: the study has no file.
            SimulationError: xarray is not installed.
        """
        if self.found.file is None:
            raise ArgumentError(
                "study.dataset: the study has no file; give study a path, such as 'study.zarr'"
            )
        return loaded("xarray", "study.dataset").open_zarr(self.found.file.path, consolidated=False)

    @with_known_names
    def plot(
        self,
        name: str,
        *,
        against: Expr | None = None,
        title: str = "",
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """Return a figure: of an output, its statistics over time; of a measure, its distribution.

        Args:
            name: the output or the measure.
            against: a parameter or an initial value, over which the measure of each case is shown instead.
            title: the title.
            path: a file to write as well.

        Raises:
            ArgumentError: there is no such output, measure or parameter.
            PictureError: the file can't be written.
        """
        own = self.cases.parameters if against in self.cases.parameters else self.cases.initial
        if against is not None and against not in own:
            raise ArgumentError(f"study.plot: against={described(against)}; expected a variable of the cases")
        bands = None if against is not None else self._over_time.get(name)
        values = None if bands else self._values(name, "study.plot")
        column = None if against is None else (str(against), own[against])
        figure: Figure = drawing_function("plot_study")(
            self.t, name, bands=bands, values=values, column=column, units=self.units, title=title, path=path
        )
        return figure

    def __repr__(self) -> str:
        parts = [counted(len(self), "case"), counted(len(self.found.values), "number")]
        failed, missing = len(self.ends.failed), len(self.not_run)
        parts[1] += " each"
        parts += [f"{len(self.plan.outputs)} over time"] if self.plan.outputs else []
        parts += [f"{failed} failed"] if failed else []
        parts += [f"{missing} not run"] if missing else []
        return f"Study({', '.join(parts)})"

    def _repr_html_(self) -> str:
        rows = [
            [name, self.units.get(name, ""), *(f"{values[column]:.6g}" for column in COLUMNS)]
            for name, values in self.summary().items()
        ]
        return html_table(repr(self), ["measure", "unit", *COLUMNS], rows)
