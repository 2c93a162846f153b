"""What a simulation evaluates: expressions of time, state and parameters, and their machine code."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache

from symbody.codegen import CompiledFunction, PreparedCode, lambdify
from symbody.dynamics import Equations, ForwardDynamics, forward_dynamics
from symbody.multibody import System, gravitational_energy, kinetic_energy, power
from symbody.symbolic import (
    Expr,
    ExprLike,
    Matrix,
    derivation,
    free_symbols,
    linear_solve,
    number,
    saddle_point_solve,
    substitute,
    symbols,
    t,
)
from symbody.symbolic import jacobian as jacobian_of

__all__ = ["DAMPING", "Model", "model_of"]

DAMPING = symbols("baumgarte_omega baumgarte_zeta")
"""The parameters of Baumgarte's stabilisation, whose values are chosen when a simulation begins."""

Inputs = Mapping[Expr, ExprLike]


@dataclass(frozen=True, eq=False)
class Model:
    """The functions of a system that its simulations share; each is derived and compiled when it is first needed.

    The state is ``(q, u)``, coordinates and speeds, and behind them the work of loads and moving constraints, where
    there is some: ``dE/dt`` is its rate, so that the balance of energy can be checked along any motion.

    Attributes:
        equations: the equations of motion.
        inputs: what is put in the place of functions of time that are given from outside.
        is_stabilized: whether the constraints are kept by Baumgarte's stabilisation.
        method: how the accelerations are found, as `forward_dynamics` takes it.
    """

    equations: Equations
    inputs: tuple[tuple[Expr, Expr], ...] = ()
    is_stabilized: bool = False
    method: str = "auto"
    _functions: dict[tuple[tuple[Expr, ...], ...], CompiledFunction] = field(default_factory=dict, repr=False)

    @property
    def system(self) -> System:
        """What moves."""
        return self.equations.system

    @property
    def coordinates(self) -> tuple[Expr, ...]:
        """The coordinates q."""
        return self.equations.coordinates

    @property
    def speeds(self) -> tuple[Expr, ...]:
        """The speeds u."""
        return self.equations.speeds

    @property
    def state(self) -> tuple[Expr, ...]:
        """The coordinates and the speeds, without the work."""
        return self.coordinates + self.speeds

    @property
    def accelerations(self) -> tuple[Expr, ...]:
        """The rates of the speeds."""
        return self.equations.accelerations

    @property
    def multipliers(self) -> tuple[Expr, ...]:
        """The multipliers of the constraints."""
        return self.equations.multipliers

    @property
    def constraints(self) -> tuple[Expr, ...]:
        """The constraints, expressions that are zero."""
        return self.equations.constraints

    @cached_property
    def independent_constraints(self) -> int:
        """How many constraints are independent at almost every position."""
        return self.equations.constraint_jacobian.rank()

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, by name: those of the equations and of the inputs."""
        given = free_symbols([value for _, value in self.inputs])
        found = {*self.equations.parameters, *(leaf for leaf in given if _is_parameter(leaf))}
        return tuple(sorted(found, key=lambda symbol: symbol.name))

    @property
    def damping(self) -> tuple[Expr, ...]:
        """The frequency and the damping ratio of Baumgarte's stabilisation, where there is one."""
        return DAMPING if self.is_stabilized else ()

    @cached_property
    def solution(self) -> ForwardDynamics:
        """The accelerations and multipliers by time, state and parameters."""
        damping = DAMPING if self.is_stabilized else None
        solution = forward_dynamics(self.equations, method=self.method, baumgarte=damping)
        return ForwardDynamics(
            self.with_inputs(solution.accelerations), self.with_inputs(solution.multipliers), solution.method
        )

    @cached_property
    def equation_names(self) -> list[str]:
        """What to call the rows of the linear system that is solved at run time."""
        constraints = [str(constraint) for constraint in self.constraints]
        if self.solution.method == "schur_complement":
            return constraints
        return [f"the equation of {speed}" for speed in self.speeds] + constraints

    @cached_property
    def kinematics(self) -> tuple[Expr, ...]:
        """The rates of the coordinates by the speeds."""
        return tuple(self.equations.kinematics.values())

    @cached_property
    def power(self) -> Expr | None:
        """The power of loads and moving constraints; None where nothing does work."""
        total = sum((power(load) for load in self.system.loads), start=number(0))
        if self.constraints:
            at_rest = dict.fromkeys(self.speeds, number(0))
            drifts = substitute(self.system.rate(self.constraints), at_rest)
            for multiplier, drift in zip(self.multipliers, drifts, strict=True):
                total -= multiplier * drift
        return None if total.is_zero else self.along_motion([total])[0]

    @cached_property
    def rates(self) -> tuple[Expr, ...]:
        """The rates of the coordinates, of the speeds, and of the work."""
        work = () if self.power is None else (self.power,)
        return (*self.with_inputs(self.kinematics), *self.solution.accelerations, *work)

    @property
    def width(self) -> int:
        """The length of the vector that is integrated."""
        return len(self.state) + (self.power is not None)

    @cached_property
    def corrections(self) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
        """The least changes of coordinates and of speeds that lead onto the constraints, to first order.

        ``M d = phi_q^T mu, phi_q d = -phi`` [Eich 1993]: least in kinetic energy, so that lengths and angles weigh
        what they should. The coordinates follow by the kinematics.
        """
        with derivation(fresh=True):
            change = self._least_change(self.constraints)
            speeds = self._least_change(self.system.rate(self.constraints))
            at_rest = substitute(self.kinematics, dict.fromkeys(self.speeds, number(0)))
            moved = substitute(self.kinematics, dict(zip(self.speeds, change, strict=True)))
            coordinates = [rate - rest for rate, rest in zip(moved, at_rest, strict=True)]
        return self.with_inputs(coordinates), self.with_inputs(speeds)

    def _least_change(self, left: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the solution d of ``M d = phi_q^T mu`` and ``phi_q d = -left``."""
        M, J = self.equations.mass_matrix, self.equations.constraint_jacobian
        n, m, nothing = M.rows, J.rows, number(0)
        if self.solution.method == "schur_complement":
            return saddle_point_solve(M, J, [nothing] * n, [-value for value in left])[0]
        upper = [[*M.row(i), *(-J[k, i] for k in range(m))] for i in range(n)]
        matrix = Matrix([*upper, *([*J.row(k), *[nothing] * m] for k in range(m))])
        return linear_solve(matrix, [*[nothing] * n, *(-value for value in left)])[:n]

    @cached_property
    def kinetic_energy(self) -> Expr:
        """The kinetic energy."""
        return self.with_inputs([kinetic_energy(self.system.bodies)])[0]

    @cached_property
    def potential_energy(self) -> Expr | None:
        """The potential energy of weight; None without gravity, or where nobody knows the height."""
        gravity = self.system.gravity
        if gravity is None or self.system.root.carrier is not None:
            return None
        return self.with_inputs([gravitational_energy(self.system.bodies, gravity)])[0]

    def with_inputs(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the expressions with what is given for the inputs, and rates of coordinates by the speeds."""
        given = substitute(expressions, dict(self.inputs)) if self.inputs else tuple(expressions)
        return substitute(given, self.system.known_rates) if self.system.known_rates else given

    def along_motion(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the expressions with the accelerations and multipliers that the equations of motion give."""
        found, unknown = free_symbols(list(expressions)), {*self.accelerations, *self.multipliers}
        if found.isdisjoint(unknown):
            return self.with_inputs(expressions)
        values = {
            **dict(zip(self.accelerations, self.solution.accelerations, strict=True)),
            **dict(zip(self.multipliers, self.solution.multipliers, strict=True)),
        }
        return substitute(self.with_inputs(expressions), values)

    @cached_property
    def integrated(self) -> tuple[Expr, ...]:
        """The variables of compiled code: time, the state, and the work, of which nothing depends."""
        return (t, *self.state, *([_WORK] if self.power is not None else []))

    def code(self, expressions: Sequence[Expr], more: Sequence[Expr] = ()) -> PreparedCode:
        """Return the machine code of expressions of time and state, and of more parameters than the equations have."""
        return PreparedCode((*self.parameters, *self.damping, *more), self.integrated, tuple(expressions))

    @cached_property
    def rates_code(self) -> PreparedCode:
        """The machine code of the rates."""
        return self.code(self.rates)

    @cached_property
    def correction_codes(self) -> tuple[PreparedCode, PreparedCode]:
        """The machine code of the corrections."""
        coordinates, speeds = self.corrections
        return self.code(coordinates), self.code(speeds)

    @cached_property
    def jacobian_code(self) -> tuple[PreparedCode, list[tuple[int, int]]]:
        """The machine code of the derivatives of the rates that aren't zero, and their rows and columns."""
        slopes = jacobian_of(list(self.rates), list(self.state))
        rows, columns = slopes.shape
        places = [(i, j) for i in range(rows) for j in range(columns) if not slopes[i, j].is_zero]
        return self.code([slopes[place] for place in places]), places

    def function(self, expressions: Sequence[Expr], parameters: tuple[Expr, ...]) -> CompiledFunction:
        """Return a function of time, state and parameters that evaluates expressions along motions."""
        key = (tuple(expressions), parameters)
        if key not in self._functions:
            values = list(self.along_motion(key[0]))
            arguments = [t, *self.state, *parameters]
            self._functions[key] = lambdify(arguments, values, equation_names=self.equation_names)
        return self._functions[key]


_WORK = symbols("work_of_loads")
"""Stands for the work in the list of variables."""


def _is_parameter(leaf: Expr) -> bool:
    return leaf.kind == "symbol" and not leaf.depends_on_time


@lru_cache(maxsize=32)
def _model(eqs: Equations, inputs: tuple[tuple[Expr, Expr], ...], is_stabilized: bool, method: str) -> Model:  # noqa: FBT001 - a key of the cache
    return Model(eqs, inputs, is_stabilized, method)


def model_of(
    eqs: Equations,
    inputs: Inputs | None = None,
    *,
    is_stabilized: bool = False,
    zeros: Collection[Expr] = (),
) -> Model:
    """Return the model of equations with given inputs, the same for the same: what it compiled is used again.

    Args:
        eqs: the equations of motion.
        inputs: what to put in the place of functions of time that are given from outside.
        is_stabilized: whether the constraints are kept by Baumgarte's stabilisation.
        zeros: parameters whose value is zero. Where they leave coordinates without mass, which constraints may move
            none the less, the mass matrix isn't eliminated.
    """
    given = tuple(
        sorted(((key, number(value)) for key, value in (inputs or {}).items()), key=lambda pair: str(pair[0]))
    )
    return _model(eqs, given, is_stabilized, "pivoted" if _is_massless(eqs, zeros) else "auto")


def _is_massless(eqs: Equations, zeros: Collection[Expr]) -> bool:
    M = eqs.mass_matrix
    vanishing = {zero: number(0) for zero in zeros if zero in eqs.parameters}
    return bool(eqs.constraints and vanishing) and M.rank() == M.rows != M.subs(vanishing).rank()
