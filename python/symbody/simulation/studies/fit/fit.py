"""Fits: least squares of parameters and initial values to measured motions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from symbody.dynamics import Equations
from symbody.errors import ArgumentError, ParameterError, notify
from symbody.simulation.given.real import is_real
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import described, with_known_names
from symbody.symbolic.given.similar_name import did_you_mean
from symbody.symbolic.given.wording import joined_by_and

from .experiment import Experiment, one_or_several
from .fitted import Fit
from .identifiability import Information, information
from .residuals import Residuals
from .unknown import Unknown, unknowns_of

__all__ = ["fit"]

Loss: TypeAlias = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]
"""How residuals count: as squares, or less where they are large."""


@with_known_names
def fit(
    eqs: Equations,
    experiments: Experiment | Sequence[Experiment],
    parameters: Mapping[Expr, float] | None = None,
    initial: Mapping[Expr, float] | None = None,
    *,
    unknown: Mapping[Expr, float | tuple[float, float, float]],
    inputs: Mapping[Expr, ExprLike] | None = None,
    method: str = "auto",
    rtol: float = 1e-8,
    atol: float = 1e-10,
    constraints: str | tuple[float, float] = "projection",
    guess: Mapping[Expr, float] | None = None,
    max_step: float = inf,
    loss: Loss = "linear",
    confidence: float = 0.95,
) -> Fit:
    """Return the parameters and initial values for which motions come closest to measured ones.

    SciPy's `least_squares`, a trust-region method, minimises the sum of ``((y(t, p) - y_measured) / deviation)^2`` with
    the exact derivatives of the motions by p. The covariance of the estimates is ``(J^T J)^-1``, times the variance of
    the residuals if the deviations of the measurements are unknown.

    Args:
        eqs: the equations of motion.
        experiments: the motions that were measured.
        parameters: the values of known parameters.
        initial: known initial values of all experiments.
        unknown: what is estimated, with the start of the search, or (start, low, high): parameters, and coordinates,
            speeds and states for their initial values. `Experiment` has those of one experiment.
        inputs: expressions for the input functions of time, for all experiments.
        method: the method of integration; see `simulate`.
        rtol: the tolerance of the error of a step, relative to the state.
        atol: the absolute tolerance of the error of a step.
        constraints: how constraints are enforced; see `simulate`.
        guess: where to look for initial states that satisfy the constraints.
        max_step: the longest step, in s.
        loss: "linear", or a robust loss of `least_squares` for outliers: "soft_l1", "huber", "cauchy", "arctan".
        confidence: the probability of the confidence intervals.

    Raises:
        ArgumentError: an argument has the wrong kind.
        ParameterError: nothing is unknown, a value is missing, or there are fewer measurements than unknowns.
        SimulationError: there is no motion at the start of the search, or an option is unknown.

    >>> import numpy as np
    >>> import symbody as sb
    >>> x, (m, k) = sb.functions_of_time("x"), sb.symbols("m k")
    >>> cart = sb.Body(sb.translate(x, 0, 0), m)
    >>> spring = sb.Force(sb.ground, -k * x, 0, 0, at=cart.center_of_mass, on=cart)
    >>> oscillator = sb.newton_euler(sb.System([cart], [spring], coordinates=[x]))
    >>> t = np.linspace(0, 3, 31)
    >>> released = sb.Experiment([sb.Measurement(x, t, 0.1 * np.cos(2 * t))])
    >>> found = sb.fit(oscillator, released, {m: 1}, unknown={k: 3.0, x: 0.2})
    >>> round(found[k], 6), round(found[x], 6)
    (4.0, 0.1)
    """
    listed = _experiments(experiments)
    unknowns = unknowns_of(unknown, listed)
    _check(loss, confidence, unknowns, parameters, initial)
    options: dict[str, Any] = {"method": method, "rtol": rtol, "atol": atol, "constraints": constraints}
    options |= {"guess": guess, "max_step": max_step, "inputs": dict(inputs or {})}
    residuals = Residuals(eqs, listed, unknowns, dict(parameters or {}), dict(initial or {}), options)
    _check_names(residuals)
    _check_count(residuals)
    found = _search(residuals, loss)
    known = information(np.asarray(found.jac))
    _warn(unknowns, known, residuals, found)
    return Fit(
        residuals,
        np.asarray(found.x),
        known,
        float(found.cost),
        np.asarray(found.fun),
        confidence,
        int(found.nfev),
    )


def _search(residuals: Residuals, loss: Loss) -> Any:
    """Return the result of SciPy's search for the least sum of squares."""
    from scipy import optimize  # noqa: PLC0415 - slow to load

    unknowns = residuals.unknowns
    return optimize.least_squares(
        residuals.values,
        np.array([each.start for each in unknowns]),
        residuals.jacobian,
        bounds=([each.low for each in unknowns], [each.high for each in unknowns]),
        x_scale="jac",
        loss=loss,
        xtol=1e-12,
        ftol=1e-12,
        gtol=1e-12,
    )


