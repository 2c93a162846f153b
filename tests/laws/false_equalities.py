"""The hunt for false equalities: many expressions of few atoms, so that values collide, judged by numbers.

    python -m tests.laws.false_equalities --expressions 40000 --seed 1

Expressions are put into classes by `==` (a dictionary: by hash, then by `==`). At each of the points, all members of a
class that are real there must have one value.

What is skipped, and counted:

* a point where an expression is undefined, lies on a jump, or has left the real line on its way (the root of a negative
  number), for this expression only: the other members of its class are compared there;
* an expression that is real at none of the points is compared with nothing ("real at no point").

Doubles decide that two values agree; that they differ, numbers of 60 and 200 digits confirm. Values are computed from
the trees, not from the forms that symbody gives them, so a wrong simplification is found as well.

The reverse is counted for information: classes whose values agree at all points although they are not known as equal
("not known as equal"), and expressions with equal fingerprints that are not equal. The latter are tried in a few larger
expressions too, which must not be equal either.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import random
import sys
from array import array
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import chain, combinations_with_replacement, product
from time import perf_counter
from typing import Any

import mpmath

from symbody.errors import SymbodyError
from symbody.symbolic import Expr, derivation, free_symbols
from tests.laws.tree_rewrites import random_tree, rewritten
from tests.laws.trees import (
    COMPLEX,
    EXACT_POINTS,
    MAKERS,
    MINUS_ONE,
    PI,
    POINTS,
    SYMBOLS,
    TWO,
    Tree,
    build,
    digits,
    doubles,
    f,
    holds_complex_leaf,
    leaf,
    number,
    text,
    value,
)

EXAMPLES = 8
COUNT = 12
"""How many points are looked at."""

SMALL = 1e-6
y = SYMBOLS["y"]


Real = float | complex | None
"""A value: complex for trees with complex leaves only, None where the tree isn't real."""


@dataclass(frozen=True, slots=True)
class Known:
    """A tree with its expression and its values at the points."""

    tree: Tree
    expression: Expr
    values: tuple[Real, ...]
    is_complex: bool

    @property
    def fingerprint(self) -> bytes:
        return self.expression.fingerprint


@dataclass(slots=True)
class Class:
    """Expressions that are equal: the first one, and at each point where that isn't real the first one that is."""

    first: Known
    others: dict[int, Known] | None = None

    def at(self, point: int) -> Known | None:
        """Return the first member that has a value at a point."""
        if self.first.values[point] is not None:
            return self.first
        return self.others.get(point) if self.others else None

    def note(self, known: Known, point: int) -> None:
        self.others = self.others or {}
        self.others[point] = known


