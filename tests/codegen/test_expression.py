"""Printed expressions keep every operation and its order: Python, which binds as the other languages do, reads them."""

from __future__ import annotations

import ast
import random
from typing import Any

import pytest

from symbody.codegen.layout.expression import Tree, entry, expression_text, name, number, wrapped
from symbody.codegen.layout.language import Language
from symbody.codegen.target.fortran import LANGUAGE as FORTRAN
from symbody.codegen.target.python import LANGUAGE as PYTHON

OPERATORS: dict[type[ast.AST], str] = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "div"}


def random_tree(draw: random.Random, depth: int) -> Tree:
    if depth == 0 or draw.random() < 0.15:
        leaves = [name("x"), name("longer_name"), number(2.0), number(-0.5), number(1e-05), entry("q", 3)]
        return draw.choice(leaves)
    operation = draw.choice(["add", "sub", "mul", "div", "neg", "sin"])
    operands = 1 if operation in {"neg", "sin"} else 2
    return (operation, *(random_tree(draw, depth - 1) for _ in range(operands)))


def read(node: Any) -> Tree:
    match node:
        case ast.BinOp(left, operator, right):
            return (OPERATORS[type(operator)], read(left), read(right))
        case ast.UnaryOp(ast.USub(), operand):
            return ("neg", read(operand))
        case ast.Call(_, [operand]):
            return ("sin", read(operand))
        case ast.Subscript(ast.Name(array), ast.Constant(index)):
            return entry(array, index)
        case ast.Constant(value):
            return number(value)
    return name(node.id)


def by_sign(tree: Tree) -> tuple[int, Tree]:
    """Signs move within products without changing a bit: a sign, and the tree without them."""
    if tree[0] == "neg":
        sign, rest = by_sign(tree[1])
        return -sign, rest
    if tree[0] == "number" and tree[1] < 0:
        return -1, number(-tree[1])
    if tree[0] in {"mul", "div"}:
        (a, left), (b, right) = by_sign(tree[1]), by_sign(tree[2])
        return a * b, (tree[0], left, right)
    if tree[0] in {"add", "sub", "sin"}:
        return 1, (tree[0], *map(by_sign, tree[1:]))
    return 1, tree


@pytest.mark.parametrize("seed", range(200))
def test_texts_read_back(seed: int) -> None:
    tree = random_tree(random.Random(seed), 6)
    text = expression_text(tree, PYTHON)
    assert by_sign(read(ast.parse(text, mode="eval").body)) == by_sign(tree)
    assert "--" not in text
    assert not any(f"{sign} -" in text or f"{sign}-" in text for sign in "+*/-")


@pytest.mark.parametrize("language", [PYTHON, FORTRAN])
@pytest.mark.parametrize("seed", range(100))
def test_lines_hold_the_same_text(seed: int, language: Language) -> None:
    line = f"value = {expression_text(random_tree(random.Random(seed), 9), language)}"
    lines = wrapped(line, language, "    ")
    assert max(map(len, lines)) <= language.width + 1
    joined = "".join(row.removesuffix(language.continuation).strip() for row in lines)
    assert joined.replace(" ", "") == line.replace(" ", "")
    for row in lines[:-1]:
        assert row.endswith(language.continuation)
        assert row.removesuffix(language.continuation)[-1] in "+-*/,"
