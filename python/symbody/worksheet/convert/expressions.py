"""Expressions of Maple as Python writes them, with the names of a program."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from symbody.geometry import Frame, Point
from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.files import FILES
from symbody.worksheet.convert.maple_calls import MAPLE
from symbody.worksheet.convert.mechanics_calls import MECHANICS
from symbody.worksheet.convert.names import Names, NoText, identifier
from symbody.worksheet.convert.operations import COMPARISON, POWER, PRODUCT, SUM, grouped, product, quotient
from symbody.worksheet.convert.selections import indexed, selection, word_of
from symbody.worksheet.sheet import syntax

__all__ = ["PythonText"]

_CONSTANTS = {"Pi": "sb.pi", "t": "sb.t", "true": "True", "false": "False"}
_AXES = {"X", "Y", "Z"}


def _compared(word: str) -> Callable[[str, str], str]:
    return lambda left, right: f"{grouped(left, COMPARISON + 1)} {word} {grouped(right, COMPARISON + 1)}"


_OPERATIONS: Mapping[str, Callable[[str, str], str]] = {
    "+": lambda left, right: f"{grouped(left, SUM)} + {grouped(right, SUM + 1)}",
    "-": lambda left, right: f"{grouped(left, SUM)} - {grouped(right, SUM + 1)}",
    "/": quotient,
    "^": lambda left, right: f"{grouped(left)}**{grouped(right)}",
    "mod": lambda left, right: f"{grouped(left)} % {grouped(right)}",
    "union": lambda left, right: f"{grouped(left, SUM)} + {grouped(right, SUM + 1)}",
    "minus": lambda left, right: f"[item for item in {left} if item not in {grouped(right)}]",
    "<>": lambda left, right: f"{grouped(left, COMPARISON + 1)} != {grouped(right, COMPARISON + 1)}",
    **{word: _compared(word) for word in ("<", "<=", ">", ">=")},
}


Called: TypeAlias = "Callable[[PythonText, str, tuple[syntax.Expression, ...]], str | None]"


class PythonText:
    """The text of expressions.

    Attributes:
        names: the names of the program.
        last: the variable that holds what ``%`` means.
        called: writes the definition of a procedure when it is first called.
        as_differences: whether ``x = 3`` is ``x - 3``, as an equation to be solved, and not ``{x: 3}``.
        shown: the expressions that the statement shows.
    """

    def __init__(
        self,
        names: Names,
        last: str = "",
        called: Called = lambda text, name, arguments: None,
    ) -> None:
        self.names, self.last, self.called = names, last, called
        self.as_differences = names.as_differences
        self.shown: list[str] = []

    def within(self, names: Names) -> PythonText:
        """Return the writer inside a loop or a function."""
        inner = PythonText(names, "", self.called)
        inner.as_differences = self.as_differences
        return inner

    def text(self, node: syntax.Expression) -> str:
        """Return an expression as Python writes it.

        Raises:
            NoText: there is no text for it.
        """
        writer = _WRITERS.get(type(node))
        if writer is None:
            raise NoText(type(node).__name__)
        return writer(self, node)

    def value(self, text: str) -> Any:
        """Return the value of a text that has been written, for its kind."""
        return self.names.value(text)

    # --- items -------------------------------------------------------------------------------------------------------

    def items(self, nodes: tuple[syntax.Expression, ...]) -> str:
        """Return items behind each other; sequences are opened."""
        return ", ".join(text for node in nodes for text in [self.item(node)] if text)

    def item(self, node: syntax.Expression) -> str:
        """Return an item of a list, or an argument; a sequence is opened."""
        match node:
            case syntax.Call(function=syntax.Name(name="op"), arguments=(whole,)):
                return f"*{grouped(self.text(whole))}"
            case syntax.Call(function=syntax.Name(name="comp_XYZ" | "Comps"), arguments=arguments):
                return f"*{self.components(arguments)}"
            case syntax.Call(function=syntax.Name(name="seq"), arguments=(each, span)):
                return f"*{self.comprehension(each, span)}"
            case syntax.SequenceDisplay(items=items):
                return self.items(items)
        return self.text(node)

    def listed(self, nodes: tuple[syntax.Expression, ...]) -> str:
        """Return a list; one that holds an opened sequence alone is that list."""
        if len(nodes) == 1:
            only = self.item(nodes[0])
            if only.startswith("*"):
                found = only[1:]
                return found if isinstance(self.value(found), list) else f"[{only}]"
        return f"[{self.items(nodes)}]"

    def comprehension(self, each: syntax.Expression, span: syntax.Expression) -> str:
        """Return ``[each for i in range(a, b + 1)]``, or over the items of a list."""
        name, over, first = self.span(span)
        inner = self.names.inner()
        inner.values[name] = first
        writer = self.within(inner)
        body = writer.item(each)
        if body.startswith("*"):
            return f"[item for {name} in {over} for item in {body[1:]}]"
        return f"[{body} for {name} in {over}]"

    def span(self, span: syntax.Expression) -> tuple[str, str, Any]:
        """Return the variable of ``i = a..b`` or ``i in L``, what it goes over, and its first value."""
        match span:
            case syntax.Infix(
                operator="=", left=variable, right=syntax.Infix(operator="..", left=first, right=last)
            ):
                a, b = self.text(first), self.text(last)
                name = _bare(variable)
                if not isinstance(self.value(a), int):
                    raise NoText("range")
                return name, f"range({a}, {_next(b)})", self.value(a)
            case syntax.Infix(operator="in" | "=", left=variable, right=whole):
                over = self.text(whole)
                found = self.value(over)
                if not isinstance(found, list | tuple) or not found:
                    raise NoText("in")
                return _bare(variable), over, found[0]
        raise NoText("range")

    # --- names -------------------------------------------------------------------------------------------------------

    def name(self, node: syntax.Name) -> str:
        name = node.name
        if name in {"ground", "master_frame", "moving_frame"}:
            return self.names.master or "sb.ground"
        if name == "nargs" and self.names.arguments:
            return f"len({self.names.arguments})"
        if name in {"NULL", "infinity", "I"}:
            raise NoText(name)
        return _CONSTANTS.get(name) or self.names.text(name)

    def delayed(self, node: syntax.Delayed) -> str:
        return self.text(node.body)

    def axis(self, node: syntax.Expression) -> str:
        """Return an axis of rotation: ``X`` as a text, unless it has a value."""
        is_word = isinstance(node, syntax.Name | syntax.Delayed)
        word = word_of(node) if is_word else ""
        known = self.names.values.get(word)
        if word in _AXES and (known is None or isinstance(known, Expr) or isinstance(node, syntax.Delayed)):
            return f'"{word}"'
        return self.text(node)

    def ditto(self, node: syntax.Ditto) -> str:
        if node.level > 1 or not self.last:
            raise NoText("%")
        return self.last

    def concatenation(self, node: syntax.Concatenation, *, is_function: bool = False) -> str:
        """Return the symbol ``gamma||i`` inside a loop, or the name itself where it is known."""
        left = word_of(node.left)
        right = self.text(node.right)
        found = self.value(right)
        if not isinstance(found, int):
            raise NoText("||")
        name = f"{left}{found}"
        if is_function:
            self.names.functions.add(name)
        if right == str(found):
            return self.names.text(name)
        known = self.names.values.get(identifier(name))
        if known is not None and not (isinstance(known, Expr) and known.is_variable):
            raise NoText("||")
        maker = "sb.functions_of_time" if name in self.names.functions else "sb.symbols"
        return f'{maker}(f"{left}{{{right}}}")'

    # --- operations --------------------------------------------------------------------------------------------------

    def prefix(self, node: syntax.Prefix) -> str:
        operand = self.text(node.operand)
        if node.operator == "not":
            return f"not {grouped(operand)}"
        if node.operator not in {"-", "+"}:
            raise NoText(node.operator)
        return f"-{grouped(operand, POWER)}" if node.operator == "-" else operand

    def infix(self, node: syntax.Infix) -> str:
        if node.operator == "=":
            return self.equation(node)
        left, right = self.text(node.left), self.text(node.right)
        operator = node.operator
        if operator in {"*", ".", "&*"}:
            return self.product(left, right)
        if operator in {"+", "-"}:
            left, right = self.with_identity(left, right), self.with_identity(right, left)
        if operator == "/" and isinstance(self.value(left), int) and isinstance(self.value(right), int):
            left = left if left.isdigit() else f"sb.number({left})"
        writer = _OPERATIONS.get(operator)
        if writer is None:
            raise NoText(operator)
        return writer(left, right)

    def with_identity(self, text: str, other: str) -> str:
        """Return a number beside a matrix as a multiple of the identity, as Maple takes it."""
        matrix = self.value(other)
        if isinstance(matrix, Frame):
            matrix = matrix.matrix
        found = self.value(text)
        if (
            isinstance(matrix, Matrix)
            and isinstance(found, int | Expr)
            and matrix.shape[0] == matrix.shape[1]
        ):
            unit = f"sb.identity({matrix.shape[0]})"
            return unit if text == "1" else f"{grouped(text, POWER)}*{unit}"
        if isinstance(found, Frame) and isinstance(matrix, int | Expr | Matrix):
            return f"{grouped(text)}.matrix"
        return text

    def product(self, left: str, right: str) -> str:
        """Return a product of numbers, frames, or matrices."""
        a, b = self.value(left), self.value(right)
        if isinstance(a, Frame) and isinstance(b, Matrix):
            return f"{grouped(left)}.matrix @ {grouped(right)}"
        if isinstance(a, Matrix) and isinstance(b, Frame):
            return f"{grouped(left)} @ {grouped(right)}.matrix"
        return product(left, right, " @ " if isinstance(a, Matrix) and isinstance(b, Matrix) else "*")

    def equation(self, node: syntax.Infix) -> str:
        """Return ``{x: value}`` for what gives a variable a value, and ``left - right`` for another equation."""
        left, right = self.text(node.left), self.text(node.right)
        found = self.value(left)
        is_known = isinstance(found, Expr) and (found.is_variable or found.kind == "application")
        if is_known and not self.as_differences:
            return f"{{{left}: {right}}}"
        return f"{grouped(left, SUM)} - {grouped(right, SUM + 1)}"

    def condition(self, node: syntax.Expression) -> str:
        """Return a condition: an equation is a comparison there."""
        match node:
            case syntax.Infix(operator="=", left=left, right=right):
                return f"{self.text(left)} == {self.text(right)}"
            case syntax.Infix(operator="and" | "or" as operator, left=left, right=right):
                return f"{grouped(self.condition(left))} {operator} {grouped(self.condition(right))}"
            case syntax.Prefix(operator="not", operand=operand):
                return f"not ({self.condition(operand)})"
        return self.text(node)

    def postfix(self, node: syntax.Postfix) -> str:
        if node.operator in {"%T", "^%T"}:
            return f"{grouped(self.text(node.operand))}.T"
        raise NoText(node.operator)

    # --- parts -------------------------------------------------------------------------------------------------------

    def components(self, arguments: tuple[syntax.Expression, ...]) -> str:
        """Return the components of a vector, or the coordinates of a point, also in another frame."""
        text = self.text(arguments[0])
        if len(arguments) == 2:
            text = f"sb.project({text}, {self.frame(arguments[1])})"
        found = self.value(text)
        return f"{grouped(text)}.{'coordinates' if isinstance(found, Point) else 'components'}"

    def frame(self, node: syntax.Expression) -> str:
        """Return a frame as commands take it: on the moving frame, where there is one."""
        if isinstance(node, syntax.Name | syntax.Delayed) and word_of(node) == "absolute":
            return self.names.master or "sb.ground"
        text = self.text(node)
        found = self.value(text)
        if isinstance(found, Matrix):
            text, found = f"sb.Frame({text})", self.value(f"sb.Frame({text})")
        if self.names.master and isinstance(found, Frame):
            master = self.names.values[self.names.master]
            if found.ancestor.key != master.ancestor.key:
                return f"{self.names.master}*{grouped(text, PRODUCT)}"
        return text

    # --- calls -------------------------------------------------------------------------------------------------------

    def call(self, node: syntax.Call) -> str:
        name, arguments = _called(node.function), node.arguments
        if not name:
            return self.call_of_value(node)
        if len(arguments) == 1 and isinstance(arguments[0], syntax.Name) and arguments[0].name == "t":
            found = self.function_of_time(name)
            if found:
                return found
        written = self.called(self, name, arguments)
        if written is not None:
            if written in self.names.root().values:
                self.names.define(written)
            return f"{written}({self.arguments(arguments)})"
        if callable(self.names.values.get(identifier(name))):
            return f"{identifier(name)}({self.arguments(arguments)})"
        command = MECHANICS.get(name) or MAPLE.get(name) or FILES.get(name)
        if command is not None:
            return command(self, arguments)
        raise NoText(name)

    def function_of_time(self, name: str) -> str:
        """Return the name of ``x(t)``, or nothing if x isn't a function of time."""
        if name not in self.names.functions:
            return ""
        known = self.names.values.get(identifier(name))
        if known is None or (
            isinstance(known, Expr) and known.kind == "symbol" and identifier(name) in self.names.symbols
        ):
            self.names.forget(name)
            self.names.declare(name)
        elif not isinstance(known, Expr):
            return ""
        return identifier(name)

    def call_of_value(self, node: syntax.Call) -> str:
        """Return the call of ``x[i](t)``, or of a function in a list."""
        match node.function, node.arguments:
            case syntax.Selection(whole=syntax.Name(name=name)) as whole, (syntax.Name(name="t"),):
                known = self.names.values.get(identifier(name))
                is_table = known is not None and not (isinstance(known, Expr) and known.is_variable)
                return self.text(whole) if is_table else indexed(self, whole, is_function=True)
            case syntax.Concatenation() as whole, (syntax.Name(name="t"),):
                return self.concatenation(whole, is_function=True)
        raise NoText("call")

    def arguments(self, nodes: tuple[syntax.Expression, ...]) -> str:
        """Return arguments of a function of the sheet: ``m = 3`` is a keyword."""
        texts = []
        for node in nodes:
            match node:
                case syntax.Infix(operator="=", left=syntax.Name(name=name), right=right):
                    texts.append(f"{identifier(name)}={self.text(right)}")
                case _:
                    texts.append(self.item(node))
        return ", ".join(texts)

    def arrow(self, node: syntax.Arrow) -> str:
        """Return ``lambda x: ...`` of symbols."""
        if isinstance(node.body, syntax.If):
            raise NoText("if")
        inner = self.names.inner()
        names = [identifier(each.name) for each in node.parameters]
        for name in names:
            inner.values[name] = self.names.value(f"sb.symbols('{name}')")
        return f"lambda {', '.join(names)}: {self.within(inner).text(node.body)}"

    def matrix(self, rows: list[tuple[syntax.Expression, ...]]) -> str:
        """Return a matrix by rows."""
        return f"sb.Matrix([{', '.join(f'[{self.items(row)}]' for row in rows)}])"

    def columns(self, node: syntax.Columns) -> str:
        rows = [each.items if isinstance(each, syntax.Rows) else (each,) for each in node.items]
        return self.matrix(rows)


