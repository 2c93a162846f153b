"""The law that `==` is a congruence: if A == B, then every function and operation gives equal results for A and B.

    python -m tests.laws.congruence --pairs 2000 --seed 1

prints how many pairs were tried, how many the program doesn't know as equal (missed: no break of the law), and how
many broke the law, with the shortest examples for each operation. ``--only 1:42`` looks at one pair again.
"""

from __future__ import annotations

import argparse
import multiprocessing
import random
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from itertools import pairwise
from multiprocessing import connection
from time import perf_counter
from typing import Any

from symbody import symbolic
from symbody.errors import SymbodyError
from symbody.symbolic import Expr, derivation, diff, gradient, number, parse, subs, symbols, time_derivative
from tests.laws.tree_rewrites import random_tree, rewritten
from tests.laws.trees import ELEMENTARY, SYMBOLS, Tree, build, compare, f, text, tree_of

EXAMPLES = 3
LARGEST = 400
"""The longest text of a tree that is tried."""

x, y, x0, a = (SYMBOLS[name] for name in ("x", "y", "x0", "a"))
POSITIVE_SUM = a + Fraction(1, 2)
MEANINGS = {str(symbol): symbol for name, symbol in SYMBOLS.items() if name != "x1"} | {"f": f}
STRANGERS = symbols("stranger"), symbols("alien", positive=True)
"""Symbols that no tree holds: what is put in for x and a."""


# --- operations ------------------------------------------------------------------------------------------------------

Operation = Callable[[Expr], Any]

FUNCTIONS: dict[str, Operation] = {
    **{name: getattr(symbolic, name) for name in (*ELEMENTARY, "sqrt", "Abs", "sign")},
    "f": f,
    "f(u, x)": lambda u: f(u, x),
    "D[1](f)": lambda u: f.derivative([1], u),
    "atan2(u, y)": lambda u: symbolic.atan2(u, y),
    "atan2(y, u)": lambda u: symbolic.atan2(y, u),
    "atan2(u, a)": lambda u: symbolic.atan2(u, a),
    "atan2(u, 1)": lambda u: symbolic.atan2(u, 1),
    "Min(u, x)": lambda u: symbolic.Min(u, x),
    "Max(u, x)": lambda u: symbolic.Max(u, x),
    "Max(1, u)": lambda u: symbolic.Max(1, u),
    "Max(u, y, 2)": lambda u: symbolic.Max(u, y, 2),
    "2**u": lambda u: 2**u,
    "(67/109)**u": lambda u: number(Fraction(67, 109)) ** u,
    "a**u": lambda u: a**u,
    "(a + 1/2)**u": lambda u: POSITIVE_SUM**u,
    "x**u": lambda u: x**u,
    "u**x": lambda u: u**x,
    "u**a": lambda u: u**a,
    "Piecewise((u, x))": lambda u: symbolic.Piecewise((u, x), otherwise=y),
    "Piecewise((x, u))": lambda u: symbolic.Piecewise((x, u), otherwise=y),
    "Piecewise(otherwise=u)": lambda u: symbolic.Piecewise((x, y), otherwise=u),
    "Piecewise((u, u))": lambda u: symbolic.Piecewise((u, u), (x, y - u), otherwise=1),
}

EXPONENTS = tuple(
    map(
        Fraction,
        ["2", "3", "-1", "-2", "1/2", "-1/2", "1/3", "2/3", "-3/2", "1/4", "5/6", "3/7", "1/13", "67/109"],
    )
)
POWERS: dict[str, Operation] = {f"u**({k})": (lambda u, k=k: u**k) for k in EXPONENTS}