@dataclass
class Hunt:
    """Classes of equal expressions, and what was found wrong in them."""

    classes: dict[Expr, Class] = field(default_factory=dict)
    fingerprints: dict[bytes, Known] = field(default_factory=dict)
    by_values: dict[bytes, Known] = field(default_factory=dict)
    counts: Counter[str] = field(default_factory=Counter)
    false: list[tuple[int, str]] = field(default_factory=list)
    unknown: list[tuple[int, str]] = field(default_factory=list)

    def add(self, known: Known) -> None:
        """Put an expression into its class, and compare it with the class."""
        self.counts["expressions"] += 1
        undefined = sum(each is None for each in known.values)
        self.counts["points skipped for one expression"] += undefined
        self.counts["real at no point"] += undefined == len(known.values)
        found = self.classes.get(known.expression)
        if found is None:
            self.classes[known.expression] = Class(known)
            self._note_fingerprint(known)
            self._note_values(known)
            return
        self.counts["in a class that was there"] += 1
        self._compare(known, found)

    def _compare(self, known: Known, found: Class) -> None:
        for k, mine in enumerate(known.values):
            if mine is None:
                continue
            other = found.at(k)
            if other is None:
                found.note(known, k)
                continue
            theirs = other.values[k]
            if _are_apart(mine, theirs):
                self.counts["judged with many digits"] += 1
                if _differ(known.tree, other.tree, k):
                    self._note_false(known.tree, other.tree, k)
                    return

    def _note_false(self, one: Tree, two: Tree, k: int, where: str = "") -> None:
        self.counts["false equalities"] += 1
        written = f"{text(one)}  ==  {text(two)}{where}  at {_printed(POINTS[k])}"
        _keep(self.false, len(text(one)) + len(text(two)), written)

    def _note_fingerprint(self, known: Known) -> None:
        """Look closely at two expressions that a fingerprint alone would confuse."""
        other = self.fingerprints.setdefault(known.fingerprint, known)
        if other is known:
            return
        self.counts["equal fingerprints, not equal"] += 1
        places = [k for k in range(len(known.values)) if _are_apart(known.values[k], other.values[k])]
        try:
            confused = [name for name, is_so in confusions(known.expression, other.expression) if is_so]
        except SymbodyError:  # what is zero but at corners is no divisor inside a derivation
            confused = []
        if places and confused and _differ(known.tree, other.tree, places[0]):
            self._note_false(known.tree, other.tree, places[0], f" ({', '.join(confused)})")

    def _note_values(self, known: Known) -> None:
        """Note which classes have the same values: all of them, at no less than half of the points."""
        if sum(each is None for each in known.values) > len(known.values) // 2:
            return
        key = _key(known.values)
        same = self.by_values.setdefault(key, known)
        if same is not known:
            self.counts["classes not known as equal"] += 1
            one, two = text(same.tree), text(known.tree)
            _keep(self.unknown, len(one) + len(two), f"{one}  !=  {two}")

    def __str__(self) -> str:
        self.counts["classes"] = len(self.classes)
        lines = [f"{count:>9}  {name}" for name, count in self.counts.items()]
        for title, examples in (("FALSE EQUALITIES", self.false), ("Not known as equal", self.unknown)):
            lines += [f"\n{title}:" * bool(examples), *(f"    {written}" for _, written in examples)]
        return "\n".join(lines)


def _are_apart(one: Real, two: Real) -> bool:
    if one is None or two is None:
        return False
    return not abs(one - two) <= SMALL * (1 + abs(one) + abs(two))


def confusions(one: Expr, two: Expr) -> Iterator[tuple[str, bool]]:
    """Yield relations of two expressions that are not equal, and whether they hold."""
    yield "A - B == 0", (one - two).is_zero
    yield "A.equals(B)", one.equals(two)
    yield "A + y == B + y", one + y == two + y
    yield "A*y == B*y", one * y == two * y
    yield "f(A) == f(B)", f(one) == f(two)
    with derivation():
        yield "A - B == 0 in a derivation", (one - two).is_zero
        yield "A + y == B + y in a derivation", one + y == two + y
        yield "-3*A == -3*B in a derivation", -3 * one == -3 * two
        yield "y/A == y/B in a derivation", not one.is_zero and not two.is_zero and y / one == y / two
        yield "f(A) == f(B) in a derivation", f(one) == f(two)


def _keep(examples: list[tuple[int, str]], length: int, written: str) -> None:
    examples.append((length, written))
    examples.sort()
    del examples[EXAMPLES:]


def _key(values: Iterable[Real]) -> bytes:
    """Return the values with seven digits: near ones agree, but for a few on the edge of rounding."""
    parts = [math.inf if each is None else each for each in values]
    return array("f", [part for each in parts for part in (each.real, each.imag)]).tobytes()


def _printed(point: dict[str, Any]) -> str:
    return ", ".join(f"{name}={value:.3g}" for name, value in point.items())


