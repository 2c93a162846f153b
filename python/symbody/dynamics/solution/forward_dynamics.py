"""Forward dynamics: the accelerations by positions, speeds and loads, as expressions.

Unconstrained equations are ``M u' = f``. They are solved over the tree, without M (`articulated_body.py`), or by the
factors ``M = L D L^T`` ("ldl"). Constrained ones are a saddle point [Benzi, Golub & Liesen 2005]:

    [ M      phi_q^T ] [    u'   ]   [  f ]
    [ phi_q     0    ] [ -lambda ] = [ -c ]        c is phi'' at u' = 0, and Baumgarte's terms

The multipliers come from the Schur complement ``phi_q M^-1 phi_q^T``, the accelerations from the null space of phi_q,
or both from the whole matrix with pivoting.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial

from symbody.dynamics.display.solution_page import SolutionPage
from symbody.dynamics.equations.baumgarte import Damping
from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.equations.singular_mass import described_singularity
from symbody.dynamics.recursion import articulated_body
from symbody.dynamics.tree.frame_tree import FrameTree
from symbody.errors import DivisionByZeroError, ExpressionError, ModelError
from symbody.geometry.given.argument import checked
from symbody.multibody import System, Variables
from symbody.symbolic import (
    MOTION,
    Expr,
    are_small,
    cost,
    derivation,
    free_symbols,
    latex,
    ldl_solve,
    number,
    saddle_point_solve,
    subs,
    substitute,
    without_idle_symbols,
)
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.latex_layout import displayed, one_formula
from symbody.symbolic.given.arguments import brief, counted
from symbody.symbolic.linear.block_triangular import LARGEST, block_triangular

from .embedded import without_freedom


@dataclass(frozen=True)
class ForwardDynamics:
    """The solution of the equations of motion for accelerations and multipliers.

    Attributes:
        accelerations: the rates of the speeds, n, in their order.
        multipliers: the multipliers, m, in the order of the constraints.
        method: how they were found.
        conditions: expressions that must be positive for the solution to be accurate; none for most methods.
        equation_names: names for the rows of the linear system that is solved at run time, which follow the word
            "equation" in messages, as `lambdify` takes them; empty if there is no such system.
        system: the system whose accelerations they are, by which `show` and `latex` name them.

    >>> from symbody import Body, System, Vector, forward_dynamics, functions_of_time, ground, newton_euler, symbols
    >>> from symbody import rotate, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    >>> solution = forward_dynamics(newton_euler(pendulum))
    >>> solution.method, solution.accelerations
    ('articulated_body', (-g*sin(theta)/l,))
    >>> print(solution.description())
    ACCELERATIONS of theta
        theta'' = -g*sin(theta)/l
    """

    accelerations: tuple[Expr, ...]
    multipliers: tuple[Expr, ...]
    method: str
    conditions: tuple[Expr, ...] = ()
    equation_names: tuple[str, ...] = ()
    system: Variables | None = field(default=None, repr=False, compare=False)

    def description(self) -> str:
        """Return a line for each acceleration and multiplier: what `show` prints. Of long ones, sizes are returned."""
        return repr(self) if self.system is None else self._page(self.system).description()

    def latex(self) -> str:
        """Return the accelerations and multipliers in LaTeX, a row for each. Of long ones, sizes are returned."""
        if self.system is None:
            return latex((*self.accelerations, *self.multipliers))
        return self._page(self.system).latex()

    def _repr_latex_(self) -> str:
        return displayed(one_formula(self.latex()))

    def _page(self, system: Variables) -> SolutionPage:
        unknowns = (*system.accelerations, *system.multipliers)
        values = (*self.accelerations, *self.multipliers)
        return SolutionPage(system, dict(zip(unknowns, values, strict=True)))

    @property
    def equations_together(self) -> str:
        """What the equations of the linear system that is solved at run time are called together, in messages."""
        by_multipliers = self.method == "schur_complement"
        return "the equations of the multipliers" if by_multipliers else "the equations of motion"

    def put_into(self, eqs: Equations, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions in which accelerations and multipliers are replaced by this solution.

        Args:
            eqs: the equations of motion that are solved.
            expressions: expressions of the motion, such as the rates of states.
        """
        unknowns = (*eqs.accelerations, *eqs.multipliers)
        return substitute(
            expressions, dict(zip(unknowns, (*self.accelerations, *self.multipliers), strict=True))
        )

    def without_idle_symbols(self) -> ForwardDynamics:
        """Return the solution in forms without symbols on which its values don't depend."""
        return _rebuilt(self, without_idle_symbols(_parts(self)))


