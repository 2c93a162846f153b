"""Waves of one angle with numeric phases: ``2*sin(q + pi/6)`` for ``sqrt(3)*sin(q) + cos(q)``.

A sum ``a sin(q) + b cos(q)`` is ``c sin(q + d)`` with ``c**2 = a**2 + b**2``. Frames at angles such as pi/4 or 2*pi/3
leave such sums of sines and cosines; their phases are multiples of pi/12.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from fractions import Fraction
from typing import NamedTuple

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.functions import cos, sin, sqrt
from symbody.symbolic.expression.leaves import pi

from .reading import angles_in, nodes_of, parts_of, waves_in
from .rewrite import expand, factor_terms
from .summands import summands
from .terms import number_of_terms

_MOST = 60
"""The terms of a sum up to which it is multiplied out."""
_OTHER = 4
"""Characters by which a wave of an angle that no frame has reads longer."""
_STEPS = 12
"""The phases in half a turn that are looked for."""
_NEAR = 1e-9


class _Wave(NamedTuple):
    """A term ``rest*(a*sin(angle) + b*cos(angle))``; a and b are numbers."""

    rest: Expr
    angle: Expr
    a: Expr
    b: Expr


def with_phases(form: Expr, angles: Collection[Expr] = ()) -> Expr:
    """Return a form whose sums of waves of one angle are one wave each, if it is shorter.

    Args:
        form: the form.
        angles: the angles of frames, which are preferred.

    >>> from symbody import cos, functions_of_time, pi, sin, sqrt
    >>> q = functions_of_time("q")
    >>> with_phases(sqrt(3) * sin(q) + cos(q)), with_phases(sqrt(3) * sin(q - 2 * pi / 3) + cos(q - 2 * pi / 3))
    (2*sin(q + pi/6), -2*cos(q))
    """
    if not any(map(_is_irrational, nodes_of(form))) or not waves_in(form):
        return form
    known = {*angles, *angles_in(form)}
    others = [_joined_in(form, known)]
    if number_of_terms(form) <= _MOST:
        others.append(_joined_in(expand(form), known))
    joined = [each for each in others if not each.same_form(form) and not each.same_form(expand(form))]
    best = min((other for each in joined for other in _factored(each)), key=_length, default=form)
    return best if _length(best) < _length(form) and best == form else form


def _factored(form: Expr) -> list[Expr]:
    """Return a form with the common factors of its terms outside, unless that leaves fractions, and as it is."""
    outside = factor_terms(form)
    inside = [term for part in parts_of(outside, "product") for term in parts_of(part, "sum")[1:]]
    return [form] if any(map(_has_fraction, inside)) else [outside, form]


def _has_fraction(term: Expr) -> bool:
    numbers = (part for part in parts_of(term, "product") if part.is_number and not part.is_decimal)
    return any(each.ratio[1] > 1 for each in numbers)


def _is_irrational(node: Expr) -> bool:
    """Return whether a node is pi or a root of a number, as frames at numeric angles leave them."""
    return node == pi or (node.kind == "power" and node.args[0].is_number)


def _joined_in(form: Expr, known: set[Expr]) -> Expr:
    made = dict[int, Expr]()
    for node in nodes_of(form):
        args = [made[arg.id] for arg in node.args]
        is_same = all(new.id == old.id for new, old in zip(args, node.args, strict=True))
        found = node
        if not is_same and node.kind in _MAKE:
            found = _MAKE[node.kind](args)
        elif not is_same and node.kind == "power":
            found = args[0] ** args[1]
        made[node.id] = _joined(found, known) if found.kind == "sum" else found
    return made[form.id]


_MAKE = {"sum": _core.sum_of, "product": _core.product_of}


def _joined(total: Expr, known: set[Expr]) -> Expr:
    """Return a sum in which the waves of one angle behind the same factors are one wave, where that is shorter."""
    terms = [part for term in summands(total) for part in _distributed(term)]
    groups = dict[tuple[Expr, Expr], dict[int, _Wave]]()
    for place, term in enumerate(terms):
        for wave in _waves(term):
            groups.setdefault((wave.rest, wave.angle), {})[place] = wave
    made = dict[int, Expr]()
    for (rest, angle), waves in groups.items():
        if (
            len(waves) > 1
            and not made.keys() & waves.keys()
            and rest.free_symbols.isdisjoint(angle.free_symbols)
        ):
            best = _one_wave(waves, known)
            old = _core.sum_of([terms[place] for place in waves])
            if best is not None and _length(rest * best) < _length(old):
                made |= dict.fromkeys(waves, _core.number(0)) | {min(waves): rest * best}
    found = _core.sum_of([made.get(place, term) for place, term in enumerate(terms)])
    return found if made and _length(found) < _length(total) else total


def _distributed(term: Expr) -> list[Expr]:
    """Return the terms of a number times a sum, such as ``sqrt(3)*(a + b)``; any other term as it is."""
    parts = parts_of(term, "product")
    sums = [part for part in parts if part.free_symbols]
    if len(sums) != 1 or sums[0].kind != "sum":
        return [term]
    factor = _core.product_of([part for part in parts if not part.free_symbols])
    return [factor * each for each in summands(sums[0])]


def _waves(term: Expr) -> Iterator[_Wave]:
    """Yield a term by each of its waves: ``a*sin(angle) + b*cos(angle)`` with an angle that has no phase."""
    parts = parts_of(term, "product")
    numbers = _core.product_of([part for part in parts if not part.free_symbols])
    others = [part for part in parts if part.free_symbols]
    for place, part in enumerate(others):
        if part.kind == "function" and part.name in {"sin", "cos"}:
            angle, phase = _without_phase(part.args[0])
            a, b = (cos(phase), sin(phase)) if part.name == "sin" else (-sin(phase), cos(phase))
            rest = _core.product_of([other for k, other in enumerate(others) if k != place])
            yield _Wave(rest, angle, numbers * a, numbers * b)


def _without_phase(angle: Expr) -> tuple[Expr, Expr]:
    """Return the part of an angle that moves, and its number."""
    terms = summands(angle)
    phase = _core.sum_of([term for term in terms if not term.free_symbols])
    return _core.sum_of([term for term in terms if term.free_symbols]), phase


def _one_wave(waves: dict[int, _Wave], known: set[Expr]) -> Expr | None:
    """Return the sum of waves of one angle as one wave; None if its phase is no multiple of pi/12."""
    angle = next(iter(waves.values())).angle
    a, b = (
        expand(_core.sum_of([*parts]))
        for parts in zip(*((wave.a, wave.b) for wave in waves.values()), strict=True)
    )
    square = expand(a**2 + b**2)
    if not square.is_number or square.is_decimal:
        return None
    if square.is_zero:
        return square
    steps = math.atan2(b.evaluate({}), a.evaluate({})) * _STEPS / math.pi
    if abs(steps - round(steps)) > _NEAR:
        return None
    forms = _forms(angle, sqrt(square), round(steps), known)
    return min(
        forms, key=lambda form: _length(form[0]) + _OTHER * (form[1] != angle and form[1] not in known)
    )[0]


def _forms(angle: Expr, size: Expr, steps: int, known: Collection[Expr]) -> Iterator[tuple[Expr, Expr]]:
    """Yield ``size*sin(angle + steps*pi/12)`` in several ways, each with its angle: of frames, or of small phases."""
    half = _STEPS // 2
    ways = [(1, sin, 0), (-1, sin, _STEPS), (1, cos, -half), (-1, cos, half)]
    phases = [(whole, _step(whole - angle)) for whole in sorted(known, key=str)]
    for whole, phase in phases:
        for sign, wave, turn in ways:
            if phase is not None and (steps + turn - phase) % (2 * _STEPS) == 0:
                yield sign * size * wave(whole), whole
    for sign, wave, turn in sorted(ways, key=lambda way: abs(_reduced(steps + way[2]))):
        whole = angle + _core.number(Fraction(_reduced(steps + turn), _STEPS)) * pi
        yield sign * size * wave(whole), whole


def _step(phase: Expr) -> int | None:
    """Return a number as a multiple of pi/12; None if it is none, or no number."""
    ratio = _STEPS * phase / pi
    return ratio.ratio[0] if ratio.is_number and not ratio.is_decimal and ratio.ratio[1] == 1 else None


def _reduced(steps: int) -> int:
    return (steps + _STEPS - 1) % (2 * _STEPS) - _STEPS + 1


def _length(form: Expr) -> int:
    return len(str(form))
