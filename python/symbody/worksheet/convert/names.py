"""What the names of a worksheet stand for in the Python program."""

from __future__ import annotations

import keyword
import re
import warnings
from dataclasses import dataclass, field
from typing import Any

from symbody.deferred import Deferred
from symbody.errors import ExpressionError, ModelNotice
from symbody.symbolic import Expr, symbol, symbols, time_function
from symbody.worksheet.convert.definitions import DEFINITIONS
from symbody.worksheet.sheet import syntax

__all__ = ["Names", "NoText", "identifier", "is_plain"]

_MODULES = """import functools
import itertools
import math
import pickle
from pathlib import Path

import numpy as np

import symbody as sb
"""
"""What a program may import: only what it needs."""
_DEFERRED = {"plt": "matplotlib.pyplot", "scipy": "scipy", "sympy": "sympy"}
"""What takes long to import, or is optional, by its names in programs: loaded where a statement needs it."""

_TAKEN = frozenset(
    {
        *DEFINITIONS,
        "ArtistAnimation",
        "sb",
        "print",
        "range",
        "len",
        "value",
        "list",
        "set",
        "abs",
        "sum",
        "min",
        "max",
        "dict",
        "np",
        "plt",
        "functools",
        "itertools",
        "math",
        "pickle",
        "Path",
        "scipy",
        "sympy",
    }
)


class NoText(Exception):
    """An expression or a statement that has no text here; its value is written instead."""


def identifier(name: str) -> str:
    """Return a name of Python for a name of Maple: ``_gravity`` becomes ``gravity``, ``theta[1]`` ``theta_1``."""
    text = re.sub(r"\W+", "_", name).lstrip("_")
    if not name.endswith("_"):  # theta_ and theta are different names
        text = text.rstrip("_")
    text = text or "name"
    if text[0].isdigit():
        text = f"_{text}"
    return f"{text}_" if keyword.iskeyword(text) or text in _TAKEN else text


