"""What a Maple name can hold.

Scalars are expressions of the core: a name without a value is a symbol, ``f(t)`` a function of time, ``f(a, b)`` an
application. The classes here are what the core doesn't hold.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from symbody.symbolic import Expr

if TYPE_CHECKING:
    from symbody.worksheet.sheet import syntax
    from symbody.worksheet.sheet.source import ReadFile

__all__ = [
    "NULL",
    "Array",
    "Boolean",
    "Builtin",
    "Listed",
    "MapleSet",
    "Plot",
    "ProcedureValue",
    "Quoted",
    "Range",
    "Reference",
    "Relation",
    "Sequence",
    "String",
    "Table",
    "Unevaluated",
    "Value",
]


@dataclass(frozen=True, slots=True)
class String:
    """``"text"``."""

    text: str


@dataclass(frozen=True, slots=True)
class Boolean:
    """``true``, ``false`` and ``FAIL`` (None)."""

    truth: bool | None


@dataclass(frozen=True, slots=True)
class Relation:
    """An equation, or an inequality: ``=``, ``<>``, ``<``, ``<=`` (``>`` is turned round, as in Maple), and ``::``."""

    operator: str
    left: Value
    right: Value


@dataclass(frozen=True, slots=True)
class Range:
    """``start .. stop``."""

    start: Value
    stop: Value


@dataclass(frozen=True, slots=True)
class Sequence:
    """``a, b``: flat, and never of one item."""

    items: tuple[Value, ...]


NULL = Sequence(())


@dataclass(frozen=True, slots=True)
class Listed:
    """A list: ``[a, b]``."""

    items: tuple[Value, ...]


@dataclass(frozen=True, slots=True)
class MapleSet:
    """A set: ``{a, b}``. Items are different by value, in a deterministic order."""

    items: tuple[Value, ...]


@dataclass(slots=True, eq=False)
class Table:
    """A mutable table: a key is the tuple of its indices. Objects of MBSymba are tables with a field ``obj``.

    ``memory`` is what a command made it of, which holds as long as the fields say the same. ``is_sparse`` tables have 0
    where nothing has been assigned.
    """

    entries: dict[tuple[Value, ...], Value] = field(default_factory=dict)
    is_sparse: bool = False
    memory: Any = field(default=None, repr=False)


@dataclass(slots=True, eq=False)
class Array:
    """A mutable matrix or vector, shared by assignment.

    ``kind``: "Matrix", "Vector", "RowVector" (they print in full), or "matrix", "vector", "array" of the old kind,
    which are evaluated to their last name. ``attributes`` hold the name of a frame, as ``set_frame_name`` writes it;
    ``frame`` is the chain of motions of which the matrix is the other face, if it has one. ``first`` are the indices of
    the first row and of the first column: ``Array(0..2)`` begins at 0. ``mirrored`` is 1 for a matrix that is kept
    symmetric, and -1 for one that is kept antisymmetric.
    """

    rows: int
    columns: int
    entries: list[Value]
    kind: str = "Matrix"
    attributes: tuple[Value, ...] = ()
    frame: Any = None
    first: tuple[int, int] = (1, 1)
    mirrored: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class ProcedureValue:
    """A procedure or an operator ``x -> ..``, with the scope that it was made in, and the results that it remembers.

    ``file`` is where it is written: what ``read`` has read, or None, the worksheet.
    """

    definition: syntax.Procedure | syntax.Arrow
    scope: Any = None
    file: ReadFile | None = field(default=None, compare=False, repr=False)
    results: dict[tuple[Any, ...], Any] = field(default_factory=dict, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Builtin:
    """A command of Maple or of MBSymba, as a value: ``map(simplify, ..)``.

    ``of_numbers`` says that a call of it stays as it is written until its arguments are numbers.
    """

    name: str
    function: Callable[..., Value] = field(compare=False, repr=False)
    of_numbers: bool = False


@dataclass(frozen=True, slots=True)
class Reference:
    """A name that stands for a table, a matrix of the old kind or a procedure: sets and lists of bodies hold names."""

    name: str


@dataclass(frozen=True, slots=True)
class Unevaluated:
    """A call that nobody knows, of arguments that aren't all scalars: it is printed as it was written."""

    function: Value
    arguments: tuple[Value, ...]


@dataclass(frozen=True, slots=True)
class Quoted:
    """What quotes keep: code that is printed as it was written, and evaluated when it is used."""

    body: syntax.Expression


@dataclass(frozen=True, slots=True, eq=False)
class Plot:
    """A drawing to be displayed: kind and data, drawn by the simulation layer's plots."""

    kind: str
    data: tuple[Any, ...]
    options: tuple[tuple[str, Value], ...] = ()


Value: TypeAlias = (
    Expr
    | String
    | Boolean
    | Relation
    | Range
    | Sequence
    | Listed
    | MapleSet
    | Table
    | Array
    | ProcedureValue
    | Builtin
    | Reference
    | Unevaluated
    | Quoted
    | Plot
)
