"""Maple's expressions as text of Python: a table of commands, and a method for each kind of expression."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from symbody.geometry import Point, Vector
from symbody.symbolic import Matrix, symbol, time_function
from symbody.worksheet import syntax

__all__ = ["Names", "NoText", "PythonText", "identifier"]


class NoText(Exception):
    """An expression that has no text here; its value is written instead."""


_TAKEN = frozenset({"sb", "print", "range", "len", "value", "list", "set"})


def identifier(name: str) -> str:
    """Return a name of Python for a name of Maple: ``_gravity`` becomes ``gravity``, ``theta[1]`` ``theta_1``."""
    text = re.sub(r"\W+", "_", name).strip("_") or "name"
    if text[0].isdigit():
        text = f"_{text}"
    return f"{text}_" if keyword.iskeyword(text) or text in _TAKEN else text


def _imported() -> dict[str, Any]:
    """Return what the first line of a program imports."""
    values: dict[str, Any] = {}
    exec("import symbody as sb", values)
    return values


@dataclass
class Names:
    """What names stand for in the program.

    Attributes:
        values: the variables of the program so far.
        functions: names of Maple that are functions of time.
        symbols: names of Maple that the program declares as symbols or as functions of time, by their identifiers.
    """

    values: dict[str, Any] = field(default_factory=_imported)
    functions: set[str] = field(default_factory=set)
    symbols: dict[str, str] = field(default_factory=dict)

    def text(self, name: str) -> str:
        """Return the identifier of a name, which is declared if it has no value."""
        text = identifier(name)
        if text not in self.values:
            self.declare(name)
        return text

    def declare(self, name: str) -> None:
        """Make a name a symbol, or a function of time."""
        text = identifier(name)
        self.values[text] = time_function(name) if name in self.functions else symbol(name)
        self.symbols[text] = name


class PythonText:
    """The text of expressions, with the names of a program."""

    def __init__(self, names: Names, last: str) -> None:
        self.names, self.last = names, last

    def text(self, node: syntax.Expression) -> str:
        """Return an expression as Python writes it.

        Raises:
            NoText: there is no text for it.
        """
        writer = _WRITERS.get(type(node))
        if writer is None:
            raise NoText(type(node).__name__)
        return writer(self, node)

    def items(self, nodes: tuple[syntax.Expression, ...]) -> str:
        return ", ".join(self.item(node) for node in nodes)

    def item(self, node: syntax.Expression) -> str:
        """Return an item of a list or an argument; sequences are opened."""
        match node:
            case syntax.Call(function=syntax.Name(name="op"), arguments=(whole,)):
                return f"*{self.text(whole)}"
            case syntax.Call(function=syntax.Name(name="comp_XYZ" | "Comps"), arguments=arguments):
                return f"*{self.components(arguments)}"
            case syntax.Call(function=syntax.Name(name="seq"), arguments=(each, syntax.Infix(operator="="))):
                return f"*{self.sequence(each, node.arguments[1])}"
        return self.text(node)

    def sequence(self, each: syntax.Expression, span: syntax.Expression) -> str:
        """Return ``[each for i in range(a, b + 1)]``."""
        match span:
            case syntax.Infix(
                left=syntax.Name(name=name), right=syntax.Infix(operator="..", left=first, right=last)
            ):
                inner = identifier(name)
                before = self.names.values.get(inner)
                self.names.values[inner] = 1
                try:
                    body = self.text(each)
                finally:
                    self.names.values.pop(inner)
                    if before is not None:
                        self.names.values[inner] = before
                return f"[{body} for {inner} in range({self.text(first)}, {self.text(last)} + 1)]"
        raise NoText("seq")

    def value(self, text: str) -> Any:
        """Return the value of a text that has been written, for its kind."""
        try:
            return eval(text, self.names.values)
        except Exception as error:
            raise NoText(str(error)) from None

    def name(self, node: syntax.Name) -> str:
        constants = {"Pi": "sb.pi", "t": "sb.t", "ground": "sb.ground", "true": "True", "false": "False"}
        if node.name in {"NULL", "master_frame", "moving_frame", "infinity", "I"}:
            raise NoText(node.name)
        return constants.get(node.name) or self.names.text(node.name)

    def ditto(self, node: syntax.Ditto) -> str:
        if node.level > 1 or not self.last:
            raise NoText("%")
        return self.last

    def delayed(self, node: syntax.Delayed) -> str:
        if isinstance(node.body, syntax.Name) and node.body.name in {"X", "Y", "Z"}:
            return f'"{node.body.name}"'
        raise NoText("quotes")

    def infix(self, node: syntax.Infix) -> str:
        left, right = self.text(node.left), self.text(node.right)
        match node.operator:
            case "+" | "-" | "/":
                return f"{_grouped(left)} {node.operator} {_grouped(right)}"
            case "*" | "." | "&*":
                matrices = all(isinstance(self.value(side), Matrix) for side in (left, right))
                return f"{_grouped(left)} {'@' if matrices else '*'} {_grouped(right)}"
            case "^":
                return f"{_grouped(left)}**{_grouped(right)}"
            case "=":
                return f"{_grouped(left)} - {_grouped(right)}"
            case "union":
                return f"{left} + {right}"
        raise NoText(node.operator)

    def selection(self, node: syntax.Selection) -> str:
        whole = self.text(node.whole)
        match node.indices:
            case (syntax.Name(name=word),) if word in _FIELDS:
                return f"{whole}.{_FIELDS[word]}"
            case (syntax.Integer(value=index),) if isinstance(self.value(whole), list | tuple):
                return f"{whole}[{index - 1 if index > 0 else index}]"
            case (index,) if isinstance(self.value(whole), list | tuple):
                return f"{whole}[{self.text(index)} - 1]"
        raise NoText("selection")

    def call(self, node: syntax.Call) -> str:
        match node:
            case syntax.Call(function=syntax.Name(name=name), arguments=arguments):
                pass
            case _:
                raise NoText("call")
        if (
            arguments
            and isinstance(arguments[0], syntax.Name)
            and arguments[0].name == "t"
            and len(arguments) == 1
        ):
            if name in self.names.functions and identifier(name) in self.names.symbols:
                return self.names.text(name)
            if name in self.names.functions:
                self.names.declare(name)
                return identifier(name)
        command = _COMMANDS.get(name)
        if command is None:
            raise NoText(name)
        return command(self, arguments)

    def components(self, arguments: tuple[syntax.Expression, ...]) -> str:
        """Return the components of a vector, or the coordinates of a point, also in another frame."""
        text = self.text(arguments[0])
        if len(arguments) == 2:
            text = f"sb.project({text}, {self.text(arguments[1])})"
        found = self.value(text)
        return f"{text}.{'coordinates' if isinstance(found, Point) else 'components'}"


def _grouped(text: str) -> str:
    """Return an operand, in brackets if it is more than one factor."""
    return text if re.fullmatch(r"[\w.]+|[\w.]+\([^()]*\)", text) else f"({text})"


_FIELDS = {
    "frame": "frame",
    "mass": "mass",
    "inertia": "inertia",
    "comps": "components",
    "coords": "coordinates",
}


def _plain(function: str, *counts: int) -> Callable[[PythonText, tuple[syntax.Expression, ...]], str]:
    """Return the writer of a function with the same arguments; ``counts`` are how many it may have."""

    def write(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
        opened = any(text.item(each).startswith("*") for each in arguments)
        if counts and len(arguments) not in counts and not opened:
            raise NoText(function)
        return f"{function}({text.items(arguments)})"

    return write


def _vector(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    if len(arguments) == 4:
        return f"sb.Vector({text.items(arguments)})"
    first, second = (text.text(each) for each in arguments)
    return f"sb.project({second} - {first}, {first}.frame)"


def _force(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    count = 4 if len(arguments) > 4 else 1
    what, rest = arguments[:count], [text.text(each) for each in arguments[count:]]
    names = ("at", "on", "reaction")
    return f"sb.Force({text.items(what)}, {', '.join(f'{n}={v}' for n, v in zip(names, rest, strict=False))})"


def _torque(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    count = 4 if len(arguments) > 3 else 1
    what, rest = arguments[:count], [text.text(each) for each in arguments[count:]]
    named = (f"{name}={value}" for name, value in zip(("on", "reaction"), rest, strict=False))
    return f"sb.Torque({text.items(what)}, {', '.join(named)})"


def _heavy(function: str) -> Callable[[PythonText, tuple[syntax.Expression, ...]], str]:
    """Return the writer of a function to which gravity is given, once the sheet has assigned it."""

    def write(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
        gravity = ", gravity=gravity" if isinstance(text.names.values.get("gravity"), Vector) else ""
        return f"{function}({text.items(arguments)}{gravity})"

    return write


def _component(index: int) -> Callable[[PythonText, tuple[syntax.Expression, ...]], str]:
    return lambda text, arguments: f"{text.components(arguments)}[{index}]"


def _unit(index: int) -> Callable[[PythonText, tuple[syntax.Expression, ...]], str]:
    components = ", ".join(str(int(k == index)) for k in range(3))
    return lambda text, arguments: f"sb.Vector({text.items(arguments)}, {components})"


def _derivative(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    written = text.text(arguments[0])
    for variable in arguments[1:]:
        written = f"sb.diff({written}, {text.text(variable)})"
    return written


def _substitution(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    *changes, expression = arguments
    written = text.text(expression)
    for change in changes:
        match change:
            case syntax.Infix(operator="=", left=left, right=right):
                written = f"sb.subs({written}, {{{text.text(left)}: {text.text(right)}}})"
            case _ if isinstance(text.value(text.text(change)), dict):
                written = f"sb.subs({written}, {text.text(change)})"
            case _:
                raise NoText("subs")
    return written


def _lagrange(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    return f"sb.lagrange({text.items(arguments[:2])})"


def _solution(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    if len(arguments) != 2 or not all(isinstance(each, syntax.SetDisplay) for each in arguments):
        raise NoText("solve")
    return f"sb.solve({text.text(arguments[0])}, {text.text(arguments[1])})"


def _mapped(text: PythonText, arguments: tuple[syntax.Expression, ...]) -> str:
    if len(arguments) != 2 or not isinstance(arguments[0], syntax.Name):
        raise NoText("map")
    written, whole = _COMMANDS.get(arguments[0].name), text.text(arguments[1])
    if written is None or not isinstance(text.value(whole), list | tuple):
        raise NoText("map")
    return f"[{_APPLIED.get(arguments[0].name, 'sb.' + arguments[0].name)}(each) for each in {whole}]"


_APPLIED: Mapping[str, str] = {"evalm": "", "arctan": "sb.atan", "ln": "sb.log"}

_COMMANDS: Mapping[str, Callable[[PythonText, tuple[syntax.Expression, ...]], str]] = {
    **{
        name: _plain(f"sb.{name}", 1) for name in ("sin", "cos", "tan", "sqrt", "exp", "sinh", "cosh", "tanh")
    },
    **{
        name: _plain(f"sb.{name}", 1)
        for name in ("simplify", "expand", "angular_velocity", "origin", "power")
    },
    **{
        name: _plain(f"sb.{name}", 1, 2)
        for name in ("velocity", "acceleration", "linear_momentum", "angular_momentum")
    },
    "arcsin": _plain("sb.asin", 1),
    "arccos": _plain("sb.acos", 1),
    "arctan": lambda text, arguments: _plain("sb.atan" if len(arguments) == 1 else "sb.atan2", 1, 2)(
        text, arguments
    ),
    "ln": _plain("sb.log", 1),
    "abs": _plain("abs", 1),
    "translate": _plain("sb.translate", 3),
    "Translate": _plain("sb.translate", 3),
    "rotate": _plain("sb.rotate", 2),
    "Rotate": _plain("sb.rotate", 2),
    "inv_frame": lambda text, arguments: f"{_grouped(text.text(arguments[0]))}.inverse()",
    "make_POINT": _plain("sb.Point", 4),
    "make_VECTOR": _vector,
    "join_points": _vector,
    "make_BODY": _plain("sb.Body", 2, 3, 4, 5, 6, 7, 8),
    "make_FORCE": _force,
    "make_TORQUE": _torque,
    "CoM": lambda text, arguments: f"{text.text(arguments[0])}.center_of_mass",
    "frame_frozen_velocity": _plain("sb.frozen_velocity", 2),
    "project": _plain("sb.project", 2),
    "dot_prod": _plain("sb.dot", 2),
    "cross_prod": _plain("sb.cross", 2),
    **dict.fromkeys(("comp_X", "Xcomp"), _component(0)),
    **dict.fromkeys(("comp_Y", "Ycomp"), _component(1)),
    **dict.fromkeys(("comp_Z", "Zcomp"), _component(2)),
    "kinetic_energy": _plain("sb.kinetic_energy", 1),
    "gravitational_energy": _heavy("sb.gravitational_energy"),
    "newton_equations": _heavy("sb.newton_equations"),
    "euler_equations": _heavy("sb.euler_equations"),
    "lagrange": _lagrange,
    "generalized_force": _plain("sb.generalized_force", 2),
    "diff": _derivative,
    "subs": _substitution,
    "solve": _solution,
    "map": _mapped,
    "nops": _plain("len", 1),
    **dict.fromkeys(("comp_XYZ", "Comps"), lambda text, arguments: text.components(arguments)),
    **{f"uvec_{axis}": _unit(index) for index, axis in enumerate("XYZ")},
    "evalm": lambda text, arguments: text.text(arguments[0]),
}

_WRITERS: Mapping[type, Callable[[PythonText, Any], str]] = {
    syntax.Integer: lambda text, node: str(node.value),
    syntax.Decimal: lambda text, node: f'sb.number("{node.text}")',
    syntax.Text: lambda text, node: repr(node.text),
    syntax.Name: PythonText.name,
    syntax.Ditto: PythonText.ditto,
    syntax.Delayed: PythonText.delayed,
    syntax.Prefix: lambda text, node: f"{node.operator}{_grouped(text.text(node.operand))}",
    syntax.Infix: PythonText.infix,
    syntax.ListDisplay: lambda text, node: f"[{text.items(node.items)}]",
    syntax.SetDisplay: lambda text, node: f"[{text.items(node.items)}]",
    syntax.SequenceDisplay: lambda text, node: f"({text.items(node.items)})",
    syntax.Selection: PythonText.selection,
    syntax.Call: PythonText.call,
}
