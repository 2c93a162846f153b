"""The text of a kernel: the functions of a model, the integration loop, and the method, as CUDA C."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files

from symbody.codegen import PreparedCode
from symbody.codegen.languages.cuda import LANGUAGE, device_functions, device_prelude
from symbody.codegen.layout.arrange import module_of
from symbody.codegen.layout.module import Function, Module
from symbody.simulation.integrate.native import problem_of
from symbody.simulation.integrate.problem import Problem, tableau_of
from symbody.simulation.integrate.task import Task
from symbody.symbolic import Argument, Expr, Program, Result, Routine, t

from .method_text import method_constants, method_text

__all__ = ["Kernel", "kernel_of"]


@dataclass(frozen=True)
class Kernel:
    """A kernel that integrates the motions of a task.

    Attributes:
        text: its text.
        width: the length of a state.
        parameters: the symbols whose values it takes, a row for each motion.
        has_events: whether it writes events.
    """

    text: str
    width: int
    parameters: tuple[Expr, ...]
    has_events: bool


def kernel_of(task: Task) -> Kernel:
    """Return the kernel of a task."""
    problem = problem_of(task.model, is_projected=task.is_projected, events=task.events)
    module = module_of(_program(problem, task.model.code_variables[1:]), LANGUAGE, None, calls=False)
    constants = {
        **_constants(problem, task, module),
        **method_constants(tableau := tableau_of(task.options.method)),
    }
    parts = [
        "/* Many motions of one model, each in a thread; made by symbody. */",
        device_prelude(module),
        device_functions(module),
        "\n".join(_doors(module)),
        "\n".join(f"#define {name} {value}" for name, value in constants.items()),
        _kinds(problem),
        files(__package__).joinpath("integrator.cu").read_text(encoding="utf-8"),
        method_text(tableau),
    ]
    return Kernel(
        "\n\n".join(filter(None, parts)), problem.width, problem.parameters, problem.events is not None
    )


_MEANINGS = {
    "rates": "the rates of the state",
    "position_correction": "the change of the coordinates that leads onto the constraints",
    "velocity_correction": "the change of the speeds that leads onto the rates of the constraints",
    "energies": "the kinetic and the potential energy",
    "events": "the functions whose zeros are events",
}
"""The functions of a model that the loop calls, by name."""


def _codes(problem: Problem) -> dict[str, PreparedCode]:
    positions, velocities = problem.corrections or (None, None)
    events = None if problem.events is None else problem.events[0]
    given = (problem.rates, positions, velocities, problem.energies, events)
    return {name: code for name, code in zip(_MEANINGS, given, strict=True) if code is not None}


def _program(problem: Problem, state: tuple[Expr, ...]) -> Program:
    arguments = (
        Argument("p", "parameters", problem.parameters, "parameters"),
        Argument("t", "time", (t,), "time and inputs"),
        Argument("x", "state", state, "velocities"),
    )
    return Program("motion", "a model", arguments, tuple(_routines(problem)))


def _routines(problem: Problem) -> Iterator[Routine]:
    """Yield each function, and before it its shortcut, which also has the conditions under which it is accurate."""
    names = ("p", "t", "x")
    for name, code in _codes(problem).items():
        out = Result("out", "", code.expressions, (len(code.expressions),))
        if code.shortcut is not None:
            brief, conditions = code.shortcut.expressions, code.shortcut.conditions
            results = (
                Result("out", "", brief, (len(brief),)),
                Result("conditions", "", conditions, (len(conditions),)),
            )
            yield Routine(
                f"{name}_briefly", f"{_MEANINGS[name]}, where the conditions are positive", names, results
            )
        yield Routine(name, _MEANINGS[name], names, (out,))


def _doors(module: Module) -> Iterator[str]:
    """Yield functions with the same arguments for all models, by which the loop calls those of this one."""
    if module.prepare is None:
        yield "static __device__ void prepare_at(const double *p, double *c, int *deficient) {}"
    else:
        yield (
            "static __device__ void prepare_at(const double *p, double *c, int *deficient)\n"
            f"{{\n    {module.prepare.name}(p, c, deficient);\n}}"
        )
    brief: Function | None = None
    for function in module.routines:
        if function.name.endswith("_briefly"):
            brief = function
            continue
        yield _door(function, brief)
        brief = None


def _door(function: Function, brief: Function | None) -> str:
    title = (
        f"static __device__ void {function.name}_at(double t, const double *x, const double *c, double *out, "
        "int *deficient)"
    )
    lines = [title, "{"]
    if brief is not None:
        size = brief.results[1].size
        lines += [
            f"    double conditions[{size}];",
            "    int all = 1;",
            f"    {_called(brief, 'out, conditions')}",
            f"    for (int i = 0; i < {size}; ++i) all &= conditions[i] > 0.0;",
            "    if (all) return;",
        ]
    return "\n".join([*lines, f"    {_called(function, 'out')}", "}"])


def _called(function: Function, results: str) -> str:
    names = [a.name if a.name in ("t", "x") else "c" for a in function.arguments]
    return f"{function.name}({', '.join([*names, results, 'deficient'])});"


def _constants(problem: Problem, task: Task, module: Module) -> Mapping[str, object]:
    """Return the numbers by which the loop knows a model."""
    codes, model = _codes(problem), task.model
    sizes = {name: len(code.expressions) for name, code in codes.items()}
    return {
        "WIDTH": problem.width,
        "CONTROLLED": problem.controlled,
        "PARAMETERS": len(problem.parameters),
        "CONSTANTS": module.prepare.results[0].size if module.prepare else 0,
        "FIRST_ACCELERATION": len(model.coordinates),
        "ACCELERATIONS": len(model.accelerations),
        "COORDINATES": sizes.get("position_correction", 0),
        "SPEEDS": sizes.get("velocity_correction", 0),
        "ENERGIES": sizes.get("energies", 0),
        "EVENTS": sizes.get("events", 0),
    }


def _kinds(problem: Problem) -> str:
    """Return which zeros are events, and which of these end a motion."""
    if problem.events is None:
        return ""
    events = problem.events[1]
    directions = ", ".join(str(event.direction) for event in events)
    ends = ", ".join(str(int(event.terminal)) for event in events)
    return (
        f"static __device__ const int EVENT_DIRECTION[] = {{{directions}}};\n"
        f"static __device__ const int EVENT_IS_TERMINAL[] = {{{ends}}};"
    )