def _differ(one: Tree, two: Tree, k: int) -> bool:
    """Return whether many digits confirm that two trees differ at a point."""
    is_complex = holds_complex_leaf(one) or holds_complex_leaf(two)
    for places in (60, 200):
        with mpmath.workdps(places):
            values = [value(tree, EXACT_POINTS[k], digits(is_complex=is_complex)) for tree in (one, two)]
            if None in values or (not is_complex and any(isinstance(each, mpmath.mpc) for each in values)):
                return False
            if abs(values[0] - values[1]) <= mpmath.mpf(10) ** (-places // 3) * (1 + abs(values[0])):
                return False
    return True


# --- expressions -----------------------------------------------------------------------------------------------------


class Trace:
    """The text of the last expression that was made, for the parent of a process that crashes; off by default."""

    last: Any = None
    last_length = 4000

    @classmethod
    def note(cls, tree: Tree) -> None:
        if cls.last is not None:
            cls.last.value = text(tree).encode()[: cls.last_length]


def known(tree: Tree) -> Known | None:
    """Return what is known of a tree, or None where symbody refuses it."""
    Trace.note(tree)
    try:
        expression = build(tree)
    except SymbodyError:
        return None
    is_complex = holds_complex_leaf(tree)
    if is_complex and not _is_complex(expression):
        return None
    arithmetic = doubles(is_complex=is_complex)
    values = [value(tree, point, arithmetic) for point in POINTS[:COUNT]]
    return Known(tree, expression, tuple(_kept(each, is_complex=is_complex) for each in values), is_complex)


def _is_complex(expression: Expr) -> bool:
    """Whether a complex leaf has not dropped out: what is left without it is meant to be real, as 1 ** s is."""
    return any(str(symbol) in COMPLEX for symbol in free_symbols(expression))


def _kept(number: Any, *, is_complex: bool) -> Real:
    if number is None or (isinstance(number, complex) and not is_complex):
        return None
    return number if abs(number) < 1e12 else None


def combined(operation: str, *parts: Known) -> Known | None:
    """Return what is known of an operation on what is known."""
    tree = (operation, *(part.tree for part in parts))
    Trace.note(tree)
    try:
        expression = MAKERS[operation](*(part.expression for part in parts))
    except SymbodyError:
        return None
    is_complex = any(part.is_complex for part in parts)
    if is_complex and not _is_complex(expression):
        return None
    arithmetic = doubles(is_complex=is_complex)
    columns = zip(*(part.values for part in parts), strict=True)
    values = (_kept(arithmetic.apply(operation, column), is_complex=is_complex) for column in columns)
    return Known(tree, expression, tuple(values), is_complex)


LEAVES = (leaf("x"), leaf("y"), leaf("a"), MINUS_ONE, TWO)
MORE_LEAVES = (
    *LEAVES,
    *(leaf(name) for name in ("x0", "b", "s")),
    *(number(Fraction(n)) for n in ("1", "67", "-4", "1/3")),
    PI,
)
ONES = ("abs", "sign", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")
OFTEN = ("abs", "abs", "sign", "sign", "exp", "log", *["^"] * 6)
ROOTS = tuple(map(Fraction, ("1/2", "1/3", "2/3", "-1/2", "3/2", "1/4", "2", "-1", "3")))
TWOS = ("+", "*", "/", "Max", "Min", "atan2", "^")
COMMUTE = ("+", "*", "Max", "Min")


Task = tuple[str, Known, Known | None]
"""An operation, its argument, and a second one or None."""


def _all_known(trees: Iterable[Tree]) -> list[Known]:
    return [each for each in map(known, trees) if each]


def next_level(level: Sequence[Known]) -> list[Task]:
    """Return all operations on expressions of a level."""
    exponents = _all_known(map(number, ROOTS))
    tasks: list[Task] = [(name, each, None) for name in ONES for each in level]
    tasks += [("^", each, exponent) for each in level for exponent in exponents]
    for name in TWOS:
        pairs = combinations_with_replacement(level, 2) if name in COMMUTE else product(level, repeat=2)
        tasks += [(name, one, two) for one, two in pairs]
    return tasks


def _done(tasks: Iterable[Task]) -> Iterator[Known]:
    for name, one, two in tasks:
        made = combined(name, one) if two is None else combined(name, one, two)
        if made:
            yield made


def enumerated(count: int, draw: random.Random, atoms: Sequence[Tree] = LEAVES) -> Iterator[Known]:
    """Yield the leaves, what one operation makes of them, and what two operations make (a sample if these are more)."""
    leaves = _all_known(atoms)
    yield from leaves
    ones = list(_done(next_level(leaves)))
    yield from ones
    forms = list({each.expression.id: each for each in (*leaves, *ones)}.values())
    left = max(0, count - len(leaves) - len(ones))
    yield from _done(next_level(forms) if len(forms) ** 2 * 5 < left else _sample(forms, left, draw))


def _sample(level: Sequence[Known], count: int, draw: random.Random) -> Iterator[Task]:
    """Yield operations as `next_level` lists them, at random."""
    exponents = _all_known(map(number, ROOTS))
    for _ in range(count):
        one, two = draw.choice(level), draw.choice(level)
        kind = draw.random()
        if kind < 0.1:
            yield (draw.choice(ONES), one, None)
        elif kind < 0.25:
            yield ("^", one, draw.choice(exponents))
        else:
            yield (draw.choice(TWOS), one, two)


def grown(count: int, draw: random.Random) -> Iterator[Known]:
    """Yield expressions of random operations on a pool of small ones, which they join; roots and moduli most."""
    pool = _all_known(MORE_LEAVES)
    exponents = _all_known(map(number, ROOTS))
    for made in range(count):
        one, two = (draw.choice(pool) for _ in range(2))
        name = draw.choice(OFTEN) if draw.random() < 0.55 else draw.choice(TWOS)
        if name in TWOS:
            new = combined(name, one, draw.choice(exponents) if name == "^" and draw.random() < 0.9 else two)
        else:
            new = combined(name, one)
        if new is None:
            continue
        yield new
        if any(each is not None for each in new.values) and len(text(new.tree)) < 80:
            if len(pool) < 400:
                pool.append(new)
            else:  # the pool stays small, so that expressions meet
                pool[draw.randrange(len(MORE_LEAVES), len(pool))] = new
        if made % 5000 == 4999:
            del pool[len(MORE_LEAVES) :]


def rewritings(count: int, draw: random.Random) -> Iterator[Known]:
    """Yield random expressions over all functions, and rewritten ones beside them."""
    for _ in range(count // 5):
        leaves = draw.choice((("x", "y", "x0", "a", "b"), ("x", "y", "a"), ("x", "s", "a")))
        tree = random_tree(draw, draw.choice((1, 2, 3)), leaves)
        trees = [tree, *(rewritten(tree, draw)[0] for _ in range(3))]
        trees.append(rewritten(trees[-1], draw)[0])
        yield from _all_known(each for each in trees if len(text(each)) < 400)


def hunt(count: int, seed: int, *, in_derivation: bool = False) -> Hunt:
    """Return what is found among about this many expressions.

    In a derivation, an expression is the first node of its class, so a false equality can't be undone by `==`.
    """
    draw = random.Random(f"hunt {seed}")
    found = Hunt()
    atoms = LEAVES if seed % 2 else MORE_LEAVES
    shares = enumerated(count // 2, draw, atoms), grown(count * 3 // 10, draw), rewritings(count // 5, draw)
    with derivation() if in_derivation else nullcontext():
        for each in chain(*shares):
            found.add(each)
    return found


@dataclass(frozen=True)
class Summary:
    """What a process has found."""

    expressions: int
    false: int
    report: str


def _send_summary(sender: Any, last: Any, count: int, seed: int, in_derivation: bool) -> None:
    Trace.last = last
    found = hunt(count, seed, in_derivation=in_derivation)
    sender.send(Summary(found.counts["expressions"], found.counts["false equalities"], str(found)))


def hunt_in_a_process(count: int, seed: int, *, in_derivation: bool = False, traced: bool = False) -> Summary:
    """Hunt in a process of its own, which gives the memory back. A crash is tried again, and its expression named."""
    context = multiprocessing.get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    last = context.Array("c", Trace.last_length, lock=False) if traced else None
    task = sender, last, count, seed, in_derivation
    process = context.Process(target=_send_summary, args=task)
    process.start()
    sender.close()
    try:
        summary: Summary = receiver.recv()
    except EOFError:
        process.join()
        if last is None:
            return hunt_in_a_process(count, seed, in_derivation=in_derivation, traced=True)
        raise RuntimeError(f"the process crashed ({process.exitcode}) at {last.value.decode()}") from None
    process.join()
    return summary


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--expressions", type=int, default=40_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--derivation", action="store_true", help="make the expressions inside derivation()")
    options = parser.parse_args()
    started = perf_counter()
    found = hunt_in_a_process(options.expressions, options.seed, in_derivation=options.derivation)
    print(found.report)
    print(f"{perf_counter() - started:.1f} s")
    return 1 if found.false else 0


if __name__ == "__main__":
    sys.exit(main())