def _bare(node: syntax.Expression) -> str:
    return identifier(word_of(node))


def _called(node: syntax.Expression) -> str:
    """Return the name of a function, also of one in a package; nothing for another value."""
    match node:
        case syntax.Name(name=name) | syntax.Member(name=name):
            return name
        case syntax.Delayed(body=syntax.Name(name=name)):
            return name
        case syntax.Selection(
            whole=syntax.Name(name=package),
            indices=(syntax.Name(name=name) | syntax.Delayed(body=syntax.Name(name=name)),),
        ) if package in _PACKAGES or package.startswith("MBSymba"):
            return name
    return ""


_PACKAGES = {
    "LinearAlgebra",
    "linalg",
    "PDEtools",
    "plots",
    "plottools",
    "codegen",
    "CodeGeneration",
    "StringTools",
    "FileTools",
}


def _next(text: str) -> str:
    return str(int(text) + 1) if text.isdigit() else f"{grouped(text, SUM)} + 1"


def _decimal(text: PythonText, node: syntax.Decimal) -> str:
    return f'sb.number("{node.text}")'


_WRITERS: Mapping[type, Callable[[PythonText, Any], str]] = {
    syntax.Integer: lambda text, node: str(node.value),
    syntax.Decimal: _decimal,
    syntax.Text: lambda text, node: repr(node.text),
    syntax.Name: PythonText.name,
    syntax.Ditto: PythonText.ditto,
    syntax.Delayed: PythonText.delayed,
    syntax.Prefix: PythonText.prefix,
    syntax.Infix: PythonText.infix,
    syntax.Postfix: PythonText.postfix,
    syntax.Concatenation: PythonText.concatenation,
    syntax.ListDisplay: lambda text, node: text.listed(node.items),
    syntax.SetDisplay: lambda text, node: text.listed(node.items),
    syntax.SequenceDisplay: lambda text, node: f"({text.items(node.items)})",
    syntax.Selection: selection,
    syntax.Call: PythonText.call,
    syntax.Arrow: PythonText.arrow,
    syntax.Columns: PythonText.columns,
    syntax.Rows: lambda text, node: text.matrix([node.items]),
}
