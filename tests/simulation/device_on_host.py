"""Kernels for a graphics processor, compiled as C++ and run thread by thread on this processor."""

from __future__ import annotations

import ctypes
import hashlib
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

BEFORE = """
#include <cfloat>
#include <cmath>
#include <cstring>
using std::isfinite;
using std::isnan;
#define __global__
#define __device__
#define __noinline__ __attribute__((noinline))
#define __forceinline__ inline
struct Place { int x; };
static Place threadIdx, blockIdx, blockDim;
static unsigned long long atomicAdd(unsigned long long *at, unsigned long long n) { *at += n; return *at - n; }
static long long __double_as_longlong(double x) { long long bits; std::memcpy(&bits, &x, 8); return bits; }
"""

AFTER = """
extern "C" void place(int block, int thread, int size) { blockIdx.x = block; threadIdx.x = thread; blockDim.x = size; }
"""

FLAGS = ("-O0", "-shared", "-fPIC", "-ffp-contract=off", "-march=native", "-Wall", "-Wextra", "-Werror")
FLAGS = (*FLAGS, "-Wno-unknown-pragmas", "-Wno-unused-function", "-Wno-type-limits", "-Wno-unused-parameter")

BLOCK = 2


class Host:
    """This processor as a device."""

    def __init__(self, folder: Path, threads: int = 5) -> None:
        self.folder, self.threads = folder, threads
        self.texts: list[str] = []

    def load(self, text: str) -> Loaded:
        self.texts.append(text)
        source = self.folder / f"{hashlib.sha256(text.encode()).hexdigest()[:16]}.cpp"
        library = source.with_suffix(".so")
        if not library.exists():
            source.write_text(BEFORE + text + AFTER, encoding="utf-8")
            subprocess.run(["g++", *FLAGS, str(source), "-o", str(library)], check=True)
        return Loaded(ctypes.CDLL(str(library)), self.threads)

    def put(self, values: NDArray[Any]) -> NDArray[Any]:
        return np.array(values)

    def empty(self, shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
        return np.full(shape, 255 if kind is np.uint8 else np.nan, dtype=kind)

    def get(self, array: NDArray[Any]) -> NDArray[Any]:
        return array.copy()


class Loaded:
    """A text as a library of this processor."""

    def __init__(self, library: ctypes.CDLL, threads: int) -> None:
        self.library, self.count, self.block = library, threads, BLOCK

    def threads(self, _name: str) -> int:
        return -(-self.count // BLOCK) * BLOCK

    def launch(self, name: str, threads: int, *given: Any) -> None:
        for number in range(threads):
            self.library.place(number // BLOCK, number % BLOCK, BLOCK)
            getattr(self.library, name)(*map(_argument, given))


def _argument(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return ctypes.c_void_p(value.ctypes.data)
    return ctypes.c_double(value) if isinstance(value, np.float64) else ctypes.c_int64(int(value))
