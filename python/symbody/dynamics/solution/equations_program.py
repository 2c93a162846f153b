"""Programs of equations of motion: the routines of which code is generated."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from symbody.dynamics.equations.baumgarte import Damping
from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.equations.output import Output, Outputs
from symbody.dynamics.solution.forward_dynamics import forward_dynamics
from symbody.dynamics.solution.program_argument import (
    MEANINGS,
    arguments_of,
    by_name,
    leaves_of,
    with_arguments,
)
from symbody.dynamics.solution.program_result import matrix_result, output_result, vector_result
from symbody.errors import ModelError, ProgramError
from symbody.geometry.given.argument import checked
from symbody.multibody import System, kinetic_energy
from symbody.multibody.energy import known_potential, potentials
from symbody.symbolic import (
    Expr,
    Program,
    Result,
    Routine,
    free_symbols,
    t,
)
from symbody.symbolic.given.identifier import program_name, title_identifier
from symbody.symbolic.numeric.program import program_of


@program_of.register
@checked(ModelError)
def program(
    eqs: Equations,
    *,
    name: str | None = None,
    outputs: Outputs | None = None,
    baumgarte: Damping = None,
    method: str | None = "auto",
) -> Program:
    """Return the routines of the equations of motion, of which code is generated.

    Args:
        eqs: the equations of motion.
        name: the name of the generated code, as an identifier; by default the name of the system, or "model".
        outputs: further expressions, vectors or matrices that the code computes, by name.
        baumgarte: omega (in rad/s) and zeta of the stabilisation of constraints in the forward dynamics.
        method: the method of `forward_dynamics`; None leaves out the forward dynamics and the right-hand side.

    Returns:
        A program of the routines mass_matrix, forcing, residuals, constraints (those on positions),
        velocity_constraints (all, if some are on velocities), state_rates, constraint_jacobian, forward_dynamics,
        right_hand_side, energies and outputs, without those that have nothing to compute. Their arguments are p
        (parameters), t, r (inputs), q, u (speeds), z (states), a (accelerations) and lambda_ (multipliers), in this
        order.

    Raises:
        ProgramError: an output isn't a function of these, or a name is not an identifier.

    >>> from symbody import Body, System, Vector, functions_of_time, ground, newton_euler, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    >>> model = program(newton_euler(pendulum), name="pendulum")
    >>> [argument.name for argument in model.arguments]
    ['p', 'q', 'u', 'a']
    """
    routines = [
        *_equations_of_motion(eqs),
        *(() if method is None else _forward(eqs, method, baumgarte)),
        Routine("energies", "energies of the bodies", (), _energies(eqs)),
    ]
    if outputs:
        results = _outputs(outputs, eqs)
        _check_time_functions(outputs, eqs, routines)
        routines.append(Routine("outputs", "what else was asked for", (), results))
    arguments = arguments_of(eqs, leaves_of(routines))
    meaning = (
        f"the equations of motion of {', '.join(map(str, eqs.coordinates))}{_drift(eqs, method, baumgarte)}"
    )
    completed = tuple(with_arguments(routine, arguments) for routine in routines)
    named = title_identifier(eqs.system.name, "model") if name is None else program_name(name, "program")
    return Program(named, meaning, tuple(arguments), completed)


def _equations_of_motion(eqs: Equations) -> list[Routine]:
    n, m = len(eqs.residuals), len(eqs.constraints)
    routines = [
        _routine("mass_matrix", "the mass matrix", matrix_result("M", eqs.mass_matrix)),
        _routine(
            "forcing",
            "the forces of speeds, weight and loads: M a = f" + (" + phi_q^T lambda" if m else ""),
            vector_result("f", eqs.forcing),
        ),
        _routine(
            "residuals",
            ("the equation" if n == 1 else f"the {n} equations") + " of motion: zero along a motion",
            vector_result("residuals", eqs.residuals),
        ),
    ]
    positions = [eqs.constraints[k] for k in eqs.system.holonomic]
    if positions:
        routines.append(
            _routine("constraints", _which_vanish(positions, ""), vector_result("phi", positions))
        )
    if not eqs.system.is_holonomic:
        levels = eqs.system.velocity_level(eqs.constraints)
        routines.append(
            _routine(
                "velocity_constraints",
                _which_vanish(levels, " on the level of velocities"),
                vector_result("psi", levels),
            )
        )
    if eqs.states:
        rates = vector_result("z_rates", [*eqs.state_rates.values()])
        routines.append(_routine("state_rates", "the rates of the states z", rates))
    if m:
        jacobian = matrix_result("phi_q", eqs.constraint_jacobian)
        routines.append(
            _routine(
                "constraint_jacobian",
                "the derivatives of the constraints by q (of their rates by u)",
                jacobian,
            )
        )
    return routines


def _which_vanish(constraints: Sequence[Expr], level: str) -> str:
    m = len(constraints)
    return (
        f"the constraint{level}, which is zero" if m == 1 else f"the {m} constraints{level}, which are zero"
    )


def _forward(eqs: Equations, method: str, baumgarte: Damping) -> list[Routine]:
    solution = forward_dynamics(eqs, method=method, baumgarte=baumgarte)
    found = [vector_result("a", solution.accelerations, "the accelerations")]
    if solution.multipliers:
        found.append(vector_result("lambda_", solution.multipliers, "the multipliers"))
    of_states = solution.put_into(eqs, [*eqs.state_rates.values()])
    rates = vector_result(
        "rates",
        (*eqs.kinematics.values(), *solution.accelerations, *of_states),
        "the rates of q, then those of u" + (", then those of z" if of_states else ""),
    )
    return [
        _routine("forward_dynamics", f"the accelerations, {_WAYS[solution.method]}", *found),
        _routine("right_hand_side", f"the rates of the state (q, u{', z' if of_states else ''})", rates),
    ]


def _drift(eqs: Equations, method: str | None, baumgarte: Damping) -> str:
    """Return how the constraints are kept along a motion, for the comment at the head of the code."""
    if method is None or not eqs.constraints:
        return ""
    if baumgarte is None:
        return (
            f".\n\nThe accelerations keep {_kept(eqs)} at zero, and nothing more: in a "
            "long motion positions and speeds drift off the constraints. Made by "
            "equations.program(baumgarte=(omega, zeta)) with a frequency and a damping ratio, the accelerations bring "
            "them back."
        )
    omega, zeta = baumgarte
    return (
        f".\n\nThe accelerations keep {_stabilized(eqs)} at zero (Baumgarte's stabilisation, "
        f"omega: {omega}, zeta: {zeta}), so that positions and speeds that have left the constraints come back."
    )


def _kept(eqs: Equations) -> str:
    system = eqs.system
    if system.is_holonomic:
        return "the second derivatives of the constraints"
    on_velocity = "the rates of the constraints on velocities"
    return f"the second derivatives of constraints, and {on_velocity}" if system.holonomic else on_velocity


def _stabilized(eqs: Equations) -> str:
    system = eqs.system
    rows = ["phi'' + 2 zeta omega phi' + omega^2 phi"] if system.holonomic else []
    rows += [] if system.is_holonomic else ["psi' + 2 zeta omega psi"]
    return " and ".join(rows)


_WAYS = {
    "articulated_body": "by articulated bodies",
    "ldl": "by elimination in the mass matrix",
    "schur_complement": "by elimination in the mass matrix, and a linear system of the multipliers that is solved with "
    "pivoting",
    "null_space": "by independent speeds, inaccurate near states where other speeds must be chosen as independent",
    "pivoted": "by a linear system that is solved with pivoting",
}


def _energies(eqs: Equations) -> tuple[Result, ...]:
    if not isinstance(eqs.system, System):
        return () if eqs.energy is None else (Result("energy", "the energy", (eqs.energy,), ()),)
    kinetic = Result(
        "kinetic", "the kinetic energy", eqs.system.by_speeds([kinetic_energy(eqs.system.bodies)]), ()
    )
    stored = known_potential(eqs.system)
    if stored is None:
        return (kinetic,)
    of = "of weight and loads" if potentials(eqs.system.loads, eqs.system.bodies) else "of weight"
    return kinetic, Result("potential", f"the potential energy {of}", (stored,), ())


def _outputs(outputs: Mapping[str, Output], eqs: Equations) -> tuple[Result, ...]:
    """Return the outputs, with rates of coordinates that are not speeds written by speeds and accelerations."""
    results = []
    for name, value in outputs.items():
        if name in MEANINGS:
            raise ProgramError(
                f"program: the output {name} has the name of an argument, {MEANINGS[name][0]}; choose another name"
            )
        result = output_result(name, value)
        by_speeds = eqs.system.by_speeds(result.expressions)
        results.append(Result(name, result.meaning, by_speeds, result.shape))
    return tuple(results)


def _routine(name: str, meaning: str, *results: Result) -> Routine:
    return Routine(name, meaning, (), results)


def _check_time_functions(outputs: Mapping[str, Output], eqs: Equations, routines: Iterable[Routine]) -> None:
    """Raise an error that names the first output with a function of time that the equations don't know."""
    motion = {*eqs.coordinates, *eqs.speeds, *eqs.states, *eqs.accelerations, *eqs.multipliers}
    inputs = {leaf.name for leaf in leaves_of(routines) if leaf.kind == "time_function"}
    inputs -= {leaf.name for leaf in motion}
    for name, value in outputs.items():
        leaves = {
            leaf for leaf in free_symbols(output_result(name, value).expressions) if leaf.depends_on_time
        }
        known = {*motion, t, *(leaf for leaf in leaves - {t} if leaf.name in inputs)}
        strange = {leaf for leaf in leaves if not _moving(eqs.system.by_speeds([leaf])) <= known}
        if strange:
            first = min(strange, key=by_name)
            raise ProgramError(
                f"program: the output {name} holds {first}, which isn't in the equations of motion; expected "
                "an expression of coordinates, speeds, accelerations, multipliers, parameters, inputs and time"
            )


def _moving(expressions: Sequence[Expr]) -> set[Expr]:
    return {leaf for leaf in free_symbols(expressions) if leaf.depends_on_time}