def _parts(solution: ForwardDynamics) -> tuple[Expr, ...]:
    return (*solution.accelerations, *solution.multipliers, *solution.conditions)


def _rebuilt(solution: ForwardDynamics, parts: Sequence[Expr]) -> ForwardDynamics:
    n, m = len(solution.accelerations), len(solution.multipliers)
    values = tuple(parts)
    return replace(
        solution, accelerations=values[:n], multipliers=values[n : n + m], conditions=values[n + m :]
    )


contains(ForwardDynamics, Container(_parts, _rebuilt, advice="its accelerations have one"))


@checked(ModelError)
def forward_dynamics(eqs: Equations, *, method: str = "auto", baumgarte: Damping = None) -> ForwardDynamics:
    """Return the accelerations and multipliers that solve ``M q'' = forcing + phi_q^T lambda`` and ``phi'' = 0``.

    Args:
        eqs: the equations of motion.
        method: "articulated_body": a recursion whose length is proportional to the number of bodies, for trees in
            which every speed drives one motion. "ldl": elimination in the mass matrix, for unconstrained equations.
            "schur_complement": the same for constrained ones; a linear system of the multipliers is solved at run
            time. "null_space": by independent speeds, for constrained equations, without a linear system at run time.
            It is inaccurate at states where other speeds should be the independent ones; `conditions` shows these.
            "pivoted": a linear system that is solved at run time, for any equations. "auto": the shortest of those
            that are accurate everywhere.
        baumgarte: omega and zeta of ``phi'' + 2 zeta omega phi' + omega^2 phi = 0``, which replaces ``phi'' = 0``.

    Raises:
        ModelError: the method doesn't apply to these equations, or a coordinate moves no mass.

    >>> from symbody import Body, Force, System, functions_of_time, ground, newton_euler, symbols, translate
    >>> x, (m, F) = functions_of_time("x"), symbols("m F")
    >>> body = Body(translate(x, 0, 0), m)
    >>> push = Force(ground, F, 0, 0, at=body.center_of_mass, on=body)
    >>> forward_dynamics(newton_euler(System([body], [push], [x]))).accelerations
    (F/m,)
    """
    if method not in _METHODS:
        raise ModelError(f"forward_dynamics: the method {method!r}; expected one of {', '.join(_METHODS)}")
    if baumgarte is not None and not eqs.constraints:
        raise ModelError(
            "forward_dynamics: Baumgarte's stabilisation without constraints; leave baumgarte out"
        )
    found = _without_scale(_METHODS[method](eqs, baumgarte), eqs, method, baumgarte)
    return replace(found, equation_names=_equation_names(eqs, found.method), system=eqs.system)


def _without_scale(
    found: ForwardDynamics, eqs: Equations, method: str, baumgarte: Damping
) -> ForwardDynamics:
    """Return a solution whose accelerations are free of a factor of all equations, such as the mass of a rolling disc.

    ``M u' = f + phi_q^T lambda`` times m has the same accelerations, and m times the multipliers. It is as accurate, so
    the conditions are those without the factor, too.

    Args:
        found: the solution with the factor.
        eqs: the equations of motion.
        method: the method by which they are solved.
        baumgarte: omega and zeta of the stabilisation.
    """
    scale = _scale(eqs, found.accelerations) if found.method != "articulated_body" else None
    if scale is None:
        return found
    other = _METHODS[method](subs(eqs, {scale: 1}), baumgarte)
    other = replace(other, multipliers=tuple(scale * each for each in other.multipliers))
    is_same = (*other.accelerations, *other.multipliers) == (*found.accelerations, *found.multipliers)
    is_shorter = _operations(other) <= _operations(found)
    return other if is_same and is_shorter else found


def _operations(solution: ForwardDynamics) -> int:
    return cost((*solution.accelerations, *solution.multipliers)).total


