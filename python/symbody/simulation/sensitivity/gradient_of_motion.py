"""The gradient of one number that a motion determines, by any number of parameters and initial values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import ArgumentError, ParameterError, SimulationError
from symbody.simulation.given.differentiated import differentiated_by
from symbody.simulation.given.event import Event
from symbody.simulation.integrate.initial_state import initial_slopes, initial_state
from symbody.simulation.integrate.methods import methods_that
from symbody.simulation.integrate.rate_jump import rate_jump
from symbody.simulation.integrate.task import Task
from symbody.simulation.integrate.task_of import task_of
from symbody.simulation.model.model import Model
from symbody.simulation.model.switching import switching_functions
from symbody.simulation.motion.motion import Motion
from symbody.simulation.motion.simulate import simulate
from symbody.symbolic import Expr, ExprLike, jacobian
from symbody.symbolic.given.arguments import brief, described, expression, with_known_names
from symbody.symbolic.given.wording import joined_by_and

from .adjoint import BackwardMotion, adjoint_of

__all__ = ["MotionGradient", "gradient_of_motion"]

Array = NDArray[np.float64]

_WHERE = "gradient_of_motion"


@dataclass(frozen=True, eq=False)
class MotionGradient:
    """A number that a motion determines, and its derivatives.

    Attributes:
        value: the number J.
        derivatives: dJ/dp by parameter, and by the coordinates, speeds and states that stand for their initial values.
        motion: the motion.

    >>> import symbody as sb
    >>> x = sb.functions_of_time("x")
    >>> body = sb.newton_euler(sb.System([sb.Body(sb.translate(x, 0, 0), 1)], coordinates=[x]))
    >>> v = sb.time_derivative(x)
    >>> found = sb.gradient_of_motion(body, {}, {v: 3}, (0, 2), by=[x, v], final=x)
    >>> round(found.value, 9), {name: round(slope, 9) for name, slope in found.derivatives.items()}
    (6.0, {x: 1.0, x': 2.0})
    """

    value: float
    derivatives: dict[Expr, float]
    motion: Motion = field(repr=False)

    def __getitem__(self, by: Expr) -> float:
        """Return one derivative.

        Raises:
            ParameterError: the derivative by this is not among them.
        """
        given: Any = by
        if not isinstance(given, Expr) or given not in self.derivatives:
            found = brief(given) if isinstance(given, Expr) else described(given)
            known = joined_by_and([str(name) for name in self.derivatives], last="or")
            raise ParameterError(
                f"MotionGradient[...]: {found}; expected what was given in {_WHERE}(..., by=[...]), {known}"
            )
        return self.derivatives[by]


@with_known_names
def gradient_of_motion(
    eqs: Equations,
    parameters: Mapping[Expr, float] | None = None,
    initial: Mapping[Expr, float] | None = None,
    t: tuple[float, float] | ArrayLike = (0.0, 10.0),
    *,
    by: Sequence[Expr],
    final: ExprLike = 0,
    integral: ExprLike = 0,
    inputs: Mapping[Expr, ExprLike] | None = None,
    method: str = "auto",
    rtol: float = 1e-8,
    atol: float = 1e-10,
    constraints: str | tuple[float, float] = "projection",
    guess: Mapping[Expr, float] | None = None,
    max_step: float = inf,
) -> MotionGradient:
    """Return ``J = g(end) + integral of L dt`` along a motion, and its derivatives, by the adjoint equations.

    ``lambda' = -f_x^T lambda - L_x`` is integrated backwards in time, once for all parameters [Cao, Li, Petzold &
    Serban 2003]. This is for many parameters and one number J; `simulate(..., sensitivities=[...])` is for few
    parameters, and for everything along the motion.

    Args:
        eqs: the equations of motion.
        parameters: the values of the parameters.
        initial: values of coordinates, rates of coordinates, speeds or states at the first instant.
        t: the first and the last instant (1001 evenly spaced instants), or all instants, in s. They are the checkpoints
            from which the motion is followed back; only the states there are kept.
        by: parameters, and coordinates, speeds and states for their initial values.
        final: g, an expression at the last instant.
        integral: L, an expression that is integrated along the motion.
        inputs: expressions for the input functions of time.
        method: "auto", "dop853" or "tsit5".
        rtol: the relative tolerance of steps, of the motion and of the adjoint equations.
        atol: the absolute tolerance; lambda is measured by the largest derivative of J.
        constraints: how constraints are enforced, as in `simulate`.
        guess: where to look for an initial state that satisfies the constraints.
        max_step: the longest step, in s.

    Raises:
        ArgumentError: neither final nor integral is given, or `by` is no list, or an empty one.
        ParameterError: a name is neither a parameter nor a variable of the state, or a value is missing.
        ConstraintError: no state with the given values satisfies the constraints, or only for these parameters.
        SimulationError: the method is implicit, the rates jump, or the motion cannot continue or be followed back.

    >>> import numpy as np
    >>> import symbody as sb
    >>> x, (m, k) = sb.functions_of_time("x"), sb.symbols("m k")
    >>> cart = sb.Body(sb.translate(x, 0, 0), m)
    >>> spring = sb.Force(sb.ground, -k * x, 0, 0, at=cart.center_of_mass, on=cart)
    >>> oscillator = sb.newton_euler(sb.System([cart], [spring], coordinates=[x]))
    >>> found = sb.gradient_of_motion(oscillator, {m: 1, k: 4}, {x: 0.1}, (0, 1), by=[k, x], final=x)
    >>> bool(abs(found[k] + 0.1 * np.sin(2) / 4) < 1e-9), bool(abs(found[x] - np.cos(2)) < 1e-9)
    (True, True)
    """
    g, L = expression(final, f"{_WHERE}, final"), expression(integral, f"{_WHERE}, integral")
    if g.is_zero and L.is_zero:
        raise ArgumentError(
            f"{_WHERE}: neither final nor integral is given; expected final=..., an expression at the last instant, or "
            "integral=..., one that is integrated along the motion"
        )
    options: dict[str, Any] = {
        "inputs": inputs,
        "method": method,
        "rtol": rtol,
        "atol": atol,
        "outputs": {"final": g, "integral": L},
        "constraints": constraints,
        "guess": guess,
        "max_step": max_step,
    }
    task = task_of(eqs, parameters, t, events=None, where=_WHERE, **options)
    task = replace(task, by=differentiated_by(by, eqs.system, task.parameters, f"{_WHERE}, by"))
    if not task.by:
        raise ArgumentError(
            f"{_WHERE}, by: nothing is given; expected a list of parameters, and of coordinates, speeds and states for "
            "their initial values"
        )
    _check_method(task)
    events = [Event(each) for each in _switching(task, L)]
    motion = simulate(eqs, parameters, initial, task.instants, events=events, progress=False, **options)
    _check_smooth(motion, L)
    given = {name: float(value) for name, value in (parameters or {}).items()}
    return _followed_back(task, given, initial, motion, (g, L))


def _check_method(task: Task) -> None:
    """Check that the method can integrate backwards.

    Raises:
        SimulationError: it is implicit.
    """
    if not task.method.is_explicit:
        able = joined_by_and(methods_that(lambda method: method.is_explicit), last="or")
        raise SimulationError(
            f"{_WHERE}: method={task.options.method!r} is for stiff equations, which can't be followed back; expected "
            f"{able}, or use simulate(..., sensitivities=[...])"
        )


def _switching(task: Task, integrand: Expr) -> tuple[Expr, ...]:
    """Return the functions at whose zeros the rates, or the integrand, may jump."""
    model = task.model
    along = (*model.rates[: len(model.state)], *model.along_motion([integrand]))
    return switching_functions(along, {*model.state, *task.by})


def _check_smooth(motion: Motion, integrand: Expr) -> None:
    """Check that neither the rates nor the integrand jump along a motion.

    Raises:
        SimulationError: one of them does.
    """
    model, n = motion.model, len(motion.model.state)
    if not motion.events:
        return
    (L,) = model.along_motion([integrand])
    code = model.code([*model.rates[:n], L], [p for p in motion.parameters if p not in model.parameters])
    values = np.array([motion.parameters[name] for name in code.parameters])
    for event in motion.events:
        vector = [*(event.state[x] for x in model.state), *([0.0] if model.power is not None else [])]
        if rate_jump(code, values, event.t, np.array(vector), n):
            raise SimulationError(
                f"{_WHERE}: the rates, or the integrand, jump at t = {event.t:.6g} s, where {event.event} passes zero, "
                "and the derivatives of that instant aren't known; replace the jump by a smooth law, such as "
                "tanh(v/v0) for sign(v)"
            )


def _followed_back(
    task: Task,
    given: Mapping[Expr, float],
    initial: Mapping[Expr, float] | None,
    motion: Motion,
    functional: tuple[Expr, Expr],
) -> MotionGradient:
    """Return the gradient, by the way back along a motion.

    Args:
        task: the task of the motion.
        given: the values of the parameters.
        initial: the given initial values.
        motion: the motion.
        functional: g and L.
    """
    model, n, (g, L) = motion.model, len(motion.model.state), functional
    names = tuple(p for p in task.by if p.kind == "symbol")
    (integrand,) = model.along_motion([L])
    adjoint = adjoint_of(model, names, integrand, is_projected=task.is_projected)
    g_x, g_p = _slopes(motion, g, names, slice(-1, None))
    L_x, _ = _slopes(motion, L, names, slice(None))
    span = float(np.ptp(motion.t)) or 1.0
    scale = max(np.abs(g_x).max(initial=0.0), span * np.abs(L_x).max(initial=0.0)) or 1.0
    sizes = np.array([abs(motion.parameters[p]) or 1.0 for p in names])
    values = {**motion.parameters, adjoint.scale: scale, **dict(zip(adjoint.sizes, sizes, strict=True))}
    start = np.concatenate([motion.states[-1], g_x[:, 0] / scale, np.zeros(len(names) + 1)])
    back = BackwardMotion(adjoint, values, task.options)
    found = back.to_start(motion.t, motion.states, start) * scale
    by_parameter = dict(zip(names, found[2 * n : 2 * n + len(names)] / sizes + g_p[:, 0], strict=True))
    state = initial_state(task, given, initial)
    of_start = found[n : 2 * n] @ initial_slopes(task, given, initial, state)
    value = float(motion.outputs["final"][-1] + found[-1])
    derivatives = {p: float(of_start[k] + by_parameter.get(p, 0.0)) for k, p in enumerate(task.by)}
    return MotionGradient(value, derivatives, motion)


def _slopes(motion: Motion, value: Expr, names: Sequence[Expr], part: slice) -> tuple[Array, Array]:
    """Return the derivatives of an expression by the state and by parameters, at some of the instants."""
    model: Model = motion.model
    (along,) = model.along_motion([value])
    slopes = jacobian([along], [*model.state, *names]).row(0)
    at, states = motion.t[part], motion.states[part]
    found = model.function(list(slopes), tuple(motion.parameters))(at, *states.T, *motion.parameters.values())
    rows = np.stack([np.broadcast_to(row, at.shape) for row in found])
    return rows[: len(model.state)], rows[len(model.state) :]
