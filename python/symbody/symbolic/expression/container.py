"""Containers of expressions: a table of how each kind is taken apart and put together again.

`rewritten` applies an operation to all expressions in a container at once, and returns a container of the same kind.
The kinds of upper layers, such as vectors and bodies, enter the table beside their classes, with `contains`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias, TypeVar, runtime_checkable

from symbody.errors import ArgumentError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.array import array_like, is_array
from symbody.symbolic.expression.latex_layout import aligned, bmatrix, one_formula, upright, with_definitions
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.expression.naming import latex_listing
from symbody.symbolic.expression.text_layout import listed, matrix_text, named
from symbody.symbolic.given.arguments import described, expression

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "Container",
    "Kind",
    "Rewrite",
    "Typeset",
    "contains",
    "derived",
    "expressions_in",
    "in_latex",
    "is_container",
    "printed_in",
    "rewritten",
    "substituted",
    "text_of",
]

Rewrite: TypeAlias = Callable[[tuple[Expr, ...]], Sequence[Expr]]
"""An operation on several expressions, which returns as many."""
Kind = TypeVar("Kind")
Layout: TypeAlias = Callable[[Any, list[str]], str]


@runtime_checkable
class Typeset(Protocol):
    """A thing with a formula of its own, such as a linear model or the matrices of equations."""

    def latex(self) -> str: ...


class Container(NamedTuple):
    """How one kind of container is made of parts, which are expressions or containers again."""

    parts: Callable[[Any], Sequence[Any]]
    rebuilt: Callable[[Any, Sequence[Any]], Any]
    """The container like a given one, with other parts."""
    layout: Layout | None = None
    """The LaTeX of a container from that of what is shown of it; None if it has a method `latex` or cannot be shown."""
    text: Layout | None = None
    """The text of a container from those of its parts; None if it is no mere collection of these."""
    shown: Callable[[Any], Sequence[Any]] | None = None
    """What is shown of it in LaTeX; its parts by default."""
    differentiated: Callable[[Any], Sequence[Any]] | None = None
    """The parts that are differentiated; its parts by default."""
    derivative: Callable[[Any, Sequence[Any]], Any] | None = None
    """The derivative of a container from those of its parts; None if it has none."""
    advice: str = ""
    """What can be differentiated instead."""
    subs: Callable[[Any, Mapping[Any, Any]], Any] | None = None
    """The substitution, where it is more than that in the parts."""


_TABLE: dict[type, Container] = {}


def contains(kind: type, container: Container) -> None:
    """Enter a kind of container into the table."""
    _TABLE[kind] = container


def is_container(value: object) -> bool:
    """Return whether a value is taken apart; an array without dimensions is a number."""
    return _entry(value) is not None


def rewritten(value: Any, operation: Rewrite, place: str) -> Any:
    """Return the container with the operation applied to all its expressions; the place is named in messages."""
    return _Pass(place, lambda entry, _: (entry.parts, entry.rebuilt)).run(value, operation)


def expressions_in(value: Any, place: str) -> tuple[Expr, ...]:
    """Return all expressions in a container, in their order; the place is named in messages."""
    one = _Pass(place, lambda entry, _: (entry.parts, entry.rebuilt))
    one.taken_apart(value, "")
    return tuple(one.leaves)


def printed_in(value: Any) -> tuple[Expr, ...]:
    """Return the expressions in a container that are printed with it; other parts, such as models, print their own."""
    found, seen, waiting = list[Expr](), dict[int, Any](), [value]
    while waiting:
        part = waiting.pop()
        entry = _entry(part)
        if isinstance(part, Expr):
            found.append(part)
        elif entry is not None and id(part) not in seen:
            seen[id(part)] = part  # which keeps its id
            waiting += entry.parts(part)
    return tuple(found)


def substituted(value: Any, mapping: Mapping[Any, Any]) -> Any:
    """Return the container with every key of the mapping replaced, all at once."""

    def replace(expressions: tuple[Expr, ...]) -> Sequence[Expr]:
        return _core.substitute(expressions, mapping)

    def whole(entry: Container, part: Any) -> Any:
        return None if entry.subs is None else entry.subs(part, mapping)

    return _Pass("subs", lambda entry, _: (entry.parts, entry.rebuilt), whole).run(value, replace)


def derived(value: Any, operation: Rewrite, place: str) -> Any:
    """Return the container of the derivatives: of a point a vector, of a frame the derivative of its matrix."""

    def ways(
        entry: Container, part: Any
    ) -> tuple[Callable[[Any], Sequence[Any]], Callable[[Any, Sequence[Any]], Any]]:
        if entry.derivative is None:
            raise ArgumentError(f"{place}: {described(part)}, which has no derivative; {entry.advice}")
        return entry.differentiated or entry.parts, entry.derivative

    return _Pass(place, ways).run(value, operation)


def in_latex(
    value: Any,
    place: str,
    form: Callable[[Expr], Expr],
    read_together: Callable[[Sequence[Expr]], None] = lambda entries: None,
) -> str:
    """Return a container in LaTeX; names are typeset differently in all of its entries.

    Args:
        value: the container.
        place: what is named in messages.
        form: which gives the form that is shown of an expression.
        read_together: what is told the entries of each matrix before their forms are asked for.
    """
    leaves: list[Expr] = []
    own = dict[int, str]()

    def collect(part: Any, path: str) -> None:
        entry = _entry(part)
        if _has_formula(part):
            own[id(part)] = one_formula(part.latex())
        elif entry is None:
            leaves.append(form(expression(part, f"{place}, entry {path}" if path else place)))
        elif entry.layout is None:
            raise ArgumentError(
                f"{place}: {described(part)}, which has no formula; expected expressions, matrices, vectors, points, "
                "frames, bodies, forces, torques, equations or linear models"
            )
        else:
            if isinstance(part, Matrix):
                read_together(part.entries)
            parts = (entry.shown or entry.parts)(part)
            names = [""] * len(parts) if entry.shown else _names(part, parts)
            for each, name in zip(parts, names, strict=True):
                collect(each, path + name)

    if _has_formula(value):
        return str(value.latex())
    collect(value, "")
    definitions, texts = latex_listing(leaves)
    remaining = iter(texts)

    def laid_out(part: Any) -> str:
        entry = _entry(part)
        if id(part) in own:
            return own[id(part)]
        if entry is None or entry.layout is None:
            return next(remaining)
        return entry.layout(part, [laid_out(each) for each in (entry.shown or entry.parts)(part)])

    return with_definitions(definitions, laid_out(value))


def _has_formula(value: Any) -> bool:
    """Return whether a thing, not its parts, says how it looks in LaTeX."""
    entry = _entry(value)
    return (
        (entry is None or entry.layout is None)
        and isinstance(value, Typeset)
        and not isinstance(value, Expr | type)
    )


def text_of(value: Any, text: Callable[[Any], str]) -> str | None:
    """Return the text of a list, a dictionary, an array or a matrix from those of its parts; None for other things."""
    entry = _entry(value)
    if entry is None or entry.text is None:
        return None
    return entry.text(value, [text(part) for part in entry.parts(value)])


class _Pass:
    """One pass over a container: its expressions are collected, changed together, and put back."""

    def __init__(
        self,
        place: str,
        ways: Callable[
            [Container, Any], tuple[Callable[[Any], Sequence[Any]], Callable[[Any, Sequence[Any]], Any]]
        ],
        whole: Callable[[Container, Any], Any] = lambda entry, part: None,
    ) -> None:
        self.place, self.ways, self.whole = place, ways, whole
        self.leaves: list[Expr] = []
        self.results: tuple[Expr, ...] = ()
        self.made: dict[int, Callable[[], Any]] = {}
        """What becomes of each container, by its id: a body on which several loads act stays one body."""
        self.kept: list[Any] = []
        """The containers, so that no other one gets their ids."""

    def run(self, value: Any, operation: Rewrite) -> Any:
        make = self.taken_apart(value, "")
        self.results = tuple(operation(tuple(self.leaves)))
        return make()

    def taken_apart(self, value: Any, path: str) -> Callable[[], Any]:
        entry = _entry(value)
        if entry is None:
            where = f"{self.place}, entry {path}" if path else self.place
            self.leaves.append(expression(value, where))
            return partial(self.result, len(self.leaves) - 1)
        if id(value) not in self.made:
            self.kept.append(value)
            self.made[id(value)] = self.rebuilding(value, entry, path)
        return self.made[id(value)]

    def result(self, place: int) -> Expr:
        return self.results[place]

    def rebuilding(self, value: Any, entry: Container, path: str) -> Callable[[], Any]:
        replaced = self.whole(entry, value)
        if replaced is not None:
            return lambda: replaced
        parts_of, rebuilt = self.ways(entry, value)
        parts = parts_of(value)
        makes = [
            self.taken_apart(part, path + name)
            for part, name in zip(parts, _names(value, parts), strict=True)
        ]
        memo: list[Any] = []

        def make() -> Any:
            if not memo:
                memo.append(rebuilt(value, [each() for each in makes]))
            return memo[0]

        return make


def _entry(value: object) -> Container | None:
    if isinstance(value, Expr):
        return None
    if is_array(value):
        return _ARRAY if value.ndim else None
    return next((_TABLE[kind] for kind in type(value).__mro__ if kind in _TABLE), None)


def _names(value: object, parts: Sequence[Any]) -> Sequence[str]:
    """Return the subscripts of the parts of lists and dictionaries."""
    if isinstance(value, dict):
        return [f"[{key!r}]" for key in value]
    if isinstance(value, list | tuple) or is_array(value):
        return [f"[{place}]" for place in range(len(parts))]
    return [""] * len(parts)


def _like_tuple(like: Any, parts: Sequence[Any]) -> Any:
    return type(like)(*parts) if hasattr(like, "_fields") else type(like)(parts)


def _array_layout(array: NDArray[Any], texts: list[str]) -> str:
    return bmatrix(texts, array.shape[1] if array.ndim == 2 else 1)


def _tuple_text(value: tuple[Any, ...], texts: list[str]) -> str:
    names = getattr(value, "_fields", None)
    return named(names, texts) if names else listed(texts, "(", ",)" if len(texts) == 1 else ")")


def _array_text(array: NDArray[Any], texts: list[str]) -> str:
    if array.ndim != 2:
        return listed(texts)
    columns = array.shape[1]
    return listed([listed(texts[k : k + columns]) for k in range(0, len(texts), columns or 1)])


def _brackets(opening: str, closing: str) -> Layout:
    return lambda _, texts: rf"\left{opening}{', '.join(texts)}\right{closing}"


def _dictionary(value: Mapping[Any, Any]) -> Sequence[Any]:
    return tuple(value.values())


def _pairs(dictionary: Mapping[Any, Any], texts: list[str]) -> str:
    values = texts[len(texts) - len(dictionary) :]
    keys = iter(texts)
    named = (next(keys) if isinstance(key, Expr) else upright(str(key)) for key in dictionary)
    return aligned(f"{key} &= {value}" for key, value in zip(named, values, strict=True))


def _keys_and_values(dictionary: Mapping[Any, Any]) -> Sequence[Any]:
    return *(key for key in dictionary if isinstance(key, Expr)), *dictionary.values()


def _alike(
    parts: Callable[[Any], Sequence[Any]], rebuilt: Callable[[Any, Sequence[Any]], Any], **more: Any
) -> Container:
    """Return the entry of a container whose derivative is one of the same kind."""
    return Container(parts, rebuilt, derivative=rebuilt, **more)


contains(
    list,
    _alike(
        list,
        lambda like, parts: type(like)(parts),
        layout=_brackets("[", "]"),
        text=lambda _, texts: listed(texts),
    ),
)
contains(tuple, _alike(tuple, _like_tuple, layout=_brackets("(", ")"), text=_tuple_text))
contains(
    dict,
    _alike(
        _dictionary,
        lambda like, parts: dict(zip(like, parts, strict=True)),
        layout=_pairs,
        text=lambda dictionary, texts: named(map(str, dictionary), texts),
        shown=_keys_and_values,
    ),
)
_ARRAY = _alike(lambda array: list(array.flat), array_like, layout=_array_layout, text=_array_text)
contains(
    Matrix,
    _alike(
        lambda matrix: matrix.entries,
        lambda like, parts: Matrix.from_entries(like.rows, like.columns, parts),
        layout=lambda matrix, texts: bmatrix(texts, matrix.columns),
        text=lambda matrix, texts: matrix_text(texts, matrix.columns),
    ),
)
