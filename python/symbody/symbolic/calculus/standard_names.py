"""Standard names for the variables of a model: what is chosen among forms by length doesn't depend on the user's names.

The form of a sum, and what a search for a form meets first, follow the names, too. So forms are looked for in standard
names, all equally long, which the variables get in the order of the model.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from hashlib import blake2b

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .derivative import substitute
from .reading import nodes_of, parts_of

_TIME = _core.time()
_RANKED = 20
"""The most new variables of an expression that are told apart by their places in it."""


@dataclass(frozen=True)
class StandardNames:
    """Variables with the user's names, and those that stand for them.

    Attributes:
        standing: what stands for each variable.
        given: the variables, by what stands for them.
    """

    standing: Mapping[Expr, Expr]
    given: Mapping[Expr, Expr]

    def standard(self, expression: Expr) -> Expr:
        """Return an expression in standard names."""
        return substitute([expression], self.standing)[0]

    def original(self, expression: Expr) -> Expr:
        """Return an expression in the user's names."""
        return substitute([expression], self.given)[0]


AS_GIVEN = StandardNames({}, {})
"""The names of the user."""


def standard_names(variables: Sequence[Expr], expressions: Iterable[Expr]) -> StandardNames:
    """Return standard names for variables, then for others in the order in which expressions contain them.

    Args:
        variables: functions of time and parameters in their order.
        expressions: those of the model in their order.

    >>> from symbody import functions_of_time, symbols
    >>> theta, (length, mass) = functions_of_time("theta"), symbols("length mass")
    >>> standard_names([theta], [mass, mass * length]).standard(mass * length * theta)
    a0*a1*A0
    """
    standing = dict[Expr, Expr]()
    for variable in variables:
        _enter(variable, standing)
    for expression in expressions:
        _enter_all(expression, standing)
    return StandardNames(standing, {standard: given for given, standard in standing.items()})


def _enter_all(expression: Expr, standing: dict[Expr, Expr]) -> None:
    leaves = (leaf for leaf in expression.free_symbols if leaf.kind in _LETTERS and leaf != _TIME)
    new = {_base(leaf) for leaf in leaves} - {*standing}
    # A variable is told from others by how it occurs in the expression; at last by its name.
    found = _occurrences(expression, new, standing) if 1 < len(new) <= _RANKED else {}
    for leaf in sorted(new, key=lambda leaf: (leaf.kind, found.get(leaf, b""), leaf.name)):
        _enter(leaf, standing)


@dataclass(frozen=True)
class _Node:
    """A node by its number, and the numbers of its parts.

    Attributes:
        new: the variable to be named that it is, or is a derivative of.
        head: what it is beside its parts; such a variable is "this" there if it is looked at, or else "another".
    """

    number: int
    parts: Sequence[int]
    is_commutative: bool
    new: Expr | None
    head: Callable[[str], str]

    def digest(self, name: str, digests: Mapping[int, bytes], others: Mapping[int, bytes]) -> bytes:
        """Return the digest of the form, from those of the parts: of a part without one, from those of others."""
        parts = [digests.get(part) or others[part] for part in self.parts]
        ordered = sorted(parts) if self.is_commutative else parts
        head = f"{self.head(name)} {len(parts)} "
        return blake2b(b"".join((head.encode(), *ordered)), digest_size=_DIGEST).digest()


def _occurrences(expression: Expr, new: set[Expr], standing: Mapping[Expr, Expr]) -> dict[Expr, bytes]:
    """Return, for each variable, what is equal for those that occur alike: a digest of the form, all others alike.

    No value is made, since a difference of equal variables may be a divisor.
    """
    nodes = [_node(node, new, standing) for node in nodes_of(expression)]
    alike = dict[int, bytes]()
    for node in nodes:
        alike[node.number] = node.digest("another", alike, alike)
    return {leaf: _occurrence(leaf, nodes, alike) for leaf in new}


def _occurrence(leaf: Expr, nodes: Sequence[_Node], alike: Mapping[int, bytes]) -> bytes:
    """Return the digest of a form with one variable unlike the others; what doesn't contain it keeps its digest."""
    unlike = dict[int, bytes]()
    for node in nodes:
        if node.new == leaf:
            unlike[node.number] = node.digest("this", unlike, alike)
        elif any(part in unlike for part in node.parts):
            unlike[node.number] = node.digest("another", unlike, alike)
    return unlike[nodes[-1].number]


def _node(node: Expr, new: set[Expr], standing: Mapping[Expr, Expr]) -> _Node:
    is_commutative = node.kind in _COMMUTATIVE
    parts = [part.id for part in (parts_of(node, node.kind) if is_commutative else node.args)]
    if node.kind not in _LETTERS or node == _TIME:
        name = getattr(node, "name", "") if node.args else str(node)
        head = f"{node.kind} {name} {getattr(node, 'orders', ())}"
        return _Node(node.id, parts, is_commutative, None, lambda _: head)
    base = _base(node)
    head = f"{node.kind} {node.assumption} {getattr(node, 'order', 0)}"
    if base in new:
        return _Node(node.id, parts, is_commutative, base, lambda name: f"{head} {name}")
    known = f"{head} {standing.get(base, base).name}"
    return _Node(node.id, parts, is_commutative, None, lambda _: known)


_COMMUTATIVE = {"sum", "product"}
_DIGEST = 16
"""The bytes of a digest."""


def _enter(variable: Expr, standing: dict[Expr, Expr]) -> None:
    if variable.kind in _LETTERS and variable not in standing:
        same = sum(other.kind == variable.kind for other in standing)
        standing[variable] = _standard(variable, same)


def _base(leaf: Expr) -> Expr:
    return leaf if leaf.kind == "symbol" else _core.time_function(leaf.name, small=leaf.assumption == "small")


def _standard(variable: Expr, number: int) -> Expr:
    letters, (tens, ones) = _LETTERS[variable.kind], divmod(number, 10)
    name = f"{letters[tens]}{ones}" if tens < len(letters) else f"{letters[-1]}{number}"
    kind = variable.assumption
    if variable.kind == "time_function":
        return _core.time_function(name, small=kind == "small")
    return _core.symbol(name, positive=kind == "positive", real=kind != "none", small=kind == "small")


_LETTERS = {"symbol": "abcdefghijklmnopqrstuvwxyz", "time_function": "ABCDEFGHIJKLMNOPQRSTUVWXYZ"}