def _scale(eqs: Equations, accelerations: Sequence[Expr]) -> Expr | None:
    """Return a parameter of the accelerations that multiplies all equations: ``r(m, lambda) = m r(1, lambda/m)``."""
    residuals = [residual for residual in eqs.derived_residuals if not residual.is_zero]
    candidates = {leaf for leaf in free_symbols(accelerations) if leaf.kind == "symbol"}
    for residual in residuals:
        candidates &= residual.free_symbols
    for each in sorted(candidates, key=str):
        unknowns = {multiplier: multiplier / each for multiplier in eqs.multipliers}
        try:
            at_one = substitute(substitute(residuals, {each: number(1)}), unknowns)
        except (DivisionByZeroError, ExpressionError):  # undefined there
            continue
        if all(each * part == residual for residual, part in zip(residuals, at_one, strict=True)):
            return each
    return None


def _equation_names(eqs: Equations, method: str) -> tuple[str, ...]:
    conditions = eqs.system.conditions
    constraints = tuple(
        f"of {condition.name}" if condition.name else str(constraint)
        for condition, constraint in zip(conditions, eqs.constraints, strict=True)
    )
    speeds = tuple(f"of {speed}" for speed in eqs.speeds)
    return {"schur_complement": constraints, "pivoted": speeds + constraints}.get(method, ())


def _shortest(eqs: Equations, baumgarte: Damping) -> ForwardDynamics:
    if eqs.constraints:
        return _shortest_with_constraints(eqs, baumgarte)
    if isinstance(eqs.system, System) and not are_small(eqs.speeds):
        with derivation(fresh=True, order=MOTION):
            tree = articulated_body.articulated_tree(eqs.system)
            recursive = articulated_body.is_applicable(eqs.system, tree)
        if recursive:
            return _shortest_for_tree(eqs, tree)
    M = eqs.mass_matrix
    if M == M.T:
        try:
            return _ldl(eqs, None)
        except ModelError:
            if M.rank() < M.rows:
                raise
    singular = described_singularity(M, eqs.speeds)
    if singular:
        raise ModelError(f"forward_dynamics: {singular}")
    return _by_saddle_point("pivoted", eqs, None)


def _shortest_with_constraints(eqs: Equations, baumgarte: Damping) -> ForwardDynamics:
    """Eliminate the mass matrix, unless that is impossible, or takes too much text for a compiler.

    If constraints depend on each other, the whole system is solved at run time. The minimum-norm multipliers
    must be distinguished from rounding errors then, and the Schur complement, a product of three matrices, has more of
    these.
    """
    entries = sum(not entry.is_zero for entry in eqs.mass_matrix.entries)
    if entries <= _MOST_ENTRIES and eqs.constraint_jacobian.rank() == len(eqs.constraints):
        with suppress(ModelError):
            return _eliminated("schur_complement", eqs, baumgarte)
    return _by_saddle_point("pivoted", eqs, baumgarte)


_MOST_ENTRIES = 2000
"""Nonzero entries of a mass matrix up to which it is eliminated in symbols."""


def _shortest_for_tree(eqs: Equations, tree: FrameTree) -> ForwardDynamics:
    """Return the shorter of recursion and elimination; if one meets a pivot that is identically zero, the other."""
    try:
        recursion = _articulated_body(eqs, None)
    except ModelError as failure:
        with suppress(ModelError):
            return _ldl(eqs, None)
        raise failure from None
    shortest = cost(recursion.accelerations).total
    if _least_elimination(tree) >= shortest:
        return recursion
    elimination = _ldl(eqs, None)
    return elimination if cost(elimination.accelerations).total < shortest else recursion


def _least_elimination(tree: FrameTree) -> int:
    """Return a lower bound of the operations of elimination: ``k (k + 5)`` for a coordinate beyond k others."""
    beyond, total = [0] * len(tree.frames), 0
    for place in range(1, len(tree.frames)):
        beyond[place] = beyond[tree.parents[place]]
        for _ in tree.moved_by[place]:
            total += beyond[place] * (beyond[place] + 5)
            beyond[place] += 1
    return total


