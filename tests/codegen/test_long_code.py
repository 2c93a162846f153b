"""Code that is long: compiled in functions and modules of bounded size, between which Ctrl-C interrupts."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable

import numpy as np
import pytest

from symbody import (
    Body,
    Expr,
    MachineCode,
    Point,
    System,
    Vector,
    atan2,
    cos,
    exp,
    functions_of_time,
    ground,
    lagrange_equations,
    lambdify,
    linear_solve,
    rotate,
    simulate,
    sin,
    symbols,
    tan,
)
from symbody.codegen.llvm import jit
from symbody.codegen.llvm.angles import MOST_RUNS
from symbody.codegen.llvm.assembly import MOST_LINES
from symbody.codegen.llvm.llvm_module import batch_modules, scalar_modules
from symbody.codegen.straight_line.code import Input, code_of_tape
from symbody.symbolic.numeric.tape import Tape
from tests.repeated import repeated

x, y = symbols("x y")


def chain(links: int, function: Callable[[Expr], Expr] = sin) -> list[Expr]:
    """Functions of one another, each link of them."""
    found = [x]
    for _ in range(links):
        found.append(function(found[-1]) + y)
    return found[1:]


def texts(expressions: list[Expr], *, is_batch: bool) -> tuple[str, ...]:
    """The modules of some expressions."""
    tape = Tape([x, y], expressions, [1, 1] if is_batch else [0, 0])
    code = code_of_tape(tape, [Input("in", 0, "x"), Input("in", 1, "y")])
    assembly = batch_modules(code, "f", 4, [False, False]) if is_batch else scalar_modules(code, "f", 4)
    return (*(part.text for part in assembly.parts), assembly.entry)


def functions(modules: tuple[str, ...]) -> list[str]:
    return [text for module in modules for text in re.split(r"^define ", module, flags=re.M)[1:]]


LONG = {
    "sines": lambda n: chain(n)[-1:],
    "exponentials": lambda n: chain(n, lambda e: exp(-e * e))[-1:],
    "tangents": lambda n: chain(n, tan)[-1:],
    "angles": lambda n: chain(n, lambda e: atan2(e, 3))[-1:],
    "sines of sines and cosines": lambda n: chain(n, lambda e: sin(e) * cos(e - x))[-1:],
    "sines side by side": lambda n: [sin(k * x) * cos(k * y) for k in range(1, n)],
}


@pytest.mark.parametrize("is_batch", [False, True])
@pytest.mark.parametrize("name", LONG)
def test_the_size_of_code_grows_as_its_length_and_that_of_its_functions_does_not(name: str, is_batch: bool):
    n = 400 if name == "sines side by side" else 200  # several functions in all cases
    few, many = (texts(LONG[name](links), is_batch=is_batch) for links in (n, 4 * n))
    lengths = [sum(text.count("\n") for text in modules) for modules in (few, many)]
    assert lengths[1] < 5 * lengths[0]
    assert max(text.count("br i1") for text in functions(many)) <= MOST_RUNS
    assert max(text.count("\n") for text in many) < 1.3 * MOST_LINES
    assert len(many) > len(few) or len(many) == 1


def test_a_call_and_a_part_of_the_code_have_equal_digits():
    values = np.linspace(-5.0, 5.0, 37)
    brief, long = (lambdify([x, y], chain(n), compile=True) for n in (MOST_RUNS, 3 * MOST_RUNS))
    assert np.array_equal(long(values, 0.3)[:MOST_RUNS], brief(values, 0.3))
    assert np.array_equal(long(0.7, 0.3)[:MOST_RUNS], brief(0.7, 0.3))


def test_large_angles_in_long_chains():
    values = np.array([0.3, 1e6, -3e7, np.inf, np.nan, 2.0, 1e300, -1e-300, 5.0])
    expected = [values]
    with np.errstate(invalid="ignore"):
        for _ in range(40):
            expected.append(np.sin(expected[-1]) + values)
        compiled = lambdify([x, y], chain(40), compile=True)
        np.testing.assert_allclose(compiled(values, values), expected[1:], rtol=1e-9, atol=1e-12)
        one = [compiled(value, value) for value in values]
    np.testing.assert_allclose(np.transpose(one), expected[1:], rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("links", [1500, *repeated([10_000])])
def test_a_long_chain_has_the_values_of_a_loop(links: int):
    values = np.linspace(0.0, 3.0, 9)
    expected = values
    for _ in range(links):
        expected = np.sin(expected) + 0.3
    compiled = lambdify([x, y], chain(links)[-1], compile=True)
    np.testing.assert_allclose(compiled(values, 0.3), expected, rtol=1e-9)
    assert compiled(values[2], 0.3) == pytest.approx(expected[2], rel=1e-9)


@pytest.mark.parametrize("function", [exp, tan, sin])
def test_functions_of_vectors_are_those_of_the_system(function: Callable[[Expr], Expr]):
    values = np.linspace(-1.0, 1.0, 11)
    code = lambdify([x, y], [function(x * y), atan2(x, y), (x * x + 1) ** y], compile=True)
    one = np.transpose([code(value, 0.5) for value in values])
    assert np.array_equal(code(values, 0.5), one)


INTERRUPTED = """
import os, signal, threading
from symbody import MachineCode, sin, symbols
from symbody.codegen.llvm import jit

