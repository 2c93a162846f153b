"""Straight-line code in LLVM's intermediate representation: for one state, or for several at a time in vectors."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import groupby

from symbody.codegen.angles_first import angles_first
from symbody.codegen.block import Cut, cut
from symbody.codegen.sincos import sincos_text
from symbody.codegen.vector import constant, vector_type
from symbody.symbolic.tape import Tape, kernel_workspace

__all__ = ["BLOCK", "Code", "batch_text", "code_of", "scalar_text"]

BLOCK = 1000
"""Instructions of a function: compilers take a time that grows faster than the length."""

Row = tuple[str, tuple[int, ...]]


@dataclass(frozen=True)
class Code:
    """A tape as plain data, read once.

    Attributes:
        constants: the first places.
        inputs: the number of inputs, which are the next places.
        rows: the instructions, whose results are the places after them.
        reads: the places that each instruction reads.
        stages: the stage of each instruction.
        matrices: sizes and entries of the matrices that are factorised.
        systems: number of the matrix and right side of each linear system.
        results: the place of each output.
        tag: what tells the linear systems of this code from those of others.
    """

    constants: tuple[float, ...]
    inputs: int
    rows: tuple[Row, ...]
    reads: tuple[tuple[int, ...], ...]
    stages: tuple[int, ...]
    matrices: tuple[tuple[int, tuple[int, ...]], ...]
    systems: tuple[tuple[int, tuple[int, ...]], ...]
    results: tuple[int, ...]
    tag: int = 0

    @property
    def first(self) -> int:
        """The place of the first instruction's result."""
        return len(self.constants) + self.inputs


def code_of(tape: Tape, tag: int = 0) -> Code:
    """Return a tape as plain data."""
    rows = [(row[0], row[1:]) for row in tape.instructions]
    first = len(tape.constants) + tape.inputs
    matrices = tuple((n, tuple(entries)) for n, entries in tape.factorizations)
    systems = tuple((rows[factor - first][1][0], tuple(right)) for factor, right in tape.solves)
    solves = tape.solves
    reads = []
    for name, operands in rows:
        match name:
            case "factor":
                reads.append(matrices[operands[0]][1])
            case "solve":
                reads.append((solves[operands[0]][0], *solves[operands[0]][1]))
            case "component":
                reads.append(operands[:1])
            case _:
                reads.append(operands)
    stages = tuple(tape.instruction_stages)
    results = tuple(tape.results)
    return Code(
        tuple(tape.constants), tape.inputs, tuple(rows), tuple(reads), stages, matrices, systems, results, tag
    )


def scalar_text(code: Code, name: str, lanes: int) -> str:
    """Return a module with the function ``void name(const double *in, double *out)``.

    ``lanes`` is the number of angles that the processor takes at a time.
    """
    everything = _Function(code, name, _ordered(code, range(len(code.rows))), 1, lanes, _scalar_input)
    stores = [(place, f"getelementptr double, ptr %out, i64 {j}") for j, place in enumerate(code.results)]
    body = everything.text(stores)
    entry = f"""\
define void @{name}(ptr noalias %in, ptr noalias %out) {{
{everything.calls("0", "0", "null")}
  ret void
}}
"""
    return _module([body, entry], everything.widths, code)


def batch_text(code: Code, name: str, lanes: int, uniform: Sequence[bool]) -> str:
    """Return a module with a function of many states, so many in a vector.

    ``void name(const double *const *in, double *out, int64 first, int64 last, int64 stride)``: input k of state i is
    ``in[k][i]``, or ``in[k][0]`` where it is ``uniform``; output j is ``out[j*stride + i]``. There must be at least
    as many states as lanes; what depends on uniform inputs alone is computed once.
    """
    before = [] if code.matrices else [k for k, stage in enumerate(code.stages) if stage == 0]
    inside = sorted(set(range(len(code.rows))) - set(before))
    nc, kept = len(code.constants), {code.first + k for k in before}
    shared = kept | {nc + k for k, is_uniform in enumerate(uniform) if is_uniform}
    needed = sorted(
        {p for k in inside for p in code.reads[k] if p in shared} | {p for p in code.results if p in shared}
    )
    slots = {place: slot for slot, place in enumerate(needed)}
    prologue = _Function(code, f"{name}_once", _ordered(code, before), 1, lanes, _pointed_input)
    body = _Function(code, f"{name}_each", _ordered(code, inside), lanes, lanes, _batch_input, slots)
    once = prologue.text([(p, f"getelementptr double, ptr %uniform, i64 {slots[p]}") for p in needed])
    each = body.text([(place, f"@{j}") for j, place in enumerate(code.results)])
    texts = [once, each, _loop(name, prologue, body, lanes, len(needed))]
    return _module(texts, prologue.widths | body.widths, code)