def _experiments(given: object) -> list[Experiment]:
    listed = one_or_several(given, Experiment)
    if not listed:
        raise ArgumentError(
            f"fit: experiments={described(given)}; expected an Experiment([Measurement(x, t, values)]), or several"
        )
    has_deviation = {each.deviation is not None for one in listed for each in one.measurements}
    if len(has_deviation) > 1:
        raise ParameterError(
            "fit: some measurements have a deviation and others have none; give it for all of them, or for none"
        )
    return listed


def _check(
    loss: object,
    confidence: object,
    unknowns: Sequence[Unknown],
    parameters: Mapping[Expr, float] | None,
    initial: Mapping[Expr, float] | None,
) -> None:
    """Check the options of a fit, and that nothing is unknown and given.

    Args:
        loss: the loss.
        confidence: the probability of the confidence intervals.
        unknowns: the unknowns.
        parameters: the values of known parameters.
        initial: the known initial values.

    Raises:
        ArgumentError: an option is not known, or values are no dictionary.
        ParameterError: a variable is unknown and given.
    """
    if loss not in get_args(Loss):
        raise ArgumentError(f"fit: loss={loss!r}; expected one of {', '.join(get_args(Loss))}")
    if not is_real(confidence) or not 0 < float(str(confidence)) < 1:
        raise ArgumentError(
            f"fit: confidence={described(confidence)}; expected a number between 0 and 1, such as 0.95"
        )
    for kind, given in (("parameters", parameters), ("initial", initial)):
        if given is not None and not isinstance(given, Mapping):
            raise ArgumentError(
                f"fit, {kind}: {described(given)}; expected a dictionary of variables and their values"
            )
        both = next(
            (each.name for each in unknowns if each.experiment is None and each.name in (given or {})), None
        )
        if both is not None:
            raise ParameterError(f"fit: {both} is unknown and given in {kind}; leave it out of one of them")


def _check_count(residuals: Residuals) -> None:
    """Check that there are as many measured values as unknowns at least."""
    values, unknowns = residuals.places[-1], len(residuals.unknowns)
    if values < unknowns:
        raise ParameterError(
            f"fit: {values} measured values for {unknowns} unknowns; expected as many at least"
        )


def _check_names(residuals: Residuals) -> None:
    """Check that each unknown occurs in some experiment."""
    count = len(residuals.experiments)
    for unknown in residuals.unknowns:
        if not any(residuals.concerns(unknown, number) for number in range(count)):
            names = [*map(str, residuals.eqs.parameters), *map(str, residuals.eqs.system.state_names)]
            meant = did_you_mean([str(unknown.name)], names)
            raise ParameterError(
                f"fit: {unknown.name} is unknown, but neither in the model nor in what was measured"
                f"{f'; {meant}' if meant else f'; expected some of {joined_by_and(names, most=12)}'}"
            )


def _warn(unknowns: Sequence[Unknown], known: Information, residuals: Residuals, found: Any) -> None:
    """Warn of what the measurements don't determine, of bounds, of differences, and of a search without end."""
    for group in known.groups:
        names = [str(unknowns[k]) for k in group]
        what = (
            f"don't depend on {names[0]}"
            if len(names) == 1
            else f"determine a combination of {joined_by_and(names, most=12)} only, not each of them"
        )
        notify(
            f"fit: the measurements {what}: their deviations are infinite; give a value to one of them, or measure "
            "something else"
        )
    at_bound = [str(each) for each, where in zip(unknowns, found.active_mask, strict=True) if where]
    if at_bound:
        verb = "is" if len(at_bound) == 1 else "are"
        notify(
            f"fit: {joined_by_and(at_bound, most=12)} {verb} at a bound; the covariance does not know of bounds"
        )
    if residuals.by_differences:
        notify(
            "fit: the motions have no exact sensitivities, as their rates jump or their method has none; derivatives "
            "are difference quotients, with fewer digits"
        )
    if found.status <= 0:
        notify(f"fit: the search ended after {found.nfev} steps without having converged; start it closer")
