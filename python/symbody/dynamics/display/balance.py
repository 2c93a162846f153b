"""One equation of motion by the kinds of its terms: ``M u' + c + g + loads = Q + phi_q^T lambda``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symbody.multibody import Action, System, Variables
from symbody.symbolic import Expr, Matrix, diff, expand, number
from symbody.symbolic.calculus.reader import Reader
from symbody.symbolic.calculus.reading import is_divisor, nodes_of
from symbody.symbolic.calculus.summands import summands

from .causes import generalized_forces
from .degree import Degrees, by_christoffel, degrees, is_defined_without, part_of, without
from .device import by_device, devices
from .given_rate import by_given_rates
from .like_terms import joined
from .reader_of import reader_of
from .source import Sources, sources


@dataclass(frozen=True)
class Balance:
    """One equation: what stands on its left and on its right. Their difference is the residual.

    Attributes:
        accelerations: the terms of the accelerations, one coefficient for each.
        velocities: the terms of products of speeds, by Coriolis' and centrifugal forces.
        gravity: the terms of weight.
        loads: the terms of springs, dampers and all others.
        applied: the given forces and torques, on the right.
        constraints: the forces of the constraints, ``phi_q^T lambda``, on the right.
    """

    accelerations: tuple[Expr, ...] = ()
    velocities: tuple[Expr, ...] = ()
    gravity: tuple[Expr, ...] = ()
    loads: tuple[Expr, ...] = ()
    applied: tuple[Expr, ...] = ()
    constraints: tuple[Expr, ...] = ()

    @property
    def left(self) -> tuple[Expr, ...]:
        """The terms on the left, in order."""
        return (*self.accelerations, *self.velocities, *self.gravity, *self.loads)

    @property
    def right(self) -> tuple[Expr, ...]:
        """The terms on the right, in order."""
        return (*self.applied, *self.constraints)

    @property
    def residual(self) -> Expr:
        """The left side minus the right one."""
        return sum(self.left, start=number(0)) - sum(self.right, start=number(0))


def balances(
    system: Variables,
    residuals: Sequence[Expr],
    mass_matrix: Matrix,
    bias: Sequence[Expr],
    jacobian: Matrix,
    actions: Sequence[Action] | None = None,
    places: Sequence[int] | None = None,
) -> tuple[tuple[Balance, ...], Matrix]:
    """Return the equations by the kinds of their terms and the mass matrix, all in their forms for the reader.

    An equation that is not the sum of such terms stays in one piece.

    Args:
        system: the system to which the equations belong.
        residuals: the equations, expressions that are zero.
        mass_matrix: M, n x n.
        bias: the residuals at zero accelerations and multipliers.
        jacobian: phi_q, m x n.
        actions: those of the loads in the equations; by default all of the system.
        places: the rows that are wanted, of large systems; by default all.
    """
    chosen = range(len(bias)) if places is None else places
    residuals, bias = [residuals[i] for i in chosen], [bias[i] for i in chosen]
    rows = Matrix([[mass_matrix[i, j] for j in range(mass_matrix.columns)] for i in chosen])
    reader = reader_of(system, [*rows.entries, *bias])
    if actions is None:
        actions = system.actions if isinstance(system, System) else ()
    kinds = sources(system, mass_matrix, actions)
    parts = _parts(system, bias, kinds, mass_matrix, actions, chosen)
    gravity = _gravity(parts, system, [*rows.entries, *bias])
    rows = _read(rows, reader)
    inertia = _by_degree(
        [part.inertia for part in parts], rows if places is None else mass_matrix, system, chosen
    )
    turning = by_given_rates([part.inertia for part in parts], system)
    loads = _loads([part.loads for part in parts], kinds, system.speeds, reader)
    made = []
    for i, (place, residual, part) in enumerate(zip(chosen, residuals, parts, strict=True)):
        row = zip((rows[i, j] for j in range(rows.columns)), system.accelerations, strict=True)
        forces = ((jacobian[k, place], multiplier) for k, multiplier in enumerate(system.multipliers))
        balance = _balance(
            [pair for pair in row if not pair[0].is_zero],
            part,
            (inertia[i], turning[i]),
            gravity[i],
            loads[i],
            [pair for pair in forces if not pair[0].is_zero],
            reader,
        )
        made.append(balance if balance.residual == residual else Balance(loads=_terms(residual, reader)))
    return tuple(made), rows


@dataclass(frozen=True)
class _Parts:
    """The bias of an equation: terms of the bodies' inertia, of weight, of loads, and of given forces."""

    inertia: Expr
    gravity: Expr
    loads: Expr
    given: Expr

    @classmethod
    def of(cls, bias: Expr, kinds: Sources) -> _Parts:
        free = without(bias, [*kinds.given])
        bodies = without(free, [*kinds.loads])
        inertia = without(bodies, [*kinds.gravity])
        weight = part_of(bodies, [*kinds.gravity])
        return cls(inertia, weight, free - bodies, -part_of(bias, [*kinds.given]))


