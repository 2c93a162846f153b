"""From a parse to nodes: a method for each rule of the grammar."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any, TypeVar

from lark import Token

from symbody.worksheet.reading.digits import MOST_DIGITS, integer_of
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.syntax import Expression, Parameter, Place, Statement

__all__ = ["Builder", "Mistake", "one_place", "unquoted"]

Items = list[Any]


class Mistake(Exception):
    """A statement with the form of the grammar, but without a meaning."""

    def __init__(self, place: Place, found: str, expected: str) -> None:
        super().__init__(f"found {found}, expected {expected}")
        self.place, self.found, self.expected = place, found, expected


def _assumed(parts: Items) -> tuple[Expression, ...]:
    """Return items of a sequence; those behind ``e assuming a > 0`` are more assumptions."""
    for place, part in enumerate(parts):
        if isinstance(part, syntax.Infix) and part.operator == "assuming" and place + 1 < len(parts):
            together = syntax.SequenceDisplay((part.right, *parts[place + 1 :]), place=part.right.place)
            return (*parts[:place], replace(part, right=together))
    return tuple(parts)


class Builder:
    """The meaning of the rules. Each method takes the place of its text and what its parts have become."""

    # --- statements ---

    def start(self, place: Place, parts: Items) -> Statement:
        statement = parts[0] if len(parts) == 2 else syntax.Empty(place=place)
        return replace(statement, shown=parts[-1])

    def terminator(self, _: Place, parts: Items) -> bool:
        return bool(parts[0].type == "SEMICOLON")

    def evaluation(self, place: Place, parts: Items) -> Statement:
        match parts[0]:
            case syntax.Call(
                function=syntax.Name(name="RETURN"), arguments=values
            ):  # syntax of Maple V and earlier
                return syntax.Return(_together(values, place), place=place)
            case syntax.Call(function=syntax.Name(name="ERROR"), arguments=values):
                return syntax.Raise(values, place=place)
        return syntax.Evaluation(parts[0], place=place)

    def assignment(self, place: Place, parts: Items) -> Statement:
        targets = tuple(_target(target) for target in _items(_bare(parts[0])))
        if not targets:
            raise Mistake(parts[0].place, "()", "a name")
        return syntax.Assignment(targets, parts[1], place=place)

    def body(self, _: Place, parts: Items) -> tuple[Statement, ...]:
        statements: list[Statement] = []
        for part in parts:
            if not isinstance(part, tuple):
                statements.append(part)
                continue
            shown, following = part
            if statements and not shown:
                statements[-1] = replace(statements[-1], shown=False)
            if following is not None:
                statements.append(following)
        return tuple(statements)

    def following(self, _: Place, parts: Items) -> tuple[bool, Statement | None]:
        return parts[0], parts[1] if len(parts) == 2 else None

    def variable(self, place: Place, parts: Items) -> Parameter:
        return Parameter(parts[0].name, parts[1], parts[2], place=place)

    def declaration(self, place: Place, parts: Items) -> Statement:
        names = tuple(variable.name for variable in parts[1:])
        return syntax.Declaration(str(parts[0]), names, tuple(parts[1:]), place=place)

    def heading(self, place: Place, parts: Items) -> Statement:
        names = tuple(_word(item) for item in _items(parts[1]))
        return syntax.Declaration(str(parts[0]), names, place=place)

    def conditional(self, place: Place, parts: Items) -> Statement:
        condition, then, *more, otherwise = parts
        return syntax.If(((condition, then), *more), otherwise or (), place=place)

    def alternative(self, _: Place, parts: Items) -> tuple[Expression, tuple[Statement, ...]]:
        return parts[0], parts[1]

    def loop(self, place: Place, parts: Items) -> Statement:
        *clauses, body = parts
        given: dict[str, Any] = {}
        for clause in clauses:
            for key, value in clause.items():
                if key in given:
                    raise Mistake(place, f"two clauses {key!r} in one loop", "one")
                given[key] = value
        return syntax.For(body, **given, place=place)

    def for_each(self, _: Place, parts: Items) -> dict[str, Any]:
        items = {} if parts[1] is None else {"items": parts[1]}
        return {"variable": parts[0].name, **items}

    def for_clause(self, _: Place, parts: Items) -> dict[str, Any]:
        return {_CLAUSES[str(parts[0])]: parts[1]}

    def returned(self, place: Place, parts: Items) -> Statement:
        return syntax.Return(parts[0], place=place)

    def raised(self, place: Place, parts: Items) -> Statement:
        return syntax.Raise(_items(parts[0]), place=place)

    def attempt(self, place: Place, parts: Items) -> Statement:
        body, *handlers, last = parts
        return syntax.Try(body, tuple(handlers), last or (), place=place)

    def catch(self, _: Place, parts: Items) -> tuple[tuple[str, ...], tuple[Statement, ...]]:
        texts = tuple(unquoted(part) for part in parts[:-1] if getattr(part, "type", "") == "STRING")
        return texts, parts[-1]

    def using(self, place: Place, parts: Items) -> Statement:
        *packages, _, body = parts
        return syntax.Use(tuple(packages), body, place=place)

    def next(self, place: Place, _: Items) -> Statement:
        return syntax.Next(place=place)

    def leave(self, place: Place, _: Items) -> Statement:
        return syntax.Break(place=place)

    def quit(self, place: Place, _: Items) -> Statement:
        return syntax.Quit(place=place)

    def read(self, place: Place, parts: Items) -> Statement:
        return syntax.Read(parts[0], place=place)

    def save(self, place: Place, parts: Items) -> Statement:
        return syntax.Save(_items(_bare(parts[0])), place=place)

    # --- operators ---

    def several(self, place: Place, parts: Items) -> Expression:
        return syntax.SequenceDisplay(_assumed(parts), place=place)

    def arrow(self, place: Place, parts: Items) -> Expression:
        heading = tuple(_heading(item) for item in _items(_bare(parts[0])))
        return syntax.Arrow(heading, parts[1], place=place)

    def infix(self, place: Place, parts: Items) -> Expression:
        left, operator, right = parts
        sign, tilde = operator.removesuffix("~"), operator.endswith("~")
        return syntax.Infix("^" if sign == "**" else sign, left, right, tilde, place=place)

    def prefix(self, place: Place, parts: Items) -> Expression:
        return syntax.Prefix(parts[0].removesuffix("~"), parts[1], place=place)

    def postfix(self, place: Place, parts: Items) -> Expression:
        return syntax.Postfix(parts[1].removeprefix("^"), parts[0], place=place)

    def closed_range(self, place: Place, parts: Items) -> Expression:
        return syntax.Infix("..", parts[0], parts[1], place=place)

    def range_from(self, place: Place, parts: Items) -> Expression:
        return syntax.Infix("..", parts[0], _nothing(place), place=place)

    def range_to(self, place: Place, parts: Items) -> Expression:
        return syntax.Infix("..", _nothing(place), parts[0], place=place)

    def range_of_all(self, place: Place, _: Items) -> Expression:
        return syntax.Infix("..", _nothing(place), _nothing(place), place=place)

    def call(self, place: Place, parts: Items) -> Expression:
        return syntax.Call(parts[0], _items(parts[1]), place=place)

    def selection(self, place: Place, parts: Items) -> Expression:
        return syntax.Selection(parts[0], _items(parts[1]), place=place)

    def member(self, place: Place, parts: Items) -> Expression:
        return syntax.Member(parts[0], parts[1].name, place=place)

    def elementwise(self, place: Place, parts: Items) -> Expression:
        return syntax.Elementwise(parts[0], place=place)

    def concatenation(self, place: Place, parts: Items) -> Expression:
        left, right = parts
        if isinstance(right, Token):
            right = self.integer(place, [right]) if right.type == "INTEGER" else self.text(place, [right])
        return syntax.Concatenation(left, right, place=place)

    # --- atoms ---

    def integer(self, place: Place, parts: Items) -> Expression:
        if len(parts[0]) > MOST_DIGITS:
            raise Mistake(place, f"a number of {len(parts[0])} digits", f"at most {MOST_DIGITS}")
        return syntax.Integer(integer_of(parts[0]), place=place)

    def decimal(self, place: Place, parts: Items) -> Expression:
        return syntax.Decimal(str(parts[0]), place=place)

    def text(self, place: Place, parts: Items) -> Expression:
        return syntax.Text(unquoted(parts[0]), place=place)

    def ditto(self, place: Place, parts: Items) -> Expression:
        return syntax.Ditto(len(parts[0]), place=place)

    def name(self, place: Place, parts: Items) -> syntax.Name:
        token = parts[0]
        return syntax.Name(unquoted(token) if token.type == "BACKQUOTED" else str(token), place=place)

    def variable_name(self, _: Place, parts: Items) -> Expression:
        name: Expression = parts[0]
        return name

    def delayed(self, place: Place, parts: Items) -> Expression:
        return syntax.Delayed(parts[0], place=place)

    def parenthesized(self, place: Place, parts: Items) -> Expression:
        if parts[0] is None:
            return _nothing(place)
        inner: Expression = parts[0]
        return inner

    def list(self, place: Place, parts: Items) -> Expression:
        return syntax.ListDisplay(_items(parts[0]), place=place)

    def set(self, place: Place, parts: Items) -> Expression:
        return syntax.SetDisplay(_items(parts[0]), place=place)

    def column(self, place: Place, parts: Items) -> syntax.Columns:
        return syntax.Columns(tuple(parts), place=place)

    def vector(self, place: Place, parts: Items) -> Expression:
        """``<a, b>`` is a column, ``<a | b>`` a row, and ``<a, b | c, d>`` columns one beside the other."""
        if len(parts) == 1:
            column: syntax.Columns = parts[0]
            return replace(column, place=place)
        entries = tuple(part.items[0] if len(part.items) == 1 else part for part in parts)
        return syntax.Rows(entries, place=place)

    def rows(self, place: Place, parts: Items) -> Expression:
        """``<a, b; c, d>``: rows one below the other."""
        rows = [part for part in parts if isinstance(part, syntax.Columns)]
        return syntax.Columns(tuple(syntax.Rows(row.items, place=row.place) for row in rows), place=place)

    # --- procedures ---

    def parameter(self, place: Place, parts: Items) -> Parameter:
        return Parameter(parts[0].name, parts[1], parts[2], place=place)

    def keywords(self, _: Place, parts: Items) -> tuple[Parameter, ...]:
        return tuple(replace(parameter, keyword=True) for parameter in parts[0])

    def no_more(self, place: Place, _: Items) -> Parameter:
        return Parameter("$", rest=True, place=place)

    def parameters(self, _: Place, parts: Items) -> tuple[Parameter, ...]:
        return tuple(one for part in parts for one in (part if isinstance(part, tuple) else (part,)))

    def procedure(self, place: Place, parts: Items) -> Expression:
        heading, body = parts[0] or (), parts[-1]
        declared: dict[str, list[str]] = {
            "local": [],
            "global": [],
            "option": [],
            "uses": [],
            "description": [],
        }
        statements: list[Statement] = []
        for statement in body:
            if isinstance(statement, syntax.Declaration):
                declared[_KINDS.get(statement.kind, statement.kind)] += statement.names
                statements += _initial_values(statement)
            else:
                statements.append(statement)
        return syntax.Procedure(
            heading,
            tuple(statements),
            tuple(declared["local"]),
            tuple(declared["global"]),
            tuple(declared["option"]),
            tuple(declared["uses"]),
            tuple(declared["description"]),
            place=place,
        )


_CLAUSES = {"from": "start", "by": "step", "to": "stop", "while": "condition"}
_KINDS = {"options": "option", "export": "local"}
_ASSIGNABLE = (syntax.Name, syntax.Selection, syntax.Call, syntax.Concatenation, syntax.Member)

_Item = TypeVar("_Item")


def one_place(token: Token) -> Place:
    """Return the place of a token."""
    line, column = token.line or 1, token.column or 1
    return Place(line, column, token.end_line or line, token.end_column or column + len(token))


def unquoted(token: str) -> str:
    """Return the text between the quotes of a string or of a name in backquotes."""
    quote, inner = token[0], token[1:-1]
    text = inner.replace(quote + quote, quote)
    if quote == "`":
        return text
    for escape, character in (("\\n", "\n"), ("\\t", "\t"), ('\\"', '"'), ("\\\\", "\\")):
        text = text.replace(escape, character)
    return text


def _nothing(place: Place) -> Expression:
    return syntax.SequenceDisplay((), place=place)


def _items(part: Expression | None) -> tuple[Expression, ...]:
    """Return the items between commas; an item in parentheses that is a sequence stays one."""
    if part is None:
        return ()
    return part.items if isinstance(part, syntax.SequenceDisplay) else (part,)


def _bare(part: Expression) -> Expression:
    """Return a sequence without its parentheses: ``(a, b) := f(x)``, ``save(a, b, file)``."""
    while isinstance(part, syntax.SequenceDisplay) and len(part.items) == 1:
        part = part.items[0]
    return part


def _together(values: tuple[Expression, ...], place: Place) -> Expression | None:
    """Return a single expression or a sequence of several; None if there are none."""
    if len(values) < 2:
        return values[0] if values else None
    return syntax.SequenceDisplay(values, place=place)


def _target(part: Expression) -> Expression:
    while isinstance(part, syntax.Delayed):
        part = part.body
    if not isinstance(part, _ASSIGNABLE):
        raise Mistake(
            part.place, "something that cannot have a value before :=", "a name, such as x, x[1] or f(t)"
        )
    return part


def _word(item: Expression) -> str:
    """Return the word of an option, a description, or of a package that is used."""
    match item:
        case syntax.Name(name=text) | syntax.Text(text=text):
            return text
        case syntax.Infix(operator="=", left=left, right=right):
            return f"{_word(left)}={_word(right)}"
        case syntax.Member(package=package, name=name):
            return f"{_word(package)}:-{name}"
        case syntax.Selection(whole=whole, indices=(index, *_)):
            return f"{_word(whole)}[{_word(index)}]"
    return ""


def _heading(item: Expression) -> Parameter:
    """Return a parameter of an operator: ``x`` or ``x::type``."""
    match item:
        case syntax.Name(name=name):
            return Parameter(name, place=item.place)
        case syntax.Infix(operator="::", left=syntax.Name(name=name), right=kind):
            return Parameter(name, kind, place=item.place)
        case syntax.SequenceDisplay(items=()):
            raise Mistake(item.place, "()", "a name")
    raise Mistake(item.place, "something else than names before ->", "a name, or names in parentheses")


def _initial_values(declaration: syntax.Declaration) -> Iterable[Statement]:
    """Return the assignments of ``local a := 0``."""
    for variable in declaration.variables:
        if variable.default is not None:
            name = syntax.Name(variable.name, place=variable.place)
            yield syntax.Assignment((name,), variable.default, place=variable.place)