NUMBERS = tuple(map(Fraction, ("-1", "2", "1/3", "67", "981/100", str(10**25 + 3))))
ARITHMETIC: dict[str, Operation] = {
    **{f"u*({n})": (lambda u, n=n: u * n) for n in NUMBERS},
    "u + 1": lambda u: u + 1,
    "u*pi": lambda u: u * symbolic.pi,
    "u*sqrt(67)": lambda u: u * symbolic.sqrt(67),
    "u*a": lambda u: u * a,
    "u*x": lambda u: u * x,
    "u + x": lambda u: u + x,
    "u/(x - y)": lambda u: u / (x - y),
    "(x - y)/u": lambda u: (x - y) / u,
}

CALCULUS: dict[str, Operation] = {
    **{f"diff(u, {name})": partial(diff, variable=SYMBOLS[name]) for name in ("x", "y", "x0", "x1", "a")},
    "time_derivative": time_derivative,
    "gradient": lambda u: gradient(u, [SYMBOLS[name] for name in ("x", "y", "x0", "x1", "a", "b")]),
    "diff twice": lambda u: diff(diff(u, x), x0),
}
SUBSTITUTIONS: dict[str, Operation] = {
    "subs(x: number)": lambda u: subs(u, {x: Fraction(17, 11)}),
    "subs(x: negative number)": lambda u: subs(u, {x: Fraction(-19, 13)}),
    "subs(x: sum)": lambda u: subs(u, {x: 2 * STRANGERS[0] - Fraction(5, 7)}),
    "subs(y: positive)": lambda u: subs(u, {y: STRANGERS[1]}),
    "subs(x0: function of t)": lambda u: subs(u, {x0: symbolic.sin(STRANGERS[0] * symbolic.t)}),
    "subs(a: product)": lambda u: subs(u, {a: 2 * STRANGERS[1] ** 2}),
}
OTHERS: dict[str, Operation] = {
    "hash": hash,
    "parse(str(u))": lambda u: parse(str(u), MEANINGS),
}
OPERATIONS = FUNCTIONS | POWERS | ARITHMETIC | CALCULUS | SUBSTITUTIONS | OTHERS
NESTABLE = list((FUNCTIONS | POWERS | ARITHMETIC).items())


def nested(draw: random.Random) -> tuple[str, Operation]:
    """Return a random composition of two or three operations."""
    chosen = draw.choices(NESTABLE, k=draw.choice((2, 2, 3)))

    def composed(u: Expr) -> Any:
        for _, operation in chosen:
            u = operation(u)
        return u

    return " of ".join(name for name, _ in reversed(chosen)), composed


Relation = Callable[[Expr, Expr], bool]

RELATIONS: dict[str, Relation] = {
    "A - B == 0": lambda A, B: bool((A - B).is_zero),
    "B - A == 0": lambda A, B: B - A == 0,
    "A/B == 1": lambda A, B: A.is_zero or A / B == 1,
    "B/A == 1": lambda A, B: B.is_zero or B / A == 1,
    "B == A": lambda A, B: B == A,
    "A.equals(B)": lambda A, B: A.equals(B) and B.equals(A),
    "A*A == A*B": lambda A, B: A * A == A * B,
    "A*B == B*B": lambda A, B: A * B == B * B,
    "A**2 - A*B == 0": lambda A, B: (A**2 - A * B).is_zero,
    "x*A - x*B == 0": lambda A, B: (x * A - x * B).is_zero,
    "sqrt(A)*sqrt(B) == A": lambda A, B: symbolic.sqrt(A) * symbolic.sqrt(B) == A,
    "Max(A, B) == A": lambda A, B: symbolic.Max(A, B) == A,
    "Piecewise((A, x), otherwise=B) == A": lambda A, B: symbolic.Piecewise((A, x), otherwise=B) == A,
    "hash": lambda A, B: hash(A) == hash(B),  # fingerprints differ where signs or roots cancel in one of them
}


