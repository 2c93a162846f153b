"""Ctrl-C ends long calls of the compiled core at once, and the process can go on."""

from __future__ import annotations

import signal
import subprocess
import sys
from time import sleep

import pytest

BEGIN = """
import signal, sys
from symbody.symbolic import *
signal.signal(signal.SIGINT, {handler})
v = symbols("v1:1001")
{setup}
print("ready", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", flush=True)
x, y = symbols("x y")
assert expand((x + y) ** 2) == x**2 + 2 * x * y + y**2
print("sound", flush=True)
"""

LONG = {
    "product of matrices": (
        "A = Matrix.from_entries(400, 400, list(symbols('w1:90001')) + [v[0]] * 70000)",
        "A @ A",
    ),
    "jacobian": ("total = sum(v); rows = [sin(total + x) * x for x in v * 4]", "jacobian(rows, v)"),
    "rank": (
        "import random; n = 800; A = Matrix([[random.randint(-9, 9) for _ in range(n)] for _ in range(n)])",
        "A.rank()",
    ),
    "diff": ("e = sin(v[0] * v[1]) * exp(v[0]**2) / (1 + v[0]**4)", "diff(e, v[0], 200)"),
    "time_derivative": ("q = functions_of_time('q')", "sin(q).diff(t, 400)"),
    "within a derivation": (
        "from symbody.symbolic import derivation\nq = functions_of_time('q')\nd = derivation().__enter__()",
        "sin(q).diff(t, 400)",
    ),
}
"""Calls that take minutes: what they need, and the call."""

GENEROUS = 20
"""Seconds in which an interrupted process ends, on a busy machine; the calls answer within 0.02 s on a free one."""


def process(setup: str, call: str, handler: str = "signal.default_int_handler") -> subprocess.Popen[str]:
    """Return a process that has begun the call."""
    text = BEGIN.format(setup=setup, call=call, handler=handler)
    child = subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "ready\n"
    sleep(0.2)
    assert child.poll() is None
    return child


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for one process")
@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_ends_a_long_call(name: str) -> None:
    with process(*LONG[name]) as child:
        child.send_signal(signal.SIGINT)
        out, _ = child.communicate(timeout=GENEROUS)
    assert out.splitlines() == ["interrupted", "sound"]
    assert child.returncode == 0


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for one process")
def test_a_handler_may_use_expressions_and_go_on() -> None:
    """The call begins again if the handler raises nothing."""
    handler = "lambda *_: print(str(v[0] + v[1]), flush=True)"
    with process(*LONG["product of matrices"], handler) as child:
        assert child.stdout is not None
        child.send_signal(signal.SIGINT)
        assert child.stdout.readline() == "v1 + v2\n"
        sleep(0.5)
        assert child.poll() is None
        child.kill()


MEASURED = """
import os, subprocess, time
from symbody.symbolic import *
from symbody.symbolic import _core
v = symbols("v1:401")
{setup}
begin = time.perf_counter()
{call}
whole = time.perf_counter() - begin
subprocess.Popen(["sh", "-c", f"sleep {{0.1 * whole}}; kill -INT {{os.getpid()}}"])
begin = time.perf_counter()
try:
    {call}
except KeyboardInterrupt:
    print(whole, time.perf_counter() - begin, flush=True)
"""

PRODUCTS = "products = [a * b for i, a in enumerate(v) for b in v[i:]]"
SIGNS = """
def pair(products): return [_core.sum_of([f(p) for p in products]) for f in (abs, lambda u: Max(u, -u))]
pairs = [pair([p + k for p in products[:8000]]) for k in (1, 2)]
def difference():
    up, down = pairs.pop()
    return up - down
"""
TOWER = """
x, y, q = symbols("x y q")
for _ in range(3): q = sin(q * y + 2 * q * x)
def request():
    try: expand_trig(q)
    except errors.ExpressionError: pass
from symbody import errors
"""
ONCE = {
    "text": (f"{PRODUCTS}; total = _core.sum_of(products)", "str(total)"),
    "LaTeX": (f"{PRODUCTS}; total = _core.sum_of(products)", "total.latex()"),
    "difference of equal sums of moduli and maxima": (PRODUCTS + SIGNS, "difference()"),
    "angles within angles": (TOWER, "request()"),
    "sum of long rationals": ('A, B = [number(q) ** 200_000 for q in ("7/5", "11/3")]', "A + B"),
}
"""Calls that take a second or more: what they need, and the call."""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for one process")
@pytest.mark.parametrize("name", ONCE)
def test_ctrl_c_ends_a_call_before_its_end(name: str) -> None:
    """On a free machine the calls answer within 0.03 s."""
    setup, call = ONCE[name]
    text = MEASURED.format(setup=setup, call=call)
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    whole, interrupted = map(float, done.stdout.split())
    assert interrupted < 0.6 * whole
