"""Mistakes with studies, samples and fits: their whole messages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy import stats

from symbody import (
    Experiment,
    Fit,
    Measurement,
    Study,
    SymbodyError,
    errors,
    fit,
    functions_of_time,
    measures,
    sample,
    sobol_indices,
    statistics,
    study,
    symbols,
)
from tests.errors.given import Mistake, check
from tests.simulation.oscillator import OSCILLATOR, c, k, m, u, x

SALTELLI = sample({k: ("uniform", 1, 4), c: ("uniform", 0, 1)}, 8, method="saltelli")


def studied(**options: Any) -> Study:
    """Return a study of one motion."""
    given: dict[str, Any] = {
        "eqs": OSCILLATOR,
        "parameters": {m: 1.0, k: 4.0, c: 0.1},
        "initial": {x: 0.1},
        "t": (0, 1),
        "measures": {"end": measures.final(x)},
    }
    return study(**given | options)


def fitted(experiments: Any = None, parameters: Any = None, initial: Any = None, **options: Any) -> Fit:
    """Return a fit to three values."""
    released = Experiment([Measurement(x, [0, 1, 2], [0.1, 0, 0])], initial={x: 0.1})
    known = {m: 1.0, c: 0.1} if parameters is None else parameters
    given: dict[str, Any] = {"unknown": {k: 3.0}}
    return fit(OSCILLATOR, experiments or released, known, initial, **given | options)


def measured(**options: Any) -> Measurement:
    """Return a measurement of two values."""
    return Measurement(x, [0, 1], [0, 1], **options)


MISTAKES: list[Mistake] = [
    (
        errors.ArgumentError,
        lambda: sample({"k": [1]}, 4),
        ("sample: the key 'k' is a str; expected a symbol, a function of time, or a tuple of them"),
    ),
    (
        errors.ParameterError,
        lambda: sample({(k, k): [1]}, 4),
        ("sample: k has two distributions; leave one of them out"),
    ),
    (
        errors.ParameterError,
        lambda: sample({k: ("normal", 1, 0)}, 4),
        (
            "sample: the distribution of k is ('normal', 1, 0); expected ('normal', mean, standard deviation)"
            " with a positive deviation"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: sample({k: ("gamma", 1, 1)}, 4),
        (
            "sample: the distribution of k: ('gamma', 1, 1) is a tuple; expected a frozen distribution of "
            "scipy.stats, such as stats.norm(1, 0.1), one of 'uniform', 'normal', 'lognormal' with two "
            "numbers, such as ('normal', 1, 0.1), a list of values, or a dictionary of values and their "
            "probabilities"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: sample({k: 5.0}, 4),
        (
            "sample: the distribution of k: 5.0 is a float; expected a frozen distribution of scipy.stats, "
            "such as stats.norm(1, 0.1), one of 'uniform', 'normal', 'lognormal' with two numbers, such as "
            "('normal', 1, 0.1), a list of values, or a dictionary of values and their probabilities"
        ),
    ),
    (
        errors.ParameterError,
        lambda: sample({k: []}, 4),
        ("sample: the values of k are []; expected at least one finite number"),
    ),
    (
        errors.ParameterError,
        lambda: sample({k: {1.0: -1}}, 4),
        ("sample: the probabilities of k are [-1]; expected numbers from 0, one of them positive"),
    ),
    (
        errors.ParameterError,
        lambda: sample({k: {1.0: 0.5, 2.0: 0.2}}, 4),
        (
            "sample: the probabilities of k are [0.5, 0.2] and sum to 0.7; expected a sum of 1, or whole numbers in "
            "proportion to the probabilities"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: measures.time_above(x, [1, 2]),  # type: ignore[arg-type]
        (
            "measures.time_above, level: [1, 2] is a list; expected an expression or a number (int, float, Fraction, "
            "NumPy scalar)"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: measures.settling_time(x, -0.1),
        "measures.settling_time: band=-0.1 is a float; expected a positive distance",
    ),
    (
        errors.ArgumentError,
        lambda: studied(statistics=[statistics.moments()]),
        (
            "study: statistics=[Moments()] is a list, but there are no outputs over time; give outputs={'x': x}. "
            "Study.summary has the statistics of measures"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied(units={"ent": "m"}),
        (
            "study, units: 'ent'; expected names of measures, outputs, parameters and initial values: end, m, k, c, x, "
            "initial_x; did you mean end?"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied(threads=True),
        "study: threads=True is a bool; expected a whole number from 1",
    ),
    (
        errors.ArgumentError,
        lambda: studied().probability("end", above="0"),  # type: ignore[arg-type]
        "study.probability: above='0' is a str; expected a number, the level of 'end'",
    ),
    (
        errors.ArgumentError,
        lambda: studied().probability("end", above=0, confidence=95),
        ("study.probability: confidence=95 is an int; expected a probability between 0 and 1, such as 0.95"),
    ),
    (
        errors.ParameterError,
        lambda: sample({k: stats.norm(0, -1)}, 4),
        (
            "sample: the distribution of k, norm(0, -1), has quantiles that are not finite numbers; expected "
            "a distribution of one variable with valid parameters"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: sample({(k, c): stats.norm(0, 1)}, 4),
        (
            "sample: the distribution of k and c together is norm(0, 1); expected "
            "scipy.stats.multivariate_normal(mean, covariance)"
        ),
    ),
    (
        errors.ParameterError,
        lambda: sample({(k, c): stats.multivariate_normal([0, 0, 0])}, 4),
        ("sample: the distribution of k and c together has 3 variables; expected 2"),
    ),
    (
        errors.ParameterError,
        lambda: sample({(k, c): stats.multivariate_normal([0, 0])}, 4, method="saltelli"),
        (
            "sample: method='saltelli' with variables that are correlated; expected independent ones, as "
            "Sobol indices divide the variance among them"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: sample({k: [1]}, 4, method="random"),
        ("sample: method='random'; expected one of sobol, latin_hypercube, halton, monte_carlo, saltelli"),
    ),
    (
        errors.ArgumentError,
        lambda: sample({k: [1]}, 0),
        ("sample: n=0 is an int; expected a whole number from 1"),
    ),
    (
        errors.ArgumentError,
        lambda: sample({k: [1]}, 4, seed=-1),
        ("sample: seed=-1 is an int; expected a whole number from 0"),
    ),
    (
        errors.ArgumentError,
        lambda: measures.final(3),
        ("measures.final: 3 is an int; expected an expression of the motion, such as x - h"),
    ),
    (
        errors.ArgumentError,
        lambda: measures.maximum(x == u),
        (
            "measures.maximum: False is a bool; expected an expression of the motion, such as x - h; == "
            "compares two expressions, which gives a bool: write a == b as a - b"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: measures.value_at(x, "1"),
        ("measures.value_at: t='1' is a str; expected an instant, in s"),
    ),
    (
        errors.SimulationError,
        lambda: measures.first_crossing(x, 2),
        ("Event: direction=2; expected 1 (rising through zero), -1 (falling) or 0 (both)"),
    ),
    (
        errors.ArgumentError,
        statistics.quantiles,
        (
            "statistics.quantiles: () is a tuple; expected probabilities between 0 and 1, such as "
            "quantiles(0.05, 0.5, 0.95)"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: statistics.quantiles(1.5),
        (
            "statistics.quantiles: (1.5,) is a tuple; expected probabilities between 0 and 1, such as "
            "quantiles(0.05, 0.5, 0.95)"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: statistics.exceedance("x"),
        ("statistics.exceedance: level='x' is a str; expected a number"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(measures=None),
        ("study: nothing to compute; give measures={'peak': measures.maximum(x)} or outputs={'x': x}"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(measures=[1]),
        (
            "study, measures: [1] is a list; expected a dictionary of names and measures, such as {'peak': "
            "measures.maximum(x)}"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied(measures={"a": x}),
        (
            "study, measures: a: x is an Expr; expected a measure, such as measures.maximum(x) or "
            "measures.final(x); expressions over time are outputs"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied(measures={"a": measures.maximum(x), "a instant": measures.final(x)}),
        ("study, measures: two of them give 'a instant'; rename one of them"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(statistics=["mean"]),
        (
            "study: statistics=['mean'] is a list; expected a list of statistics, such as "
            "[statistics.moments(), statistics.quantiles(0.05, 0.95)]"
        ),
    ),
    (
        errors.SimulationError,
        lambda: studied(measures={"a": measures.value_at(x, 3)}),
        ("study, measures: 'a' is the value at t = 3 s; expected an instant from 0 to 1 s"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(histories=True),
        ("study: histories=True, but there are no outputs; give outputs={'x': x}"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(histories=True, outputs={"x": x}),
        (
            "study: histories=True needs a path, such as path='study.zarr'; simulate_many keeps motions in "
            "memory"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied(measures={"k": measures.final(x)}),
        ("study: the name 'k' of a measure or an output is taken, or contains '/'; rename it"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(
            measures={"x mean": measures.average(x)}, outputs={"x": x}, statistics=[statistics.moments()]
        ),
        ("study: the name 'x mean' of a measure or an output is taken, or contains '/'; rename it"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(
            measures={"end": measures.final(symbols("status") * x)},
            cases={symbols("status"): [1.0, 2.0]},
            path="study.zarr",
        ),
        (
            "study: the file needs the name 'status' for an array of its own, but a parameter has it; rename the "
            "parameter, or leave out path"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied(units={"a": 1}),
        ("study, units: {'a': 1} is a dict; expected names and units, such as {'peak': 'm/s'}"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(chunk=0),
        ("study: chunk=0 is an int; expected a whole number from 1"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(executor=3),
        (
            "study: executor=3 is an int; expected an executor of concurrent.futures, such as "
            "ProcessPoolExecutor(), dask's client.get_executor(), or None for threads of this process"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied(path=3),
        ("study: path=3 is an int; expected a path, such as 'study.zarr'"),
    ),
    (
        errors.SimulationError,
        lambda: studied(measures={"a": measures.final(functions_of_time("w"))}),
        (
            "study: the measure 'a' contains w; expected an expression of time, coordinates, speeds, "
            "accelerations, multipliers and parameters"
        ),
    ),
    (
        errors.ParameterError,
        lambda: studied(parameters={m: 1.0}),
        ("study: no value for c, k; give parameters={c: ..., k: ...}"),
    ),
    (
        errors.ParameterError,
        lambda: studied(initial={functions_of_time("w"): 1}),
        (
            "study, initial: w is not a coordinate, a rate of one or a speed of this system; expected one of "
            "x, x'"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied()["start"],
        ("study['start']: 'start' is a str; expected one of the measures end"),
    ),
    (
        errors.ArgumentError,
        lambda: studied(outputs={"x": x})["x"],
        (
            "study['x']: 'x' is a str; expected one of the measures end; study.over_time('x') has the "
            "statistics of this output"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: studied().over_time("x"),
        ("study.over_time: 'x' is a str; expected one of the outputs (there are none)"),
    ),
    (
        errors.ArgumentError,
        lambda: studied().probability("start", 1),
        ("study.probability: 'start' is a str; expected one of the measures end"),
    ),
    (
        errors.ArgumentError,
        lambda: studied().motion(2),
        ("study.motion: 2 is an int; expected one of the 1 cases, from 0"),
    ),
    (
        errors.ArgumentError,
        lambda: studied().dataset,
        ("study.dataset: the study has no file; give study a path, such as 'study.zarr'"),
    ),
    (
        errors.ArgumentError,
        lambda: studied().plot("end", against=functions_of_time("w")),
        ("study.plot: against=w is an Expr; expected a variable of the cases"),
    ),
    (
        errors.ArgumentError,
        lambda: Measurement(3, [0], [0]),
        ("Measurement: 3 is an int; expected an expression of the motion, such as a coordinate"),
    ),
    (
        errors.ParameterError,
        lambda: Measurement(x, [0, 1], [0]),
        ("Measurement of x: 1 value at 2 instants; expected one for each"),
    ),
    (
        errors.ArgumentError,
        lambda: Measurement(x, [0, 1], "ab"),
        ("Measurement of x, values: 'ab' is a str; expected a row of finite numbers"),
    ),
    (
        errors.ParameterError,
        lambda: measured(deviation=0),
        ("Measurement of x, deviation: 0 is an int; expected a positive number, or one for each value"),
    ),
    (
        errors.ArgumentError,
        lambda: Experiment([x]),
        ("Experiment: measurements=[x] is a list; expected a list of Measurement(expression, t, values)"),
    ),
    (
        errors.ArgumentError,
        lambda: Experiment([measured()], t0="0"),
        ("Experiment: t0='0' is a str; expected an instant, in s"),
    ),
    (
        errors.ParameterError,
        lambda: Experiment([measured()], t0=0.5),
        ("Experiment: a measurement is at t = 0 s, before the start at t0 = 0.5 s; give t0="),
    ),
    (
        errors.ArgumentError,
        lambda: fitted([measured()]),
        (
            "fit: experiments=[Measurement(x, 2 values)] is a list; expected an Experiment([Measurement(x, t,"
            " values)]), or several"
        ),
    ),
    (
        errors.ParameterError,
        lambda: fitted([Experiment([measured()]), Experiment([measured(deviation=1)])]),
        (
            "fit: some measurements have a deviation and others have none; give it for all of them, or for "
            "none"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: fitted(unknown=3),
        (
            "fit, unknown: 3 is an int; expected a dictionary of variables, with a start or (start, low, "
            "high) each"
        ),
    ),
    (
        errors.ParameterError,
        lambda: fitted(unknown={}),
        ("fit: nothing is unknown; give unknown={k: 100.0}"),
    ),
    (
        errors.ArgumentError,
        lambda: fitted(unknown={"k": 1}),
        ("fit, unknown: the key 'k' is a str; expected a symbol or a function of time"),
    ),
    (
        errors.ArgumentError,
        lambda: fitted(unknown={k: "1"}),
        ("fit, unknown, k: '1' is a str; expected a start, or (start, low, high), such as (1.0, 0, inf)"),
    ),
    (
        errors.ParameterError,
        lambda: fitted(unknown={k: (1, 2, 3)}),
        ("fit, unknown, k: (1, 2, 3); expected low <= start <= high"),
    ),
    (
        errors.ParameterError,
        lambda: fitted(unknown={m: 1.0}),
        ("fit: m is unknown and given in parameters; leave it out of one of them"),
    ),
    (
        errors.ParameterError,
        lambda: fitted(unknown={k: 1, x: 0.1}),
        ("fit: x of experiment 0 is unknown and given, or unknown twice; leave one of them out"),
    ),
    (
        errors.ParameterError,
        lambda: fitted(unknown={k: 1, symbols("kk"): 2}),
        ("fit: kk is unknown, but neither in the model nor in what was measured; did you mean k?"),
    ),
    (
        errors.ParameterError,
        lambda: fitted(
            unknown={k: 1, c: 1, u: 0},
            parameters={m: 1.0},
            experiments=Experiment([Measurement(x, [0, 1], [0.1, 0])], initial={x: 0.1}),
        ),
        ("fit: 2 measured values for 3 unknowns; expected as many at least"),
    ),
    (
        errors.ArgumentError,
        lambda: fitted(loss="square"),
        ("fit: loss='square'; expected one of linear, soft_l1, huber, cauchy, arctan"),
    ),
    (
        errors.ArgumentError,
        lambda: fitted(confidence=2),
        ("fit: confidence=2 is an int; expected a number between 0 and 1, such as 0.95"),
    ),
    (
        errors.SimulationError,
        lambda: fitted(parameters={c: 0.1, m: 0}),
        (
            "fit: there is no motion at the start of the search: simulate: at t = 0 s: the mass matrix is "
            "singular: x' moves no mass; give it some, or leave that coordinate out; or the position is "
            "singular, which happens with Euler angles but not with floating_frame(); what was computed is "
            "the error's motion"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: fitted()[m],
        ("fit[m]: expected one of the unknowns k"),
    ),
    (
        errors.ArgumentError,
        lambda: fitted().motion(3),
        ("fit.motion: 3 is an int; expected the number of an experiment, from 0 to 0"),
    ),
    (
        errors.ArgumentError,
        lambda: sobol_indices({}, [1]),
        ("sobol_indices, table: {} is a dict; expected a sample(..., method='saltelli')"),
    ),
    (
        errors.ParameterError,
        lambda: sobol_indices({k: [1, 2, 3]}, [1, 2, 3]),
        (
            "sobol_indices: the table is not made for them; expected sample(..., method='saltelli'), with all"
            " cases in order"
        ),
    ),
    (
        errors.ParameterError,
        lambda: sobol_indices(SALTELLI, [1, 2]),
        ("sobol_indices: values of shape (2,) for 32 cases; expected one for each case"),
    ),
    (
        errors.ParameterError,
        lambda: sobol_indices(SALTELLI, np.full(32, np.nan)),
        (
            "sobol_indices: 32 of 32 cases have no finite value, the first is case 0; every case counts: "
            "choose distributions for which no motion fails, or a result that each motion has"
        ),
    ),
    (
        errors.ParameterError,
        lambda: sobol_indices(SALTELLI, np.ones(32)),
        ("sobol_indices: the result is the same in all cases; its variance is zero"),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES, ids=[row[2][:40] for row in MISTAKES])
def test_messages_of_studies(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)


def test_packages_of_the_extra_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of what is not installed: the store of files, and the digests of many values."""
    monkeypatch.setitem(__import__("sys").modules, "zarr", None)
    with pytest.raises(errors.SimulationError) as caught:
        studied(path="study.zarr")
    assert str(caught.value) == (
        "study: path='study.zarr'; the package zarr is not installed here: pip install \"symbody[study]\""
    )
