"""The tables of an LALR parser, made ready for long statements: chains of operators of one part take one step.

A grammar with a rule for each strength of operators reduces ``x`` to a product, to a sum, to a range, and so on. These
reductions change nothing but the state, and where they lead depends on two states and the next token. So this is worked
out once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from lark import Lark, Tree
from lark.grammar import Rule
from lark.parse_tree_builder import maybe_create_child_filter

from symbody.worksheet.sheet.syntax import Place

__all__ = ["Meaning", "Reduction", "Tables", "tables_of"]

#: What a rule means: from the place of its text and what its parts have become.
Meaning: TypeAlias = Callable[[Place, list[Any]], Any]


@dataclass(frozen=True, slots=True)
class Reduction:
    """A rule at its end.

    Attributes:
        size: the number of its symbols.
        origin: the kind that they become.
        parts: what of them the rule keeps.
        meaning: None where it has one symbol, and is what this is.
    """

    size: int
    origin: str
    parts: Callable[[list[Any]], list[Any]]
    meaning: Meaning | None


@dataclass(frozen=True, slots=True)
class Tables:
    """For each state and the next kind of token: the state after it, or the rule that ends before it."""

    steps: Mapping[int, Mapping[str, int | Reduction]]
    start: int
    end: int
    _settled: dict[tuple[int, int, str], int] = field(default_factory=dict, repr=False)

    def settled(self, below: int, state: int, kind: str) -> int:
        """Return the state that a state above ``below`` becomes before a token, by rules of one symbol."""
        known = self._settled.get((below, state, kind))
        if known is not None:
            return known
        last, step = state, self.steps[state].get(kind)
        while isinstance(step, Reduction) and step.meaning is None:
            goto = self.steps[below][step.origin]
            assert isinstance(goto, int)
            last, step = goto, self.steps[goto].get(kind)
        self._settled[below, state, kind] = last
        return last


def tables_of(parser: Lark, meanings: object) -> Tables:
    """Return the tables of a parser; ``meanings`` has a method for each rule."""
    conf = parser.parse_interactive("").parser_state.parse_conf
    reductions = {rule: _reduction(rule, meanings) for rule in parser.rules}
    steps = {
        state: {kind: reductions[arg] if isinstance(arg, Rule) else arg for kind, (_, arg) in actions.items()}
        for state, actions in conf.states.items()
    }
    return Tables(steps, conf.start_state, conf.end_state)


def _reduction(rule: Rule, meanings: object) -> Reduction:
    name = rule.alias or rule.origin.name
    size = len(rule.expansion)
    wrapper = maybe_create_child_filter(rule.expansion, False, False, [*rule.options.empty_indices])
    parts = list if wrapper is None else wrapper(list)
    if rule.options.expand1 and not rule.alias:
        assert size == 1, rule
        return Reduction(size, rule.origin.name, parts, None)
    if name.startswith("_"):  # repeated symbols, which become parts of the rule that they stand in
        return Reduction(size, rule.origin.name, parts, lambda _, items: Tree(name, items))
    return Reduction(size, rule.origin.name, parts, getattr(meanings, name))