def with_others(C: Expr) -> dict[str, Operation]:
    """Return the operations that combine with another expression."""
    return {
        "u*C": lambda u: u * C,
        "u/C": lambda u: u / C,
        "C/u": lambda u: C / u,
        "u + C": lambda u: u + C,
        "C - u": lambda u: C - u,
        "Max(u, C)": lambda u: symbolic.Max(u, C),
        "atan2(C, u)": lambda u: symbolic.atan2(C, u),
        "Piecewise((x, C), (u, x))": lambda u: symbolic.Piecewise((x, C), (u, x), otherwise=y),
        "sqrt(u*C)": lambda u: symbolic.sqrt(u * C),
        "sqrt(u**2 + C**2)": lambda u: symbolic.sqrt(u**2 + C**2),
        "sqrt(u + C)": lambda u: symbolic.sqrt(u + C),
        "f(C, u)": lambda u: f(C, u),
    }


# --- pairs -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Pair:
    """Two trees, the second one rewritten from the first one."""

    place: str
    """Seed and index, which give this pair again."""
    one: Tree
    two: Tree
    chain: tuple[Tree, ...] = ()
    """What came between them."""
    rewrites: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.place}  A = {text(self.one)}  B = {text(self.two)}  ({', '.join(self.rewrites)})"

    @property
    def length(self) -> int:
        return len(text(self.one)) + len(text(self.two))


def pair(seed: int, index: int) -> Pair:
    """Return the pair of this seed and index."""
    draw = random.Random(f"{seed}:{index}")
    while True:
        leaves = ["x", "y", "x0", "a", "b", *draw.choice(([], [], ["x1"], ["s"]))]
        one = random_tree(draw, draw.choice((1, 2, 2, 3)), leaves)
        chain, rewrites = [one], []
        for _ in range(draw.choice((1, 1, 2, 3))):
            two, rewrite = rewritten(chain[-1], draw)
            chain.append(two)
            rewrites.append(rewrite)
        if max(len(text(tree)) for tree in chain) <= LARGEST:
            return Pair(f"{seed}:{index}", one, chain[-1], tuple(chain), tuple(rewrites))


# --- the law ---------------------------------------------------------------------------------------------------------


@dataclass
class Report:
    """What a run has found."""

    next_index: int = 0
    counts: Counter[str] = field(default_factory=Counter)
    tried: Counter[str] = field(default_factory=Counter)
    """How often each operation was tried."""
    broken: Counter[str] = field(default_factory=Counter)
    missed: Counter[str] = field(default_factory=Counter)
    """How many pairs each rewrite made that are not known as equal."""
    examples: dict[str, list[tuple[int, str]]] = field(default_factory=dict)

    def example(self, operation: str, length: int, written: str) -> None:
        """Keep the shortest examples."""
        kept = self.examples.setdefault(operation, [])
        kept.append((length, written))
        kept.sort()
        del kept[EXAMPLES:]

    def add(self, other: Report) -> None:
        for mine, theirs in (
            (self.counts, other.counts),
            (self.tried, other.tried),
            (self.broken, other.broken),
            (self.missed, other.missed),
        ):
            mine.update(theirs)
        for operation, examples in other.examples.items():
            for length, written in examples:
                self.example(operation, length, written)

    @property
    def is_clean(self) -> bool:
        return not self.broken and not self.counts["false equalities"]

    def __str__(self) -> str:
        lines = [f"{count:>9}  {name}" for name, count in self.counts.items()]
        lines += [f"{self.tried.total():>9}  checks", f"{self.broken.total():>9}  broken checks"]
        if self.missed:
            listed = ", ".join(f"{name} {count}" for name, count in self.missed.most_common(12))
            lines.append(f"Missed by rewrite: {listed}")
        lines += ["", "Broken operations: how often, of how many tries, the shortest examples"] * bool(
            self.broken
        )
        written: dict[str, list[str]] = {}
        for name, count in self.broken.most_common():
            places = [example.split(" ", 1)[0] for _, example in self.examples[name]]
            lines.append(f"{count:>9} of {self.tried[name]:>6}  {name:<36} {' '.join(places)}")
            for _, example in self.examples[name]:
                written.setdefault(example, []).append(name)
        lines += [""] * bool(written)
        for example, names in written.items():
            lines.append(f"{example}\n    breaks {', '.join(names)}")
        for name in self.counts:
            if name in self.examples:
                lines.append(f"\n{name[0].upper()}{name[1:]}: {self.counts[name]}")
                lines += [f"    {example}" for _, example in self.examples[name]]
        return "\n".join(lines)


