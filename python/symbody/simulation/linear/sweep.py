"""Sweeps: the eigenvalues of a linear model for many parameter sets, on all cores or on many machines."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Linear
from symbody.errors import ArgumentError, ParameterError, notify
from symbody.simulation.batch.workers import core_count
from symbody.simulation.given.column import column_of
from symbody.simulation.motion.drawing import drawing_function
from symbody.simulation.terminal.interruption import Interruption
from symbody.simulation.terminal.progress import progress_bar
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import counted, described, with_known_names

from .finite_part import finite_part
from .matrices import check_linear, pencil
from .regular_pencil import rates_matrix

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Sweep", "sweep"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_WHERE = "sweep"
_CASES = 2000
"""The most cases of a part: some MB of matrices."""
_LOOK = 0.1
"""The time between two checks for Ctrl-C, in s."""


@dataclass(frozen=True, eq=False)
class Sweep:
    """The eigenvalues of a linear model for k parameter sets.

    Attributes:
        linear: the linear model.
        parameters: the values of all parameters, an array of shape (k,) for each.
        eigenvalues: in 1/s, the fastest growing first, shape (k, n); those of ignorable coordinates, which are zero,
            are left out. NaN for those at infinity, where E is singular.

    >>> from symbody import functions_of_time, linearize, equations_of, sweep, symbols, Matrix
    >>> x, (m, k) = functions_of_time("x"), symbols("m k")
    >>> linear = linearize(equations_of(Matrix([[m]]), [-k * x], [x]))
    >>> sweep(linear, {m: 1, k: [4, -4]}).growth
    array([0., 2.])
    """

    linear: Linear = field(repr=False)
    parameters: Mapping[Expr, Array]
    eigenvalues: Complex

    def __len__(self) -> int:
        return len(self.eigenvalues)

    @property
    def growth(self) -> Array:
        """The largest real part of each case, in 1/s, shape (k,): negative where all modes decay."""
        return np.asarray(np.fmax.reduce(self.eigenvalues.real, axis=1, initial=np.nan))

    @property
    def damping_ratio(self) -> Array:
        """The least damping ratio of the modes that oscillate, shape (k,); 1 where none does."""
        size = np.abs(self.eigenvalues)
        oscillates = np.abs(self.eigenvalues.imag) > 1e-9 * size
        with np.errstate(invalid="ignore", divide="ignore"):
            ratios = np.where(oscillates, -self.eigenvalues.real / size, 1.0)  # 1 for infinite ones, too
        return np.asarray(np.where(np.isnan(self.growth), np.nan, ratios.min(axis=1)))

    @property
    def varying(self) -> tuple[Expr, ...]:
        """The parameters that are not the same in all cases."""
        return tuple(name for name, values in self.parameters.items() if np.ptp(values) > 0)

    def __repr__(self) -> str:
        return f"Sweep({counted(len(self), 'case')} over {', '.join(map(str, self.varying)) or 'nothing'})"

    def _repr_html_(self) -> str:
        rows = [
            [
                *(f"{self.parameters[name][k]:.6g}" for name in self.varying),
                f"{self.growth[k]:.6g}",
                f"{self.damping_ratio[k]:.4g}",
            ]
            for k in range(len(self))
        ]
        header = [*map(str, self.varying), "largest real part [1/s]", "least damping ratio"]
        return html_table(repr(self), header, rows)

    @with_known_names
    def plot(
        self,
        *,
        units: Mapping[Expr | str, str] | None = None,
        title: str = "",
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """Return the eigenvalues over one parameter, or the growth over a grid of two, with the limit of stability.

        Args:
            units: the units of the parameters.
            title: the title.
            path: a file to write as well.

        Raises:
            ViewError: the cases are neither those of one parameter nor those of a grid of two.
        """
        figure: Figure = drawing_function("plot_sweep")(self, units=units, title=title, path=path)
        return figure


@with_known_names
def sweep(
    linear: Linear,
    parameters: Mapping[Expr, ArrayLike] | None = None,
    *,
    cases: Mapping[Expr, ArrayLike] | None = None,
    executor: Executor | None = None,
    threads: int | None = None,
    progress: bool | None = None,
) -> Sweep:
    """Return the eigenvalues of a linear model for many parameter sets.

    The matrices of all cases come from compiled code, and their eigenvalues from LAPACK, on all cores. After Ctrl-C,
    those that are finished are returned; the others are NaN.

    Args:
        linear: the linear model.
        parameters: a number for each parameter, or a row of numbers with one for each case.
        cases: further parameters by rows, such as a `grid` of all combinations.
        executor: an executor whose workers compute eigenvalues, as in `simulate_many`; by default, threads of this
            process.
        threads: the number of these threads; by default one for each core.
        progress: whether to show a progress bar; by default if messages go to a terminal.

    Raises:
        ParameterError: a value is missing, has an unknown key, is given twice, or rows differ in length.
        ArgumentError: an argument has the wrong kind.
        ModelError: a motion is not steady.

    >>> from symbody import functions_of_time, grid, linearize, equations_of, symbols, time_derivative, Matrix
    >>> x, (m, c, k) = functions_of_time("x"), symbols("m c k")
    >>> linear = linearize(equations_of(Matrix([[m]]), [-k * x - c * time_derivative(x)], [x]))
    >>> found = sweep(linear, {m: 1}, cases=grid({k: [4, 9], c: [-0.2, 0.2]}))
    >>> found.growth.round(6), found.damping_ratio.round(6)
    (array([ 0.1, -0.1,  0.1, -0.1]), array([-0.05    ,  0.05    , -0.033333,  0.033333]))
    """
    check_linear(linear, _WHERE)
    if not isinstance(executor, Executor | None):
        raise ArgumentError(
            f"{_WHERE}: executor={described(executor)}; expected an executor of concurrent.futures, such as "
            "ProcessPoolExecutor(), or None for threads of this process"
        )
    count_of_threads = core_count() if threads is None else threads
    given: object = count_of_threads
    if not isinstance(given, int) or count_of_threads < 1:
        raise ArgumentError(f"{_WHERE}: threads={described(threads)}; expected a whole number from 1")
    columns = _columns(parameters, cases)
    count = len(next(iter(columns.values()))) if columns else 1
    size = max(1, min(_CASES, -(-count // (4 * count_of_threads))))
    parts = [slice(start, min(start + size, count)) for start in range(0, count, size)]
    kept = [k for k, x in enumerate(linear.states) if x not in linear.ignorable]
    found = np.full((count, len(kept)), complex(np.nan, np.nan))
    with Interruption() as interruption, progress_bar(_WHERE, count, is_shown=progress) as show:
        pool = executor or ThreadPoolExecutor(count_of_threads)
        try:
            for part, values in _computed(linear, columns, parts, kept, pool, interruption):
                found[part] = values
                show(int(np.isfinite(found[:, 0].real).sum()) if kept else count)
        finally:
            if executor is None:
                pool.shutdown()
    _warn(
        int(np.isnan(found).all(axis=1).sum()) if kept else 0, count, is_interrupted=interruption.is_asked_for
    )
    return Sweep(linear, columns, found)


def _columns(
    parameters: Mapping[Expr, ArrayLike] | None, cases: Mapping[Expr, ArrayLike] | None
) -> dict[Expr, Array]:
    """Return a row with a value for each case, for each parameter."""
    found: dict[Any, Array] = {}
    both: dict[str, Any] = {"parameters": parameters, "cases": cases}
    for kind, given in both.items():
        if given is None:
            continue
        if not isinstance(given, Mapping):
            raise ArgumentError(
                f"{_WHERE}, {kind}: {described(given)}; expected a dictionary of parameters and their values"
            )
        for name, values in given.items():
            if name in found:
                raise ParameterError(
                    f"{_WHERE}: {name} is given in parameters and in cases; leave it out of one of them"
                )
            found[name] = column_of(name, values, f"{_WHERE}, {kind}")
    lengths = {str(name): len(column) for name, column in found.items() if column.ndim == 1}
    empty = next((name for name, length in lengths.items() if not length), None)
    if empty is not None:
        raise ParameterError(f"{_WHERE}: {empty} has no values; expected one for each case")
    several = [name for name, column in found.items() if column.ndim > 1]
    if several or len({*lengths.values()}) > 1:
        listed = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        listed = listed or f"{several[0]} has values of shape {found[several[0]].shape}"
        raise ParameterError(
            f"{_WHERE}: rows of different lengths ({listed}); expected one value for each case in every row, or a "
            "number for all cases. For all combinations use cases=grid({...})"
        )
    count = next(iter(lengths.values()), 1)
    return {name: np.array(np.broadcast_to(column, count)) for name, column in found.items()}


def _computed(
    linear: Linear,
    columns: Mapping[Expr, Array],
    parts: list[slice],
    kept: list[int],
    pool: Executor,
    interruption: Interruption,
) -> Iterator[tuple[slice, Complex]]:
    """Yield the eigenvalues of parts as they are finished.

    Args:
        linear: the linear model.
        columns: the values of all parameters.
        parts: the cases of each part.
        kept: the places of the states that count.
        pool: the workers.
        interruption: what Ctrl-C asks for.
    """
    waiting: dict[Future[Complex], slice] = {}
    for part in parts:
        matrices = pencil(linear, {name: values[part] for name, values in columns.items()}, where=_WHERE)
        shape = (part.stop - part.start, *matrices.E.shape[-2:])
        E, A0 = (
            np.ascontiguousarray(np.broadcast_to(each, shape)[:, kept][:, :, kept])
            for each in (matrices.E, matrices.A0)
        )
        waiting[pool.submit(_eigenvalues, E, A0)] = part
    while waiting and not interruption.is_asked_for:
        ready, _ = wait(waiting, timeout=_LOOK, return_when=FIRST_COMPLETED)
        for future in ready:
            yield waiting.pop(future), future.result()
    for future in waiting:
        future.cancel()


def _eigenvalues(E: Array, A0: Array) -> Complex:
    """Return eigenvalues by falling real parts, (k, n); NaN for those that are infinite, as E is singular."""
    A = rates_matrix(E, A0)
    if A is None:
        if len(E) > 1:
            return np.concatenate([_eigenvalues(E[[k]], A0[[k]]) for k in range(len(E))])
        part = finite_part(E[0], A0[0])
        A = np.zeros((1, 0, 0)) if part is None else part.A[None]
        infinite = np.full((1, E.shape[1] - A.shape[1]), complex(np.nan, np.nan))
        return np.concatenate([_sorted(A), infinite], axis=1)
    return _sorted(A)


def _sorted(A: Array) -> Complex:
    """Return the eigenvalues of matrices by falling real parts."""
    found = np.linalg.eigvals(A).astype(np.complex128)
    scale = np.abs(found).max(axis=1, initial=1e-300)[:, None]
    keys = (found.imag, np.abs(found.imag), -np.round(found.real / scale, 9))
    return np.take_along_axis(found, np.lexsort(keys, axis=1), axis=1)


def _warn(missing: int, count: int, *, is_interrupted: bool) -> None:
    if missing:
        cause = "were not computed (interrupted)" if is_interrupted else "have no finite eigenvalues"
        notify(f"{_WHERE}: {missing} of {counted(count, 'case')} {cause}; their eigenvalues are NaN")
