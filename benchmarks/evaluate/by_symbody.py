"""symbody's equations: machine code in the process, for one state and for many, and generated C."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, replace
from functools import cached_property
from time import perf_counter

import numpy as np

from symbody import Equations, Expr, MachineCode, cost, forward_dynamics, generate, newton_euler
from symbody.symbolic import Argument, Program, Result, Routine

from .contender import Contender
from .native import compiled, loops, pointer, workplace
from .robot import Robot, forces, system
from .states import States, Values

_ALIVE: list[object] = []
"""Machine code and arrays of which the loops know but the address."""


@dataclass(frozen=True, eq=False)
class Model:
    """A robot derived by symbody."""

    robot: Robot
    states: States

    @cached_property
    def equations(self) -> Equations:
        """Its equations of motion."""
        return newton_euler(system(self.robot))

    def outputs(self, function: str) -> tuple[Expr, ...]:
        """Return what a function computes; of the mass matrix the upper triangle."""
        if function == "mass matrix":
            n = self.robot.size
            return tuple(self.equations.mass_matrix[i, j] for i in range(n) for j in range(i, n))
        if function == "inverse dynamics":
            return self.equations.residuals
        return forward_dynamics(newton_euler(system(self.robot, driven=True))).accelerations

    def arguments(self, function: str) -> tuple[Argument, ...]:
        """Return what a function takes."""
        e = self.equations
        q = Argument("q", "positions", e.coordinates, "positions")
        u = Argument("u", "speeds", e.speeds, "velocities")
        a = Argument("a", "accelerations", e.accelerations, "accelerations")
        f = Argument("f", "forces", forces(self.robot), "time and inputs")
        return {"mass matrix": (q,), "inverse dynamics": (q, u, a), "forward dynamics": (q, u, f)}[function]

    def rows(self, function: str) -> Values:
        """Return the states, a row of inputs for each."""
        s = self.states
        last = s.force if function == "forward dynamics" else s.acceleration
        return np.ascontiguousarray(np.hstack((s.position, s.speed, last)[: len(self.arguments(function))]))


def contenders(model: Model, function: str) -> list[Contender]:
    """Return machine code and generated C of a function."""
    return [_machine_code(model, function), _generated_c(model, function)]


def _machine_code(model: Model, function: str) -> Contender:
    expressions, rows = model.outputs(function), model.rows(function)
    variables = tuple(v for argument in model.arguments(function) for v in argument.variables)
    code = MachineCode(variables, expressions)
    contender = _rows("symbody, machine code", code.address, rows, len(expressions))
    _ALIVE.append(code)
    return replace(contender, operations=cost(expressions).total)


def batch(model: Model, function: str) -> Contender:
    """Return the machine code of many states at a time, in a loop outside Python."""
    code, columns, out = _columns(model, function)
    points = out.shape[1]
    address = ctypes.c_void_p(code.batch_address([False] * len(columns)))
    pointers = (ctypes.c_void_p * len(columns))(*(c.ctypes.data for c in columns))

    def time(repetitions: int) -> float:
        return float(loops().loop_columns(address, pointers, pointer(out), points, repetitions))

    return Contender("symbody, vectors of states", time, lambda: out.T, cost(code.expressions).total)


def threaded(model: Model, function: str, threads: int) -> Contender:
    """Return the machine code of many states on some threads, by the clock on the wall: they work at the same time."""
    code, columns, out = _columns(model, function)
    points = out.shape[1]

    def time(repetitions: int) -> float:
        start = perf_counter()
        for _ in range(repetitions):
            code.evaluate_columns(columns, points, out, threads)
        return (perf_counter() - start) * 1e9 / (points * repetitions)

    label = f"symbody, vectors of states, {threads} thread{'s' if threads > 1 else ''}"
    return Contender(label, time, lambda: out.T, cost(code.expressions).total)


def _columns(model: Model, function: str) -> tuple[MachineCode, list[Values], Values]:
    """Return the code of a function, a column for each input, and room for the results."""
    expressions = model.outputs(function)
    code = MachineCode(tuple(v for a in model.arguments(function) for v in a.variables), tuple(expressions))
    columns = [np.ascontiguousarray(column) for column in model.rows(function).T]
    _ALIVE.extend((code, *columns))
    return code, columns, np.empty((len(expressions), len(columns[0])))


def _generated_c(model: Model, function: str) -> Contender:
    expressions, rows = model.outputs(function), model.rows(function)
    arguments = model.arguments(function)
    name = function.replace(" ", "_")
    result = Result("out", "", tuple(expressions), (len(expressions),))
    routine = Routine(name, function, tuple(a.name for a in arguments), (result,))
    folder = workplace() / f"{model.robot.name}-{name}".replace(" ", "_")
    generate(Program("model", model.robot.name, arguments, (routine,)), "c", folder)
    offsets = np.cumsum([0, *(len(a.variables) for a in arguments)])
    call = ", ".join(f"in + {offset}" for offset in offsets[:-1])
    wrapper = folder / f"call_{folder.name}.c"
    wrapper.write_text(
        f'#include "model.c"\nvoid call(const double *in, double *out) {{ model_{name}({call}, out); }}\n',
        encoding="utf-8",
    )
    library = compiled(wrapper, "-lm")
    address = ctypes.cast(library.call, ctypes.c_void_p).value
    assert address is not None
    return _rows("symbody, generated C", address, rows, len(expressions))


def _rows(label: str, address: int, rows: Values, outputs: int) -> Contender:
    out = np.empty((len(rows), outputs))

    def time(repetitions: int) -> float:
        arguments = (pointer(rows), rows.shape[1], pointer(out), outputs, len(rows), repetitions)
        return float(loops().loop_rows(ctypes.c_void_p(address), *arguments))

    return Contender(label, time, lambda: out)