def _parts(
    system: Variables,
    bias: Sequence[Expr],
    kinds: Sources,
    mass_matrix: Matrix,
    actions: Sequence[Action],
    places: Sequence[int],
) -> list[_Parts]:
    """Return the terms by their symbols, or by generalised forces where only these leave forces of inertia.

    Symbols give short forms and are right as a rule, but they don't tell numbers and quotients apart, nor a load from
    inertia where it is undefined without its symbols, as `m*g*x/l`. Christoffel's symbols tell the forces of inertia.

    Args:
        system: the system to which the equations belong.
        bias: the residuals at zero accelerations and multipliers.
        kinds: the symbols by which terms are told apart.
        mass_matrix: M, n x n.
        actions: those of the loads.
        places: the rows whose bias it is.
    """
    parts = [_Parts.of(entry, kinds) for entry in bias]
    follows = by_christoffel([part.inertia for part in parts], mass_matrix, system, places)
    if system.has_quasi_velocities or not isinstance(system, System) or all(follows):
        return parts
    forces = generalized_forces(system, actions)
    others = [
        _Parts(entry + weight + moving + given, -weight, -moving, given)
        for entry, weight, moving, given in zip(
            bias,
            *([each[i] for i in places] for each in (forces.weight, forces.moving, forces.given)),
            strict=True,
        )
    ]
    better = by_christoffel([part.inertia for part in others], mass_matrix, system, places)
    symbols = (*kinds.gravity, *kinds.loads, *kinds.given)
    return [
        other if known is None and (found is not None or not is_defined_without(entry, symbols)) else part
        for entry, part, other, known, found in zip(bias, parts, others, follows, better, strict=True)
    ]


def _loads(
    loads: Sequence[Expr], kinds: Sources, speeds: Sequence[Expr], reader: Reader
) -> list[tuple[Expr, ...]]:
    """Return the terms of the loads: one for each spring and damper, or by the speeds if that is shorter."""
    symbols = devices(loads, kinds.loads)
    made = []
    for load, degree in zip(loads, degrees(loads, speeds), strict=True):
        terms = _terms(load, reader)
        if degree is not None:
            products = (*degree.quadratic, *degree.linear)
            terms = (*joined(products, reader), *_terms(degree.constant, reader))
        others = by_device(load, symbols, speeds, reader)
        made.append(others if others is not None and _is_short(others, terms, reader) else terms)
    return made


def _is_short(others: Sequence[Expr], terms: Sequence[Expr], reader: Reader) -> bool:
    lengths = (reader.length(sum(each, start=number(0))) for each in (others, terms))
    return next(lengths) <= _EQUAL * next(lengths)


_EQUAL = 1.1
"""The length of terms by devices, at most, in relation to that of terms by speeds."""


def _gravity(
    parts: Sequence[_Parts], system: Variables, expressions: Sequence[Expr]
) -> list[tuple[Expr, ...]]:
    """Return the terms of weight, which are read by themselves, as inertia may use up all of a reader's work."""
    reader = reader_of(system, expressions)
    return [() if part.gravity.is_zero else (reader.form_of_large(part.gravity),) for part in parts]


def _read(matrix: Matrix, reader: Reader) -> Matrix:
    n, entries = matrix.shape[1], reader.all_of(matrix.entries)
    return Matrix([entries[start : start + n] for start in range(0, len(entries), n)])


def _by_degree(
    inertia: Sequence[Expr], mass_matrix: Matrix, system: Variables, places: Sequence[int]
) -> list[Degrees | None]:
    found = by_christoffel(inertia, mass_matrix, system, places)
    if all(found):
        return found
    others = degrees(inertia, system.speeds)
    return [first or second for first, second in zip(found, others, strict=True)]


