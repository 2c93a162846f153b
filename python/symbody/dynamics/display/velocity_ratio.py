"""Velocity ratios of embedded equations: ``u_i = K_i v``, ``u_i' = K_i v' + L_i v**2`` [Paul 1979; Doughty 1988].

With them the equation of a mechanism of one freedom is Eksergian's: ``J(q) q'' + C(q) q'**2 = Q`` with
``J = sum of m_i K_i**2`` and ``C = sum of m_i K_i L_i``. With more freedoms, each dependent speed has a ratio to each
independent one, and L_i contains the products of speeds. If constraints depend on time, ``u_i = sum of K_ij v_j + B_i``
[Kane & Levinson 1985, sec. 2.13], and L_i contains the rate of B_i.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from symbody.multibody import Variables
from symbody.symbolic import Expr, Matrix, jacobian, number, substitute, time_derivative, time_function
from symbody.symbolic.calculus.reader import Reader

from .reader_of import reader_of

_RATIOS, _CHANGES, _GIVEN = ("K", "kappa", "N"), ("L", "D", "Lambda"), ("B", "U", "Beta")
"""The letters that are tried: a name must not look like one of the model's."""
_PLAIN = 7
"""The length up to which a ratio, such as r or tan(q), needs no name."""
_LOOP = 3
"""The most conditions of a loop."""
_CONSTANT = 20
"""The same of ratios that are constant, as of gears."""


@dataclass(frozen=True)
class VelocityRatios:
    """The dependent speeds of embedded equations by the independent ones, with names.

    Attributes:
        system: the embedded system.
        reader: which finds forms of expressions in these names.
        ratios: K_i by the dependent speed, one for each independent speed: names, or what is short without.
        changes: L_i by the dependent speed: of one freedom the factor of v**2, else with the products of speeds.
        named: the names, and what they stand for; each uses only those before it.
        given: B_i by dependent speed, if constraints depend on time: its value if the independent speeds vanish.
    """

    system: Variables
    reader: Reader
    ratios: Mapping[Expr, tuple[Expr, ...]]
    changes: Mapping[Expr, Expr]
    named: tuple[tuple[Expr, Expr], ...]
    given: Mapping[Expr, Expr]

    @property
    def has_one_speed(self) -> bool:
        """Whether all dependent speeds are multiples of a single independent speed."""
        return len(self.system.speeds) == 1 and not self.given

    @property
    def squares(self) -> Expr:
        """The factor of a change: v**2 if all dependent speeds are multiples of one speed v, else 1."""
        return self.system.speeds[0] ** 2 if self.has_one_speed else number(1)

    def speed(self, dependent: Expr) -> Expr:
        """Return a dependent speed by the names."""
        return _product(self.ratios[dependent], self.system.speeds) + self.given.get(dependent, number(0))

    def acceleration(self, dependent: Expr) -> Expr:
        """Return the rate of a dependent speed by the names."""
        rates = _product(self.ratios[dependent], self.system.accelerations)
        return rates + self.changes[dependent] * self.squares

    def in_full(self, expressions: Iterable[Expr]) -> tuple[Expr, ...]:
        """Return expressions without the names, by the independent speeds."""
        made = tuple(expressions)
        for name, value in reversed(self.named):
            made = substitute(made, {name: value})
        return self.system.by_speeds(made)


def velocity_ratios(system: Variables) -> VelocityRatios | None:
    """Return the velocity ratios of an embedded system; None if none needs a name because all are short."""
    dependent, at_rest = system.eliminated, dict.fromkeys(system.speeds, number(0))
    if not dependent:
        return None
    rest = dict(zip(dependent, substitute([*dependent.values()], at_rest), strict=True))
    ratio, change, drift = _letters(system)
    ratios = {u: tuple(_name(ratio, u, v, system) for v in system.speeds) for u in dependent}
    changes, drifts = (
        {u: time_function(f"{letter}_{u.name}") for u in dependent} for letter in (change, drift)
    )
    names = [*(each for row in ratios.values() for each in row), *changes.values(), *drifts.values()]
    bare = VelocityRatios(system, reader_of(system, further=names), {}, {}, (), {})
    bare = _with_ratios(bare, ratios)
    if not bare.named:
        return None
    if any(not each.is_zero for each in rest.values()):
        bare = _with_given(bare, drifts, rest)
    made = _with_changes(bare, changes)
    exact = (*dependent.values(), *system.rate([*dependent.values()]))
    shown = (*map(made.speed, dependent), *map(made.acceleration, dependent))
    return made if made.in_full(shown) == exact else None


