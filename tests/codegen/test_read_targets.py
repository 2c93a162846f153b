"""Julia and Modelica without their tools: read by parsers that aren't ours, and Modelica evaluated."""

from __future__ import annotations

import pytest
import tree_sitter_julia
from tree_sitter import Language, Parser

from symbody.codegen.layout.arrange import module_of
from symbody.codegen.sources.generate import TARGETS
from tests.codegen.modelica_reader import Package
from tests.codegen.programs import PROGRAMS, REFERENCES, at_reference_state, texts
from tests.repeated import repeated

JULIA = Parser(Language(tree_sitter_julia.language()))

READ_BELOW = ("panda_7dof", "solo12_floating")
"""The programs whose Modelica is compared with values of other programs: reading them takes longest."""


@pytest.mark.parametrize(
    "program", [*(each for each in PROGRAMS if each != "solo12_floating"), *repeated(["solo12_floating"])]
)
def test_julia_is_julia(program: str) -> None:
    for text in texts(program, "julia").values():
        assert not JULIA.parse(text.encode()).root_node.has_error
        assert JULIA.parse("".join(text.rsplit(")", 1)).encode()).root_node.has_error


@pytest.mark.parametrize(
    "program", [*(each for each in PROGRAMS if each not in READ_BELOW), *repeated(READ_BELOW)]
)
def test_modelica_gives_the_values_of_the_evaluator(program: str) -> None:
    text = next(iter(texts(program, "modelica").values()))
    assert Package(text).call("self_check")


@pytest.mark.parametrize("robot", REFERENCES)
def test_modelica_gives_the_values_of_other_programs(robot: str) -> None:
    target = TARGETS["modelica"]
    program, sample = at_reference_state(robot)
    text = next(iter(target.files(module_of(program, target.language, target.limit, sample)).values()))
    assert Package(text).call("self_check")


def test_a_mistake_in_modelica_is_found() -> None:
    text = next(iter(texts("double_pendulum", "modelica").values()))
    assert not Package(text.replace("cos(", "sin(")).call("self_check")
