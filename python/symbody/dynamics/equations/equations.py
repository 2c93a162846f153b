"""Equations of motion: what every formalism returns."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

from symbody.deferred import cached_property
from symbody.dynamics.display.display import Display
from symbody.dynamics.display.equation_page import EquationPage
from symbody.dynamics.display.matrix_form import MatrixForm
from symbody.errors import ModelError
from symbody.geometry import Scalar
from symbody.geometry.given.argument import checked
from symbody.multibody import System, Variables
from symbody.symbolic import (
    MOTION,
    Expr,
    Matrix,
    Program,
    are_small,
    derivation,
    free_symbols,
    seemingly_idle_symbols,
    truncated,
    with_numbers_for_idle_symbols,
    without_idle_symbols,
)
from symbody.symbolic.calculus.cost import operations
from symbody.symbolic.calculus.multiplied_out import multiplied_out_if_cheaper
from symbody.symbolic.expression.container import Container, contains, substituted
from symbody.symbolic.given.arguments import counted
from symbody.symbolic.numeric.program import program_of

from .baumgarte import Damping, stabilized_beside
from .constraint_bias import by_jacobian, by_second_rate, is_shorter_by_jacobian
from .constraint_force import constraint_jacobian
from .constraint_form import in_shortest_form
from .output import Outputs

Known = TypeVar("Known")


@dataclass(frozen=True)
class Assembly:
    """The coefficients of the equations ``M u' + bias = phi_q^T lambda``.

    Attributes:
        mass_matrix: M, n x n for n speeds.
        bias: one expression per speed.
    """

    mass_matrix: Matrix
    bias: tuple[Expr, ...]

    @classmethod
    def of_entries(cls, entries: Sequence[Expr], n: int) -> Assembly:
        """Return the coefficients by their entries: those of M, n x n and row by row, then those of the bias."""
        return cls(Matrix.from_entries(n, n, entries[: n * n]), tuple(entries[n * n :]))

    def of_first_order(self, system: Variables) -> Assembly:
        """Return the coefficients without the terms that small variables make negligible in ``M u' + bias``.

        An entry of M keeps terms of degree 0 if the rates of both of its speeds are small, and of degree 1 if not, so
        that M stays symmetric.
        """
        if not are_small((*self.mass_matrix.entries, *self.bias)):
            return self
        small = [are_small([u]) for u in system.speeds]
        n = len(small)
        entries = self.mass_matrix.entries
        resting, varying = truncated(entries, 0), truncated(entries, MOTION)
        kept = [resting[k] if small[k // n] and small[k % n] else varying[k] for k in range(len(entries))]
        return Assembly(Matrix.from_entries(n, n, kept), truncated(self.bias, MOTION))

    def without_idle_symbols(self) -> Assembly:
        """Return the coefficients in forms without symbols on which their values don't depend."""
        n = len(self.bias)
        entries = without_idle_symbols((*self.mass_matrix.entries, *self.bias))
        if len(entries) <= _MOST_ENTRIES:
            entries = _each_without_idle_symbols(entries)
        return Assembly.of_entries(entries, n)


_MOST_ENTRIES = 60
"""The most entries for which symbols are looked for that are idle in one entry and not in others."""


