"""Expressions: a method per construct."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable
from typing import Any

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr, UndefinedFunction, number
from symbody.worksheet import builtins
from symbody.worksheet.builtins.arrays import from_columns, from_rows
from symbody.worksheet.builtins.sets import joined_by
from symbody.worksheet.evaluation import arithmetic
from symbody.worksheet.evaluation.condition import compared, truth
from symbody.worksheet.evaluation.current import flattened, set_of
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.select import selected
from symbody.worksheet.evaluation.session import Session, sequence
from symbody.worksheet.interpreter.procedure import ProcedureCall, call_procedure
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.complex_number import normal
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Boolean,
    Builtin,
    Listed,
    MapleSet,
    ProcedureValue,
    Quoted,
    Range,
    Reference,
    Relation,
    Sequence,
    String,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["Evaluator"]

_RELATIONS = {"=", "<>", "<", "<=", "::"}
_TURNED = {">": "<", ">=": "<="}
_ARITHMETIC = {"+", "-", "*", "/", "^", ".", "&*"}
_SETS = {"union", "minus", "intersect", "subset"}


class Evaluator:
    """Evaluates expressions in a session.

    Attributes:
        session: the session.
        execute: executes the statements of a procedure; set by the interpreter.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        self.depth = 0
        self.execute: Callable[[Iterable[syntax.Statement]], Value] = lambda statements: NULL
        session.call = self.call
        session.evaluate = self.evaluate
        session.rebuild = lambda scalar, values: arithmetic.rebuilt(session, scalar, values)
        session.select = lambda whole, indices: selected(session, whole, indices)
        self._methods: dict[type, Callable[[Any], Value]] = {
            syntax.Integer: lambda node: number(node.value),
            syntax.Decimal: self._decimal,
            syntax.Name: self._name,
            syntax.Text: lambda node: String(node.text),
            syntax.Ditto: self._ditto,
            syntax.Delayed: lambda node: self.unevaluated(node.body),
            syntax.SequenceDisplay: lambda node: sequence(self.arguments(node.items)),
            syntax.ListDisplay: lambda node: Listed(self.arguments(node.items)),
            syntax.SetDisplay: lambda node: set_of(self.arguments(node.items)),
            syntax.Columns: lambda node: from_columns(session, self.arguments(node.items)),
            syntax.Rows: lambda node: from_rows(session, self.arguments(node.items)),
            syntax.Prefix: self._prefix,
            syntax.Postfix: self._postfix,
            syntax.Infix: self._infix,
            syntax.Concatenation: self._concatenated,
            syntax.Call: self._call,
            syntax.Selection: self._selection,
            syntax.Member: self._member,
            syntax.Elementwise: lambda node: Unevaluated(symbol("~"), (self.evaluate(node.function),)),
            syntax.Arrow: self._procedure,
            syntax.Procedure: self._procedure,
        }

    def evaluate(self, node: syntax.Expression) -> Value:
        """Return the value of an expression."""
        self.depth += 1
        if self.depth > 2500:
            self.depth = 0
            raise WorksheetError("too many levels of recursion")
        try:
            return self._methods[type(node)](node)
        except WorksheetError as error:
            if error.place is None:
                error.place = node.place
            raise
        except (SymbodyError, ArithmeticError, MemoryError) as error:
            raise WorksheetError(str(error) or type(error).__name__, node.place) from error
        finally:
            self.depth -= 1

    def arguments(self, nodes: Iterable[syntax.Expression]) -> tuple[Value, ...]:
        """Return the values of several expressions, sequences among them opened."""
        return tuple(flattened(self.evaluate(node) for node in nodes))

    # --- leaves -------------------------------------------------------------------------------------------------------

    def _decimal(self, node: syntax.Decimal) -> Value:
        text = node.text
        mantissa, _, exponent = text.lower().partition("e")
        if len(exponent.lstrip("+-")) > 4:
            raise WorksheetError(f"the number {text} is out of range")
        value = number((mantissa if mantissa.strip(".") else "0") + (f"e{exponent}" if exponent else ""))
        return value if value.is_decimal else number(float(text)) if "." in text or exponent else value

    def _name(self, node: syntax.Name) -> Value:
        return self._named(node.name)

    def _named(self, name: str) -> Value:
        session = self.session
        if name in ("args", "nargs", "procname") and session.scopes:
            scope = session.scopes[-1]
            if name == "procname":
                return symbol(scope.name)
            return sequence(scope.arguments) if name == "args" else number(len(scope.arguments))
        if name == "Digits" and name not in session.names:
            return number(session.options.digits)
        return session.value(name)

    def _ditto(self, node: syntax.Ditto) -> Value:
        lasts = self.session.lasts
        if len(lasts) < node.level:
            return NULL
        return self.session.current(lasts[node.level - 1])

    def unevaluated(self, node: syntax.Expression) -> Value:
        """Return what quotes keep: a name, a call of what isn't a command, or code as it is written."""
        if isinstance(node, syntax.Name):
            return symbol(node.name)
        if isinstance(node, syntax.Concatenation):
            return symbol(self.concatenation(node))
        if isinstance(node, syntax.Integer | syntax.Decimal | syntax.Text | syntax.Ditto):
            return self.evaluate(node)
        if isinstance(node, syntax.ListDisplay | syntax.SetDisplay | syntax.SequenceDisplay):
            items = flattened(self.unevaluated(item) for item in node.items)
            if isinstance(node, syntax.SetDisplay):
                return set_of(items)
            return Listed(tuple(items)) if isinstance(node, syntax.ListDisplay) else sequence(items)
        if isinstance(node, syntax.Selection) and isinstance(node.whole, syntax.Name):
            return self._unevaluated_entry(node)
        if isinstance(node, syntax.Call) and isinstance(node.function, syntax.Name | syntax.Concatenation):
            name = self.concatenation(node.function)
            arguments = [self.unevaluated(each) for each in node.arguments]
            if builtins.command(self.session, name) is None and all(
                isinstance(each, Expr) for each in arguments
            ):
                return self._application(name, tuple(arguments))
        return Quoted(node)

    def _unevaluated_entry(self, node: syntax.Selection) -> Value:
        assert isinstance(node.whole, syntax.Name)
        indices = flattened(self.unevaluated(each) for each in node.indices)
        text = ",".join(self.session.text(each) for each in indices)
        name = f"{node.whole.name}[{text}]"
        self.session.indexed[name] = (node.whole.name, tuple(indices))
        return symbol(name)

    def concatenation(self, node: syntax.Expression) -> str:
        """Return the name that ``a || b`` makes; the left side isn't evaluated."""
        if isinstance(node, syntax.Name):
            return node.name
        if isinstance(node, syntax.Text):
            return node.text
        if isinstance(node, syntax.Concatenation):
            return self.concatenation(node.left) + self._piece(node.right)
        return self._piece(node)

    def _concatenated(self, node: syntax.Concatenation) -> Value:
        """Return what the name ``a || b`` stands for; ``a || (1..3)`` are several."""
        if isinstance(node.right, syntax.Infix | syntax.SequenceDisplay):
            right = self.evaluate(node.right)
            items = builtins.repeated(self.session, right)
            if isinstance(items, Sequence):
                left = self.concatenation(node.left)
                return sequence([self._named(left + _bare(self.session.text(item))) for item in items.items])
        return self._named(self.concatenation(node))

    def _piece(self, node: syntax.Expression) -> str:
        value = self.evaluate(node)
        return value.text if isinstance(value, String) else _bare(self.session.text(value))

    # --- operators ------------------------------------------------------------------------------------------------

    def _prefix(self, node: syntax.Prefix) -> Value:
        value = self.evaluate(node.operand)
        if node.operator == "-":
            return arithmetic.negated(self.session, value)
        if node.operator == "not":
            found = truth(self.session, value)
            return Boolean(None if found is None else not found)
        if node.operator == "$":
            return builtins.repeated(self.session, value)
        return value

    def _postfix(self, node: syntax.Postfix) -> Value:
        value = self.evaluate(node.operand)
        if node.operator == "!":
            return self.call(symbol("factorial"), (value,))
        array = self.session.resolve(value)
        if isinstance(array, Array):
            return arithmetic.transposed(array)
        return value

    def _infix(self, node: syntax.Infix) -> Value:
        operator = node.operator
        if node.elementwise:
            return self._entrywise(operator, self.evaluate(node.left), self.evaluate(node.right))
        if operator in ("and", "or", "xor", "implies"):
            return self._logical(node)
        if operator == "$":
            return builtins.dollar(self.session, node.left, node.right)
        left = self.evaluate(node.left)
        if operator == "assuming":  # names stand for real numbers, and nothing more is assumed
            return left
        return self.operated(operator, left, self.evaluate(node.right))

    def operated(self, operator: str, left: Value, right: Value) -> Value:
        """Return the value of an operator between two values."""
        if operator in _ARITHMETIC:
            return arithmetic.binary(self.session, operator, left, right)
        if operator in _TURNED:
            return Relation(_TURNED[operator], right, left)
        if operator in _RELATIONS:
            return Relation(operator, left, right)
        if operator == "..":
            return Range(left, right)
        if operator in _SETS:
            return joined_by(self.session, operator, left, right)
        if operator == "in":
            return compared(self.session, Relation("in", left, right))
        if operator == "mod":
            return self.call(symbol("modp"), (left, right))
        return Unevaluated(symbol(operator), (left, right))  # @ and @@

    def _logical(self, node: syntax.Infix) -> Value:
        left = truth(self.session, self.evaluate(node.left))
        if node.operator == "and" and left is False:
            return Boolean(truth=False)
        if node.operator == "or" and left is True:
            return Boolean(truth=True)
        right = truth(self.session, self.evaluate(node.right))
        if left is None or right is None:
            return Boolean(None)
        results = {
            "and": left and right,
            "or": left or right,
            "xor": left != right,
            "implies": not left or right,
        }
        return Boolean(results[node.operator])

    def _entrywise(self, operator: str, left: Value, right: Value) -> Value:
        a, b = self.session.resolve(left), self.session.resolve(right)
        for side in (a, b):
            if isinstance(side, Listed | Array):
                count = len(side.items if isinstance(side, Listed) else side.entries)
                pairs = zip(_repeated(a, count), _repeated(b, count), strict=True)
                entries = [self.operated(operator, x, y) for x, y in pairs]
                if isinstance(side, Listed):
                    return Listed(tuple(entries))
                return Array(side.rows, side.columns, entries, side.kind)
        return self.operated(operator, left, right)

    # --- selections and calls -------------------------------------------------------------------------------------

    def _selection(self, node: syntax.Selection) -> Value:
        if isinstance(node.whole, syntax.Name):
            package = builtins.package_command(self.session, node.whole.name, node.indices)
            if package is not None:
                return package
            whole = self._whole(node.whole.name)
        else:
            whole = self.evaluate(node.whole)
        return selected(self.session, whole, self.arguments(node.indices))

    def _whole(self, name: str) -> Value:
        """A list of which one item is wanted isn't evaluated as a whole."""
        session = self.session
        held = session.names.get(name) if not session.scopes and name not in session.options.aliases else None
        return held if isinstance(held, Listed) else self._named(name)

    def _member(self, node: syntax.Member) -> Value:
        names: list[str] = []
        package: syntax.Expression = node
        while isinstance(package, syntax.Member):
            names.insert(0, package.name)
            package = package.package
        if isinstance(package, syntax.Name):
            found = builtins.member(self.session, package.name, names)
            if found is not None:
                return found
        return selected(self.session, self.evaluate(node.package), (symbol(node.name),))

    def _procedure(self, node: syntax.Procedure | syntax.Arrow) -> Value:
        return ProcedureValue(node, self.session.scope)

    def _call(self, node: syntax.Call) -> Value:
        session = self.session
        function = node.function
        if isinstance(function, syntax.Elementwise):
            return self._mapped(self.evaluate(function.function), self.arguments(node.arguments))
        name = function.name if isinstance(function, syntax.Name) else None
        if name is None or self._is_local(name):
            head = self.evaluate(function)
        elif name in session.names or name in session.options.aliases:
            head = self._named(name)
        else:
            head = symbol(name)
        form = self._form(head)
        if form is not None:
            return self._guarded(form, self._head_name(head), node.arguments)
        return self.call(head, self.arguments(node.arguments))

    def _form(self, head: Value) -> Callable[..., Value] | None:
        """Return the command that takes its arguments unevaluated, if a head is one."""
        name = self._head_name(head)
        return builtins.FORMS.get(name) if name not in self.session.names else None

    def _head_name(self, head: Value) -> str:
        if isinstance(head, Builtin) or (isinstance(head, Expr) and head.kind == "symbol"):
            return str(head.name)
        return ""

    def _guarded(self, function: Callable[..., Value], name: str, arguments: tuple[Any, ...]) -> Value:
        """Call a command; wrong arguments are told by its name."""
        try:
            return function(self.session, *arguments)
        except TypeError as error:
            if "argument" in str(error) and "positional" in str(error):
                raise WorksheetError(f"{name}: {builtins.usage(function, len(arguments))}") from error
            raise WorksheetError(f"{name}: arguments that it can't use; {error}") from error
        except (AssertionError, AttributeError, LookupError) as error:
            raise WorksheetError(f"{name}: arguments that it can't use") from error

    def _is_local(self, name: str) -> bool:
        scope = self.session.scope
        while scope is not None:
            if name in scope.local or name in scope.names:
                return True
            scope = scope.parent
        return False

    def _mapped(self, function: Value, arguments: tuple[Value, ...]) -> Value:
        return builtins.elementwise(self.session, function, arguments)

    def call(self, function: Value, arguments: tuple[Value, ...]) -> Value:
        """Return the value of a function at arguments."""
        session = self.session
        if isinstance(function, Reference) or (isinstance(function, Expr) and function.kind == "symbol"):
            entries = session.remembered.get(function.name)
            entry = entries.get(arguments) if entries else None
            if entry is not None and function.name not in session.resolving:
                return session.current(entry)
            found = session.resolve(function)
            if found is function or found == function or isinstance(found, Table):
                return self._named_call(function.name, arguments)
            if isinstance(found, ProcedureValue):
                return self._procedure_call(found, arguments, function.name)
            function = found
        if isinstance(function, ProcedureValue):
            return self._procedure_call(function, arguments, "unnamed")
        if isinstance(function, Builtin):
            return self._command(function.name, function.function, arguments)
        return self._other_call(function, arguments)

    def _procedure_call(self, found: ProcedureValue, arguments: tuple[Value, ...], name: str) -> Value:
        return call_procedure(self.session, self.execute, ProcedureCall(found, arguments, name))

    def _other_call(self, function: Value, arguments: tuple[Value, ...]) -> Value:
        if isinstance(function, Listed):
            return Listed(tuple(self.call(item, arguments) for item in function.items))
        if isinstance(function, Array):  # A(1, 2) is the entry A[1, 2]
            return self.session.select(function, arguments)
        if isinstance(function, Quoted):
            return self.call(self.evaluate(function.body), arguments)
        if isinstance(function, Expr):
            if function.is_number:
                return function
            if function.kind == "symbol":
                return self._named_call(function.name, arguments)
            return builtins.applied_sum(self.session, function, arguments)
        if isinstance(function, Unevaluated):
            made = builtins.operator_call(self.session, function, arguments)
            if made is not None:
                return made
        return Unevaluated(function, arguments)

    def _named_call(self, name: str, arguments: tuple[Value, ...]) -> Value:
        if name.startswith("evalf["):
            base, (digits,) = self.session.indexed[name]
            return self.call(symbol(base), (*arguments, digits))
        if name.startswith("log[") and len(arguments) == 1:
            above, below = (self.call(symbol("ln"), (each,)) for each in (arguments[0], self._base(name)))
            return self.operated("/", above, below)
        if name.startswith("D[") and len(arguments) == 1:
            return Unevaluated(symbol(name), arguments)
        found = builtins.command(self.session, name)
        if found is not None:
            return self._command(name, found, arguments)
        self._notice_unknown(name, arguments)
        return self._application(name, arguments)

    def _base(self, name: str) -> Value:
        """Return the base of a logarithm, ``log[b]``."""
        return self.session.indexed[name][1][0]

    def _command(self, name: str, function: Callable[..., Value], arguments: tuple[Value, ...]) -> Value:
        if any(isinstance(each, Quoted) for each in arguments) and name not in ("print", "show"):
            arguments = tuple(
                flattened(
                    self.evaluate(each.body) if isinstance(each, Quoted) else each for each in arguments
                )
            )
        self.session.limits.check()
        made = self._guarded(function, name, arguments)
        if (
            isinstance(made, Expr | Listed | Sequence | Relation | MapleSet)
            and self.session.options.imaginary
        ):
            return entrywise(self.session, made, normal)
        return made

    def _application(self, name: str, arguments: tuple[Value, ...]) -> Value:
        if arguments and all(isinstance(each, Expr | Reference) for each in arguments):
            scalars = [arithmetic.scalar(self.session, each) for each in arguments]
            made = UndefinedFunction(name)(*scalars)
            if made.kind == "application":
                self.session.applied.add(name)
            return made
        return Unevaluated(symbol(name), arguments)

    def _notice_unknown(self, name: str, arguments: tuple[Value, ...]) -> None:
        if len(arguments) == 1 and isinstance(arguments[0], Expr) and arguments[0].kind == "symbol":
            return  # f(t) and f(x) are functions
        if name in builtins.MISSING:
            self.session.notice(f"{name} of Maple is not there; it comes back unevaluated")
            return
        close = difflib.get_close_matches(name, builtins.known_names(self.session), 1, 0.75)
        if close:
            self.session.notice(f"{name} is not a command; did you mean {close[0]}?")


def _bare(text: str) -> str:
    return text[1:-1] if text.startswith("`") and text.endswith("`") else text


def _repeated(value: Value, count: int) -> list[Value]:
    if isinstance(value, Listed | Sequence):
        return list(value.items)
    if isinstance(value, Array):
        return list(value.entries)
    return [value] * count
