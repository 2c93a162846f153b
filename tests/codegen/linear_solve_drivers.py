"""Programs that solve the systems of a file with the texts that go into generated code.

A file holds doubles: for each system n, the matrix row by row, the right side, and at the end 0; what comes back holds
for each system x and then, for each equation, 1 if it follows from others and else 0.
"""

from __future__ import annotations

import subprocess
import sys
import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from symbody.codegen.runtime.linear_solve import kernel_text
from symbody.codegen.runtime.snippets import SNIPPETS

Solved = list[tuple[np.ndarray, tuple[int, ...]]]
"""For each system x, and the equations that follow from others."""


def solved_by(
    compiled: Sequence[str], systems: Sequence[tuple[np.ndarray, np.ndarray]], folder: Path
) -> Solved:
    """Run a program that reads systems and writes solutions."""
    parts = [part for a, b in systems for part in ([float(len(b))], np.ravel(a), b)]
    np.concatenate([*parts, [0.0]]).astype("<f8").tofile(folder / "systems")
    subprocess.run([*compiled, "systems", "solutions"], cwd=folder, check=True, timeout=120)
    numbers = np.fromfile(folder / "solutions", "<f8")
    ends = np.cumsum([2 * len(b) for _, b in systems])
    assert len(numbers) == ends[-1]
    return [_taken_apart(both) for both in np.split(numbers, ends[:-1])]


def _taken_apart(both: np.ndarray) -> tuple[np.ndarray, tuple[int, ...]]:
    x, marks = np.split(both, 2)
    return x, tuple(np.flatnonzero(marks).tolist())


_C = r"""
#include <stdio.h>
#include <stdlib.h>

int main(int count, char **names)
{
    FILE *in = fopen(names[count - 2], "rb"), *out = fopen(names[count - 1], "wb");
    double size, none = 0.0;
    while (in && out && fread(&size, 8, 1, in) == 1 && size > 0) {
        const int n = (int)size;
        double *work = malloc(8 * (2 * n * n + 5 * n + 1)), *x = malloc(8 * n);
        if (!work || fread(work, 8, n * n, in) + fread(x, 8, n, in) != (size_t)(n * n + n)) return 1;
        const int dependent = symbody_factor(n, work);
        symbody_solve(n, work, x);
        fwrite(x, 8, n, out);
        for (int i = 0; i < n; i++) fwrite(dependent > 0 ? work + 2 * n * n + 4 * n + i : &none, 8, 1, out);
        free(work);
        free(x);
    }
    return in && out && fclose(out) == 0 ? 0 : 1;
}
"""


def c(folder: Path) -> list[str]:
    (folder / "solve.c").write_text(kernel_text("linear_solve.c") + _C)
    flags = ["-std=c99", "-pedantic", "-O2", "-Wall", "-Wextra", "-Wno-sign-conversion", "-Werror"]
    subprocess.run(["cc", *flags, "solve.c", "-o", "solve_c", "-lm"], cwd=folder, check=True)
    return [str(folder / "solve_c")]


_FORTRAN_HEAD = """
module systems
    use, intrinsic :: iso_fortran_env, only: dp => real64
    implicit none
contains
"""

_FORTRAN = """
end module systems

program main
    use systems
    implicit none
    real(dp) :: size
    real(dp), allocatable :: work(:), x(:)
    integer :: n, input, output
    open (newunit=input, file="systems", access="stream", form="unformatted", status="old")
    open (newunit=output, file="solutions", access="stream", form="unformatted", status="replace")
    do
        read (input) size
        n = nint(size)
        if (n == 0) exit
        allocate (work(2*n*n + 5*n + 1), x(n))
        read (input) work(:n*n), x
        call symbody_factor(n, work)
        call symbody_solve(n, work, x)
        write (output) x
        if (work(2*n*n + 5*n + 1) < 0 .or. work(2*n*n + 5*n + 1) > n - 1) work = 0
        write (output) work(2*n*n + 4*n + 1:2*n*n + 5*n)
        deallocate (work, x)
    end do
end program main
"""


def fortran(folder: Path) -> list[str]:
    text = _FORTRAN_HEAD + textwrap.indent(kernel_text("linear_solve.f90"), "    ") + _FORTRAN
    (folder / "solve.f90").write_text(text)
    flags = ["-std=f2008", "-O2", "-Wall", "-Wextra", "-Wno-compare-reals", "-Werror", "-fcheck=all"]
    subprocess.run(["gfortran", *flags, "solve.f90", "-o", "solve_f"], cwd=folder, check=True)
    return [str(folder / "solve_f")]


_RUST = """
fn main() {
    let bytes = std::fs::read("systems").unwrap();
    let mut numbers = bytes.chunks(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap()));
    let mut solutions = Vec::new();
    loop {
        let n = numbers.next().unwrap() as usize;
        if n == 0 {
            break;
        }
        let mut work: Vec<f64> = numbers.by_ref().take(n * n).collect();
        work.resize(linear_solve::workspace(n), 0.0);
        let mut x: Vec<f64> = numbers.by_ref().take(n).collect();
        factor(n, &mut work);
        solve(n, &work, &mut x);
        let mut marks = vec![0.0; n];
        linear_solve::dependent(n, &work).for_each(|row| marks[row] = 1.0);
        solutions.extend(x.into_iter().chain(marks));
    }
    let bytes: Vec<u8> = solutions.into_iter().flat_map(f64::to_le_bytes).collect();
    std::fs::write("solutions", bytes).unwrap();
}
"""


def rust(folder: Path) -> list[str]:
    (folder / "solve.rs").write_text(kernel_text("linear_solve.rs") + _RUST)
    flags = ["--edition=2021", "-O", "-D", "warnings"]
    subprocess.run(["rustc", *flags, "solve.rs", "-o", "solve_rs"], cwd=folder, check=True)
    return [str(folder / "solve_rs")]


_OCTAVE = """1;
%s
input = fopen('systems', 'rb');
output = fopen('solutions', 'wb');
n = fread(input, 1, 'double');
while n > 0
    a = fread(input, [n, n], 'double').';
    b = fread(input, n, 'double');
    fwrite(output, [linear_solve(a, b); zeros(n, 1)], 'double');
    n = fread(input, 1, 'double');
end
"""


def octave(folder: Path) -> list[str]:
    (folder / "solve.m").write_text(_OCTAVE % SNIPPETS["matlab"])
    return ["octave-cli", "--quiet", "--norc", "solve.m"]


_PYTHON = """
import sys
import numpy as np
%s
numbers = np.fromfile("systems")
solutions = []
while n := int(numbers[0]):
    a, b, numbers = np.split(numbers[1:], [n * n, n * n + n])
    solutions += [linear_solve(a.reshape(n, n), list(b)), np.zeros(n)]
np.concatenate(solutions).tofile("solutions")
"""


def numpy(folder: Path) -> list[str]:
    (folder / "solve.py").write_text(_PYTHON % SNIPPETS["numpy"])
    return [sys.executable, "-W", "error", "solve.py"]


NEEDED = {"C": "cc", "Fortran": "gfortran", "Rust": "rustc", "Octave": "octave-cli"}
"""The programs that they need."""

COMPILED: dict[str, Callable[[Path], list[str]]] = {"C": c, "Fortran": fortran, "Rust": rust}
"""These have the whole algorithm, and name the equations that follow from others."""

LIBRARIES: dict[str, Callable[[Path], list[str]]] = {"Octave": octave, "NumPy": numpy}
"""These call their language's libraries."""