def _loop(name: str, prologue: _Function, body: _Function, lanes: int, uniforms: int) -> str:
    """Return the loop over the states; the last vector ends with the last state, and may overlap the one before."""
    return f"""\
define void @{name}(ptr noalias %in, ptr noalias %out, i64 %start, i64 %last, i64 %stride) alignstack(64) {{
  %uniform = alloca double, i64 {max(uniforms, 1)}, align 64
  call void @{name}_prepared(ptr %in, ptr %uniform)
  %end = sub i64 %last, {lanes}
  br label %loop
loop:
  %next = phi i64 [ %start, %0 ], [ %after, %loop ]
  %beyond = icmp sgt i64 %next, %end
  %i = select i1 %beyond, i64 %end, i64 %next
  call void @{name}_vector(ptr %in, ptr %out, ptr %uniform, i64 %i, i64 %stride)
  %after = add i64 %next, {lanes}
  %more = icmp slt i64 %after, %last
  br i1 %more, label %loop, label %done
done:
  ret void
}}

define internal void @{name}_prepared(ptr noalias %in, ptr noalias %uniform) noinline {{
{prologue.calls("0", "0", "%uniform", out="null")}
  ret void
}}

define internal void @{name}_vector(
    ptr noalias %in, ptr noalias %out, ptr noalias %uniform, i64 %i, i64 %stride) alignstack(64) {{
{body.calls("%i", "%stride", "%uniform")}
  ret void
}}
"""


def _module(texts: Iterable[str], widths: Iterable[int], code: Code) -> str:
    """Return a module: the functions of the text, sines and cosines, and what they call."""
    waves = [sincos_text(lanes) for lanes in sorted(widths)]
    declared = "\n".join(_DECLARATIONS) if not code.matrices else "\n".join([*_DECLARATIONS, *_KERNEL])
    return "\n".join(
        [*texts, *waves, declared, '!0 = !{!"branch_weights", i32 1, i32 100000}', "!1 = !{}", ""]
    )


_LIBM = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log")
_DECLARATIONS = (
    *(f"declare double @{name}(double) readnone nounwind willreturn" for name in _LIBM),
    *(f"declare double @{name}(double, double) readnone nounwind willreturn" for name in ("atan2", "pow")),
)
_KERNEL = (
    "declare void @symbody_factor(i64, ptr, i64)",
    "declare void @symbody_solve(i64, ptr, ptr)",
)


def _ordered(code: Code, rows: Iterable[int]) -> list[int]:
    """Return the rows with sines and cosines together."""
    listed = list(rows)
    position = {code.first + k: code.first + new for new, k in enumerate(listed)}
    reads = [[position.get(p, 0) for p in code.reads[k]] for k in listed]
    waves = [code.rows[k][0] in {"sin", "cos"} for k in listed]
    return [listed[new] for new in angles_first(reads, waves, code.first)]


Load = Callable[["_Writer", int], str]


def _scalar_input(w: _Writer, number: int) -> str:
    return w.input(w.let(f"getelementptr double, ptr %in, i64 {number}"))


def _pointed_input(w: _Writer, number: int) -> str:
    pointer = w.let(f"getelementptr ptr, ptr %in, i64 {number}")
    return w.input(w.let(f"load ptr, ptr {pointer}"))


def _batch_input(w: _Writer, number: int) -> str:
    pointer = w.let(f"getelementptr ptr, ptr %in, i64 {number}")
    base = w.let(f"load ptr, ptr {pointer}")
    return w.input(w.let(f"getelementptr double, ptr {base}, i64 %i"))


