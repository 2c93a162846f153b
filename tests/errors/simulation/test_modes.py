"""Mistakes with modes, root loci and responses: their whole messages."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Linear,
    Matrix,
    ModelNotice,
    SymbodyError,
    System,
    equations_of,
    errors,
    frequency_response,
    functions_of_time,
    ground,
    impulse_response,
    linearize,
    modes,
    newton_euler,
    root_locus,
    state_space,
    step_response,
    sweep,
    symbols,
    time_derivative,
    translate,
)
from symbody.models import n_pendulum
from tests.errors.given import check

x, y, F, w = functions_of_time("x y F w")
m, k, c, p = symbols("m k c p")


def cart(force: Expr, outputs: Sequence[Expr] = ()) -> Linear:
    """Return the linear model of a cart on a line."""
    body = Body(translate(x, 0, 0), m)
    load = Force(ground, force, 0, 0, at=body.center_of_mass, on=body)
    return linearize(newton_euler(System([body], [load], coordinates=[x])), outputs=list(outputs))


SPRING, UNSTABLE = cart(F - k * x, [x]), cart(F + k * x, [x])
DRIVEN = cart(k * (w - x) + c * time_derivative(w - x), [time_derivative(x, 2)])
LOOSE = linearize(equations_of(Matrix([[m, 0], [0, 0]]), [-k * x, 0 * y], [x, y]))
MASSLESS = linearize(
    equations_of(Matrix([[m, 0], [0, 0]]), [-k * (x - y), k * (x - y) - c * time_derivative(y)], [x, y])
)
BODILESS = linearize(equations_of(Matrix([[m]]), [-k * x], [x]))
NUMBERS = {m: 1.0, k: 4.0}
OVER = {k: np.linspace(1, 2, 5)}

MISTAKES: dict[str, tuple[Callable[[], object], type[SymbodyError], str]] = {
    "something else than a linear model": (
        lambda: modes(newton_euler(n_pendulum(1).system)),
        errors.ArgumentError,
        (
            "modes: Equations(1 equation of motion, 0 constraints, coordinate theta1) is an Equations; "
            "expected a linear model: linearize(equations)"
        ),
    ),
    "a missing value": (
        lambda: modes(SPRING, {m: 1}),
        errors.ParameterError,
        ("modes: no value for k; give parameters={k: ...}"),
    ),
    "a parameter of a locus given twice": (
        lambda: root_locus(SPRING, {m: 1, k: 1}, over=OVER),
        errors.ParameterError,
        "root_locus: k is given in parameters and in over; leave it out of parameters",
    ),
    "a name beyond the range": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER, names={"w": (7, 1j)}),
        errors.ArgumentError,
        "root_locus, names, w: 7 is not within the values of the parameter, from 1 to 2",
    ),
    "a name far from every eigenvalue": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER, names={"w": (1, 55j)}),
        errors.ArgumentError,
        "root_locus, names, w: 0+55j is far from every eigenvalue at 1; the nearest is 0+1j",
    ),
    "modes beyond a locus": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER).modes_at(3),
        errors.ParameterError,
        "RootLocus.modes_at: k = 3 is beyond the locus, which goes from 1 to 2",
    ),
    "rows of values": (
        lambda: modes(SPRING, {m: 1, k: [1, 2]}),
        errors.ParameterError,
        (
            "modes, parameters: the values have the shape (2,); expected one number for each parameter: for "
            "rows of numbers use root_locus or sweep"
        ),
    ),
    "a name as a text": (
        lambda: modes(SPRING, {**NUMBERS, "c": 1}),
        errors.ParameterError,
        ("modes, parameters: 'c', a str, is not a parameter of these equations; expected one of k, m"),
    ),
    "a singular pencil": (
        lambda: modes(LOOSE, NUMBERS),
        errors.ModelError,
        (
            "modes: the pencil of E x' = A0 x is singular: nothing determines a motion of y, y', which has "
            "neither mass, damping nor stiffness; give it one of them, or leave the coordinate out"
        ),
    ),
    "a locus of a singular pencil": (
        lambda: root_locus(LOOSE, {m: 1}, over=OVER),
        errors.ModelError,
        (
            "root_locus: the pencil of E x' = A0 x is singular: nothing determines a motion of y', which has"
            " neither mass, damping nor stiffness; give it one of them, or leave the coordinate out"
        ),
    ),
    "a locus through a mass that vanishes": (
        lambda: root_locus(MASSLESS, {k: 1, c: 1}, over={m: [0, 1, 2]}),
        errors.ModelError,
        (
            "root_locus: finite eigenvalues: 1 at m = 0, and 3 at 1, where E of E x' = A0 x loses or gains a "
            "rank; expected values between which masses don't vanish: draw a locus on each side"
        ),
    ),
    "energies without bodies": (
        lambda: modes(BODILESS, NUMBERS)[0].kinetic_energies,
        errors.ModelError,
        (
            "Mode.kinetic_energies: the equations of this linear model were given without bodies; expected "
            "those of a System with bodies"
        ),
    ),
    "an animation without bodies": (
        lambda: modes(BODILESS, NUMBERS)[0].animate("x.html"),
        errors.ModelError,
        (
            "Mode.animate: the equations of this linear model were given without bodies; expected those of a"
            " System with bodies"
        ),
    ),
    "an infinite amplitude": (
        lambda: modes(SPRING, NUMBERS)[0].motion(float("nan")),
        errors.ArgumentError,
        ("Mode.motion: amplitude=nan is a float; expected a finite number"),
    ),
    "a locus over two parameters": (
        lambda: root_locus(SPRING, {}, over={m: [1, 2], k: [1, 2]}),
        errors.ParameterError,
        (
            "root_locus, over: 2 parameters; expected one: for several parameters use sweep(linear, "
            "cases=grid({...}))"
        ),
    ),
    "a locus over a symbol of another model": (
        lambda: root_locus(SPRING, NUMBERS, over={p: [1, 2]}),
        errors.ParameterError,
        ("root_locus, over: p is not a parameter of this linear model; expected one of k, m"),
    ),
    "a locus over one value": (
        lambda: root_locus(SPRING, NUMBERS, over={k: [1]}),
        errors.ParameterError,
        (
            "root_locus, over: the values of k are not two or more different finite numbers; expected such "
            "as {k: numpy.linspace(1, 10, 200)}"
        ),
    ),
    "a locus over a symbol alone": (
        lambda: root_locus(SPRING, NUMBERS, over=k),
        errors.ArgumentError,
        (
            "root_locus, over: k is an Expr; expected a dictionary of one parameter and its values, such as "
            "{v: numpy.linspace(1, 10, 200)}"
        ),
    ),
    "a locus with a missing value": (
        lambda: root_locus(SPRING, {}, over=OVER),
        errors.ParameterError,
        ("root_locus: no value for m; give parameters={m: ...}"),
    ),
    "a locus with rows of another parameter": (
        lambda: root_locus(SPRING, {m: [1, 2]}, over=OVER),
        errors.ParameterError,
        (
            "root_locus, parameters: m has values of shape (2,); expected one number, or a function of the "
            "parameter, such as {m: lambda value: ...}"
        ),
    ),
    "a name of a branch without its place": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER, names={"a": 3}),
        errors.ArgumentError,
        (
            "root_locus, names, a: 3 is an int; expected a value of the parameter and an eigenvalue, such as"
            " (5, -0.8 + 4.5j)"
        ),
    ),
    "a branch that has no such name": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER)["weave"],
        errors.ArgumentError,
        ("RootLocus: no branch is named 'weave'; expected one of branch 1"),
    ),
    "a critical value where there is none": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER).critical_value("branch 1"),
        errors.ArgumentError,
        ("RootLocus.critical_value: the branches named 'branch 1' have 0 critical values; no branch has any"),
    ),
    "something else than a branch of steady motions": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER, along=3),
        errors.ArgumentError,
        ("root_locus, along: 3 is an int; expected a branch of steady motions: continuation(...)"),
    ),
    "an unknown kind of plot of a locus": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER).plot("x"),
        errors.ViewError,
        ("RootLocus.plot, kind: 'x' is a str; expected 'both', 'plane' or 'over'"),
    ),
    "limits of an axis that are one number": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER).plot(real=3),
        errors.ViewError,
        ("RootLocus.plot, real: 3 is an int; expected the least and the largest value, such as (-20, 5)"),
    ),
    "names of branches in a list": (
        lambda: root_locus(SPRING, {m: 1}, over=OVER, names=["weave"]),  # type: ignore[arg-type]
        errors.ArgumentError,
        (
            "root_locus, names: ['weave'] is a list; expected a dictionary of names, each with a value of the "
            "parameter and an eigenvalue, such as {'weave': (5, -0.8 + 4.5j)}"
        ),
    ),
    "no eigenvalue to be near to": (
        lambda: modes(SPRING, NUMBERS).near("fast"),  # type: ignore[arg-type]
        errors.ArgumentError,
        ("Modes.near: 'fast' is a str; expected an eigenvalue in 1/s, such as -0.8 + 4.5j"),
    ),
    "the place of a mode that there isn't": (
        lambda: modes(SPRING, NUMBERS)[3],
        errors.ArgumentError,
        ("Modes: [3] is not the place of a mode; expected a number below 1, or modes.near(eigenvalue)"),
    ),
    "derivatives in a list": (
        lambda: modes(SPRING, NUMBERS)[0].sensitivity(k, together=[1]),  # type: ignore[arg-type]
        errors.ArgumentError,
        (
            "Mode.sensitivity, together: [1] is a list; expected a dictionary of parameters and their "
            "derivatives"
        ),
    ),
    "a sweep without cases": (
        lambda: sweep(SPRING, {m: 1, k: []}),
        errors.ParameterError,
        ("sweep: k has no values; expected one for each case"),
    ),
    "matrices of equations that are not linear": (
        lambda: state_space(newton_euler(n_pendulum(1).system)),  # type: ignore[arg-type]
        errors.ArgumentError,
        (
            "state_space: Equations(1 equation of motion, 0 constraints, coordinate theta1) is an Equations; expected "
            "a linear model: linearize(equations)"
        ),
    ),
    "units that are no dictionary": (
        lambda: frequency_response(SPRING, NUMBERS, [1]).plot(units="N"),  # type: ignore[arg-type]
        errors.ViewError,
        ("FrequencyResponse.plot, units: 'N' is a str; expected a dictionary, such as {x: 'm'}"),
    ),
    "an unknown kind of plot of a response": (
        lambda: frequency_response(SPRING, NUMBERS, [1]).plot("x"),
        errors.ViewError,
        ("FrequencyResponse.plot, kind: 'x' is a str; expected 'bode' or 'nyquist'"),
    ),
    "no inputs": (
        lambda: frequency_response(cart(-k * x), NUMBERS, [1]),
        errors.ModelError,
        (
            "frequency_response: the linear model has no inputs; expected functions of time that "
            "occur in loads or constraints: linearize(..., inputs=[F])"
        ),
    ),
    "no outputs": (
        lambda: frequency_response(cart(F - k * x), NUMBERS, [1]),
        errors.ModelError,
        ("frequency_response: the linear model has no outputs; name them: linearize(..., outputs=[x])"),
    ),
    "the response at an eigenvalue": (
        lambda: frequency_response(SPRING, NUMBERS, [1, 2]),
        errors.ModelError,
        (
            "frequency_response: the response is infinite at omega = 2 rad/s: 2i is an eigenvalue; leave "
            "this frequency out, or add damping"
        ),
    ),
    "the response at zero of what is free": (
        lambda: frequency_response(cart(F, [x]), {m: 1}, [0]),
        errors.ModelError,
        (
            "frequency_response: the response is infinite at omega = 0 rad/s: 0 is an eigenvalue; leave "
            "this frequency out, or add damping"
        ),
    ),
    "a text as frequencies": (
        lambda: frequency_response(SPRING, NUMBERS, "a"),
        errors.ArgumentError,
        (
            "frequency_response, omega: 'a' is a str; expected a row of finite frequencies in rad/s, such as"
            " numpy.geomspace(0.1, 100, 500)"
        ),
    ),
    "an output that is not known": (
        lambda: frequency_response(SPRING, NUMBERS, [1])["y", F],
        errors.ArgumentError,
        ("FrequencyResponse: [y, F] is not known; expected one of the outputs x and one of the inputs F"),
    ),
    "an output alone": (
        lambda: step_response(SPRING, NUMBERS, 1)["x"],
        errors.ArgumentError,
        ("TimeResponse: 'x' is a str; expected an output and an input, such as response['x', F]"),
    ),
    "instants that go back": (
        lambda: step_response(SPRING, NUMBERS, [1, 0]),
        errors.ArgumentError,
        (
            "step_response, t: [1, 0] does not increase; expected the first and the last instant in s, such "
            "as (0, 5), all instants, increasing from 0, or the last one"
        ),
    ),
    "no instants": (
        lambda: step_response(SPRING, NUMBERS, []),
        errors.ArgumentError,
        (
            "step_response, t: [] is empty; expected the first and the last instant in s, such "
            "as (0, 5), all instants, increasing from 0, or the last one"
        ),
    ),
    "an instant before the step": (
        lambda: step_response(SPRING, NUMBERS, [-1, 1]),
        errors.ArgumentError,
        (
            "step_response, t: [-1, 1] begins before 0; expected the first and the last instant in s, such "
            "as (0, 5), all instants, increasing from 0, or the last one"
        ),
    ),
    "a last instant before the step": (
        lambda: step_response(SPRING, NUMBERS, -1),
        errors.ArgumentError,
        (
            "step_response, t: -1 is not positive; expected the first and the last instant in s, such "
            "as (0, 5), all instants, increasing from 0, or the last one"
        ),
    ),
    "a frequency that is not a number": (
        lambda: frequency_response(SPRING, NUMBERS, [float("nan")]),
        errors.ArgumentError,
        (
            "frequency_response, omega: [nan] holds NaN; expected a row of finite frequencies in rad/s, such as "
            "numpy.geomspace(0.1, 100, 500)"
        ),
    ),
    "a step of an input on whose rate an output depends": (
        lambda: step_response(DRIVEN, {**NUMBERS, c: 1}, [1]),
        errors.ModelError,
        (
            "step_response: x'' follows the rate of an input at once, so that its response contains an impulse; "
            "expected outputs such as positions and speeds, or use frequency_response"
        ),
    ),
    "an impulse in an output": (
        lambda: impulse_response(cart(F - k * x, [time_derivative(x, 2)]), NUMBERS, 1),
        errors.ModelError,
        (
            "impulse_response: x'' follows an input at once, so that its response contains an impulse; expected"
            " outputs such as positions and speeds, or use step_response"
        ),
    ),
    "a parameter given twice in a sweep": (
        lambda: sweep(SPRING, NUMBERS, cases={k: [1, 2]}),
        errors.ParameterError,
        ("sweep: k is given in parameters and in cases; leave it out of one of them"),
    ),
    "rows of different lengths": (
        lambda: sweep(SPRING, {m: [1, 2, 3], k: [1, 2]}),
        errors.ParameterError,
        (
            "sweep: rows of different lengths (m has 3, k has 2); expected one value for each case in every "
            "row, or a number for all cases. For all combinations use cases=grid({...})"
        ),
    ),
    "a table of values": (
        lambda: sweep(SPRING, {m: 1, k: [[1, 2], [3, 4]]}),
        errors.ParameterError,
        (
            "sweep: rows of different lengths (k has values of shape (2, 2)); expected one value for each "
            "case in every row, or a number for all cases. For all combinations use cases=grid({...})"
        ),
    ),
    "no executor": (
        lambda: sweep(SPRING, NUMBERS, executor="threads"),
        errors.ArgumentError,
        (
            "sweep: executor='threads' is a str; expected an executor of concurrent.futures, such as "
            "ProcessPoolExecutor(), or None for threads of this process"
        ),
    ),
    "no threads": (
        lambda: sweep(SPRING, NUMBERS, threads=0),
        errors.ArgumentError,
        ("sweep: threads=0 is an int; expected a whole number from 1"),
    ),
    "a sweep with a missing value": (
        lambda: sweep(SPRING, {k: [1, 2]}),
        errors.ParameterError,
        ("sweep: no value for m; give parameters={m: ...}"),
    ),
    "cases as a list": (
        lambda: sweep(SPRING, {m: 1}, cases=[1, 2]),
        errors.ArgumentError,
        ("sweep, cases: [1, 2] is a list; expected a dictionary of parameters and their values"),
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistake(name: str) -> None:
    mistake, kind, message = MISTAKES[name]
    check(kind, mistake, message)


def test_an_unstable_system_has_a_response_that_is_not_reached() -> None:
    with pytest.warns(ModelNotice) as caught:
        response = frequency_response(UNSTABLE, NUMBERS, [1.0])
    np.testing.assert_allclose(response[x, F], -1 / 5)
    assert str(caught[0].message) == (
        "frequency_response: the system is unstable, with the eigenvalue 2 1/s: its motions don't reach the steady "
        "state that this response describes"
    )


def test_marginal_and_defective_modes_are_noted() -> None:
    spring, free = modes(SPRING, NUMBERS), modes(cart(F), {m: 1.0})
    grows = "the linear model does not tell whether these motions grow in the nonlinear one"
    assert spring.notes == (f"marginal: 0 ± 2i; {grows}",)
    assert free.notes == (
        (
            "the eigenvalue 0 occurs 2 times but has 1 shape: it is defective, motions t exp(s t) occur, and "
            "participations are not defined"
        ),
        f"marginal: 0, of x; {grows}",
    )
    assert "note: marginal" in repr(spring)
    assert "it is defective" in free._repr_html_()
