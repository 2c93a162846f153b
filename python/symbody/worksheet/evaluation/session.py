"""A session: the names and their values, the last values, aliases, options and modes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.evaluation import current
from symbody.worksheet.evaluation.limits import Limits
from symbody.worksheet.evaluation.state import Seen
from symbody.worksheet.printing.print import Style, text_of
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import NULL, Array, Sequence, String, Table, Value

if TYPE_CHECKING:
    from symbody.worksheet.sheet import syntax
    from symbody.worksheet.sheet.source import ReadFile

__all__ = ["Command", "Scope", "Session"]

# A command takes the session and its evaluated arguments, sequences flattened, options as relations.
Command: TypeAlias = Callable[..., Value]


@dataclass
class Scope:
    """The names of one call of a procedure.

    Attributes:
        names: parameters and local names that have a value.
        local: the names that are local, with a value or without.
        arguments: what ``args`` stands for.
        parent: the scope in which the procedure was written, or None for the session.
        last: the last values, for ``%``.
        name: what the procedure is called by.
        parameters: the names of the parameters that have an argument.
        missing: the parameters for which the call has no argument, by their places.
    """

    names: dict[str, Value] = field(default_factory=dict)
    local: set[str] = field(default_factory=set)
    arguments: tuple[Value, ...] = ()
    parent: Scope | None = None
    last: list[Value] = field(default_factory=list)
    name: str = ""
    parameters: set[str] = field(default_factory=set)
    missing: dict[str, int] = field(default_factory=dict)


@dataclass
class Options:
    """What ``interface``, ``Digits``, ``PDEtools[declare]`` and ``alias`` have set; what has occurred."""

    digits: int = 10
    places: int | None = None
    primes: str = ""
    declared: set[str] = field(default_factory=set)
    aliases: dict[str, Value] = field(default_factory=dict)
    reciprocals: set[str] = field(default_factory=set)
    imaginary: bool = False
    series: bool = False
    printlevel: int = 1
    precise: dict[Expr, int] = field(default_factory=dict)
    positive: frozenset[Expr] = frozenset()


_KEPT = (
    *("folder", "source", "any_folder", "lines", "notices", "limits", "drawings", "draws", "file"),
    *("call", "evaluate", "execute", "run", "parsed", "rebuild", "select", "overload", "face"),
)
"""What ``restart`` doesn't forget."""


