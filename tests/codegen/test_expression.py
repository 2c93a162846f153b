"""Printed expressions keep every operation and its order: Python, which binds as the other languages do, reads them."""

from __future__ import annotations

import ast
import random
from typing import Any

import pytest

from symbody.codegen.languages.fortran import LANGUAGE as FORTRAN
from symbody.codegen.languages.python import LANGUAGE as PYTHON
from symbody.codegen.layout.code_text import expression_text, wrap_line
from symbody.codegen.layout.language import Language
from symbody.codegen.layout.tree import Application, Entry, Name, Number, Tree
from symbody.codegen.straight_line.instruction import Operation
from tests.repeated import repeated

OPERATORS: dict[type[ast.AST], Operation] = {
    ast.Add: Operation.ADD,
    ast.Sub: Operation.SUB,
    ast.Mult: Operation.MUL,
    ast.Div: Operation.DIV,
}


def random_tree(draw: random.Random, depth: int) -> Tree:
    if depth == 0 or draw.random() < 0.15:
        leaves = [Name("x"), Name("longer_name"), Number(2.0), Number(-0.5), Number(1e-05), Entry("q", 3)]
        return draw.choice(leaves)
    operation = draw.choice([*OPERATORS.values(), Operation.NEG, Operation.SIN])
    operands = 1 if operation in {Operation.NEG, Operation.SIN} else 2
    return Application(operation, tuple(random_tree(draw, depth - 1) for _ in range(operands)))


def read(node: Any) -> Tree:
    match node:
        case ast.BinOp(left, operator, right):
            return Application(OPERATORS[type(operator)], (read(left), read(right)))
        case ast.UnaryOp(ast.USub(), operand):
            return Application(Operation.NEG, (read(operand),))
        case ast.Call(_, [operand]):
            return Application(Operation.SIN, (read(operand),))
        case ast.Subscript(ast.Name(array), ast.Constant(index)):
            return Entry(array, index)
        case ast.Constant(value):
            return Number(value)
    return Name(node.id)


def by_sign(tree: Tree) -> tuple[int, Tree]:
    """Signs move within products without changing a bit: a sign, and the tree without them."""
    match tree:
        case Application(Operation.NEG, (operand,)):
            sign, rest = by_sign(operand)
            return -sign, rest
        case Number(value) if value < 0:
            return -1, Number(-value)
        case Application((Operation.MUL | Operation.DIV) as operation, operands):
            (a, left), (b, right) = map(by_sign, operands)
            return a * b, Application(operation, (left, right))
        case Application(operation, operands):
            return 1, (operation, *map(by_sign, operands))
    return 1, tree


@pytest.mark.parametrize("seed", [*range(60), *repeated(range(60, 200))])
def test_texts_read_back(seed: int) -> None:
    tree = random_tree(random.Random(seed), 6)
    text = expression_text(tree, PYTHON)
    assert by_sign(read(ast.parse(text, mode="eval").body)) == by_sign(tree)
    assert "--" not in text
    assert not any(f"{sign} -" in text or f"{sign}-" in text for sign in "+*/-")


@pytest.mark.parametrize("language", [PYTHON, FORTRAN])
@pytest.mark.parametrize("seed", [*range(30), *repeated(range(30, 100))])
def test_lines_hold_the_same_text(seed: int, language: Language) -> None:
    line = f"value = {expression_text(random_tree(random.Random(seed), 9), language)}"
    lines = wrap_line(line, language, "    ")
    assert max(map(len, lines)) <= language.width + 1
    joined = "".join(row.removesuffix(language.continuation).strip() for row in lines)
    assert joined.replace(" ", "") == line.replace(" ", "")
    for row in lines[:-1]:
        assert row.endswith(language.continuation)
        assert row.removesuffix(language.continuation)[-1] in "+-*/,"