def _balance(
    row: Sequence[tuple[Expr, Expr]],
    part: _Parts,
    inertia: Sequence[Degrees | None],
    gravity: tuple[Expr, ...],
    loads: tuple[Expr, ...],
    forces: Sequence[tuple[Expr, Expr]],
    reader: Reader,
) -> Balance:
    """Return one equation.

    Args:
        row: the entries of its row of M, each with its acceleration.
        part: its bias by the sources of the terms.
        inertia: the forces of inertia by their degree in the speeds, and in these and given rates, if they are so.
        gravity: the terms of weight.
        loads: the terms of springs, dampers and others.
        forces: the entries of its column of phi_q, each with its multiplier.
        reader: which finds the forms.
    """
    ways = [_by_products(each, reader) for each in inertia if each is not None]
    velocities = min(ways or [_terms(part.inertia, reader)], key=lambda terms: sum(map(reader.length, terms)))
    gravity, applied = _without_pairs(part, gravity, reader)
    return Balance(
        accelerations=_accelerations(row, reader),
        velocities=velocities,
        gravity=gravity,
        loads=loads,
        applied=applied,
        constraints=tuple(joined(forces, reader, by_sign_only=True)),
    )


def _accelerations(row: Sequence[tuple[Expr, Expr]], reader: Reader) -> tuple[Expr, ...]:
    """Return the terms of accelerations; long entries that are equal stand once, before the sum of theirs."""
    terms = list[tuple[Expr, Expr]]()
    for entry, acceleration in row:
        long = range(len(terms)) if reader.length(entry) >= _LONG else ()
        same = next((place for place in long if terms[place][0] in {entry, -entry}), None)
        if same is None:
            terms.append((entry, acceleration))
        else:
            known, accelerations = terms[same]
            terms[same] = known, accelerations + (acceleration if entry == known else -acceleration)
    return tuple(entry * accelerations for entry, accelerations in terms)


_LONG = 25
"""The characters of an entry of the mass matrix from which on it is written once."""


def _by_products(inertia: Degrees, reader: Reader) -> tuple[Expr, ...]:
    """Return forces of inertia, one term for each product of speeds."""
    products = (*inertia.quadratic, *inertia.linear)
    return (*joined(products, reader), *_given_accelerations(inertia.constant, reader))


def _without_pairs(
    part: _Parts, gravity: tuple[Expr, ...], reader: Reader
) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
    """Return the terms of weight and of given forces; those that are on both sides, as of a preload, are on none."""
    applied = _given(part.given, reader)
    if gravity and applied:
        rest = _given(part.given - part.gravity, reader)
        if sum(map(reader.length, rest)) < sum(map(reader.length, applied)):
            return (), rest
    return gravity, applied


def _given(force: Expr, reader: Reader) -> tuple[Expr, ...]:
    """Return the term of given forces; the force of a motor is flat, ``F - F*x'/v``, rather than ``-F*(x' - v)/v``."""
    terms = _terms(force, reader)
    if terms and any(map(is_divisor, nodes_of(terms[0]))) and str(terms[0]).startswith("-"):
        flat = tuple(summands(expand(force)))
        return flat if sum(map(reader.length, flat)) <= reader.length(terms[0]) else terms
    return terms


def _given_accelerations(constant: Expr, reader: Reader) -> tuple[Expr, ...]:
    """Return terms without speeds, one for each acceleration that is given, such as that of a support."""
    given = sorted((leaf for leaf in constant.free_symbols if _is_acceleration(leaf)), key=str)
    products = [(diff(constant, leaf), leaf) for leaf in given]
    rest = constant - sum((factor * leaf for factor, leaf in products), start=number(0))
    if any(leaf in rest.free_symbols for leaf in given) and not rest.is_zero:
        return _terms(constant, reader)
    terms = joined(products, reader, by_sign_only=True)
    return (*terms, *_terms(rest, reader))


def _is_acceleration(leaf: Expr) -> bool:
    return leaf.kind == "time_function" and leaf.order > 1


def _terms(expression: Expr, reader: Reader) -> tuple[Expr, ...]:
    return () if expression.is_zero else (reader(expression),)
