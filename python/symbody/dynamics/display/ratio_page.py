"""The page of embedded equations by velocity ratios: the equations with constraints, each row times its ratio."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from math import prod

from symbody.multibody import Variables
from symbody.symbolic import Expr, Matrix, diff, number, substitute, time_derivative
from symbody.symbolic.calculus.reading import is_divisor, nodes_of, parts_of
from symbody.symbolic.calculus.summands import summands

from .balance import Balance
from .page import Page
from .reader_of import reader_of
from .velocity_ratio import VelocityRatios, velocity_ratios

_LONGER = 1.25
"""How many times longer a page with velocity ratios may be than one without, for mechanisms that may reach a dead
centre. For others, such as wheels and blades, whose ratios have no quotients, it must be shorter."""
_SHORTER = 0.8
"""The length of the form of a sum, at most, in relation to its terms, each with the mass of a body."""
_DEFINED = len("     := ")
"""The characters around a name where it is defined, with the end of the line."""


def page_of_ratios(
    system: Variables, residuals: Sequence[Expr], state_rates: Mapping[Expr, Expr], whole: Page
) -> Page | None:
    """Return the page of embedded equations by velocity ratios; None if its values can't be shown to be theirs.

    Args:
        system: the embedded system.
        residuals: its equations, expressions that are zero.
        state_rates: the rates of the states.
        whole: the page of the equations with constraints.
    """
    ratios = velocity_ratios(system)
    if ratios is None or any(u not in whole.system.speeds for u in system.eliminated):
        return None
    made = _Rows(ratios, whole).page(state_rates)
    shown: tuple[Expr, ...] = tuple(balance.residual for balance in made.balances)
    for name, value in reversed(whole.named):
        shown = substitute(shown, {name: value})
    return made if ratios.in_full(shown) == tuple(residuals) else None


def better_page(page: Page, by_ratios: Page) -> Page:
    """Return the page by velocity ratios unless that without is much shorter, as it has quotients in quotients."""
    system = by_ratios.system
    is_mechanism = system.eliminated_constraints and any(map(_is_quotient, dict(by_ratios.named).values()))
    most, order = (_LONGER, 1) if is_mechanism else (1, 2)
    length = reader_of(system, further=[name for name, _ in by_ratios.named]).length
    return by_ratios if _size(by_ratios, length, order) < most * _size(page, length, order) else page


class _Rows:
    """Writes the rows of embedded equations.

    Args:
        ratios: the dependent speeds by the independent ones.
        whole: the page of the equations with constraints.
    """

    def __init__(self, ratios: VelocityRatios, whole: Page) -> None:
        self._ratios, self._whole, self._reader = ratios, whole, ratios.reader
        self._speeds = whole.system.speeds
        self._moving = {u: ratios.speed(u) for u in ratios.ratios} if ratios.has_one_speed else {}

    def page(self, state_rates: Mapping[Expr, Expr]) -> Page:
        """Return the page with these rows."""
        n = len(self._ratios.system.speeds)
        matrix = Matrix([[self._entry(i, j) for j in range(n)] for i in range(n)])
        balances = tuple(self._balance(i, matrix) for i in range(n))
        named = (*self._ratios.named, *self._whole.named)
        rates, kinematics = tuple(state_rates.items()), self._kinematics(state_rates)
        return Page(self._ratios.system, balances, (), matrix, rates, named, kinematics)

    def _ratio(self, u: Expr, place: int) -> Expr:
        """Return the ratio of any speed to an independent one."""
        if u in self._ratios.ratios:
            return self._ratios.ratios[u][place]
        return number(int(u == self._ratios.system.speeds[place]))

    def _entry(self, i: int, j: int) -> Expr:
        """Return an entry of the mass matrix: ``sum of K_ki K_lj M_kl``."""
        M, places = self._whole.mass_matrix, range(len(self._speeds))
        return self._short(
            M[k, l] * self._ratio(self._speeds[k], i) * self._ratio(self._speeds[l], j)
            for k, l in product(places, repeat=2)
        )

    def _balance(self, i: int, matrix: Matrix) -> Balance:
        accelerations = self._ratios.system.accelerations
        row = [(matrix[i, j], each) for j, each in enumerate(accelerations)]
        applied = self._forces(i, lambda balance: balance.applied)
        return Balance(
            accelerations=tuple(entry * each for entry, each in row if not entry.is_zero),
            velocities=self._velocities(i),
            gravity=self._forces(i, lambda balance: balance.gravity),
            loads=self._forces(i, lambda balance: balance.loads),
            applied=applied,
        )

    def _velocities(self, i: int) -> tuple[Expr, ...]:
        """Return the terms of products of speeds: those of the rows, and of the changes of dependent speeds."""
        ratios, M = self._ratios, self._whole.mass_matrix
        terms = list[Expr]()
        for k, (u, balance) in enumerate(zip(self._speeds, self._whole.balances, strict=True)):
            ratio = self._ratio(u, i)
            changes = (
                M[k, l] * ratios.changes[other] * ratios.squares
                for l, other in enumerate(self._speeds)
                if other in ratios.changes
            )
            terms += [ratio * each for each in (*balance.velocities, *changes)]
        return self._sum(terms)

    def _forces(self, i: int, kind: Callable[[Balance], tuple[Expr, ...]]) -> tuple[Expr, ...]:
        rows = zip(self._speeds, self._whole.balances, strict=True)
        return self._sum(self._ratio(u, i) * term for u, balance in rows for term in kind(balance))

    def _sum(self, terms: Iterable[Expr]) -> tuple[Expr, ...]:
        """Return the sum of terms; with a single speed v, its terms are collected by powers of v.

        The coefficient of ``c*v**k`` is its value at v = 1; dividing by ``v**k`` might give a form that is 0/0 at rest.
        """
        moving = [each for each in substitute([*terms], self._moving) if not each.is_zero]
        if not self._ratios.has_one_speed or not moving:
            return (self._short(moving),) if moving else ()
        (v,) = self._ratios.system.speeds
        powers: dict[int, list[Expr]] = {}
        for term in moving:
            powers.setdefault(_degree(term, v), []).append(term)
        factors = {k: substitute(terms, {v: number(1)}) if k else terms for k, terms in powers.items()}
        made = [self._short(factors[k]) * v**k for k in sorted(powers, reverse=True)]
        return tuple(each for each in made if not each.is_zero)

    def _short(self, terms: Iterable[Expr]) -> Expr:
        """Return a sum term by term, or its form for the reader if that is shorter by a fifth."""
        given, length = sum(terms, start=number(0)), self._reader.length
        form, total = self._reader(given), min(given, self._by_parameters(given), key=length)
        return form if length(form) < _SHORTER * length(given) else total

    def _by_parameters(self, total: Expr) -> Expr:
        """Return a sum with one bracket for the terms that have the same parameters, such as those of one coupling."""
        groups = dict[Expr, list[Expr]]()
        for term in summands(total):
            factors = parts_of(term, "product")
            parameters = prod((each for each in factors if _is_parameter(each)), start=number(1))
            groups.setdefault(parameters, []).append(term / parameters)
        brackets = ((each, sum(rests, start=number(0))) for each, rests in groups.items())
        return sum((each * self._reader(rest) for each, rest in brackets), start=number(0))

    def _kinematics(self, state_rates: Mapping[Expr, Expr]) -> tuple[tuple[Expr, Expr], ...]:
        """Return the kinematics by the names, with the rates of dependent speeds, which tell what their changes are."""
        ratios, reader = self._ratios, self._reader
        made = list[tuple[Expr, Expr]]()
        for u, change in ratios.changes.items():
            is_named = any(name == change for name, _ in ratios.named)
            made += [
                (u, ratios.speed(u)),
                *([(time_derivative(u), ratios.acceleration(u))] if is_named else []),
            ]
        others = {**ratios.system.known_rates, **state_rates}
        return (
            *made,
            *((rate, reader.form(value)) for rate, value in others.items() if rate not in ratios.ratios),
        )


def _is_parameter(factor: Expr) -> bool:
    return not factor.is_number and all(leaf.kind == "symbol" for leaf in factor.free_symbols)


def _degree(term: Expr, v: Expr) -> int:
    """Return the power of a speed in a term; 0 if the term is no product of it."""
    for power in (2, 1):
        if diff(term / v**power, v).is_zero:
            return power
    return 0


def _size(page: Page, length: Callable[[Expr], int], order: int) -> int:
    """Return the length of the rows, of the named values, and of rates up to an order (1 for speeds)."""
    rows = [term for balance in page.balances for term in (*balance.left, *balance.right)]
    pairs = [*page.named, *(pair for pair in page.rates if pair[0].order <= order)]
    return sum(map(length, rows)) + sum(length(name) + _DEFINED + length(value) for name, value in pairs)


def _is_quotient(form: Expr) -> bool:
    """Return whether a divisor contains a function of time."""
    divisors = (node.args[0] for node in nodes_of(form) if is_divisor(node))
    return any(leaf.kind == "time_function" for each in divisors for leaf in each.free_symbols)
