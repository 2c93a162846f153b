"""Machine code in a process whose memory is full of holes: what is compiled late lies far from its constants."""

from __future__ import annotations

import subprocess
import sys

import pytest

SCRIPT = """
import mmap
import numpy as np
from symbody import cos, sin, symbols
from symbody.codegen import PreparedCode

x, kept = symbols("x"), []
NORESERVE = 0x4000
for k in range(60):
    code = PreparedCode((), (x,), (sin(k * x) + 0.3 * k * cos(x),))
    found = code.evaluate(np.array([]), np.array([0.3]))[0]
    assert abs(found - (np.sin(0.3 * k) + 0.3 * k * np.cos(0.3))) < 1e-12 * (k + 1)
    flags = mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | NORESERVE
    kept += [code, mmap.mmap(-1, 3 << 30, flags=flags)]
print("all were right")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="memory is mapped as Linux does")
def test_constants_are_reached_wherever_they_lie() -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=False)
    assert (done.stdout, done.returncode) == ("all were right\n", 0), done.stderr[-500:]
