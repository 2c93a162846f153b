"""Kinetic energies as books print them: ``M11*u1**2/2 + M12*u1*u2 + ...``, one coefficient for each product of speeds.

They are derived as squares of velocities, ``m*((c*(p' + q') + l*cos(q)*p')**2 + l**2*sin(q)**2*p'**2)/2``. Simplified
as they are, brackets with speeds stay within brackets with speeds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .cost import cost
from .derivative import diff
from .quadratic_form import QuadraticForm
from .reader import Reader
from .reading import awkward_parts, awkward_terms, nodes_of
from .standard_names import standard_names
from .summands import summands

__all__ = ["energy_form", "flat_inertia", "quadratic_terms"]

_MOST = 250
"""Operations up to which an energy is read."""
_LONGER = 1.6
"""The length of the form, at most, in relation to the given one: a short product of sums stays as it is written."""
_NESTED = 3
"""Brackets with speeds within each other from which on a form is that of a computation."""
_SEVERAL = 2


def energy_form(expression: Expr) -> Expr | None:
    """Return an energy with one coefficient for each product of speeds; None for what is no nested energy.

    An energy holds the squares of all of its speeds, at least of two, and no accelerations.

    >>> from symbody import cos, functions_of_time, sin, symbols, t
    >>> (p, q), (m, c, l) = functions_of_time("p q"), symbols("m c l")
    >>> pt, qt = p.diff(t), q.diff(t)
    >>> energy_form(m * ((c * (pt + qt) + l * cos(q) * pt) ** 2 + l**2 * sin(q) ** 2 * pt**2) / 2)
    m*c**2*q'**2/2 + m*(c**2 + c*l*cos(q))*p'*q' + m*(c**2 + l**2 + 2*c*l*cos(q))*p'**2/2
    """
    speeds = _squared_speeds(expression)
    if len(speeds) < _SEVERAL or not _is_nested(expression) or cost(expression).total > _MOST:
        return None
    reader = Reader(standard_names([], [expression]), inertias=_inertias(expression))
    found = _core.sum_of(quadratic_terms(expression, speeds, reader.all_of))
    is_short = len(str(found)) <= _LONGER * len(str(expression))
    return found if is_short and found == expression else None


def quadratic_terms(
    T: Expr, speeds: Sequence[Expr], read: Callable[[Sequence[Expr]], Sequence[Expr]]
) -> list[Expr]:
    """Return the terms of ``M11*u1**2/2 + M12*u1*u2 + ...``, and of what is left, in their forms for the reader.

    Products with one coefficient are one term: ``m*(x'**2 + y'**2)/2``, ``J*(p' + q')**2/2``.

    Args:
        T: the energy, quadratic in the speeds.
        speeds: the speeds.
        read: finds the forms of the coefficients and of what is left.
    """
    products = dict[Expr, list[Expr]]()
    slopes = [diff(T, speed) for speed in speeds]
    for i, speed in enumerate(speeds):
        products.setdefault(diff(slopes[i], speed), []).append(speed**2)
        for other in speeds[i + 1 :]:
            products.setdefault(diff(slopes[i], other), []).append(2 * speed * other)
    doubled = {coefficient: _core.sum_of(parts) for coefficient, parts in products.items()}
    rest = T - _core.sum_of([coefficient * each / 2 for coefficient, each in doubled.items()])
    *coefficients, rest = read([*doubled, rest])
    pairs = zip(coefficients, map(_half, doubled.values()), strict=True)
    terms = [coefficient * each for coefficient, each in pairs]
    return [term for term in (*terms, rest) if not term.is_zero] or [rest]


def _half(form: Expr) -> Expr:
    """Return half of a quadratic form of speeds: ``p'*q'`` of ``2*p'*q'``, ``(p' + q')**2/2`` if it is a square."""
    quadratic = QuadraticForm.of(form)
    root = quadratic.root_with(QuadraticForm({}), 1) if quadratic is not None else None
    has_squares = quadratic is None or quadratic.squared
    return (
        (form if root is None else root**2) / 2
        if has_squares
        else _core.sum_of([each / 2 for each in summands(form)])
    )


def flat_inertia(expression: Expr, form: Expr) -> Expr:
    """Return the form of an entry of a mass matrix, or another one whose quadratic forms of lengths are flat.

    Args:
        expression: the entry.
        form: its form, such as ``J + l*m*(l + a*cos(q))``.

    >>> from symbody import cos, functions_of_time, symbols
    >>> q, (J, m, a, l) = functions_of_time("q"), symbols("J m a l")
    >>> flat_inertia(J + m * l**2 + m * a * l * cos(q), J + l * m * (l + a * cos(q)))
    J + m*(l**2 + a*l*cos(q))
    """
    leaves = [leaf for leaf in expression.free_symbols if leaf.kind == "time_function"]
    is_entry = leaves and not any(leaf.order for leaf in leaves) and cost(expression).total <= _MOST
    inertias = _inertias(expression) if is_entry and awkward_parts(form) else ()
    if not inertias:
        return form
    flat = Reader(standard_names([], [expression]), inertias=inertias)(expression)
    is_flatter = awkward_parts(flat) < awkward_parts(form) and len(str(flat)) <= _FLATTER * len(str(form))
    return flat if is_flatter else form


_FLATTER = 1.25
"""The length of a flat form, at most, in relation to one with a length before brackets in which it is."""


def _is_nested(form: Expr) -> bool:
    """Return whether sums with speeds stand within sums with speeds, or a factor before brackets in which it is."""
    depth = dict[int, int]()
    for node in nodes_of(form):
        inner = max((depth[part.id] for part in node.args), default=0)
        has_speed = any(leaf.kind == "time_function" and leaf.order == 1 for leaf in node.free_symbols)
        depth[node.id] = inner + (node.kind == "sum" and has_speed)
    return depth[form.id] >= _NESTED or (depth[form.id] > 0 and awkward_terms(form) > 0)


def _squared_speeds(expression: Expr) -> list[Expr]:
    """Return the speeds in an expression; none if one of them has no square, or beside accelerations."""
    rates = [leaf for leaf in expression.free_symbols if leaf.kind == "time_function" and leaf.order > 0]
    is_energy = all(each.order == 1 and not diff(diff(expression, each), each).is_zero for each in rates)
    return sorted(rates, key=str) if is_energy else []


def _inertias(expression: Expr) -> tuple[Expr, ...]:
    """Return the masses and moments of inertia, one of which is a factor of each term; none if there are no such.

    A length in which an energy is linear, too, is a factor beside masses: it has products with more of the others.
    """
    slopes = {leaf: diff(expression, leaf) for leaf in expression.free_symbols if leaf.kind == "symbol"}
    linear = sorted((leaf for leaf, slope in slopes.items() if leaf not in slope.free_symbols), key=str)
    beside = {leaf: [each for each in linear if each in slopes[leaf].free_symbols] for leaf in linear}
    while any(beside.values()):
        length = max(beside, key=lambda leaf: (len(beside[leaf]), leaf * slopes[leaf] != expression))
        beside = {
            leaf: [each for each in beside[leaf] if each != length] for leaf in beside if leaf != length
        }
    total = _core.sum_of([leaf * slopes[leaf] for leaf in beside])
    return tuple(beside) if total == expression else ()