@dataclass
class _Function:
    """A sequence of rows as functions of some lanes, cut into blocks."""

    code: Code
    name: str
    order: list[int]
    lanes: int
    pack: int
    load: Load
    uniform: dict[int, int] = field(default_factory=dict)
    widths: set[int] = field(default_factory=set)

    def __post_init__(self) -> None:
        first = self.code.first
        moved = {first + k: first + new for new, k in enumerate(self.order)}
        self.places = {new: old for old, new in moved.items()}
        reads = [[moved.get(p, 0) if p >= first else p for p in self.code.reads[k]] for k in self.order]
        held = [
            first + new for new, k in enumerate(self.order) if self.code.rows[k][0] in {"factor", "solve"}
        ]
        self.cut: Cut = cut(reads, first, BLOCK, held)
        self.slots = {self.places[new]: slot for new, slot in self.cut.slots.items()}
        self.memory = _memory(self.code, self.cut.size) if self.lanes else {}

    @property
    def blocks(self) -> int:
        """The number of blocks; at least one."""
        return max(len(self.cut.starts) - 1, 1)

    def text(self, stores: Sequence[tuple[int, str]]) -> str:
        """Return the functions of the blocks; each stores the results that it makes."""
        waiting: dict[int, list[str]] = {}
        for place, target in stores:
            waiting.setdefault(place, []).append(target)
        texts = []
        for block in range(self.blocks):
            rows = self.order[self.cut.starts[block] : self.cut.starts[block + 1]] if self.order else []
            made = {self.code.first + k for k in rows}
            last = block == self.blocks - 1
            here = {p: waiting[p] for p in waiting if p in made or (last and p not in self._computed)}
            writer = _Writer(self, block)
            writer.rows(rows, here)
            texts.append(writer.text)
        return "\n".join(texts)

    @property
    def _computed(self) -> set[int]:
        return {self.code.first + k for k in self.order}

    def calls(self, i: str, stride: str, uniform: str, out: str = "%out") -> str:
        """Return the calls of the blocks, with the memory that they share."""
        size = max(sum(size for _, size in self.memory.values()) + self.cut.size, 1) * self.lanes
        lines = [f"  %work = alloca double, i64 {size}, align 64"]
        for block in range(self.blocks):
            arguments = f"ptr %in, ptr {out}, ptr %work, ptr {uniform}, i64 {i}, i64 {stride}"
            lines.append(f"  call void @{self.name}{block}({arguments})")
        return "\n".join(lines)


def _memory(code: Code, start: int) -> dict[tuple[str, int], tuple[int, int]]:
    """Return where the matrices and solutions are kept, after the slots: start and size, for one lane."""
    memory: dict[tuple[str, int], tuple[int, int]] = {}
    for number, (n, _) in enumerate(code.matrices):
        memory["factor", number] = (start, kernel_workspace(n))
        start += kernel_workspace(n)
    for number, (_, right) in enumerate(code.systems):
        memory["solve", number] = (start, len(right))
        start += len(right)
    return memory