@dataclass
class Session:
    """What commands read and write.

    Attributes:
        names: the value of each name that was assigned, as it was assigned; `value` evaluates it.
        log: the names that were assigned, one after the other.
        assigned: the count at which each name was assigned last.
        remembered: the entries of remember tables, as ``x(t) := V*t`` makes them, by function and arguments.
        folder: where files are written; nothing is written elsewhere.
        source: the folder of the worksheet, where ``read`` looks second.
        file: the file whose statements are executed, if ``read`` has read it; None in the worksheet itself.
        any_folder: whether the user allows the sheet to read and write elsewhere too.
        lines: what the statement has printed so far, in order: printed values, ``printf``, warnings.
        shown: the values, and the texts of ``printf``, that the statement has printed so far.
        notices: what the user should know that Maple doesn't print.
        mechanics: the modes of MBSymba (`worksheet/mechanics/modes.py`); None until one of its commands runs.
        packages: the commands that ``with`` has made known by their short names.
        last: the last values that aren't NULL, the latest first, for ``%``.
        scopes: the procedures that run, the innermost one last.
        opaque: what the names of scalars stand for that were made of other values.
        indexed: base and indices of names such as ``a[1]``.
        applied: names that were applied to arguments other than t.
        unfinished: whether the last printed line has not ended.
        draws: whether drawings are written into files.
        drawings: how many files of drawings were written.
        rules: the names of the sheet's own rules of derivatives, ``diff/f``.
        files: the files that ``fopen`` has opened.
        resolving: names that are being evaluated.
        depends: names on which the scalars depend that are being evaluated.
        variables: the names of the variables in scalars.
        seen: evaluated scalars (`seen`).
        call: calls a function with arguments; set by the interpreter.
        evaluate: evaluates an expression; set by the interpreter.
        execute: executes the statements of a procedure, and returns the last value; set by the interpreter.
        run: runs the statements of a file, given its name and text; set by the interpreter.
        parsed: evaluates an expression given as a text; set by the interpreter.
        rebuild: makes a scalar anew with other values for its symbols; set by the interpreter.
        select: takes entries of a list, table or matrix; set by the interpreter.
        overload: MBSymba's operators: takes the session, an operator and its operands; None for what is not its own.
        face: takes the session, a matrix that is a frame, and the evaluated matrix, and substitutes the chain too.
    """

    names: dict[str, Value] = field(default_factory=dict)
    log: list[str] = field(default_factory=list)
    assigned: dict[str, int] = field(default_factory=dict)
    remembered: dict[str, dict[tuple[Value, ...], Value]] = field(default_factory=dict)
    folder: Path = field(default_factory=Path)
    source: Path = field(default_factory=Path)
    file: ReadFile | None = None
    any_folder: bool = False
    lines: list[str] = field(default_factory=list)
    shown: list[Value | str] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)
    mechanics: Any = None
    packages: dict[str, Command] = field(default_factory=dict)
    options: Options = field(default_factory=Options)
    limits: Limits = field(default_factory=Limits)
    last: list[Value] = field(default_factory=list)
    scopes: list[Scope] = field(default_factory=list)
    opaque: dict[str, Value] = field(default_factory=dict)
    indexed: dict[str, tuple[str, tuple[Value, ...]]] = field(default_factory=dict)
    applied: set[str] = field(default_factory=set)
    seen: dict[int, Seen] = field(default_factory=dict)
    variables: dict[int, frozenset[str]] = field(default_factory=dict)
    resolving: list[str] = field(default_factory=list)
    depends: list[set[str]] = field(default_factory=list)
    unfinished: bool = False
    draws: bool = True
    drawings: int = 0
    rules: set[str] = field(default_factory=set)
    files: dict[Any, Any] = field(default_factory=dict)
    call: Callable[[Value, tuple[Value, ...]], Value] = field(default=lambda function, arguments: NULL)
    evaluate: Callable[[syntax.Expression], Value] = field(default=lambda node: NULL)
    execute: Callable[[Iterable[syntax.Statement]], Value] = field(default=lambda statements: NULL)
    run: Callable[[str, str], None] = field(default=lambda name, text: None)
    parsed: Callable[[str], Value] = field(default=lambda text: NULL)
    rebuild: Callable[[Expr, dict[Expr, Value]], Value] = field(default=lambda scalar, values: scalar)
    select: Callable[[Value, tuple[Value, ...]], Value] = field(default=lambda whole, indices: whole)
    overload: Callable[[Session, str, Value, Value], Value | None] | None = None
    face: Callable[[Session, Array, Array], Array] | None = None

    # --- names -------------------------------------------------------------------------------------------------------

    @property
    def count(self) -> int:
        """The number of assignments so far: a value with an older stamp may hold names that have values now."""
        return len(self.log)

    @property
    def scope(self) -> Scope | None:
        """The innermost procedure that runs."""
        return self.scopes[-1] if self.scopes else None

    def assign(self, name: str, value: Value) -> None:
        """Give a name of the session a value, in place of the one before with its remember table."""
        self.names[name] = value
        self.remembered.pop(name, None)
        if name.startswith("diff/"):
            self.rules.add(name)
        self.touch(name)

    def keep_exception(self, message: str) -> None:
        """Keep the message of an error, as a sheet may ask for it."""
        self.assign("lastexception", Sequence((symbol("unknown"), String(message))))
        self.assign("lasterror", String(message))

    def unassign(self, name: str) -> None:
        """Take the value of a name, and what its remember table holds."""
        self.names.pop(name, None)
        self.remembered.pop(name, None)
        self.touch(name)
        self.options.positive = frozenset(each for each in self.options.positive if each.name != name)

    def scope_of(self, name: str) -> Scope | None:
        """Return the call of a procedure in which a name is local; None for a name of the session."""
        scope = self.scope
        while scope is not None and name not in scope.local:
            scope = scope.parent
        return scope

    def give(self, name: str, value: Value) -> None:
        """Give a name that a command was told a value: a local one of the procedure that runs, or the session's."""
        scope = self.scope_of(name)
        if scope is None:
            self.assign(name, value)
        else:
            scope.names[name] = value

    def take(self, name: str) -> None:
        """Take the value of a name that a command was told, as `give` gives it."""
        scope = self.scope_of(name)
        if scope is None:
            self.unassign(name)
        else:
            scope.names.pop(name, None)

    def holder(self, name: str) -> Value:
        """Return what holds the entries of a name, which may itself be an entry: T, or T[1] of T[1][b]."""
        is_local = self.scope_of(name) is not None
        return self.resolve(self.value(name) if is_local else self.current(symbol(name)))

    def touch_entry(self, name: str) -> None:
        """Note that an entry of a name has changed, or an entry of one of its entries."""
        while name in self.indexed:
            name = self.indexed[name][0]
        self.touch(name)

    def remember(self, name: str, arguments: tuple[Value, ...], value: Value) -> None:
        """Give an entry of a function a value: ``x(t) := V*t``."""
        self.remembered.setdefault(name, {})[arguments] = value
        self.touch(name)

    def touch(self, name: str) -> None:
        """Note that the meaning of a name has changed."""
        self.log.append(name)
        self.assigned[name] = self.count

    def current(self, value: Value) -> Value:
        """Return a value with all that was assigned since it was made: scalars, matrices, lists; tables as they are.

        Matrices that nothing has changed come back themselves. The chain of one that is a frame is substituted too
        (`face`).
        """
        return current.current(self, value, arrays=True)

    def evaluated(self, nodes: Iterable[syntax.Expression]) -> tuple[Value, ...]:
        """Return the values of several expressions, sequences among them opened."""
        found = tuple(current.flattened(self.evaluate(node) for node in nodes))
        self.limits.check_items(len(found))
        return found

    def value(self, name: str) -> Value:
        """Return what a name stands for: its last name if that is a table, a procedure or an old matrix."""
        return current.named(self, name)

    def resolve(self, value: Value) -> Value:
        """Return the table, the matrix or the procedure that a reference stands for; other values as they are."""
        return current.resolved(self, value)

    def table(self, value: Value) -> Table | Array:
        """Return the mutable object that a value stands for; raise what the user should read if it is another."""
        found = self.resolve(value)
        if isinstance(found, Table | Array):
            return found
        raise WorksheetError(f"{self.text(value)} is neither a table nor a matrix")

    # --- last values ----------------------------------------------------------------------------------------------

    @property
    def lasts(self) -> list[Value]:
        """The last values of the procedure that runs, or of the session."""
        return self.scopes[-1].last if self.scopes else self.last

    def note(self, value: Value) -> None:
        """Make a value the last one, unless it is NULL."""
        if value != NULL:
            self.lasts.insert(0, value)
            del self.lasts[3:]

    # --- output -----------------------------------------------------------------------------------------------------

    @property
    def style(self) -> Style:
        """How values are printed now."""
        functions: dict[str, str] = {}
        expressions: dict[Expr, str] = {}
        for alias, value in self.options.aliases.items():
            if isinstance(value, Expr) and value.kind == "symbol":
                functions[value.name] = alias
            if isinstance(value, Expr):
                expressions[value] = alias
        return Style(
            primes=self.options.primes,
            declared=frozenset(self.options.declared),
            functions=functions,
            aliases=expressions,
            digits=self.options.digits,
            places=self.options.places,
            reciprocals=frozenset(self.options.reciprocals),
            raw=frozenset(self.opaque),
            precise=self.options.precise,
            elided=True,
        )

    def text(self, value: Value) -> str:
        """Return a value in one-dimensional notation, as the session's options have it."""
        return text_of(value, self.style)

    def print(self, text: str) -> None:
        """Print a line, or several."""
        self.unfinished = False
        self.lines.append(text)

    def write(self, text: str) -> None:
        """Print a text that may end within a line, as printf does."""
        if self.unfinished and self.lines:
            text = self.lines.pop() + text
        self.unfinished = not text.endswith("\n")
        self.lines.append(text.removesuffix("\n"))

    def notice(self, text: str) -> None:
        """Tell the user what Maple doesn't print; once."""
        if text not in self.notices:
            self.notices.append(text)

    def close(self) -> None:
        """Close the files that the sheet left open."""
        for file in self.files.values():
            if hasattr(file, "close"):
                file.close()
        self.files.clear()

    def restart(self) -> None:
        """Forget everything but the folders, what was printed, and the limits."""
        self.close()
        kept: Mapping[str, Any] = {name: getattr(self, name) for name in _KEPT}
        self.__dict__.update(Session(**kept).__dict__)


def sequence(values: list[Value] | tuple[Value, ...]) -> Value:
    """Return values as a sequence, flat; one value is itself."""
    flat: list[Value] = []
    for value in values:
        if isinstance(value, Sequence):
            flat.extend(value.items)
        else:
            flat.append(value)
    return flat[0] if len(flat) == 1 else Sequence(tuple(flat))


def is_last_name(value: Value) -> bool:
    """Whether evaluation of a name stops before this value."""
    return current.is_last_name(value)
