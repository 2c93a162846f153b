"""SymPy and back. SymPy is an extra, imported when a function here is called."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from symbody.errors import ArgumentError, ExpressionError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.arguments import described
from symbody.symbolic.leaves import ExprLike, check_name
from symbody.symbolic.matrix import Matrix
from symbody.symbolic.traverse import post_order

__all__ = ["from_sympy", "to_sympy"]

#: The functions that both sides call by the same name.
_COMMON = frozenset(_core.function_names()) - {"Power", "Piecewise"}

#: SymPy's functions that are the reciprocals of others.
_RECIPROCALS = {"sec": "cos", "csc": "sin", "cot": "tan", "sech": "cosh", "csch": "sinh", "coth": "tanh"}


def to_sympy(expression: ExprLike | Matrix, names: Mapping[str, Any] | None = None) -> Any:
    """Return the expression or matrix as SymPy has it; what is shared here is one object there.

    Functions of time become ``x(t)`` as ``dynamicsymbols`` makes them, symbols keep their assumptions.
    ``names`` gives SymPy's object for a name where another one is wanted.

    Raises:
        ImportError: SymPy isn't installed.
        ExpressionError: the expression is deeper than SymPy's recursions reach.

    >>> from symbody import functions_of_time, symbols, time_derivative
    >>> m = symbols("m")
    >>> x = functions_of_time("x")
    >>> to_sympy(m * time_derivative(x, 2))
    m*Derivative(x(t), (t, 2))
    """
    sympy = _sympy()
    bridge = _ToSympy(sympy, names or {})
    try:
        if isinstance(expression, Matrix):
            return sympy.Matrix(*expression.shape, [bridge.convert(entry) for entry in expression.entries])
        return bridge.convert(_core.number(expression, "to_sympy"))
    except RecursionError:
        raise ExpressionError(
            "to_sympy: the expression is nested deeper than SymPy, which recurses, can go; "
            "raise the limit with sys.setrecursionlimit, or convert parts of it"
        ) from None


def from_sympy(expression: Any, names: Mapping[str, Expr] | None = None) -> Expr:
    """Return an expression of SymPy as an expression; ``x(t)`` becomes a function of time.

    A symbol without assumptions becomes a real one, as ``symbols`` makes it. ``names`` gives the
    expression for a name where another one is wanted.

    Raises:
        ImportError: SymPy isn't installed.
        ExpressionError: something in the expression has no counterpart.

    >>> import sympy
    >>> x = sympy.Symbol("x")
    >>> from_sympy(sympy.sin(x) ** 2)
    sin(x)**2
    """
    sympy = _sympy()
    if isinstance(expression, Expr):
        return expression
    if isinstance(expression, str):
        raise ArgumentError(f"from_sympy: {described(expression)}; parse reads texts")
    if isinstance(expression, sympy.MatrixBase):
        raise ArgumentError(
            "from_sympy: found a matrix of SymPy's; convert its entries, "
            "as in Matrix([[from_sympy(e) for e in row] for row in A.tolist()])"
        )
    if not isinstance(expression, sympy.Expr | int | float):
        raise ArgumentError(f"from_sympy: {described(expression)}; expected an expression of SymPy's")
    return _FromSympy(sympy, names or {}).convert(sympy.sympify(expression))


def _sympy() -> Any:
    try:
        import sympy  # noqa: PLC0415 - an extra: only who converts needs it
    except ImportError as error:
        raise ImportError("SymPy isn't installed; pip install 'symbody[sympy]'") from error
    return sympy


class _ToSympy:
    def __init__(self, sympy: Any, names: Mapping[str, Any]) -> None:
        self._sympy, self._names = sympy, names
        self._made: dict[int, Any] = {}
        self._t = names.get("t", sympy.Symbol("t"))

    def convert(self, root: Expr) -> Any:
        for node in post_order([root], lambda e: e.args, lambda e: e.id):
            self._made[node.id] = self._node(node, [self._made[arg.id] for arg in node.args])
        return self._made[root.id]

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
                return sympy.Float(float(e)) if e.is_decimal else sympy.Rational(*e.ratio)
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
        assumptions = {"real": {"real": True}, "positive": {"positive": True}, "none": {"complex": True}}
        symbol = self._sympy.Symbol(e.name, **assumptions[e.assumption])
        return self._names.get(e.name, symbol)

    def _application(self, e: Expr, args: list[Any]) -> Any:
        """Return f(x, y) or its derivative: by an argument itself if that is a symbol on its own."""
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


class _FromSympy:
    def __init__(self, sympy: Any, names: Mapping[str, Expr]) -> None:
        self._sympy, self._names = sympy, names
        self._made: dict[int, Expr] = {}

    def convert(self, root: Any) -> Expr:
        # Keyed by object: the parts of a tuple held by their parent live as long as the root.
        for node in post_order([root], self._parts, id):
            self._made[id(node)] = self._node(node)
        return self._of(root)

    def _of(self, s: Any) -> Expr:
        return self._made[id(s)]

    def _all(self, nodes: Iterable[Any]) -> list[Expr]:
        return [self._of(node) for node in nodes]

    def _parts(self, s: Any) -> Sequence[Any]:
        sympy = self._sympy
        if isinstance(s, sympy.Derivative):
            return [s.expr, *(variable for variable, _ in s.variable_count)]
        if isinstance(s, sympy.Subs):
            return [s.expr, *s.variables, *s.point]
        if isinstance(s, sympy.Piecewise):
            sides = [side for _, condition in s.args for side in _sides(sympy, condition)]
            return [*(value for value, _ in s.args), *sides]
        known = isinstance(s, sympy.Add | sympy.Mul | sympy.Pow | sympy.core.function.Application)
        return list(s.args) if known else []

    def _node(self, s: Any) -> Expr:
        sympy = self._sympy
        match s:
            case sympy.Add():
                return _core.sum_of(self._all(s.args))
            case sympy.Mul():
                return _core.product_of(self._all(s.args))
            case sympy.Pow():
                base, exponent = self._all(s.args)
                return base**exponent
            case sympy.Derivative():
                return self._derivative(s)
            case sympy.Subs():
                return self._of(s.expr).subs(
                    dict(zip(self._all(s.variables), self._all(s.point), strict=True))
                )
            case sympy.Piecewise():
                return self._piecewise(s)
            case sympy.core.function.Application():
                return self._function(s)
            case _:
                return self._leaf(s)

    def _leaf(self, s: Any) -> Expr:
        sympy = self._sympy
        match s:
            case sympy.Rational():
                return _core.number(int(s.p)) / int(s.q)
            case sympy.Float():
                return _core.number(float(s))
            case sympy.Symbol():
                return self._symbol(s)
            case sympy.pi:
                return _core.pi()
            case sympy.E:
                return _core.apply("exp", (1,))
            case _:
                raise _no_counterpart(s)

    def _symbol(self, s: Any) -> Expr:
        if isinstance(s, self._sympy.Dummy):
            return _core.symbol(_checked(f"{s.name}_{s.dummy_index % 2**64}"))
        if s.name in self._names:
            return self._names[s.name]
        if s.name == "t":
            return _core.time()
        _checked(s.name)
        return _core.symbol(s.name, positive=bool(s.is_positive), real=bool(s.is_real) or not s.is_complex)

    def _function(self, s: Any) -> Expr:
        args, name = self._all(s.args), type(s).__name__
        if name in self._names and args == [_core.time()]:
            return self._names[name]
        if isinstance(s, self._sympy.core.function.AppliedUndef):
            return _core.application(_checked(name), args)
        if name in _COMMON:
            return _core.apply(name, args)
        if name in _RECIPROCALS:
            return 1 / _core.apply(_RECIPROCALS[name], args)
        raise _no_counterpart(s)

    def _derivative(self, s: Any) -> Expr:
        result = self._of(s.expr)
        for variable, count in s.variable_count:
            result = result.diff(self._of(variable), int(count))
        return result

    def _piecewise(self, s: Any) -> Expr:
        *branches, (otherwise, condition) = s.args
        if condition is not self._sympy.true:
            raise ExpressionError(f"the Piecewise has no last branch (value, True): {s}")
        result = self._of(otherwise)
        for value, condition in reversed(branches):
            result = self._choice(condition, self._of(value), result)
        return result

    def _choice(self, condition: Any, yes: Expr, no: Expr) -> Expr:
        """Return ``yes`` where the condition holds and ``no`` elsewhere."""
        sympy = self._sympy
        match condition:
            case sympy.And():
                for part in condition.args:
                    yes = self._choice(part, yes, no)
                return yes
            case sympy.Or():
                for part in condition.args:
                    no = self._choice(part, yes, no)
                return no
            case sympy.Not():
                return self._choice(condition.args[0], no, yes)
            case sympy.core.relational.Relational():
                return _comparison(
                    condition.rel_op, self._of(condition.lhs) - self._of(condition.rhs), yes, no
                )
            case _:
                raise _no_counterpart(condition)


def _comparison(operator: str, excess: Expr, yes: Expr, no: Expr) -> Expr:
    """Return ``yes`` where the excess of the left over the right side fits, by strict inequalities alone."""
    if operator in {">=", "<=", "=="}:
        return _comparison({">=": "<", "<=": ">", "==": "!="}[operator], excess, no, yes)
    if operator == "!=":
        no = _first(yes, -excess, no)
    return _first(yes, -excess if operator == "<" else excess, no)


def _sides(sympy: Any, condition: Any) -> list[Any]:
    """Return both sides of every comparison in a condition."""
    relational = sympy.core.relational.Relational
    parts = sympy.preorder_traversal(condition)
    return [side for part in parts if isinstance(part, relational) for side in part.args]


def _first(value: Expr, condition: Expr, otherwise: Expr) -> Expr:
    """Return the value where the condition is positive, in one list with the choices made otherwise."""
    nested = otherwise.kind == "function" and otherwise.name == "Piecewise"
    rest = otherwise.args if nested else (otherwise,)
    return _core.apply("Piecewise", (value, condition, *rest))


def _no_counterpart(s: Any) -> ExpressionError:
    return ExpressionError(f"SymPy's {type(s).__name__} has no counterpart here: {s}")


def _checked(name: str) -> str:
    """Return a name of SymPy's that prints as a name here too."""
    try:
        check_name(name)
    except ExpressionError as error:
        raise ExpressionError(
            f"from_sympy: {error}; say what it stands for, as in names={{{name!r}: symbols('a')}}"
        ) from None
    return name