class _Writer:
    """The text of one block."""

    def __init__(self, function: _Function, block: int) -> None:
        self.function, self.code, self.lanes = function, function.code, function.lanes
        self.V = vector_type(self.lanes)
        self.suffix = "f64" if self.lanes == 1 else f"v{self.lanes}f64"
        self.block = block
        self.lines: list[str] = []
        self.values: dict[int, str] = {}
        self.own: set[int] = set()
        self.count = self.runs = 0

    @property
    def text(self) -> str:
        attributes = "alwaysinline" if self.function.blocks == 1 else "noinline"
        arguments = (
            "ptr noalias %in, ptr noalias %out, ptr noalias %work, ptr noalias %uniform, i64 %i, i64 %stride"
        )
        lines = [
            f"define internal void @{self.function.name}{self.block}({arguments}) {attributes} alignstack(64) {{"
        ]
        return "\n".join([*lines, *self.lines, "  ret void", "}", ""])

    def let(self, instruction: str) -> str:
        name = f"%x{self.count}"
        self.count += 1
        self.lines.append(f"  {name} = {instruction}")
        return name

    def load(self, pointer: str) -> str:
        return self.let(f"load {self.V}, ptr {pointer}, align 8")

    def input(self, pointer: str) -> str:
        """Load what nothing changes: it may be loaded again rather than kept."""
        return self.let(f"load {self.V}, ptr {pointer}, align 8, !invariant.load !1")

    def store(self, value: str, pointer: str) -> None:
        self.lines.append(f"  store {self.V} {value}, ptr {pointer}, align 8")

    def rows(self, rows: Sequence[int], stores: dict[int, list[str]]) -> None:
        """Write instructions, and store their results where they are awaited."""
        self.own = {self.code.first + k for k in rows}
        for is_wave, group in groupby(rows, key=lambda k: self.code.rows[k][0] in {"sin", "cos"}):
            listed = list(group)
            if is_wave:
                self._waves(listed)
            for k in listed:
                if not is_wave:
                    self.values[self.code.first + k] = self._row(*self.code.rows[k])
                self._keep(self.code.first + k)
        for place, targets in stores.items():
            for target in targets:
                self.store(self.value(place), self._address(target))

    def _keep(self, place: int) -> None:
        """Store a value that later blocks read."""
        slot = self.function.slots.get(place)
        if slot is not None:
            self.store(self.values[place], self.slot(slot))

    def slot(self, number: int) -> str:
        return self.let(f"getelementptr double, ptr %work, i64 {number * self.lanes}")

    def _address(self, target: str) -> str:
        """Return where a result goes: ``@j`` stands for row j of the results of many states."""
        if not target.startswith("@"):
            return self.let(target)
        row = self.let(f"mul i64 %stride, {target[1:]}")
        return self.let(f"getelementptr double, ptr %out, i64 {self.let(f'add i64 {row}, %i')}")

    def value(self, place: int) -> str:
        """Return the name of the value at a place; loaded at its first use in a block."""
        if place < len(self.code.constants):
            return constant(self.code.constants[place], self.lanes)
        if place not in self.values:
            self.values[place] = self._loaded(place)
        return self.values[place]

    def _loaded(self, place: int) -> str:
        if place in self.function.uniform:
            pointer = self.let(f"getelementptr double, ptr %uniform, i64 {self.function.uniform[place]}")
            return self.splat(self.let(f"load double, ptr {pointer}, align 8"))
        if place < self.code.first:
            return self.function.load(self, place - len(self.code.constants))
        return self.load(self.slot(self.function.slots[place]))

    def splat(self, value: str) -> str:
        if self.lanes == 1:
            return value
        one = self.let(f"insertelement {self.V} poison, double {value}, i64 0")
        zeros = vector_type(self.lanes, "i32")
        return self.let(f"shufflevector {self.V} {one}, {self.V} poison, {zeros} zeroinitializer")

    def _row(self, name: str, operands: tuple[int, ...]) -> str:
        if name in {"factor", "solve", "component"}:
            return self._linear_system(name, *operands)
        values = [self.value(place) for place in operands]
        if name in _ARITHMETIC:
            return self.let(f"{_ARITHMETIC[name]} contract {self.V} {', '.join(values)}")
        if name in _INTRINSICS:
            arguments = ", ".join(f"{self.V} {value}" for value in values)
            return self.let(f"call {self.V} @llvm.{_INTRINSICS[name]}.{self.suffix}({arguments})")
        if name == "select":
            return self._select(*values)
        if name == "sign":
            return self._sign(*values)
        return self._system(_SYSTEM.get(name, name), values)

    def _select(self, condition: str, positive: str, otherwise: str) -> str:
        chosen = self.let(f"fcmp ogt {self.V} {condition}, {constant(0.0, self.lanes)}")
        mask = vector_type(self.lanes, "i1")
        return self.let(f"select {mask} {chosen}, {self.V} {positive}, {self.V} {otherwise}")

    def _sign(self, value: str) -> str:
        """Return -1, 0 or 1; what is no number stays so."""
        one, mask = constant(1.0, self.lanes), vector_type(self.lanes, "i1")
        unit = self.let(f"call {self.V} @llvm.copysign.{self.suffix}({self.V} {one}, {self.V} {value})")
        # Zero is its own sign, and so is what compares with nothing.
        itself = self.let(f"fcmp ueq {self.V} {value}, {constant(0.0, self.lanes)}")
        return self.let(f"select {mask} {itself}, {self.V} {value}, {self.V} {unit}")

    def _system(self, name: str, values: Sequence[str]) -> str:
        """Call a function of the system, lane by lane."""
        if self.lanes == 1:
            return self.let(f"call double @{name}({', '.join(f'double {value}' for value in values)})")
        result = "poison"
        for lane in range(self.lanes):
            parts = [self.lane(value, lane) for value in values]
            one = self.let(f"call double @{name}({', '.join(f'double {part}' for part in parts)})")
            result = self.let(f"insertelement {self.V} {result}, double {one}, i32 {lane}")
        return result

    def lane(self, vector: str, lane: int) -> str:
        return vector if self.lanes == 1 else self.let(f"extractelement {self.V} {vector}, i32 {lane}")

    def _waves(self, rows: Sequence[int]) -> None:
        """Take sines and cosines of several angles together: in vectors, if there is one state only."""
        places = list(dict.fromkeys(self.code.rows[k][1][0] for k in rows))
        size = self.function.pack if self.lanes == 1 else 1
        groups = [places[start : start + size] for start in range(0, len(places), size)]
        widths = [self.lanes if self.lanes > 1 else 1 << (len(group) - 1).bit_length() for group in groups]
        angles = [self._packed(group, lanes) for group, lanes in zip(groups, widths, strict=True)]
        both = self._checked(angles, widths)
        for k in rows:
            name, (angle,) = self.code.rows[k]
            number = places.index(angle)
            vector = both[number // size][name == "cos"]
            self.values[self.code.first + k] = self._unpacked(vector, widths[number // size], number % size)

    def _packed(self, places: Sequence[int], lanes: int) -> str:
        """Return angles as one vector, if they aren't vectors of states themselves."""
        if lanes == self.lanes:
            return self.value(places[0])
        V, angles = vector_type(lanes), constant(0.0, lanes)
        for lane, place in enumerate(places):
            angles = self.let(f"insertelement {V} {angles}, double {self.value(place)}, i32 {lane}")
        return angles

    def _unpacked(self, vector: str, lanes: int, lane: int) -> str:
        if lanes == self.lanes:
            return vector
        return self.let(f"extractelement {vector_type(lanes)} {vector}, i32 {lane}")

    def _checked(self, angles: Sequence[str], widths: Sequence[int]) -> list[tuple[str, str]]:
        """Return sines and cosines; one check sends all to the system's functions if some angle is large."""
        self.function.widths.update(widths)
        self.runs += 1
        fast, slow, end = (f"{name}{self.runs}" for name in ("fast", "slow", "end"))
        large = "false"
        for x, lanes in zip(angles, widths, strict=True):
            one = self.let(f"call i1 @is_large{lanes}({vector_type(lanes)} {x})")
            large = self.let(f"or i1 {large}, {one}")
        self.lines += [f"  br i1 {large}, label %{slow}, label %{fast}, !prof !0", f"{fast}:"]
        quick = [self._pair("sincos", x, lanes) for x, lanes in zip(angles, widths, strict=True)]
        self.lines += [f"  br label %{end}", f"{slow}:"]
        sure = [self._pair("system_sincos", x, lanes) for x, lanes in zip(angles, widths, strict=True)]
        self.lines += [f"  br label %{end}", f"{end}:"]
        both = []
        for quick_pair, sure_pair, lanes in zip(quick, sure, widths, strict=True):
            V = vector_type(lanes)
            first, second = (
                self.let(f"phi {V} [ {a}, %{fast} ], [ {b}, %{slow} ]")
                for a, b in zip(quick_pair, sure_pair, strict=True)
            )
            both.append((first, second))
        return both

    def _pair(self, name: str, angles: str, lanes: int) -> tuple[str, str]:
        V = vector_type(lanes)
        both = self.let(f"call {{ {V}, {V} }} @{name}{lanes}({V} {angles})")
        sine, cosine = (self.let(f"extractvalue {{ {V}, {V} }} {both}, {k}") for k in (0, 1))
        return sine, cosine

    def _linear_system(self, name: str, *numbers: int) -> str:
        match name:
            case "factor":
                return self._factor(numbers[0])
            case "solve":
                return self._solve(numbers[0])
        system = self.code.rows[numbers[0] - self.code.first][1][0]
        start, size = self.function.memory["solve", system]
        result = "poison"
        for lane in range(self.lanes):
            pointer = self._lane_address(start, size, lane, numbers[1])
            one = self.let(f"load double, ptr {pointer}, align 8")
            if self.lanes == 1:
                return one
            result = self.let(f"insertelement {self.V} {result}, double {one}, i32 {lane}")
        return result

    def _lane_address(self, start: int, size: int, lane: int, entry: int = 0) -> str:
        place = start * self.lanes + lane * size + entry
        return self.let(f"getelementptr double, ptr %work, i64 {place}")

    def _entries(self, start: int, size: int, places: Sequence[int]) -> None:
        values = [self.value(place) for place in places]
        for lane in range(self.lanes):
            for entry, value in enumerate(values):
                one = self.lane(value, lane)
                pointer = self._lane_address(start, size, lane, entry)
                self.lines.append(f"  store double {one}, ptr {pointer}, align 8")

    def _factor(self, number: int) -> str:
        n, entries = self.code.matrices[number]
        start, size = self.function.memory["factor", number]
        self._entries(start, size, entries)
        for lane in range(self.lanes):
            pointer, tag = self._lane_address(start, size, lane), self.code.tag + number
            self.lines.append(f"  call void @symbody_factor(i64 {n}, ptr {pointer}, i64 {tag})")
        return ""

    def _solve(self, number: int) -> str:
        matrix, right = self.code.systems[number]
        start, size = self.function.memory["solve", number]
        self._entries(start, size, right)
        factor_start, factor_size = self.function.memory["factor", matrix]
        for lane in range(self.lanes):
            factors = self._lane_address(factor_start, factor_size, lane)
            pointer = self._lane_address(start, size, lane)
            self.lines.append(f"  call void @symbody_solve(i64 {size}, ptr {factors}, ptr {pointer})")
        return ""


_ARITHMETIC = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv", "neg": "fneg"}
_INTRINSICS = {"sqrt": "sqrt", "Abs": "fabs", "Min": "minimum", "Max": "maximum"}
_SYSTEM = {"Power": "pow"}