POLICIES: tuple[Callable[[], AbstractContextManager[object]], ...] = (nullcontext, nullcontext, derivation)


class _Failed:
    """The result of an operation that raised an error."""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Failed)

    def __hash__(self) -> int:
        return 0


def _result(operation: Operation, u: Expr) -> Any:
    try:
        return operation(u)
    except SymbodyError:
        return _Failed()


def broken_operations(
    A: Expr, B: Expr, draw: random.Random, compositions: int = 20
) -> Iterator[tuple[str, bool]]:
    """Yield each operation and some compositions, and whether it breaks the law for two equal expressions."""
    C = _build(random_tree(draw, draw.choice((0, 1, 1, 2)))) or x
    operations = OPERATIONS | with_others(C)
    policies = draw.choice(POLICIES), draw.choice(POLICIES)
    first, second = (A, B) if draw.random() < 0.5 else (B, A)
    with policies[0]():
        ones = [_result(operation, first) for operation in operations.values()]
    with policies[1]():
        twos = [_result(operation, second) for operation in operations.values()]
        for (name, operation), one, two in zip(operations.items(), ones, twos, strict=True):
            if operation in SUBSTITUTIONS.values() and _Failed() in (one, two):
                continue  # a value that one of the forms divides by
            yield name, one != two
        for _ in range(compositions):
            name, operation = nested(draw)
            yield f"nested: {name}", _result(operation, A) != _result(operation, B)
        for name, relation in RELATIONS.items():
            holds = _result(lambda u, relation=relation: relation(u, B), A)
            if holds == _Failed() and _result(lambda u, relation=relation: relation(u, u), A) == _Failed():
                continue  # the root of a negative number, say
            yield name, holds is not True


def _build(tree: Tree) -> Expr | None:
    try:
        return build(tree)
    except SymbodyError:
        return None


def check(pair: Pair, report: Report, compositions: int = 20) -> None:
    """Try the law on one pair, and note what is found."""
    chain = [_build(tree) for tree in pair.chain or (pair.one, pair.two)]
    if any(expression is None for expression in chain):
        report.counts["not built (division by zero)"] += 1
        return
    A, B = chain[0], chain[-1]
    assert A is not None
    assert B is not None
    if A.same_form(B):
        report.counts["same form"] += 1
        return
    same = A == B
    verdict = compare(tree_of(A), tree_of(B)) if _has_rewrite(pair) else compare(pair.one, pair.two)
    if same and verdict.differing:
        report.counts["false equalities"] += 1
        report.example("false equalities", pair.length, str(pair))
    elif verdict.differing:
        report.counts["rewrites of ours that are wrong"] += 1
        report.example("rewrites of ours that are wrong", pair.length, str(pair))
    elif verdict.compared + verdict.off_line == 0:
        report.counts["comparable nowhere"] += 1
    elif not same and verdict.compared == 0:
        report.counts["not real anywhere, not known as equal"] += 1
    elif not same:
        report.counts["missed"] += 1
        report.example("missed", pair.length, str(pair))
        report.missed[" + ".join(pair.rewrites) if len(pair.rewrites) == 1 else "several"] += 1
        _check_transitivity(chain, pair, report)
    else:
        if verdict.off_line_differing:
            report.counts["equal pairs that differ off the real line"] += 1
            report.example("equal pairs that differ off the real line", pair.length, str(pair))
        report.counts["pairs"] += 1
        _check_transitivity(chain, pair, report)
        _check_law(A, B, pair, report, compositions)


def _has_rewrite(pair: Pair) -> bool:
    return any(not name.startswith("_") for name in pair.rewrites)