def _each_without_idle_symbols(entries: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Return entries without symbols that are idle in one of them, if all together take fewer operations.

    Those that are numbers are written as such in any case.
    """
    idle = {entry: found for entry in dict.fromkeys(entries) if (found := seemingly_idle_symbols((entry,)))}
    bare: dict[Expr, Expr] = {}
    for entry in [entry for entry, found in idle.items() if entry.free_symbols <= {*found}]:
        form = without_idle_symbols((entry,))[0]
        if form.is_number:
            bare[entry] = form
            del idle[entry]
    numbers = tuple(bare.get(entry, entry) for entry in entries)
    if not idle or not _may_pay(numbers, [*idle]):
        return numbers
    bare |= {entry: without_idle_symbols((entry,))[0] for entry in idle}
    rewritten = tuple(bare.get(entry, entry) for entry in entries)
    return rewritten if operations(rewritten) < operations(numbers) else numbers


def _may_pay(entries: Sequence[Expr], idle: Sequence[Expr]) -> bool:
    """Return whether entries may take fewer operations if those with idle symbols are rewritten.

    Not so if the latter share nearly all of their operations with the others. Else numbers take the places of the
    symbols in one entry after another until all take no fewer operations even without the rest. The last ones come
    first: those of the bias are the longest as a rule.
    """
    fewest = operations(entries)
    made = [entry for entry in entries if entry not in idle]
    if fewest - operations(made) < _LEAST_OWN * operations(idle):
        return False
    for entry in reversed(idle):
        made += with_numbers_for_idle_symbols((entry,))
        if operations(made) >= fewest:
            return False
    return True


_LEAST_OWN = 0.22
"""Entries with idle symbols are rewritten if at least this part of their operations is in no other entry: where fewer
are, as of chains in space with 5 to 20 %, rewriting has not paid; the least part with which it has is 23 %."""


@dataclass(frozen=True, eq=False)
class Equations:
    """The equations of motion of a system: ``M u' = forcing + phi_q^T lambda`` with the constraints ``phi = 0``.

    There are n speeds u and m constraints. The speeds are the rates of the coordinates, so that ``M u'`` is ``M q''``.
    Where frames move by speeds of their own (quasi-velocities), `kinematics` gives the rates of the coordinates, and
    phi_q is ``dphi'/du``. A constraint on velocities, ``A u + b = 0``, has A as its rows of phi_q.

    Attributes:
        system: the system to which they belong; of equations that were given without bodies, their variables.
        derive: derives the residuals when they are first needed; the mass matrix and the bias don't need them.
        assemble: derives the mass matrix and the bias when they are first needed; the residuals don't need them.
        energy: the energy of equations that were given without bodies, if it is known.
        whole: the equations with constraints of which these are embedded ones; their terms are shown.

    >>> from symbody import Body, System, functions_of_time, newton_euler, symbols, translate
    >>> (x, y), (m, l) = functions_of_time("x y"), symbols("m l")
    >>> circle = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x**2 + y**2 - l**2])
    >>> equations = newton_euler(circle)
    >>> equations
    Equations(2 equations of motion, 1 constraint, coordinates x, y)
    >>> equations.mass_matrix, equations.constraint_jacobian
    (Matrix([[m, 0], [0, m]]), Matrix([[2*x, 2*y]]))
    """

    system: Variables
    derive: Callable[[Any], tuple[Expr, ...]]
    assemble: Callable[[Any], Assembly]
    energy: Expr | None = None
    whole: Equations | None = None

    @cached_property
    def derived_residuals(self) -> tuple[Expr, ...]:
        """The residuals in the form in which they were derived, of which they are simulated, solved and shown."""
        return self.derive(self.system)

    @cached_property
    def residuals(self) -> tuple[Expr, ...]:
        """The n expressions ``M u' - forcing - phi_q^T lambda``, which are zero along a motion.

        Like terms are collected where that takes fewer operations.
        """
        if isinstance(self.derive, Derived) and self.derive.is_asked_for:
            return self.derived_residuals
        return multiplied_out_if_cheaper(self.derived_residuals, self.accelerations)

    @property
    def coordinates(self) -> tuple[Expr, ...]:
        """The coordinates q."""
        return self.system.coordinates

    @property
    def speeds(self) -> tuple[Expr, ...]:
        """The speeds u, in the order of the equations: quasi-velocities, then rates of coordinates."""
        return self.system.speeds

    @property
    def accelerations(self) -> tuple[Expr, ...]:
        """The rates of the speeds."""
        return self.system.accelerations

    @property
    def kinematics(self) -> dict[Expr, Expr]:
        """The rates of the coordinates, each by the speeds: the rates are the keys."""
        values = self.system.kinematics
        return dict(zip(values, truncated([*values.values()], MOTION), strict=True))

    @property
    def states(self) -> tuple[Expr, ...]:
        """The states z beside the mechanics, functions of time whose rates are given."""
        return self.system.states

    @cached_property
    def state_rates(self) -> dict[Expr, Expr]:
        """The rates z' of the states, which may contain accelerations and multipliers: the rates are the keys."""
        values = self.system.state_rates
        return dict(zip(values, truncated([*values.values()], MOTION), strict=True))

    @cached_property
    def constraints(self) -> tuple[Expr, ...]:
        """The constraints, expressions that are zero: phi on positions, or ``A u + b`` on velocities."""
        return truncated(self.system.constraints, MOTION)

    @cached_property
    def constraint_jacobian(self) -> Matrix:
        """The Jacobian A of ``A u + b``, m x n: ``phi_q = dphi'/du``, one row per constraint, one column per speed."""
        return constraint_jacobian(self.system)

    def constraint_bias(self, omega: Scalar = 0, zeta: Scalar = 0) -> tuple[Expr, ...]:
        """Return c of ``A u' + c = 0``, m: the constraints' accelerations at zero rates of the speeds.

        Args:
            omega: the frequency of Baumgarte's stabilisation, in rad/s; none by default.
            zeta: its damping ratio.
        """
        form = by_jacobian if self._has_shorter_jacobian_rate else by_second_rate
        return form(self.system, self._short_constraints, self.constraint_jacobian, omega, zeta)

    @cached_property
    def _has_shorter_jacobian_rate(self) -> bool:
        return is_shorter_by_jacobian(self.system, self._short_constraints, self.constraint_jacobian)

    @property
    def _short_constraints(self) -> tuple[Expr, ...]:
        """The constraints in the form of which the Jacobian is made."""
        return in_shortest_form(self.system, self.constraints)

    @property
    def multipliers(self) -> tuple[Expr, ...]:
        """The multipliers, one per constraint."""
        return self.system.multipliers

    @cached_property
    def _assembly(self) -> Assembly:
        return self.assemble(self.system)

    @property
    def mass_matrix(self) -> Matrix:
        """The mass matrix M, n x n; symmetric, unless loads depend on accelerations."""
        return self._assembly.mass_matrix

    @property
    def bias(self) -> tuple[Expr, ...]:
        """The residuals at zero accelerations and multipliers, n: inertia forces of speeds, less weight and loads."""
        return self._assembly.bias

    @cached_property
    def forcing(self) -> tuple[Expr, ...]:
        """The negative of the bias, n."""
        with derivation(fresh=True):  # its form doesn't depend on where it is read first
            return tuple(-entry for entry in self.bias)

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, by name."""
        symbols = {leaf for leaf in self._leaves if leaf.kind == "symbol" and not leaf.depends_on_time}
        return tuple(sorted(symbols, key=lambda symbol: symbol.name))

    @cached_property
    def inputs(self) -> tuple[Expr, ...]:
        """The functions of time, and their rates, that are given from outside, by name."""
        replaced = self.system.eliminated
        unknowns = (*self.coordinates, *self.speeds, *replaced, *self.states, *self.multipliers)
        known = {unknown.name for unknown in unknowns}
        given = {leaf for leaf in self._leaves if leaf.kind == "time_function" and leaf.name not in known}
        return tuple(sorted(given, key=lambda function: (function.name, function.order)))

    @cached_property
    def _leaves(self) -> frozenset[Expr]:
        rates = (*self.system.known_rates.values(), *self.state_rates.values())
        constraints = (*self.constraints, *self.system.eliminated_constraints)
        return free_symbols((*self.derived_residuals, *constraints, *rates))

    @checked(ModelError)
    def baumgarte(self, omega: Scalar, zeta: Scalar) -> tuple[Expr, ...]:
        """Return the stabilised constraints ``phi'' + 2 zeta omega phi' + omega^2 phi``, linear in the accelerations.

        Of a constraint psi on velocities, it is ``psi' + 2 zeta omega psi``.

        Args:
            omega: the frequency with which a violation dies out, in rad/s.
            zeta: its damping ratio; 1 is critical.
        """
        return stabilized_beside(self.derived_residuals, self.system, self.constraints, omega, zeta)

    def program(
        self,
        *,
        name: str | None = None,
        outputs: Outputs | None = None,
        baumgarte: Damping = None,
        method: str | None = "auto",
    ) -> Program:
        """Return the routines of which code is generated; see `dynamics/solution/equations_program.py`.

        Args:
            name: the name of the generated code, as an identifier; by default the name of the system, or "model".
            outputs: further expressions, vectors or matrices that the code computes, by name.
            baumgarte: omega (in rad/s) and zeta of the stabilisation of constraints in the forward dynamics.
            method: the method of `forward_dynamics`; None leaves out the forward dynamics.
        """
        return program_of(self, name=name, outputs=outputs, baumgarte=baumgarte, method=method)

    def __repr__(self) -> str:
        n, m, names = len(self.speeds), len(self.constraints), ", ".join(map(str, self.system.driving))
        alone = "coordinates" if len(self.system.driving) != 1 else "coordinate"
        kind = "speeds and coordinates" if self.system.quasi_velocities else alone
        kind = "momenta" if self.system.momenta else kind
        states = f", {counted(len(self.states), 'state').split()[1]} {', '.join(map(str, self.states))}"
        return (
            f"Equations({counted(n, 'equation')} of motion, {counted(m, 'constraint')}, {kind} {names}"
            f"{states if self.states else ''})"
        )

    @cached_property
    def display(self) -> Display:
        """How the equations are shown."""
        return Display(self)

    def of(self, system: System) -> Equations:
        """Return the equations of another system by the same formalism."""
        return replace(self, system=system)

    @property
    def is_readable(self) -> bool:
        """Whether the equations are written out: they have at most 1000 operations, and fill at most two pages.

        By common quantities, they fill at most three. Equations that are so short as text alone, by names of repeated
        sums, are not written out as formulas.
        """
        return self.display.is_readable

    def description(self, *, whole: bool = False) -> str:
        """Return the equations line by line as a textbook prints them: what `show` prints.

        On the left are the accelerations, each with one coefficient, products of speeds, gravity and other loads; on
        the right are given forces and those of constraints. Equations that would fill pages so, as those of arms in
        space, are written by their common quantities: velocities, accelerations, forces and torques of the bodies
        [Craig 2005, sec. 6.5]. If they fill pages all the same, the short ones and the sizes of the others are
        returned; of those of more than 1000 operations, the sizes.

        Args:
            whole: whether equations of at most 1000 operations are written out term by term, however many pages they
                fill.
        """
        return self.display.description(whole=whole)

    def equation_of(self, speed: Expr) -> EquationPage:
        """Return one equation, to be shown by itself with the names that it needs.

        Args:
            speed: the coordinate whose equation it is, its rate, or the quasi-velocity.

        Raises:
            ModelError: it is none of these.

        >>> from symbody import newton_euler, show
        >>> from symbody.models import cart_pole
        >>> model = cart_pole()
        >>> show(newton_euler(model.system).equation_of(model.system.coordinates[0]))
        EQUATION OF MOTION of x
            (M + m1)*x'' + a1*m1*cos(theta1)*theta1'' - a1*m1*sin(theta1)*theta1'**2 + b*x' = F
        """
        return self.display.equation_of(speed)

    def latex(self, *, whole: bool = False) -> str:
        r"""Return the equations and constraints in LaTeX, as a textbook prints them.

        Long ones are broken at terms, so that they are as wide as a page of the class `article`. What is higher than a
        page is the environment ``align*``, which stands outside of formulas and is broken between pages; what isn't is
        ``aligned``, within a formula. Of equations that are too long, the sizes are returned;
        ``latex(equations.equation_of(q))`` is one of them.

        Args:
            whole: whether equations of at most 1000 operations are written out, however many pages they fill.
        """
        return self.display.latex(whole=whole)

    def matrix_form(self, *, christoffel: bool = False) -> MatrixForm:
        """Return ``M q'' + c + g + loads = Q + phi_q^T lambda`` with each entry in its form for the reader.

        Equations that were given by M and f are ``M q'' = f + phi_q^T lambda``: what is weight there, and what a
        spring, isn't known.

        Args:
            christoffel: whether c(q, q') is written as C(q, q') q', by Christoffel's symbols, if it follows from M:
                with quasi-velocities, and on a moving support, it does not, and a notice (`ModelNotice`) says why.

        Raises:
            ModelError: the equations are too long to be read, as `show` tells by their sizes.
        """
        return self.display.matrix_form(christoffel=christoffel)

    def _repr_latex_(self) -> str | None:
        return self.display.notebook_latex

    def _repr_html_(self) -> str | None:
        """Return the sizes of equations that are too long to be read."""
        return self.display.notebook_html()


@dataclass(frozen=True)
class Derived(Generic[Known]):
    """Residuals, or an assembly, that are known already.

    Attributes:
        known: the residuals, or the assembly.
        is_asked_for: whether their form was given or asked for, so that they are read in no other.
    """

    known: Known
    is_asked_for: bool = False

    def __call__(self, system: object) -> Known:
        del system
        return self.known


def _parts(equations: Equations) -> tuple[object, ...]:
    return equations.residuals, *_parts_beside_residuals(equations)


def _parts_beside_residuals(equations: Equations) -> tuple[object, ...]:
    rates = tuple(equations.state_rates.values())
    return equations.constraints, equations.mass_matrix, equations.bias, rates


def _rebuilt(equations: Equations, parts: Sequence[Any]) -> Equations:
    """Return the equations in a form that was asked for; they belong to the same system."""
    residuals, *others = parts
    return _with_parts(equations, Derived(residuals, is_asked_for=True), others)


def _with_parts(equations: Equations, derive: Derived[Any], parts: Sequence[Any]) -> Equations:
    constraints, mass_matrix, bias, rates = parts
    made = replace(equations, derive=derive, assemble=Derived(Assembly(mass_matrix, bias)))
    # the values that the cached properties would find
    vars(made)["constraints"] = constraints
    vars(made)["state_rates"] = dict(zip(equations.state_rates, rates, strict=True))
    return made


def _substituted(equations: Equations, mapping: Mapping[Any, Any]) -> Equations:
    system = substituted(equations.system, mapping)
    given = (equations.derived_residuals, *_parts_beside_residuals(equations))
    residuals, *others = substituted(given, mapping)
    energy = None if equations.energy is None else substituted(equations.energy, mapping)
    whole = None if equations.whole is None else substituted(equations.whole, mapping)
    is_asked_for = isinstance(equations.derive, Derived) and equations.derive.is_asked_for
    changed = replace(equations, system=system, energy=energy, whole=whole)
    return _with_parts(changed, Derived(residuals, is_asked_for), others)


contains(
    Equations,
    Container(
        _parts,
        _rebuilt,
        advice="its residuals have one: diff(equations.residuals, x)",
        subs=_substituted,
    ),
)