x, y = symbols("x y")
e = x
for _ in range(10_000):
    e = sin(e) + y

begun, has_begun, compiled = [], threading.Event(), jit._object

def counted(text):
    begun.append(text)
    has_begun.set()
    return compiled(text)

def press():
    has_begun.wait()
    os.kill(os.getpid(), signal.SIGINT)

signal.signal(signal.SIGINT, signal.default_int_handler)
jit._object = counted
threading.Thread(target=press).start()
try:
    MachineCode((x, y), (e,)).address
except KeyboardInterrupt:
    print("interrupted")
print(len(begun))
"""


def test_ctrl_c_comes_through_between_two_modules():
    command, environment = [sys.executable, "-c", INTERRUPTED], os.environ | {"SYMBODY_CACHE": "off"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    word, begun = done.stdout.split()
    assert word == "interrupted"
    assert int(begun) < len(texts(chain(10_000)[-1:], is_batch=False)) - 1


def test_ctrl_c_while_a_simulation_compiles_is_an_interrupt(monkeypatch: pytest.MonkeyPatch):
    q, (m, g, length) = functions_of_time("q_long"), symbols("m g length")
    bob = Body(Point(rotate("Z", q), 0, -length, 0), m)
    equations = lagrange_equations(System([bob], coordinates=[q], gravity=Vector(ground, 0, -g, 0)))
    compiled, begun = jit._object, []

    def pressed(text: str) -> bytes:
        begun.append(text)
        os.kill(os.getpid(), signal.SIGINT)
        return compiled(text)

    values = {m: 1.0, g: 9.81, length: 0.5}
    jit._short_object.cache_clear()
    with monkeypatch.context() as patch:
        patch.setattr(jit, "_object", pressed)
        patch.setenv("SYMBODY_CACHE", "off")
        with pytest.raises(KeyboardInterrupt):
            simulate(equations, values, {q: 0.3}, t=(0, 1))
    assert len(begun) == 1
    assert simulate(equations, values, {q: 0.3}, t=(0, 1)).completed


def test_code_in_several_modules_runs_from_any_thread():
    code = MachineCode((x, y), tuple(chain(3000)[-1:]))
    columns, out = [np.linspace(0.0, 1.0, 100_000), np.array([0.2])], np.empty((1, 100_000))
    code.evaluate_columns(columns, 100_000, out, threads=4)
    again = np.empty((1, 100_000))
    code.evaluate_columns(columns, 100_000, again)
    assert np.array_equal(out, again)


def test_zeros_of_large_matrices_are_set_at_once():
    """A band of three in 30 equations: 88 entries are stored, and no zero is."""
    band = {-1: y, 0: 4 + x, 1: x * y}
    matrix = [[band.get(j - i, 0) for j in range(30)] for i in range(30)]
    solution = list(linear_solve(matrix, [1 + k * x for k in range(30)]))
    for is_batch in (False, True):
        assert not re.search(r"store double 0x0000000000000000,", "".join(texts(solution, is_batch=is_batch)))
    values = np.linspace(0.1, 1.0, 9)
    found = lambdify([x, y], solution, compile=True)(values, 0.5)
    for value, column in zip(values, found.T, strict=True):
        numbers = np.diag(np.full(30, 4 + value)) + np.diag([0.5] * 29, -1) + np.diag([value * 0.5] * 29, 1)
        np.testing.assert_allclose(column, np.linalg.solve(numbers, 1 + value * np.arange(30)), rtol=1e-12)