def _with_ratios(bare: VelocityRatios, names: Mapping[Expr, tuple[Expr, ...]]) -> VelocityRatios:
    """Return the ratios with names, loop by loop: those of a loop follow from those before it."""
    system = bare.system
    slopes = jacobian([*system.eliminated.values()], system.speeds)
    direct = {u: slopes.row(i) for i, u in enumerate(system.eliminated)}
    given, named = dict[Expr, tuple[Expr, ...]](), list[tuple[Expr, Expr]]()
    for loop in _loops(system):
        columns = []
        for j, v in enumerate(system.speeds):
            known = {other: ratios[j] for other, ratios in given.items()}
            known |= {w: number(int(w == v)) for w in system.speeds}
            columns.append(_solved(_of_speeds(loop, system), loop.unknowns, known, {}, bare.reader))
        for i, u in enumerate(loop.unknowns):
            values = [[direct[u][j], *column[i : i + 1]] for j, column in enumerate(columns)]
            given[u] = tuple(
                _entered(bare.reader, name, each, named) for name, each in zip(names[u], values, strict=True)
            )
    return replace(bare, ratios=given, named=tuple(named))


def _of_speeds(loop: _Loop, system: Variables) -> list[Expr]:
    """Return the conditions of a loop without the terms that remain at zero speeds."""
    at_rest = substitute(loop.conditions, dict.fromkeys(system.whole.speeds, number(0)))
    return [each - rest for each, rest in zip(loop.conditions, at_rest, strict=True)]


def _with_given(
    bare: VelocityRatios, names: Mapping[Expr, Expr], rest: Mapping[Expr, Expr]
) -> VelocityRatios:
    """Return the ratios, and the values of the dependent speeds at zero independent speeds."""
    system = bare.system
    given, named = dict[Expr, Expr](), [*bare.named]
    for loop in _loops(system):
        known = {**given, **dict.fromkeys(system.speeds, number(0))}
        solved = _solved(loop.conditions, loop.unknowns, known, {}, bare.reader)
        for i, u in enumerate(loop.unknowns):
            given[u] = _entered(bare.reader, names[u], [rest[u], *solved[i : i + 1]], named)
    return replace(bare, given=given, named=tuple(named))


def _with_changes(bare: VelocityRatios, names: Mapping[Expr, Expr]) -> VelocityRatios:
    """Return the same with the rates of the dependent speeds where the independent ones are constant."""
    system = bare.system
    moving = dict[Expr, Expr]()
    if bare.has_one_speed:  # the changes are the factors of v**2
        moving = {u: ratio for u, (ratio,) in bare.ratios.items()} | dict.fromkeys(system.speeds, number(1))
    rates = _rates([system.eliminated[u] for u in bare.ratios], system)
    direct = dict(zip(bare.ratios, substitute(rates, moving), strict=True))
    given, named = dict[Expr, Expr](), [*bare.named]
    for loop in _loops(system):
        known = {time_derivative(other): change for other, change in given.items()}
        known |= dict.fromkeys(system.accelerations, number(0))
        second = system.whole.rate(loop.conditions)
        solved = _solved(second, [*map(time_derivative, loop.unknowns)], known, moving, bare.reader)
        for i, u in enumerate(loop.unknowns):
            given[u] = _entered(bare.reader, names[u], [direct[u], *solved[i : i + 1]], named)
    return replace(bare, changes=given, named=tuple(named))


@dataclass(frozen=True)
class _Loop:
    """As many conditions as unknowns that occur in no condition before; no condition where there are not as many."""

    unknowns: tuple[Expr, ...]
    conditions: tuple[Expr, ...]


