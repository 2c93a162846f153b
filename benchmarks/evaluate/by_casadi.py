"""CasADi's C code of Pinocchio's algorithms, optimised by the compiler."""

from __future__ import annotations

import ctypes
from importlib.util import find_spec
from typing import Any

import numpy as np

from . import by_pinocchio
from .contender import Contender
from .native import compiled, loops, pointer, workplace
from .robot import Robot
from .states import States, Values


def missing() -> str:
    """Return what the machine lacks, or nothing."""
    if find_spec("casadi") is None:
        return "CasADi (pip: casadi)"
    return ""


def contender(robot: Robot, states: States, function: str) -> Contender:
    """Return the compiled C code of an algorithm."""
    import casadi  # noqa: PLC0415 - a rival

    from . import casadi_recursion as recursion  # noqa: PLC0415

    positions = len(by_pinocchio.configuration(robot, states)[0])
    q, v, a = (
        casadi.SX.sym(name, size) for name, size in (("q", positions), ("v", robot.size), ("a", robot.size))
    )
    if function == "inverse dynamics":
        arguments, result = [q, v, a], recursion.inverse_dynamics(robot, q, v, a)
    elif function == "mass matrix":
        arguments, result = [q], recursion.mass_matrix(robot, q)
    else:
        arguments, result = [q, v, a], recursion.forward_dynamics(robot, q, v, a)
    made = casadi.Function("f", arguments, [casadi.densify(result)])
    rows = _rows(robot, states, function)
    return _timed(made, rows, _operations(made), f"{robot.name} {function}".replace(" ", "_"))


def _rows(robot: Robot, states: States, function: str) -> Values:
    last = states.force if function == "forward dynamics" else states.acceleration
    parts = (by_pinocchio.configuration(robot, states), states.speed, last)
    return np.ascontiguousarray(np.hstack(parts[:1] if function == "mass matrix" else parts))


def _operations(made: Any) -> int:
    """Count additions, multiplications, divisions and functions; a square is a multiplication."""
    import casadi  # noqa: PLC0415

    free = {casadi.OP_INPUT, casadi.OP_OUTPUT, casadi.OP_CONST, casadi.OP_ASSIGN}
    return sum(made.instruction_id(k) not in free for k in range(made.n_instructions()))


def _timed(made: Any, rows: Values, operations: int, name: str) -> Contender:
    import casadi  # noqa: PLC0415

    file = workplace() / f"casadi_{name}.c"
    generator = casadi.CodeGenerator(file.name)
    generator.add(made)
    generator.generate(f"{workplace()}/")
    library = compiled(file, "-lm")
    address = ctypes.cast(library.f, ctypes.c_void_p)
    sizes = np.array([made.size1_in(k) for k in range(made.n_in())], dtype=np.int32)
    out = np.empty((len(rows), made.size1_out(0)))
    work = (
        (ctypes.c_void_p * max(made.sz_arg(), 1))(), (ctypes.c_void_p * max(made.sz_res(), 1))(),
        (ctypes.c_longlong * max(made.sz_iw(), 1))(), (ctypes.c_double * max(made.sz_w(), 1))(),
    )  # fmt: skip

    def time(repetitions: int) -> float:
        run = loops().loop_casadi
        arrays = (pointer(rows), pointer(sizes), len(sizes), pointer(out), out.shape[1], len(rows))
        return float(run(address, *arrays, repetitions, *work))

    return Contender("CasADi, generated C", time, lambda: out, operations)