def _articulated_body(eqs: Equations, _: Damping) -> ForwardDynamics:
    system = eqs.system
    if not isinstance(system, System):
        raise ModelError(
            "forward_dynamics: the articulated-body recursion is for systems of bodies, and these equations were given "
            "without bodies; use method='auto'"
        )
    if are_small(eqs.speeds):
        raise ModelError(
            "forward_dynamics: the articulated-body recursion doesn't know which accelerations are small; use "
            "method='auto'"
        )
    with derivation(fresh=True, order=MOTION):
        tree = articulated_body.articulated_tree(system)
        if not articulated_body.is_applicable(system, tree):
            raise ModelError(
                "forward_dynamics: the articulated-body recursion is for trees without constraints, each coordinate "
                "of which drives one rigid motion alone, and loads without accelerations; use method='auto'"
            )
        accelerations = articulated_body.accelerations(system, tree)
    return ForwardDynamics(accelerations, (), "articulated_body").without_idle_symbols()


def _ldl(eqs: Equations, _: Damping) -> ForwardDynamics:
    M = eqs.mass_matrix
    if eqs.constraints or M != M.T:
        raise ModelError(
            "forward_dynamics: elimination without pivoting is for symmetric mass matrices and no constraints; "
            "use method='pivoted'"
        )
    with derivation(fresh=True, order=MOTION):
        try:
            accelerations = ldl_solve(M, [-entry for entry in eqs.bias])
        except ExpressionError as failure:
            raise ModelError(_massless(eqs, failure)) from failure
    return ForwardDynamics(accelerations, (), "ldl").without_idle_symbols()


def _eliminated(method: str, eqs: Equations, baumgarte: Damping) -> ForwardDynamics:
    """Solve ``M q'' = forcing + phi_q^T lambda, phi_q q'' = -bias of phi''`` without pivoting in M."""
    if not eqs.constraints or eqs.mass_matrix != eqs.mass_matrix.T:
        raise ModelError(
            f"forward_dynamics: the method {method!r} is for symmetric mass matrices and constraints; use method='auto'"
        )
    try:
        return _by_saddle_point(method, eqs, baumgarte)
    except ExpressionError as failure:
        entangled = _without_blocks(eqs) if method == "null_space" else ""
        if entangled:
            raise ModelError(f"forward_dynamics, method='null_space': {entangled}") from failure
        raise ModelError(_massless(eqs, failure)) from failure


def _by_saddle_point(method: str, eqs: Equations, baumgarte: Damping) -> ForwardDynamics:
    with derivation(fresh=True, order=MOTION):
        right = [-entry for entry in eqs.constraint_bias(*(baumgarte or (0, 0)))] if eqs.constraints else []
        forcing = tuple(-entry for entry in eqs.bias)  # in the forms of this derivation
        solution = saddle_point_solve(eqs.mass_matrix, eqs.constraint_jacobian, forcing, right, method)
    return ForwardDynamics(solution.x, solution.y, method, solution.conditions).without_idle_symbols()


def _without_blocks(eqs: Equations) -> str:
    """Return why the constraints don't give dependent speeds in small blocks; the empty text if they do."""
    A = eqs.constraint_jacobian
    rank, count = A.rank(), len(eqs.constraints)
    if rank < count:
        return (
            f"the rank of {counted(count, 'constraint')} is {rank}: some depend on others; leave out those, which "
            "system.mobility(parameters, q) names, or use method='auto'"
        )
    if rank == len(eqs.speeds):
        return f"{without_freedom(eqs)}, or use method='auto'"
    try:
        block_triangular(A)
    except ExpressionError:
        return (
            f"the constraints on {brief(', '.join(map(str, eqs.speeds)))} are entangled: more than {LARGEST} of them "
            "have to be solved together, and the inverse would be too long; use method='auto'"
        )
    return ""


def _massless(eqs: Equations, failure: ExpressionError) -> str:
    singular = described_singularity(eqs.mass_matrix, eqs.speeds)
    if singular:
        way_out = (
            "; method='pivoted' solves the equations if constraints determine it" if eqs.constraints else ""
        )
        return f"forward_dynamics: {singular}{way_out}"
    names = ", ".join(map(str, eqs.speeds))
    return f"forward_dynamics: the mass matrix of {names}: {failure}; use method='pivoted'"


_METHODS: dict[str, Callable[[Equations, Damping], ForwardDynamics]] = {
    "auto": _shortest,
    "articulated_body": _articulated_body,
    "ldl": _ldl,
    "schur_complement": partial(_eliminated, "schur_complement"),
    "null_space": partial(_eliminated, "null_space"),
    "pivoted": partial(_by_saddle_point, "pivoted"),
}
