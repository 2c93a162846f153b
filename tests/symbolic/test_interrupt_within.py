"""Ctrl-C ends a long call well before its end, measured in processor time."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.repeated import repeated

CALLS = {
    "evaluate": "total.evaluate({a: 0.5 for a in v})",
    "text": "str(total)",
    "LaTeX": "total.latex()",
    "gradient": "gradient(total, v)",
}
"""Calls that take half a second or more."""

TEXT = """
import os, signal
from symbody.symbolic import *
from symbody.symbolic import _core

def used(process):
    with open(f"/proc/{{process}}/schedstat") as file:
        return int(file.read().split()[0])

v = symbols("x1:251")
total = _core.sum_of([sin(a * b) for i, a in enumerate(v) for b in v[i:]])
me, begin = os.getpid(), used("self")
{call}
whole = used("self") - begin
signal.signal(signal.SIGINT, signal.default_int_handler)
begin = used("self")
child = os.fork()
if child == 0:
    while os.getppid() == me and used(me) - begin < whole / 4:
        pass
    os.kill(me, signal.SIGINT)
    os._exit(0)
try:
    {call}
except KeyboardInterrupt:
    print((used("self") - begin) / whole)
os.kill(child, signal.SIGKILL)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel tells the processor time of another process")
@pytest.mark.parametrize("name", ["evaluate", *repeated(name for name in CALLS if name != "evaluate")])
def test_ctrl_c_ends_a_call_before_its_end(name: str) -> None:
    text = TEXT.format(call=CALLS[name])
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert float(done.stdout) < 0.6