def _check_transitivity(chain: Sequence[Any], pair: Pair, report: Report) -> None:
    if len(chain) < 3:
        return
    report.tried["transitivity"] += 1
    if all(one == two for one, two in pairwise(chain)) and chain[0] != chain[-1]:
        report.broken["transitivity"] += 1
        report.example("transitivity", pair.length, str(pair))


def _check_law(A: Expr, B: Expr, pair: Pair, report: Report, compositions: int) -> None:
    broken = False
    for name, is_broken in broken_operations(A, B, random.Random(f"law {pair.place}"), compositions):
        group = "nested" if name.startswith("nested") else name
        report.tried[group] += 1
        if is_broken:
            broken = True
            report.broken[group] += 1
            report.example(group, pair.length, f"{pair}  {name}" if group == "nested" else str(pair))
    report.counts["pairs that break the law"] += broken


# --- runs ------------------------------------------------------------------------------------------------------------


def run(pairs: int, seed: int, *, start: int = 0, progress: Any = None) -> Report:
    """Try this many pairs that are known as equal, and have different forms."""
    report = Report(start)
    while report.counts["pairs"] < pairs:
        if progress is not None:
            progress.value = report.next_index
        check(pair(seed, report.next_index), report)
        report.next_index += 1
    return report


@dataclass
class _Child:
    """A process that tries some pairs. It may crash."""

    pairs: int
    seed: int
    start: int

    def __post_init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.progress = context.Value("q", self.start, lock=False)
        self.receiver, sender = context.Pipe(duplex=False)
        task = sender, self.pairs, self.seed, self.start, self.progress
        self.process = context.Process(target=_send_reports, args=task)
        self.process.start()
        sender.close()

    def advance(self, report: Report) -> bool:
        """Add what the process has found meanwhile, and return whether it is still at work."""
        try:
            found = self.receiver.recv()
        except EOFError:
            self.process.join()
            if self.pairs > 0:
                self._note_crash(report)
            return False
        report.add(found)
        self.pairs -= found.counts["pairs"]
        return True

    def _note_crash(self, report: Report) -> None:
        crashed = pair(self.seed, self.progress.value)
        report.broken["crash"] += 1
        report.tried["crash"] += 1
        report.example("crash", crashed.length, str(crashed))
        self.start = self.progress.value + 1


def _send_reports(sender: Any, pairs: int, seed: int, start: int, progress: Any) -> None:
    while pairs > 0:
        report = run(min(pairs, 50), seed, start=start, progress=progress)
        pairs, start = pairs - report.counts["pairs"], report.next_index
        sender.send(report)


def run_in_processes(pairs: int, seed: int, processes: int = 1, *, chunk: int = 2000) -> Report:
    """Try pairs in processes that end after a chunk: the graph of expressions only grows.

    A crash is reported as a broken operation. The up to 50 pairs before it are tried, but not counted.
    """
    waiting = [(min(chunk, pairs - done), seed, 10**9 * k) for k, done in enumerate(range(0, pairs, chunk))]
    running: list[_Child] = []
    total = Report()
    while waiting or running:
        while waiting and len(running) < processes:
            running.append(_Child(*waiting.pop(0)))
        connection.wait([child.receiver for child in running])
        for child in [child for child in running if child.receiver.poll()]:
            if not child.advance(total):
                running.remove(child)
                if child.pairs > 0:
                    waiting.insert(0, (child.pairs, child.seed, child.start))
    return total


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--pairs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--only", metavar="SEED:INDEX", help="look at one pair")
    options = parser.parse_args()
    started = perf_counter()
    if options.only:
        seed, index = map(int, options.only.split(":"))
        report = Report()
        print(pair(seed, index))
        check(pair(seed, index), report)
    else:
        report = run_in_processes(options.pairs, options.seed, options.processes)
    print(report)
    print(f"{perf_counter() - started:.1f} s")
    return 0 if report.is_clean else 1


if __name__ == "__main__":
    sys.exit(main())
