"""The syntax of Maple: statements and expressions as immutable nodes, each with its place in the file."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

__all__ = [
    "Arrow",
    "Assignment",
    "Break",
    "Call",
    "Columns",
    "Concatenation",
    "Decimal",
    "Declaration",
    "Delayed",
    "Ditto",
    "Elementwise",
    "Empty",
    "Evaluation",
    "Expression",
    "For",
    "If",
    "Infix",
    "Integer",
    "ListDisplay",
    "Member",
    "Name",
    "Next",
    "Node",
    "Parameter",
    "Place",
    "Postfix",
    "Prefix",
    "Procedure",
    "Quit",
    "Raise",
    "Read",
    "Return",
    "Rows",
    "Save",
    "Selection",
    "SequenceDisplay",
    "SetDisplay",
    "Statement",
    "Text",
    "Try",
    "Use",
]


@dataclass(frozen=True, slots=True)
class Place:
    """A region of a file; lines and columns begin at 1, the end is exclusive."""

    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """What has a place in the file. Nodes are compared by what they say, not by where they stand."""

    place: Place = field(compare=False)


# --- expressions ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Integer(Node):
    """A whole number."""

    value: int


@dataclass(frozen=True, slots=True)
class Decimal(Node):
    """A decimal number; ``text`` as it is written: ``.5``, ``9.81``, ``1.``, ``.17e-1``."""

    text: str


@dataclass(frozen=True, slots=True)
class Name(Node):
    """A name, without its backquotes: ``x``, ``m__1``, ``diff/theta``."""

    name: str


@dataclass(frozen=True, slots=True)
class Text(Node):
    """A string, without its quotes."""

    text: str


@dataclass(frozen=True, slots=True)
class Ditto(Node):
    """``%``, ``%%``, ``%%%``: the last value but ``level - 1``."""

    level: int


@dataclass(frozen=True, slots=True)
class Delayed(Node):
    """``'x'``: an evaluation takes the quotes away."""

    body: Expression


@dataclass(frozen=True, slots=True)
class SequenceDisplay(Node):
    """``a, b``; ``()`` and ``NULL`` have no items."""

    items: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class ListDisplay(Node):
    """``[a, b]``."""

    items: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class SetDisplay(Node):
    """``{a, b}``."""

    items: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Columns(Node):
    """``<a, b>``: one below the other."""

    items: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Rows(Node):
    """``<a | b>``: one beside the other."""

    items: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Prefix(Node):
    """An operator before its operand: ``-``, ``+``, ``not``, ``$``."""

    operator: str
    operand: Expression


@dataclass(frozen=True, slots=True)
class Postfix(Node):
    """An operator behind its operand: ``!``, ``^%T`` (as ``%T``)."""

    operator: str
    operand: Expression


@dataclass(frozen=True, slots=True)
class Infix(Node):
    """An operator between its operands.

    ``+ - * / ^ . &* @ @@ = <> < <= > >= and or xor implies assuming in .. :: $ union minus intersect subset mod``;
    ``elementwise`` where ``~`` follows it. A side of ``..`` that is left out is an empty sequence.
    """

    operator: str
    left: Expression
    right: Expression
    elementwise: bool = False


@dataclass(frozen=True, slots=True)
class Concatenation(Node):
    """``left || right``: a name."""

    left: Expression
    right: Expression


@dataclass(frozen=True, slots=True)
class Call(Node):
    """``function(arguments)``; an argument ``a, b`` in parentheses is a sequence."""

    function: Expression
    arguments: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Selection(Node):
    """``whole[indices]``."""

    whole: Expression
    indices: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Member(Node):
    """``package:-name``."""

    package: Expression
    name: str


@dataclass(frozen=True, slots=True)
class Elementwise(Node):
    """``f~``, to be called on each entry."""

    function: Expression


@dataclass(frozen=True, slots=True)
class Parameter(Node):
    """A parameter: ``x::type := default``; ``keyword`` in braces, ``rest`` for ``$`` (no more arguments)."""

    name: str
    type: Expression | None = None
    default: Expression | None = None
    keyword: bool = False
    rest: bool = False


@dataclass(frozen=True, slots=True)
class Arrow(Node):
    """``x -> body``; the body may be an ``If``."""

    parameters: tuple[Parameter, ...]
    body: Expression | If


@dataclass(frozen=True, slots=True)
class Procedure(Node):
    """``proc (parameters) local ..; global ..; option ..; uses ..; description ..; body end proc``."""

    parameters: tuple[Parameter, ...]
    body: tuple[Statement, ...]
    local: tuple[str, ...] = ()
    shared: tuple[str, ...] = ()
    options: tuple[str, ...] = ()
    uses: tuple[str, ...] = ()
    description: tuple[str, ...] = ()


Expression: TypeAlias = (
    Integer
    | Decimal
    | Name
    | Text
    | Ditto
    | Delayed
    | SequenceDisplay
    | ListDisplay
    | SetDisplay
    | Columns
    | Rows
    | Prefix
    | Postfix
    | Infix
    | Concatenation
    | Call
    | Selection
    | Member
    | Elementwise
    | Arrow
    | Procedure
)


# --- statements -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, kw_only=True)
class _Statement(Node):
    """``shown`` where it ends by ``;`` or by nothing, not by ``:``."""

    shown: bool = field(default=True)


@dataclass(frozen=True, slots=True)
class Assignment(_Statement):
    """``target := value``; ``(a, b) := f(..)`` and ``a, b := f(..)`` have several targets."""

    targets: tuple[Expression, ...]
    value: Expression


@dataclass(frozen=True, slots=True)
class Evaluation(_Statement):
    """An expression as a statement."""

    expression: Expression


@dataclass(frozen=True, slots=True)
class If(_Statement):
    """``if .. then .. elif .. then .. else .. end if``: pairs of a condition and its statements."""

    branches: tuple[tuple[Expression, tuple[Statement, ...]], ...]
    otherwise: tuple[Statement, ...] = ()


@dataclass(frozen=True, slots=True)
class For(_Statement):
    """``for variable from start by step to stop while condition do body end do``, or ``for variable in items``."""

    body: tuple[Statement, ...]
    variable: str | None = None
    start: Expression | None = None
    step: Expression | None = None
    stop: Expression | None = None
    items: Expression | None = None
    condition: Expression | None = None


@dataclass(frozen=True, slots=True)
class Return(_Statement):
    """``return value``."""

    value: Expression | None = None


@dataclass(frozen=True, slots=True)
class Raise(_Statement):
    """``error "message", arguments``."""

    arguments: tuple[Expression, ...] = ()


@dataclass(frozen=True, slots=True)
class Try(_Statement):
    """``try .. catch "text": .. finally .. end try``."""

    body: tuple[Statement, ...]
    handlers: tuple[tuple[tuple[str, ...], tuple[Statement, ...]], ...] = ()
    finally_: tuple[Statement, ...] = ()


@dataclass(frozen=True, slots=True)
class Use(_Statement):
    """``use P in .. end use``: statements in which the commands of packages have their short names."""

    packages: tuple[Expression, ...]
    body: tuple[Statement, ...]


@dataclass(frozen=True, slots=True)
class Next(_Statement):
    """``next``: the next pass of a loop."""


@dataclass(frozen=True, slots=True)
class Break(_Statement):
    """``break``: the end of a loop."""


@dataclass(frozen=True, slots=True)
class Read(_Statement):
    """``read file``."""

    file: Expression


@dataclass(frozen=True, slots=True)
class Save(_Statement):
    """``save a, b, file``."""

    arguments: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Declaration(_Statement):
    """``local a, b`` or ``global a`` at the top of a session; ``variables`` with their types and first values."""

    kind: str
    names: tuple[str, ...]
    variables: tuple[Parameter, ...] = ()


@dataclass(frozen=True, slots=True)
class Quit(_Statement):
    """``quit``, ``done``, ``stop``: the end of the sheet."""


@dataclass(frozen=True, slots=True)
class Empty(_Statement):
    """A terminator alone."""


Statement: TypeAlias = (
    Assignment
    | Evaluation
    | If
    | For
    | Return
    | Raise
    | Try
    | Use
    | Next
    | Break
    | Read
    | Save
    | Declaration
    | Quit
    | Empty
)
