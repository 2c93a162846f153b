"""Linear equations of small deviations from rest or from a steady motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Annotated, Any, TypeAlias

from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.equations.output import Output
from symbody.dynamics.solution.program_result import output_result
from symbody.errors import ModelError, ProgramError
from symbody.geometry.given.argument import checked
from symbody.symbolic import (
    Expr,
    derivation,
    free_symbols,
    functions_of_time,
    t,
)
from symbody.symbolic.given.arguments import brief, described

from .balance import Balance, force_balance
from .input_leaves import input_leaves
from .linear import Linear
from .linear_of import linear_of
from .reference_motion import ReferenceMotion, reference_motion
from .smoothness import check_smooth
from .turning_axes import turning_plane
from .variation import Variation, variation

__all__ = ["linearize"]

_WHERE = "linearize"

About: TypeAlias = Annotated[
    Mapping[Expr, Any] | None, "a dictionary of variables and their values, such as {theta: 0}"
]
Inputs: TypeAlias = Annotated[Sequence[Expr] | None, "a list of inputs, such as [F]"]
Outputs: TypeAlias = Annotated[
    Mapping[str, Output] | Sequence[Expr] | None,
    "a dictionary of expressions by name, such as {'force': k * x}, or a list of expressions",
]
Independent: TypeAlias = Annotated[Sequence[Expr], "a list of coordinates and speeds, such as [x, theta]"]


@checked(ModelError)
def linearize(
    eqs: Equations,
    about: About = None,
    inputs: Inputs = None,
    outputs: Outputs = None,
    *,
    independent: Independent = (),
    keep_ignorable: bool = True,
) -> Linear:
    """Return the linear equations of small deviations from rest or from a steady motion.

    ``E x' = A0 x + B0 r`` with the state ``x = (s, v, z)``: deviations of independent coordinates, of independent
    speeds, and of states beside the mechanics. Constraints are eliminated by implicit differentiation, on the level of
    positions and on that of velocities. What they do to second order, the forces of their multipliers times the change
    of their directions, is in the coefficients [Schwab & Meijaard 2006].

    Args:
        eqs: the equations of motion.
        about: the values of coordinates, speeds, states and inputs in the steady motion, as numbers or expressions of
            parameters and t. What is not given is zero; speeds follow from the constraints as far as these determine
            them. Coordinates that move without a course in t may have any value: no coefficient depends on them. In a
            turn, the velocity (x', y') is that at the first instant, and turns with a heading.
        inputs: the inputs r, functions of time or parameters; by default, all functions of time that are given from
            outside. The rates of inputs that the equations, driven constraints or outputs hold are further inputs.
        outputs: expressions of coordinates, speeds, accelerations, multipliers, states and inputs, by name.
        independent: coordinates and speeds that shall be independent. By default, those whose coefficients in the
            constraints are short and neither zero nor small depend on the others, the last ones first.
        keep_ignorable: whether coordinates on which nothing depends stay in the state, such as the place and the
            heading of a vehicle.

    Raises:
        ModelError: the values are no steady motion, or a key is not known.
        ConstraintError: the constraints don't determine the dependent variables.

    >>> from symbody import Body, System, Vector, ground, newton_euler, rotate, translate
    >>> from symbody import functions_of_time, pi, symbols
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Y", theta) * translate(0, 0, l), m)
    >>> eqs = newton_euler(System([bob], coordinates=[theta], gravity=Vector(ground, 0, 0, g)))
    >>> linearize(eqs).K, linearize(eqs, about={theta: pi}).K
    (Matrix([[g*l*m]]), Matrix([[-g*l*m]]))
    """
    with derivation(fresh=True):
        _check_independent(eqs, independent)
        named = _named(eqs, outputs)
        known = input_leaves(eqs, [*named.values()])
        r = _inputs(eqs, known, inputs)

        def linear(turning: tuple[Expr, Expr, Expr] | None) -> Linear:
            motion = reference_motion(eqs, about, known, turning)
            return _about(eqs, motion, r, named, independent, keep_ignorable=keep_ignorable)

        try:
            return linear(getattr(about, "turning", None))
        except ModelError as failure:
            turning = turning_plane(eqs, about)
            if turning is None:
                raise
            with suppress(ModelError):
                return linear(turning)
            raise failure from None


def _about(
    eqs: Equations,
    motion: ReferenceMotion,
    inputs: tuple[Expr, ...],
    outputs: Mapping[str, Expr],
    independent: Sequence[Expr],
    *,
    keep_ignorable: bool,
) -> Linear:
    """Return the linear equations about a motion.

    Args:
        eqs: the equations of motion.
        motion: the motion.
        inputs: the inputs.
        outputs: the outputs by name.
        independent: coordinates and speeds that shall be independent.
        keep_ignorable: whether ignorable coordinates stay in the state.
    """
    check_smooth(eqs, motion)
    vary = variation(eqs, motion, inputs, independent)
    balance = force_balance(eqs, motion, vary)
    if not eqs.system.is_holonomic:  # the speeds of coordinates that matter are better independent
        again = variation(eqs, motion, inputs, independent, _that_matter(balance, vary))
        if again.pivots != vary.pivots:
            vary, balance = again, force_balance(eqs, motion, again)
    return linear_of(eqs, balance, vary, outputs, keep_ignorable=keep_ignorable)


def _that_matter(balance: Balance, vary: Variation) -> list[Expr]:
    """Return the coordinates on which forces depend: the lean and the steering angle of a bicycle, not its yaw."""
    X = balance.forces
    return [
        q for k, q in enumerate(vary.columns.coordinates) if not all(X[i, k].is_zero for i in range(X.rows))
    ]


def _inputs(eqs: Equations, known: Sequence[Expr], inputs: Sequence[Expr] | None) -> tuple[Expr, ...]:
    """Return the inputs, each followed by those of its rates that the equations, constraints or outputs hold.

    Args:
        eqs: the equations of motion.
        known: the functions of time from outside, and their rates, that occur.
        inputs: the inputs that the user chose.

    Raises:
        ModelError: one is not an input of the equations, or is given twice.
    """
    lowest = {r.name: r for r in reversed(known)}
    functions = {functions_of_time(name) for name in lowest}
    given = [r for r in known if lowest[r.name] == r] if inputs is None else [*inputs]
    found: list[Expr] = []
    for r in given:
        if r not in (*known, *functions, *eqs.parameters):
            names = ", ".join(map(str, dict.fromkeys([*known, *eqs.parameters])))
            raise ModelError(
                f"{_WHERE}, inputs: {brief(r)} is neither an input nor a parameter of these equations; expected some "
                f"of {brief(names)}"
            )
        if r in found:
            raise ModelError(
                f"{_WHERE}, inputs: {r} is given twice, or follows from an earlier one; give it once"
            )
        if r in (*known, *eqs.parameters):
            found.append(r)
        is_function = r.kind == "time_function"
        found += [leaf for leaf in known if is_function and leaf.name == r.name and leaf.order > r.order]
    return tuple(dict.fromkeys(found))


def _check_independent(eqs: Equations, independent: Sequence[Expr]) -> None:
    known = (*eqs.coordinates, *eqs.speeds)
    for name in independent:
        if name not in known:
            raise ModelError(
                f"{_WHERE}, independent: {brief(name)} is neither a coordinate nor a speed of these equations; "
                f"expected some of {brief(', '.join(map(str, known)))}"
            )


def _named(eqs: Equations, outputs: Mapping[str, Output] | Sequence[Expr] | None) -> dict[str, Expr]:
    """Return the outputs by name, written by speeds; of vectors and lists, a name for each component."""
    if outputs is None:
        return {}
    given = outputs if isinstance(outputs, Mapping) else {str(each): each for each in outputs}
    named: dict[str, Expr] = {}
    for name, value in given.items():
        try:
            found = output_result("output", value).expressions
        except ProgramError:
            raise ModelError(
                f"{_WHERE}, outputs, {brief(name)}: {described(value)}; expected an expression, a vector, a "
                "matrix or a list of expressions"
            ) from None
        labels = [name] if len(found) == 1 else [f"{name}[{k}]" for k in range(len(found))]
        named |= dict(zip(labels, found, strict=True))
    written = dict(zip(named, eqs.system.by_speeds([*named.values()]), strict=True))
    known = {*eqs.coordinates, *eqs.speeds, *eqs.accelerations, *eqs.multipliers, *eqs.states, t}
    inputs = {r.name for r in eqs.inputs}
    for name, value in written.items():
        held = {leaf for leaf in free_symbols([value]) - known if leaf.depends_on_time}
        strange = sorted(str(leaf) for leaf in held if leaf.name not in inputs)
        if strange:
            raise ModelError(
                f"{_WHERE}, outputs: {brief(name)} holds {strange[0]}, which is not a variable of these equations; "
                "expected an expression of coordinates, speeds, accelerations, multipliers, states, inputs and "
                "parameters"
            )
    return written
