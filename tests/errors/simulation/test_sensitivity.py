"""Mistakes with sensitivities: their whole messages."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Equilibrium,
    Event,
    Expr,
    Force,
    Mode,
    ModelNotice,
    Motion,
    MotionGradient,
    SymbodyError,
    System,
    Vector,
    equilibrium,
    errors,
    functions_of_time,
    gradient_of_motion,
    ground,
    hamilton,
    linearize,
    modes,
    newton_euler,
    sign,
    simulate,
    sqrt,
    steady,
    symbols,
    time_derivative,
    translate,
)
from symbody.simulation import Occurrence
from tests.errors.given import Mistake, check

x, y, w = functions_of_time("x y w")
m, k, l, g = symbols("m k l g")
v = time_derivative(x)

body = Body(translate(x, 0, 0), m)
CART = System([body], [Force(ground, -k * x, 0, 0, at=body.center_of_mass, on=body)], [x])
SPRING = newton_euler(CART)
PENDULUM = newton_euler(
    System([Body(translate(x, y, 0), m)], (), [x, y], [x**2 + y**2 - l**2], Vector(ground, 0, -g, 0))
)
VALUES = {m: 1.0, k: 4.0}
OF_PENDULUM = {m: 1.0, l: 5.0, g: 9.81}


def cart(**options: object) -> Motion:
    """Return a motion of a cart with a spring."""
    return simulate(SPRING, VALUES, {x: 0.1}, (0, 1), **options)  # type: ignore[arg-type]


def pendulum(initial: dict[object, float], **options: object) -> Motion:
    """Return a motion of a pendulum in x and y."""
    return simulate(PENDULUM, OF_PENDULUM, initial, (0, 1), **options)  # type: ignore[arg-type]


def touching() -> float:
    """Ask for the derivative of an instant at which the expression of an event only touches zero."""
    motion = cart(sensitivities=[k])
    return motion.instant_sensitivity(Occurrence(Event(v**2), 0.0, {x: 0.1, v: 0.0}, np.zeros((2, 1))), by=k)


def gradient(**options: object) -> MotionGradient:
    """Return the gradient of a number that the motion of the cart determines."""
    start: dict[str, object] = {
        "eqs": SPRING,
        "parameters": VALUES,
        "initial": {x: 0.1},
        "t": (0, 1),
        "by": [k],
    }
    return gradient_of_motion(**{**start, **options})  # type: ignore[arg-type]


def rubbing() -> Equations:
    """Return a cart with a spring and dry friction."""
    force = Force(ground, -k * x - m * sign(v) / 10, 0, 0, at=body.center_of_mass, on=body)
    return newton_euler(System([body], [force], [x]))


def rest(**options: object) -> Equilibrium:
    """Return the equilibrium of a cart on a spring, which a force pushes."""
    force = Force(ground, l - k * x, 0, 0, at=body.center_of_mass, on=body)
    eqs = newton_euler(System([body], [force], [x]))
    return equilibrium(eqs, {m: 1.0, k: 4.0, l: 2.0}, **options)  # type: ignore[arg-type]


def beads() -> float:
    """Ask for the derivative of a multiplier of a constraint that is there twice: the sum of both is known."""
    bead = Body(translate(x, y, 0), m)
    circle = x**2 + y**2 - l**2
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        eqs = newton_euler(System([bead], (), [x, y], [circle, circle], Vector(ground, 0, -g, 0)))
        found = equilibrium(eqs, {m: 1.0, l: 2.0, g: 9.81}, guess={x: 0.1, y: -1.0})
    one, other = eqs.multipliers
    assert found.sensitivity(one + other, by=m) == pytest.approx(
        -9.81 / (2 * 2.0)
    )  # m g = 2 y (lambda1 + lambda2)
    assert found.sensitivity(y, by=l) == pytest.approx(-1.0)
    return found.sensitivity(one, by=m)


def folded() -> float:
    """Ask for a derivative where two equilibria of ``k = x^2`` meet."""
    force = Force(ground, k - x**2, 0, 0, at=body.center_of_mass, on=body)
    eqs = newton_euler(System([body], [force], [x]))
    found = equilibrium(eqs, {m: 1.0, k: 0.0})
    return found.sensitivity(x, by=k)


def merged(root: float, find: Callable[..., Mapping[Expr, float]]) -> float:
    """Ask for a derivative at a double root that is found, but for rounding errors."""
    force = Force(ground, l - k * (x**2 - 2 * root * x + root**2), 0, 0, at=body.center_of_mass, on=body)
    found = find(newton_euler(System([body], [force], [x])), {m: 1.0, k: 1.0, l: 0.0}, guess={x: 0.3})
    return found.sensitivity(x, by=l)  # type: ignore[attr-defined]


def test_beside_a_double_root() -> None:
    """``x = sqrt(l/k)`` has the derivative ``1/(2 k x)`` down to small x, and so has a stiff contact."""
    for law, slope in (
        (k * x**2, lambda at: 1 / (2 * 1e3 * at)),
        (k * sqrt(x**3), lambda at: at**-0.5 / 1.5e3),
    ):
        force = Force(ground, l - law, 0, 0, at=body.center_of_mass, on=body)
        eqs = newton_euler(System([body], [force], [x]))
        found = equilibrium(eqs, {m: 1.0, k: 1e3, l: 1e-5}, guess={x: 1e-2})
        assert found.sensitivity(x, by=l) == pytest.approx(slope(found[x]), rel=1e-9)


def loose_mode() -> Mode:
    """Return the mode of two masses with a spring between: only their distance is determined."""
    x0, y0 = symbols("x0 y0")
    pull = Force(ground, l - k * (x - y) ** 3, 0, 0, at=body.center_of_mass, on=body)
    foot = Body(translate(y, 0, 0), m)
    back = Force(ground, k * (x - y) ** 3 - l, 0, 0, at=foot.center_of_mass, on=foot)
    linear = linearize(newton_euler(System([body, foot], [pull, back], [x, y])), about={x: x0, y: y0})
    return modes(linear, {m: 1.0, k: 2.0, l: 2.0, x0: 2.0, y0: 1.0}).near(3.5j)


def mode(*, repeated: bool = False, place: float | None = None) -> Mode:
    """Return the mode of a cart about a position x0 that a force holds, or one of two equal carts."""
    x0 = symbols("x0") if place is None else place
    force = Force(ground, l - k * x**3, 0, 0, at=body.center_of_mass, on=body)
    if not repeated:
        linear = linearize(newton_euler(System([body], [force], [x])), about={x: x0})
        own = {x0: 1.0} if isinstance(x0, Expr) else {}
        return modes(linear, {m: 1.0, k: 2.0, l: 2.0, **own})[0]
    other = Body(translate(0, y, 0), m)
    pulls = [Force(ground, -k * x, 0, 0, at=body.center_of_mass, on=body)]
    pulls += [Force(ground, 0, -k * y, 0, at=other.center_of_mass, on=other)]
    return modes(linearize(newton_euler(System([body, other], pulls, [x, y]))), {m: 1.0, k: 2.0})[0]


MISTAKES: list[Mistake] = [
    (
        errors.ParameterError,
        lambda: cart(sensitivities=[l]),
        (
            "simulate, sensitivities: l is neither a parameter of the model nor a coordinate, a speed or a state, "
            "which stand for their initial values; expected some of k, m, x and x'"
        ),
    ),
    (
        errors.ParameterError,
        lambda: cart(sensitivities=["k"]),
        (
            "simulate, sensitivities: 'k', a str, is neither a parameter of the model nor a coordinate, a speed or a "
            "state, which stand for their initial values; expected the variable itself: [k]"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: cart(sensitivities=k),
        (
            "simulate, sensitivities: k is one expression; expected a list of parameters, and of coordinates, speeds "
            "and states for their initial values"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: cart(sensitivities=[k, x, k]),
        "simulate, sensitivities: k twice; expected each once",
    ),
    (
        errors.SimulationError,
        lambda: cart(sensitivities=[k], method="ida"),
        (
            "simulate, sensitivities: method='ida' doesn't integrate them; leave them out, or use a method that does: "
            "'dop853', 'tsit5', 'bdf', 'esdirk34' and 'tr_bdf2'"
        ),
    ),
    (
        errors.ParameterError,
        lambda: cart().sensitivity(x, by=k),
        "motion.sensitivity: this motion has no sensitivities; expected simulate(..., sensitivities=[k])",
    ),
    (
        errors.ParameterError,
        lambda: cart(sensitivities=[k, x]).sensitivity(x, by=m),
        "motion.sensitivity, by: m; expected one of the sensitivities of simulate, k or x",
    ),
    (
        errors.ArgumentError,
        lambda: cart(sensitivities=[k]).sensitivity("x", by=k),  # type: ignore[arg-type]
        "motion[...]: 'x' is a str; expected an expression, such as motion[x]",
    ),
    (
        errors.SimulationError,
        lambda: cart(sensitivities=[k]).sensitivity(w, by=k),
        (
            "motion: no values of w; this motion has values of time, the coordinates x, the speeds x', accelerations, "
            "multipliers and parameters; w is neither a coordinate nor a speed of this system: use those, or add it to "
            "the system before simulating"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: cart(sensitivities=[k]).instant_sensitivity(0, by=k),  # type: ignore[arg-type]
        "motion.instant_sensitivity: 0 is an int; expected an event of this motion, such as motion.events[0]",
    ),
    (
        errors.SimulationError,
        touching,
        (
            "motion.instant_sensitivity: x'**2 only touches zero at t = 0 s, so that the instant has no derivative; "
            "expected an event whose expression passes zero"
        ),
    ),
    (
        errors.ConstraintError,
        lambda: pendulum({x: 3.0, y: -4.0, v: 0.0}, sensitivities=[g, l]),
        (
            "simulate, sensitivities: the given initial values satisfy the constraints only for these values of l, so "
            "that they have no derivatives; give some of the initial values as a guess instead, so that they are "
            "solved for"
        ),
    ),
    (
        errors.SimulationError,
        lambda: pendulum({x: 3.0, v: 0.0}, guess={y: -1.0}, sensitivities=[y]),
        (
            "simulate, sensitivities: the initial value of y isn't given, it is what the constraints and the "
            "kinematics demand; give it in initial={y: ...}, or leave it out of the sensitivities"
        ),
    ),
    (
        errors.SimulationError,
        lambda: simulate(hamilton(CART).equations, VALUES, {x: 0.1}, (0, 1), sensitivities=[k]),
        (
            "simulate, sensitivities: the speeds of the equations are momenta; expected equations in speeds, such as "
            "newton_euler(system)"
        ),
    ),
    (
        errors.ArgumentError,
        gradient,
        (
            "gradient_of_motion: neither final nor integral is given; expected final=..., an expression at the last "
            "instant, or integral=..., one that is integrated along the motion"
        ),
    ),
    (
        errors.ParameterError,
        lambda: gradient(final=x, by=[l]),
        (
            "gradient_of_motion, by: l is neither a parameter of the model nor a coordinate, a speed or a state, which "
            "stand for their initial values; expected some of k, m, x and x'"
        ),
    ),
    (
        errors.SimulationError,
        lambda: gradient(final=x, method="bdf"),
        (
            "gradient_of_motion: method='bdf' is for stiff equations, which can't be followed back; expected 'dop853' "
            "or 'tsit5', or use simulate(..., sensitivities=[...])"
        ),
    ),
    (
        errors.SimulationError,
        lambda: gradient(final=w),
        (
            "gradient_of_motion: the output 'final' contains w; expected an expression of time, coordinates, speeds, "
            "accelerations, multipliers and parameters"
        ),
    ),
    (
        errors.SimulationError,
        lambda: gradient(eqs=rubbing(), final=x, t=(0, 3)),
        (
            "gradient_of_motion: the rates, or the integrand, jump at t = 1.5708 s, where x' passes zero, and the "
            "derivatives of that instant aren't known; replace the jump by a smooth law, such as tanh(v/v0) for sign(v)"
        ),
    ),
    (
        errors.SimulationError,
        lambda: gradient(integral=sign(x), t=(0, 3)),
        (
            "gradient_of_motion: the rates, or the integrand, jump at t = 0.785398 s, where x passes zero, and the "
            "derivatives of that instant aren't known; replace the jump by a smooth law, such as tanh(v/v0) for sign(v)"
        ),
    ),
    (
        errors.ParameterError,
        lambda: rest().sensitivity(x, by=g),
        "equilibrium.sensitivity, by: g is not a parameter here; expected one of k, l or m",
    ),
    (
        errors.ParameterError,
        lambda: rest().sensitivity(x, by=x),
        (
            "equilibrium.sensitivity, by: x is not given here, it is solved for; expected a parameter, an input, or "
            "what was given"
        ),
    ),
    (
        errors.SimulationError,
        lambda: rest().sensitivity(w, by=k),
        "equilibrium.sensitivity: no value of w; expected an expression of x, multipliers and parameters",
    ),
    (
        errors.SimulationError,
        folded,
        (
            "equilibrium.sensitivity: the conditions don't determine the derivatives by k: this is a fold, or a place "
            "where branches meet; expected another place on the branch"
        ),
    ),
    *(
        (
            errors.SimulationError,
            partial(merged, root, find),
            (
                f"{where}.sensitivity: the conditions don't determine the derivatives by l: this is a fold, or a place "
                "where branches meet; expected another place on the branch"
            ),
        )
        for where, find in (("equilibrium", equilibrium), ("SteadyMotion", steady))
        for root in (0, 1)
    ),
    (
        errors.ParameterError,
        lambda: gradient(final=x)[m],
        "MotionGradient[...]: m; expected what was given in gradient_of_motion(..., by=[...]), k",
    ),
    (
        errors.ArgumentError,
        lambda: gradient(final=x, by=[]),
        (
            "gradient_of_motion, by: nothing is given; expected a list of parameters, and of coordinates, speeds and "
            "states for their initial values"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: mode().sensitivity(by=[k, l]),  # type: ignore[arg-type]
        "Mode.sensitivity, by: [k, l] is a list; expected one parameter of the linear model",
    ),
    (
        errors.SimulationError,
        beads,
        (
            "equilibrium.sensitivity: the position doesn't determine lambda1, as constraints depend on each other, and "
            "the derivatives of their shares aren't known; expected an expression without them, or in which they "
            "balance the same loads"
        ),
    ),
    (
        errors.ParameterError,
        lambda: mode().sensitivity(by=g),
        "Mode.sensitivity: g is not a parameter of the linear model; expected k, l, m or x0",
    ),
    (
        errors.ModelError,
        lambda: mode(place=1.0).sensitivity(by=k),
        (
            "Mode.sensitivity: when k changes, the reference motion isn't steady any more: the equation of motion of "
            "x' is off; expected a motion that follows: linearize about symbols, such as about={q: q0}, and give "
            "their values to modes"
        ),
    ),
    (
        errors.ModelError,
        lambda: loose_mode().sensitivity(by=k),
        (
            "Mode.sensitivity: the conditions of the steady motion don't determine how x0 and y0 change: give as many "
            "of them as are free, such as together={x0: 0} for one that stays"
        ),
    ),
    (
        errors.ModelError,
        lambda: mode(repeated=True).sensitivity(by=k),
        (
            "Mode.sensitivity: the eigenvalue 0+1.41421j is repeated, and has no derivative; expected a simple one"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