def _loops(system: Variables) -> list[_Loop]:
    """Return the dependent speeds in an order in which each loop determines its own by those before it."""
    whole = system.whole
    waiting = [u for u in whole.speeds if u in system.eliminated]
    left = [*whole.velocity_level(whole.constraints)]
    found = list[_Loop]()
    while waiting:
        conditions = next(filter(None, (_closed(left, waiting, size) for size in range(1, _LOOP + 1))), ())
        held = [u for u in waiting if any(u in each.free_symbols for each in conditions)] or waiting
        found.append(_Loop(tuple(held), conditions))
        waiting = [u for u in waiting if u not in held]
        left = [each for each in left if each not in conditions]
    return found


def _closed(level: Sequence[Expr], waiting: Sequence[Expr], size: int) -> tuple[Expr, ...]:
    """Return the first conditions that hold as many unknowns."""
    for conditions in combinations(level, size):
        if sum(any(u in each.free_symbols for each in conditions) for u in waiting) == size:
            return conditions
    return ()


def _solved(
    conditions: Sequence[Expr],
    unknowns: Sequence[Expr],
    known: Mapping[Expr, Expr],
    moving: Mapping[Expr, Expr],
    reader: Reader,
) -> list[Expr]:
    """Return the unknowns of linear conditions by Cramer's rule; nothing if they don't determine them.

    Args:
        conditions: expressions that are zero.
        unknowns: the speeds or accelerations that are solved for.
        known: others of the same level.
        moving: the speeds in conditions on accelerations, which are put in after these.
        reader: which finds the forms.
    """
    if not conditions:
        return []
    at_rest = substitute(conditions, {**known, **dict.fromkeys(unknowns, number(0))})
    columns = [list(each) for each in jacobian(conditions, unknowns).T.tolist()]
    determinant = Matrix(columns).det()
    if determinant.is_zero:
        return []
    right = [-each for each in substitute(at_rest, moving)]
    made = []
    for i in range(len(columns)):
        top = Matrix([right if k == i else each for k, each in enumerate(columns)]).det()
        made.append(_short(top, reader) / _short(determinant, reader))
    return made


def _short(expression: Expr, reader: Reader) -> Expr:
    forms = (expression, reader(expression), reader.simplest_form(expression))
    return min(forms, key=reader.length)


def _rates(expressions: Sequence[Expr], system: Variables) -> tuple[Expr, ...]:
    """Return the rates of expressions where all speeds are constant."""
    return substitute(system.whole.rate(expressions), dict.fromkeys(system.whole.accelerations, number(0)))


def _entered(reader: Reader, name: Expr, values: Iterable[Expr], named: list[tuple[Expr, Expr]]) -> Expr:
    """Return a name for the shortest form of a value, and enter it; the form itself if it is short or constant."""
    forms = [form for each in values for form in (each, reader(each))]
    # In standard names, a divisor such as s*sin(q)**2 + s*cos(q)**2 is s; of equal lengths, take the shorter text.
    value = min(forms, key=lambda form: (reader.length(form), len(str(form))))
    most = _PLAIN if any(leaf.kind == "time_function" for leaf in value.free_symbols) else _CONSTANT
    if reader.length(value) <= most:
        return value
    named.append((name, value))
    return name


def _product(first: Iterable[Expr], second: Iterable[Expr]) -> Expr:
    return sum((a * b for a, b in zip(first, second, strict=True)), start=number(0))


def _name(letter: str, dependent: Expr, independent: Expr, system: Variables) -> Expr:
    index = "" if len(system.speeds) == 1 else f"_{independent.name}"
    return time_function(f"{letter}_{dependent.name}{index}")


def _letters(system: Variables) -> list[str]:
    """Return the letters of ratios, changes and given speeds: the first ones that the model doesn't use."""
    taken = {leaf.name.rstrip("0123456789").partition("_")[0] for leaf in system.leaves}
    return [
        next((letter for letter in letters if letter not in taken), letters[0] * 2)
        for letters in (_RATIOS, _CHANGES, _GIVEN)
    ]