def is_plain(name: str) -> bool:
    """Whether `symbols` makes a symbol of a name; cos, which an alias may leave bare, stands for the function."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        try:
            symbols(name)
        except ExpressionError:
            return False
    return name.isidentifier()


def _maker(name: str, *, is_function: bool) -> str:
    """Return what makes a symbol, or a function of time; some names of Maple are none in Python."""
    if not is_plain(name):
        return f'sb.symbolic.{"time_function" if is_function else "symbol"}("{name}")'
    return f'sb.functions_of_time("{name}")' if is_function else f'sb.symbols("{name}")'


def _imported() -> dict[str, Any]:
    """Return what the first lines of a program import."""
    values: dict[str, Any] = {}
    exec("\n".join([_MODULES, *DEFINITIONS.values()]), values)
    values |= {name: Deferred(module) for name, module in _DEFERRED.items()}
    values["draw"] = values["animate"] = list  # nothing is drawn while the program is written
    return values


@dataclass
class Names:
    """What names stand for in the program.

    Attributes:
        values: the variables of the program so far; inside a loop or a function, those of its first pass.
        functions: names of Maple that are functions of time.
        symbols: names of Maple that the program declares as symbols or as functions of time, by their identifiers.
        outer: the names around a function.
        master: the variable that holds the moving master frame; nothing without it.
        small: small variables by those that are marked; less the value from which they deviate.
        arguments: inside a function, the name of the arguments that ``args`` and ``nargs`` mean.
        as_differences: whether equations that a statement gives are to be solved.
        solved: names in calls of ``solve``: their equations are differences.
        as_pairs: whether equations that a statement gives are pairs of sides.
        sided: names whose sides the sheet asks for: their equations are pairs.
        values_of: names of lists of equations that are only substituted: each is one dictionary.
        made: the lines that have given variables their values, of those that took one line.
        tyres: the tyres of the program, by their variables.
        used: identifiers that had values before a ``restart``; as symbols, they are declared again.
        late: lines of such declarations, which stand before the statement.
        behind: identifiers that only such lines declare: at the head of the program, they mean something else.
        reserved: identifiers of the worksheet.
        added: identifiers that only the program has.
        rules: the variable that holds the sheet's own rates of functions of time; nothing without them.
        sets: the sets and lists of names that the sheet assigns once, as it writes them.
        called: names that the sheet calls, or whose procedures it asks for.
        motions: the equations of motions, by their variables.
        acting: procedures that change tables or other names of the sheet, or print: they are called for that.
        own_functions: names whose value is the function of time of that name: ``theta := theta(t)``.
        local: parameters and variables of the functions at hand, which hide functions of time.
        assigned: those that have been assigned as a whole.
        bare: identifiers of symbols that have the name of a function of time, as V in ``V(t) = V``.
    """

    values: dict[str, Any] = field(default_factory=_imported)
    functions: set[str] = field(default_factory=set)
    symbols: dict[str, str] = field(default_factory=dict)
    outer: Names | None = None
    master: str = ""
    small: dict[Expr, Expr] = field(default_factory=dict)
    arguments: str = ""
    as_differences: bool = False
    solved: set[str] = field(default_factory=set)
    as_pairs: bool = False
    sided: set[str] = field(default_factory=set)
    values_of: set[str] = field(default_factory=set)
    made: dict[str, str] = field(default_factory=dict)
    tyres: dict[str, Any] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    late: list[str] = field(default_factory=list)
    reserved: frozenset[str] = frozenset()
    added: set[str] = field(default_factory=set)
    bare: set[str] = field(default_factory=set)
    rules: str = ""
    sets: dict[str, syntax.Expression] = field(default_factory=dict)
    called: frozenset[str] = frozenset()
    motions: dict[str, str] = field(default_factory=dict)
    acting: set[str] = field(default_factory=set)
    behind: set[str] = field(default_factory=set)
    own_functions: frozenset[str] = frozenset()
    local: frozenset[str] = frozenset()
    assigned: set[str] = field(default_factory=set)

    def own(self, name: str) -> str:
        """Return an identifier for what only the program has a name for."""
        while name in self.reserved:
            name += "_"
        self.added.add(name)
        return name

    def text(self, name: str) -> str:
        """Return the identifier of a name, which is declared if it has no value."""
        text = identifier(name)
        if text not in self.values and name not in self.local:
            self.declare(name)
        return text

    def bare_text(self, name: str) -> str:
        """Return the identifier of a symbol that may have the name of a function of time."""
        known = self.values.get(identifier(name))
        is_function = isinstance(known, Expr) and known.kind == "time_function" and known.name == name
        hides = name in self.own_functions or name in self.local
        if name not in self.functions or hides or not (known is None or is_function):
            return self.text(name)
        text = f"{identifier(name)}_"
        self.values.setdefault(text, symbol(name))
        self.root().values.setdefault(text, symbol(name))
        self.bare.add(text)
        self.symbols[text] = name
        return text

    def declare(self, name: str) -> None:
        """Make a name a symbol, or a function of time."""
        text = identifier(name)
        made = time_function(name) if name in self.functions else symbol(name)
        scope: Names | None = self
        while scope is not None:
            scope.values.setdefault(text, made)
            scope = scope.outer
        if text in self.used:
            self.used.discard(text)
            self.late.append(f"{text} = {self.declaration(name)}")
            if text not in self.symbols:
                self.root().behind.add(text)
        self.symbols[text] = name

    def plain(self, text: str) -> Expr:
        """Return the symbol, or the function of time, that an identifier is declared as."""
        name = self.symbols[text]
        return time_function(name) if self.is_function(text) else symbol(name)

    def is_function(self, text: str) -> bool:
        """Whether an identifier is declared as a function of time."""
        return self.symbols[text] in self.functions and text not in self.bare

    def declared(self, text: str) -> str:
        """Return what makes the symbol, or the function of time, of an identifier."""
        return _maker(self.symbols[text], is_function=self.is_function(text))

    def declaration(self, name: str) -> str:
        """Return what makes a symbol, or a function of time, of a name."""
        return _maker(name, is_function=name in self.functions)

    def restart(self) -> None:
        """Forget all values; names that have had one are declared again where they are used."""
        imported = _imported()
        kept = {
            text: made
            for text, made in self.values.items()
            if text in imported
            or (text in self.symbols and str(made) == self.symbols[text] and made not in self.small)
        }
        self.used |= self.values.keys() - kept.keys()
        self.values.clear()
        self.values.update(kept)
        self.master = self.rules = ""
        self.made.clear()
        self.small = {}

    def snapshot(self) -> tuple[dict[str, Any], dict[str, str], str, dict[Expr, Expr], set[str]]:
        """Return what a statement may change."""
        return dict(self.values), dict(self.symbols), self.master, dict(self.small), set(self.used)

    def restore(self, before: tuple[dict[str, Any], dict[str, str], str, dict[Expr, Expr], set[str]]) -> None:
        """Undo the changes of a statement; the dictionary of values stays the same, as functions hold it."""
        values, self.symbols, self.master, self.small, self.used = before
        self.values.clear()
        self.values.update(values)
        self.late.clear()

    def inner(self) -> Names:
        """Return the names inside a loop or a function, where values are tried out."""
        return Names(
            dict(self.values),
            self.functions,
            self.symbols,
            self,
            self.master,
            self.small,
            self.arguments,
            self.as_differences,
            self.solved,
            self.as_pairs,
            self.sided,
            self.values_of,
            self.made,
            self.tyres,
            self.used,
            self.late,
            self.reserved,
            self.added,
            self.bare,
            self.rules,
            self.sets,
            self.called,
            own_functions=self.own_functions,
            local=self.local,
            assigned=self.assigned,
        )

    def value(self, text: str) -> Any:
        """Return the value of a text that has been written; None where it isn't known."""
        try:
            return eval(text, self.values)
        except Exception:
            return None

    def define(self, text: str) -> None:
        """Let inner names know a function that has been defined in the program."""
        scope: Names | None = self
        while scope is not None:
            scope.values[text] = self.root().values[text]
            scope = scope.outer

    def root(self) -> Names:
        """Return the names of the program itself."""
        return self if self.outer is None else self.outer.root()

    def forget(self, name: str) -> None:
        """Let a name be a symbol again."""
        self.values.pop(identifier(name), None)
