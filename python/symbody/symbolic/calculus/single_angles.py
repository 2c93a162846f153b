"""One set of angles for several forms: ``cos(x)**2 - sin(x)**2`` for ``cos(2*x)`` beside products of waves of x."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.functions import cos, sin
from symbody.symbolic.expression.traverse import post_order

from .reading import nodes_of, parts_of, waves_in
from .rewrite import textbook_form


def in_single_angles(forms: Sequence[Expr], given: Collection[Expr] = ()) -> tuple[Expr, ...]:
    """Return forms without sines and cosines of 2*x, if one of them has products or powers of those of x.

    Args:
        forms: the forms, which are read together.
        given: angles that stay.

    >>> from symbody import cos, sin, symbols
    >>> a, b, x = symbols("a b x")
    >>> in_single_angles([a * cos(2 * x), b * sin(x) ** 2])
    (a*(cos(x)**2 - sin(x)**2), b*sin(x)**2)
    >>> in_single_angles([a * cos(2 * x), b * sin(x)])
    (a*cos(2*x), b*sin(x))
    """
    nodes = post_order([*forms], lambda node: node.args, lambda node: node.id)
    angles = {node.args[0] for node in nodes if _is_wave(node)}
    halves = {angle: angle / 2 for angle in angles if angle.kind == "product" and angle not in given}
    if not halves:
        return tuple(forms)
    known = {angle for form in forms for angle in _multiplied(form)}
    opened = {angle: half for angle, half in halves.items() if half in known}
    return tuple(_opened(form, opened) for form in forms) if opened else tuple(forms)


def _multiplied(form: Expr) -> set[Expr]:
    """Return the angles of which a form has a power, or a product, of sines and cosines."""
    found = set[Expr]()
    for node in nodes_of(form):
        if node.kind == "power" and _is_wave(node.args[0]) and node.args[1] == 2:
            found.add(node.args[0].args[0])
        elif node.kind == "product":
            angles = [part.args[0] for part in parts_of(node, "product") if _is_wave(part)]
            found |= {angle for angle in angles if angles.count(angle) > 1}
    return found


def _is_wave(node: Expr) -> bool:
    return node.kind == "function" and node.name in {"sin", "cos"}


def _opened(form: Expr, halves: dict[Expr, Expr]) -> Expr:
    made = dict[int, Expr]()
    for node in nodes_of(form):
        args = [made[arg.id] for arg in node.args]
        is_changed = any(new.id != old.id for new, old in zip(args, node.args, strict=True))
        if _is_wave(node) and node.args[0] in halves:
            made[node.id] = _by_half(node.name, halves[node.args[0]])
        else:
            made[node.id] = _MAKE[node.kind](args) if is_changed and node.kind in _MAKE else node
    found = made[form.id]
    if found.id == form.id or found != form:
        return form
    return min((found, textbook_form(found)), key=lambda each: (_doubles(each, halves), len(str(each))))


_MAKE = {"sum": _core.sum_of, "product": _core.product_of}


def _by_half(name: str, half: Expr) -> Expr:
    return cos(half) ** 2 - sin(half) ** 2 if name == "cos" else 2 * sin(half) * cos(half)


def _doubles(form: Expr, halves: dict[Expr, Expr]) -> int:
    return sum(wave.args[0] in halves for wave in waves_in(form))
