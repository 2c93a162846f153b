"""Conversion of expressions to SymPy, node by node."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from symbody.errors import ExpressionError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.traverse import post_order

__all__ = ["ToSympy", "import_sympy"]


class ToSympy:
    """A conversion to SymPy; a node that several expressions share is converted once."""

    def __init__(self, sympy: Any, names: Mapping[str, Any]) -> None:
        self._sympy, self._names = sympy, names
        self._made: dict[int, Any] = {}
        self._t = names.get("t", sympy.Symbol("t"))

    def convert(self, root: Expr) -> Any:
        """Return one expression as a SymPy expression.

        Raises:
            ExpressionError: the expression is nested deeper than SymPy's recursion allows.
        """
        parts: dict[int, Sequence[Expr]] = {}

        def parts_of(e: Expr) -> Sequence[Expr]:
            return parts.setdefault(e.id, e.args)

        order = post_order([root], parts_of, lambda e: e.id)
        opened = _opened(order, parts)
        _check_depth(order, parts, opened)
        try:
            for node in order:
                if node.id not in opened:
                    args = _with_terms(parts[node.id], parts, opened)
                    self._made[node.id] = self._node(node, [self._made[arg.id] for arg in args])
        except RecursionError:
            raise ExpressionError(
                "to_sympy: the expression is nested deeper than SymPy, which recurses, can go; "
                "raise the limit with sys.setrecursionlimit, or convert parts of it"
            ) from None
        return self._made[root.id]

    def convert_matrix(self, shape: tuple[int, int], entries: Sequence[Expr]) -> Any:
        """Return a matrix as a SymPy matrix."""
        return self._sympy.Matrix(*shape, [self.convert(entry) for entry in entries])

    def _node(self, e: Expr, args: list[Any]) -> Any:
        sympy = self._sympy
        match e.kind:
            case "sum":
                return sympy.Add(*args)
            case "product":
                return sympy.Mul(*args)
            case "power":
                return sympy.Pow(*args)
            case "application":
                return self._application(e, args)
            case "solution":
                raise ExpressionError(
                    "to_sympy: the expression holds the solution of a linear system, which has no counterpart in "
                    "SymPy; solve the system there, or evaluate it with lambdify"
                )
            case "function":
                return self._piecewise(args) if e.name == "Piecewise" else getattr(sympy, e.name)(*args)
            case _:
                return self._leaf(e)

    def _leaf(self, e: Expr) -> Any:
        sympy = self._sympy
        match e.kind:
            case "number":
                # A decimal that no double represents, such as 0.1/3, stays exact.
                is_double = e.is_decimal and _core.number(float(e)) == e
                return sympy.Float(float(e)) if is_double else sympy.Rational(*e.ratio)
            case "constant":
                return sympy.pi
            case "time_function":
                function = self._names.get(e.name, sympy.Function(e.name)(self._t))
                return function.diff(self._t, e.order) if e.order else function
            case _:
                return self._symbol(e)

    def _symbol(self, e: Expr) -> Any:
        if e.same_form(_core.time()):
            return self._t
        assumptions = {
            "real": {"real": True},
            "positive": {"positive": True},
            "none": {"complex": True},
            "small": {"real": True},
        }
        symbol = self._sympy.Symbol(e.name, **assumptions[e.assumption])
        return self._names.get(e.name, symbol)

    def _application(self, e: Expr, args: list[Any]) -> Any:
        """Return f(x, y) or its derivative; an argument that is not a symbol of its own is replaced by a dummy."""
        sympy = self._sympy
        function = self._names.get(e.name, sympy.Function(e.name))
        slots, by = list(args), []
        for i, order in enumerate(e.orders):
            others = [arg for j, arg in enumerate(args) if j != i]
            if order and not (args[i].is_Symbol and all(args[i] not in arg.free_symbols for arg in others)):
                slots[i] = sympy.Dummy(f"xi_{i + 1}")
            if order:
                by.append((slots[i], order))
        if not by:
            return function(*args)
        moved = [(slot, arg) for slot, arg in zip(slots, args, strict=True) if slot is not arg]
        derivative = sympy.Derivative(function(*slots), *by)
        return sympy.Subs(derivative, *zip(*moved, strict=True)) if moved else derivative

    def _piecewise(self, args: list[Any]) -> Any:
        sympy = self._sympy
        # Unevaluated: SymPy would rescale the conditions.
        branches = [
            (value, sympy.Gt(condition, 0, evaluate=False))
            for value, condition in zip(args[:-1:2], args[1::2], strict=True)
        ]
        return sympy.Piecewise(*branches, (args[-1], True), evaluate=False)


def _opened(order: Sequence[Expr], parts: Mapping[int, Sequence[Expr]]) -> set[int]:
    """Return the sums that are terms of one other sum and nothing else: SymPy has one sum for both."""
    uses = Counter(arg.id for node in order for arg in parts[node.id])
    terms = (arg for node in order if node.kind == "sum" for arg in parts[node.id])
    return {term.id for term in terms if term.kind == "sum" and uses[term.id] == 1}


def _with_terms(
    args: Sequence[Expr], parts: Mapping[int, Sequence[Expr]], opened: set[int]
) -> Sequence[Expr]:
    """Return the arguments with the terms of opened sums in their places."""
    found, stack = [], [*reversed(args)]
    while stack:
        arg = stack.pop()
        if arg.id in opened:
            stack.extend(reversed(parts[arg.id]))
        else:
            found.append(arg)
    return found


def _check_depth(order: Sequence[Expr], parts: Mapping[int, Sequence[Expr]], opened: set[int]) -> None:
    """Raise an error at once for an expression that is nested deeper than any function of SymPy can recurse."""
    levels: dict[int, int] = {}
    for node in order:
        below = max((levels[arg.id] for arg in parts[node.id]), default=0)
        levels[node.id] = below + (node.id not in opened)
    found, limit = levels[order[-1].id], sys.getrecursionlimit()
    if found > limit:
        raise ExpressionError(
            f"to_sympy: the expression is nested {found} levels deep; SymPy recurses, and Python's limit is {limit} "
            "calls; raise it with sys.setrecursionlimit, or convert parts of it"
        )


def import_sympy() -> Any:
    """Import SymPy, an optional dependency.

    Raises:
        ImportError: it isn't installed.
    """
    try:
        import sympy  # noqa: PLC0415 - an extra, imported by the first conversion
    except ModuleNotFoundError as error:
        if error.name != "sympy":  # SymPy is installed, but one of its own dependencies is missing
            raise
        raise ImportError("SymPy isn't installed; pip install 'symbody[sympy]'") from error
    return sympy
