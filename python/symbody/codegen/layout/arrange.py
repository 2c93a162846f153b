"""From a program to a module: choose identifiers, divide the work, compose statements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite

from symbody.codegen.layout.compose import Composition, compose
from symbody.codegen.layout.formula import formulas
from symbody.codegen.layout.language import Language
from symbody.codegen.layout.module import Array, Function, Module
from symbody.codegen.layout.names import Scope, program_identifier
from symbody.codegen.runtime.linear_solve import factor_size
from symbody.codegen.straight_line.call import Call, call_in
from symbody.codegen.straight_line.code import Code, Input, code_of
from symbody.codegen.straight_line.count import counts_by_stage
from symbody.codegen.straight_line.preparation import Preparation
from symbody.codegen.straight_line.sample import Sample, sample_of
from symbody.errors import ProgramError
from symbody.symbolic import Argument, Program, Routine, t
from symbody.symbolic.given.identifier import identifier

__all__ = ["module_name", "module_of"]


def module_of(
    program: Program,
    language: Language,
    limit: int | None = 1000,
    sample: Sample | None = None,
    *,
    calls: bool = True,
) -> Module:
    """Return the program as statements.

    Args:
        program: the program.
        language: the language.
        limit: the largest number of operations of a function; longer ones are divided.
        sample: what the self-check compares with; by default the evaluator's values at some state.
        calls: whether a routine calls an earlier one that has its results, by value: not if it must compute them in
            its own way.
    """
    return _Arrangement(program, language, limit, calls=calls).module(sample or sample_of(program))


def module_name(name: str, language: Language) -> str:
    """Return the identifier of a program of this name, after which its files are named."""
    reserved = language.reserved if language.reserved_programs is None else language.reserved_programs
    return program_identifier(name, Scope(reserved, language.case_sensitive))


_IN_PLACE = (
    "(the other routines take these instead of the parameters: first the parameters that they read as they are, "
    "then what follows from parameters alone)"
)


class _Arrangement:
    """Names are claimed in one order: program, routines, arguments, then results and locals of each routine."""

    def __init__(self, program: Program, language: Language, limit: int | None, *, calls: bool) -> None:
        self.program, self.language, self.limit, self.may_call = program, language, limit, calls
        self.name = module_name(program.name, language)
        self.scope = Scope(language.reserved, language.case_sensitive).inner([self.name])
        self.routines = {routine.name: self.scope.claim(routine.name) for routine in program.routines}
        self.arrays = {argument.name: self._argument(argument) for argument in program.arguments}
        self.constants: list[tuple[str, str]] = []
        self.order: dict[int, int] = {}
        self.constants_name = ""
        self.calls: dict[str, Call] = {}
        self.made: dict[str, Function] = {}

    def module(self, sample: Sample) -> Module:
        program = self.program
        codes = self._codes()
        constants, prepare, codes = self._prepared(codes) or (None, None, codes)
        for routine, code in zip(program.routines, codes, strict=True):
            self.made[routine.name] = self._routine(routine, code, self._arguments(routine, constants))
        routines = tuple(self.made.values())
        arguments = tuple(self.arrays.values())
        if prepare and constants:
            arguments = (*prepare.arguments, constants, *(a for a in arguments if a not in prepare.arguments))
        values = {
            self.arrays[a.name].name: v for a, v in zip(program.arguments, sample.arguments, strict=True)
        }
        return Module(self.name, program.meaning, arguments, prepare, routines, values, sample.results)

    def _argument(self, argument: Argument) -> Array:
        names = tuple(map(str, argument.variables))
        shape = () if argument.variables == (t,) else (len(names),)
        meaning = argument.meaning.removesuffix(f": {', '.join(names)}")
        return Array(self.scope.claim(argument.name), meaning, names, shape)

    def _codes(self) -> list[Code]:
        """Return the code of each routine; if it calls another one, only what remains to be computed."""
        codes = list(map(self._code, self.program.routines))
        left = list(codes)
        for number, routine in enumerate(self.program.routines):
            call = call_in(self.program, number, codes) if self.may_call else None
            if call:
                self.calls[routine.name], left[number] = call, call.rest
        return left

    def _code(self, routine: Routine) -> Code:
        code = code_of(self.program.arguments_of(routine), routine.expressions)
        if not all(map(isfinite, code.constants)):
            raise ProgramError(
                f"the routine {routine.name} contains a number beyond the range of doubles; choose other units"
            )
        return code

    def _arguments(self, routine: Routine, constants: Array | None) -> tuple[Array, ...]:
        """Return the arguments of a routine, with the constants of the model instead of the parameters."""
        taken: dict[str, Array] = {}
        for argument in self.program.arguments_of(routine):
            is_replaced = constants is not None and argument.stage == "parameters"
            array = constants if constants and is_replaced else self.arrays[argument.name]
            taken[array.name] = array
        return tuple(taken.values())

    def _prepared(self, codes: Sequence[Code]) -> tuple[Array, Function, list[Code]] | None:
        """Return the constants of the model, the function that computes them, and what remains of the routines."""
        parameters = tuple(a for a in self.program.arguments if a.stage == "parameters")
        preparation = Preparation(parameters)
        left = [preparation.without_parameters(code) for code in codes]
        code = preparation.code()
        if not code.results:
            return None
        prepare = self.scope.claim("prepare")
        self.constants_name = self.scope.claim("c")
        texts = formulas(code, self.language)
        direct = [self._parameter(code, place) for place in code.results]
        self.order = {k: position for position, k in enumerate(preparation.order)}
        self.constants = list(zip(direct, texts, strict=True))
        entries = tuple(d or text or "see prepare" for d, text in zip(direct, texts, strict=True))
        meaning = f"constants of the model, which {prepare} computes from the parameters\n{_IN_PLACE}"
        constants = Array(self.constants_name, meaning, entries, (len(entries),))
        result = replace(constants, entries=(), meaning="constants of the model")
        arguments = tuple(self.arrays[parameter.name] for parameter in parameters)
        function = self._function(
            prepare, "compute what the other routines need of the parameters", arguments, (result,), code
        )
        return constants, function, left

    def _parameter(self, code: Code, place: int) -> str:
        number = place - code.first_input
        return code.inputs[number].name if 0 <= number < len(code.inputs) else ""

    def _routine(self, routine: Routine, code: Code, arguments: tuple[Array, ...]) -> Function:
        name, call = self.routines[routine.name], self.calls.get(routine.name)
        functions = [name, self.name, *([self.routines[call.routine.name]] if call else [])]
        scope = Scope(self.language.reserved, self.language.case_sensitive)
        scope = scope.inner(
            [*(array.name for array in arguments), *([] if self.language.qualified else functions)]
        )
        results = tuple(
            Array(scope.claim(r.name, f"{r.name}_out"), r.meaning, (), r.shape) for r in routine.results
        )
        if not call:
            return self._function(name, routine.meaning, arguments, results, code)
        called = self._called(call.routine, scope)
        return self._function(
            name, routine.meaning, arguments, results, _received(code, call.routine, called), (called,)
        )

    def _called(self, routine: Routine, scope: Scope) -> Function:
        """Return a routine as another one calls it: its results have names that are free there."""
        made = self.made[routine.name]
        names = (scope.claim(result.name, f"{result.name}_out") for result in routine.results)
        return replace(
            made,
            results=tuple(
                replace(result, name=name) for result, name in zip(made.results, names, strict=True)
            ),
        )

    def _function(
        self,
        name: str,
        meaning: str,
        arguments: tuple[Array, ...],
        results: tuple[Array, ...],
        code: Code,
        calls: tuple[Function, ...] = (),
    ) -> Function:
        """Return one function of the generated module.

        Args:
            name: its name in the code.
            meaning: what it computes, for the reader of the code.
            arguments: its input arrays.
            results: its output arrays.
            code: the straight-line code that computes them.
            calls: functions that it calls first, and whose results the code reads.
        """
        received = [result for call in calls for result in call.results]
        scope = self.scope.inner(array.name for array in (*arguments, *results, *received))
        inputs = tuple(self._input(read) for read in code.inputs)
        composition = compose(
            replace(code, inputs=tuple(read for read, _ in inputs)),
            scope,
            [note for _, note in inputs],
            [(result.name, index) for result in results for index in range(result.size)],
            scalars=frozenset(array.name for array in arguments if array.is_scalar),
            limit=self.limit,
            fuses=bool(self.language.fused),
        )
        operations = frozenset(row.operation for row in code.instructions)
        working = self._working(composition)
        return Function(
            name, meaning, arguments, results, composition, counts_by_stage(code), operations, working, calls
        )

    def _working(self, made: Composition) -> tuple[tuple[str, int], ...]:
        """Return the working arrays; matrices are larger where their factorisation takes their place."""
        matrices = tuple(
            (name, factor_size(n) if self.language.factor else n * n) for name, n in made.matrices
        )
        return tuple((name, size) for name, size in (*matrices, *made.solutions, made.workspace) if size)

    def _input(self, read: Input) -> tuple[Input, str]:
        """Return an input with its array's identifier, and a note where its name doesn't say what it is."""
        if not read.array:
            index = self.order[read.index]
            name, formula = self.constants[index]
            name, note = (name, "") if name else (f"k{index + self.language.first_index}", formula)
            return Input(self.constants_name, index, name), note
        if not read.name:
            return read, ""
        plain = read.name.rstrip("'")
        note = "" if identifier(plain) == plain else read.name
        return replace(read, array=self.arrays[read.array].name), note


def _received(code: Code, routine: Routine, called: Function) -> Code:
    """Return the code with the names that the results of a call have in this routine."""
    names = {
        f"{routine.name}.{result.name}": array.name
        for result, array in zip(routine.results, called.results, strict=True)
    }
    inputs = tuple(replace(read, array=names.get(read.array, read.array)) for read in code.inputs)
    return replace(code, inputs=inputs)
