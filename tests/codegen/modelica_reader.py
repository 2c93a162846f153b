"""Run functions of Modelica as pymoca, which isn't ours, has read them: assignments, operators, calls.

Linear systems are solved by NumPy in the place of the package's own function.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from functools import partial, reduce
from typing import Any

import numpy as np
from pymoca import ast, parser

OPERATORS: dict[str, Callable[..., Any]] = {
    "+": operator.add,
    "*": operator.mul,
    "/": operator.truediv,
    "^": operator.pow,
    ">": operator.gt,
    "<=": operator.le,
    "and": lambda a, b: bool(a) and bool(b),
}
BUILTIN: dict[str, Callable[..., Any]] = {
    **{
        name: getattr(math, name)
        for name in ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "exp")
    },
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh", "log")},
    "abs": np.abs,
    "sign": np.sign,
    "min": min,
    "max": lambda *values: max(values) if len(values) > 1 else np.max(values[0]),
    "fill": lambda value, *sizes: np.full([int(size) for size in sizes], value),
    "linear_solve": lambda a, b: np.linalg.pinv(np.array(a)) @ np.array(b),
}


class Package:
    """A package of functions in Modelica's text."""

    def __init__(self, text: str) -> None:
        tree = parser.parse(text)
        assert tree is not None, "pymoca can't read the package"
        (self.package,) = [c for c in tree.classes.values() if c.type == "package"]

    def call(self, name: str, *values: Any) -> Any:
        """Evaluate a function: its output, or a tuple of them."""
        function = self.package.classes[name]
        symbols = list(function.symbols.values())
        local: dict[str, Any] = {symbol.name: self.initial(symbol) for symbol in symbols}
        local |= dict(zip([s.name for s in symbols if "input" in s.prefixes], values, strict=True))
        for statement in function.statements:
            assert isinstance(statement, ast.AssignmentStatement)
            self.assign(statement, local)
        outputs = [local[s.name] for s in symbols if "output" in s.prefixes]
        return outputs[0] if len(outputs) == 1 else tuple(outputs)

    def initial(self, symbol: ast.Symbol) -> Any:
        given = self.binding(symbol)
        sizes = [self.value(d, {}) for dimension in symbol.dimensions for d in dimension]
        if given is None and sizes != [None]:
            return np.full([int(size) for size in sizes], np.nan)
        return given

    def binding(self, symbol: ast.Symbol) -> Any:
        """The value in the declaration of a variable, if there is one."""
        modification = symbol.class_modification
        for argument in modification.arguments if modification else []:
            if argument.value.component.name == "value":
                return self.value(argument.value.modifications[0], {})
        return None

    def assign(self, statement: ast.AssignmentStatement, local: dict[str, Any]) -> None:
        value = self.value(statement.right, local)
        for place, part in zip(statement.left, value if len(statement.left) > 1 else [value], strict=True):
            index = self.index(place, local)
            if index:
                local[place.name][index] = part
            else:
                assert place.name in local
                local[place.name] = part

    def index(self, place: ast.ComponentRef, local: dict[str, Any]) -> tuple[int, ...]:
        indices = [i for dimension in place.indices for i in dimension if i is not None]
        return tuple(int(self.value(i, local)) - 1 for i in indices)

    def value(self, node: Any, local: dict[str, Any]) -> Any:
        if isinstance(node, ast.Primary):
            return node.value
        if isinstance(node, ast.Array):
            return np.array([self.value(v, local) for v in node.values])
        if isinstance(node, ast.ComponentRef):
            index = self.index(node, local)
            return local[node.name][index] if index else local[node.name]
        if isinstance(node, ast.IfExpression):
            return self.value(node.expressions[not self.value(node.conditions[0], local)], local)
        assert isinstance(node, ast.Expression), node
        return self.operation(str(node.operator), [self.value(operand, local) for operand in node.operands])

    def operation(self, name: str, values: Sequence[Any]) -> Any:
        if name == "-":
            return -values[0] if len(values) == 1 else reduce(operator.sub, values)
        if name in OPERATORS:
            return reduce(OPERATORS[name], values)
        return BUILTIN.get(name, partial(self.call, name))(*values)
