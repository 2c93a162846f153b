"""Rust: a module without dependencies, and a self-check that rustc alone compiles."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.codegen.languages.heads import comment_lines, comparisons, head, head_of_function, mark
from symbody.codegen.languages.target import Target
from symbody.codegen.layout.code_text import part_lines, wrap_line, wrap_lines
from symbody.codegen.layout.language import Language, functions, number_text
from symbody.codegen.layout.module import Array, Function, Module
from symbody.codegen.runtime.linear_solve import kernel_text
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["RUST"]

_NAMES = """
as break const continue crate else enum extern false fn for if impl in let loop match mod move mut pub ref return self
Self static struct super trait true type unsafe use where while async await dyn abstract become box do final macro
override priv typeof unsized virtual yield try union f64 main sign_of least greatest factor solve compare failures
reference gen std core alloc process
"""

_METHODS = ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp")

LANGUAGE = Language(
    comment=("//", ""),
    declare="let {name} = {value};",
    assign="{place} = {value};",
    functions=functions(
        **{name: f"f64::{name}({{}})" for name in _METHODS},
        atan2="f64::atan2({}, {})",
        log="f64::ln({})",
        Abs="f64::abs({})",
        sign="sign_of({})",
        Min="least({}, {})",
        Max="greatest({}, {})",
        Power="f64::powf({}, {})",
        select="(if {} > 0.0 {{ {} }} else {{ {} }})",
    ),
    reserved=frozenset(_NAMES.split()),
    literal=lambda value: {"inf": "f64::INFINITY", "-inf": "-f64::INFINITY", "nan": "f64::NAN"}.get(
        repr(value), number_text(value)
    ),
    matrix="{}[{}][{}]",
    scalar="*{}",
    clear="{array}.fill(0.0);",
    clear_matrix="for row in {array}.iter_mut() {{ row.fill(0.0); }}",
    factor="factor({n}, &mut {work}[..]);",
    solve="solve({n}, &{work}[..], &mut {x}[..]);",
)

_HELPERS = {
    Operation.SIGN: """
fn sign_of(x: f64) -> f64 {
    f64::from(i8::from(x > 0.0) - i8::from(x < 0.0))
}
""",
    "Min": """
fn least(a: f64, b: f64) -> f64 {
    if a < b || a.is_nan() { a } else { b }
}
""",
    "Max": """
fn greatest(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}
""",
}


def _files(module: Module) -> dict[str, str]:
    return {f"{module.name}.rs": _source(module), f"{module.name}_check.rs": _check(module)}


def _source(module: Module) -> str:
    title = "Functions of the model; results come last. Matrices are arrays of rows."
    lines = [*comment_lines(head(module, title, 0), "//!"), ""]
    lines += ["#![allow(non_snake_case, unused_parens, dead_code, clippy::all)]"]
    for function in module.functions:
        lines += ["", *_function(function)]
    lines += [
        line
        for name, text in _HELPERS.items()
        if name in module.operations
        for line in text.rstrip().split("\n")
    ]
    if Operation.FACTOR in module.operations:
        lines += ["", kernel_text("linear_solve.rs").rstrip()]
    return "\n".join(lines) + "\n"


def _type(array: Array) -> str:
    text = "f64"
    for size in reversed(array.shape):
        text = f"[{text}; {size}]"
    return text


def _declared(function: Function) -> dict[str, str]:
    """Return the parameters of a function by name."""
    declared = {a.name: f"{a.name}: {'' if a.is_scalar else '&'}{_type(a)}" for a in function.arguments}
    return declared | {r.name: f"{r.name}: &mut {_type(r)}" for r in function.results}


def _function(function: Function) -> list[str]:
    """Return a function; if it is long, one that calls its parts, and these."""
    lines = comment_lines(head_of_function(function), "///")
    parts = function.composition.parts
    arrays = [f"    let mut {name} = [0.0; {size}];" for name, size in function.arrays]
    calls = wrap_lines([_called(call) for call in function.calls], LANGUAGE, "    ")
    unused = [f"    let _ = {a.name};" for a in function.arguments if a.name not in function.mentions]
    title = f"pub fn {function.name}({', '.join(_declared(function).values())}) {{"
    if len(parts) == 1:
        body, definitions = part_lines(parts[0], LANGUAGE, function.shapes), []
    else:
        body = wrap_lines([_call(function, k) for k in range(len(parts))], LANGUAGE, "    ")
        definitions = [line for k in range(len(parts)) for line in ["", *_part(function, k)]]
    return [*lines, *wrap_line(title, LANGUAGE, ""), *arrays, *calls, *body, *unused, "}", *definitions]


def _part(function: Function, number: int) -> list[str]:
    """Return one part as a function of the arrays that it uses."""
    part = function.composition.parts[number]
    declared = _declared(function)
    declared |= {name: f"{name}: &mut [f64; {size}]" for name, size in function.arrays}
    used = ", ".join(text for name, text in declared.items() if name in part.mentions)
    title = f"fn {function.name}_part{number + 1}({used}) {{"
    return [*wrap_line(title, LANGUAGE, ""), *part_lines(part, LANGUAGE, function.shapes), "}"]


def _call(function: Function, number: int) -> str:
    names = {array.name: array.name for array in (*function.arguments, *function.results)}
    names |= {name: f"&mut {name}" for name, _ in function.arrays}
    mentioned = function.composition.parts[number].mentions
    used = ", ".join(text for name, text in names.items() if name in mentioned)
    return f"{function.name}_part{number + 1}({used});"


def _called(function: Function) -> str:
    """Return the call of a function inside another one, which has its arguments."""
    names = [*(a.name for a in function.arguments), *(f"&mut {result.name}" for result in function.results)]
    return f"{function.name}({', '.join(names)});"


_COMPARE = """
/// Compare numbers with their reference, relative to the largest; zeros may differ by rounding.
fn compare(what: &str, value: &[f64], reference: &[f64]) -> bool {
    let largest = reference.iter().fold(0.0_f64, |largest, r| largest.max(r.abs()));
    let error = value.iter().zip(reference).fold(0.0_f64, |error, (v, r)| error.max((v - r).abs()));
    let is_close = |(v, r): (&f64, &f64)| (v - r).abs() <= 1e-12 * largest + 1e-15;
    let same = value.iter().zip(reference).all(is_close);
    let relative = if largest > 0.0 { error / largest } else { error };
    let verdict = if same { "ok" } else { "DIFFERS" };
    println!("  {what:<44} {:>5} {relative:>10.1e}  {verdict}", reference.len());
    same
}
"""


def _check(module: Module) -> str:
    title = [mark(module), "", "Evaluates every routine at one state and compares with reference values."]
    lines = [*comment_lines(title, "//!"), "", "#![allow(non_snake_case, clippy::all)]", ""]
    lines += [f'#[path = "{module.name}.rs"]', f"mod {module.name};", "", "fn main() {"]
    for array in module.arguments:
        if array.name in module.values:
            literals = ", ".join(map(LANGUAGE.literal, module.values[array.name]))
            value = literals if array.is_scalar else f"[{literals}]"
            lines += wrap_line(f"let {array.name} = {value};", LANGUAGE, "    ")
    lines += ["    let mut failures = 0;", f'    println!("{module.name}: entries, largest relative error");']
    lines += _call_of(module, module.prepare) if module.prepare else []
    for function, references in zip(module.routines, module.references, strict=True):
        lines += ["", *_comparison(module, function, references)]
    lines += ["", "    std::process::exit(i32::from(failures > 0));", "}"]
    return "\n".join([*lines, *_COMPARE.rstrip().split("\n")]) + "\n"


def _call_of(module: Module, function: Function) -> list[str]:
    """Return the lines that make room for the results and call a function."""
    zeros = [f"    let mut {r.name}: {_type(r)} = {_zeros(r)};" for r in function.results]
    names = [a.name if a.is_scalar else f"&{a.name}" for a in function.arguments]
    names += [f"&mut {result.name}" for result in function.results]
    call = f"{module.name}::{function.name}({', '.join(names)});"
    return [*zeros, *wrap_line(call, LANGUAGE, "    ")]


def _zeros(array: Array) -> str:
    text = "0.0"
    for size in reversed(array.shape):
        text = f"[{text}; {size}]"
    return text


def _comparison(module: Module, function: Function, references: Sequence[Sequence[float]]) -> list[str]:
    """Return a block that calls a routine and compares its results."""
    lines = ["    {", *(f"    {line}" for line in _call_of(module, function))]
    for result, reference in comparisons(function, references):
        literals = ", ".join(map(LANGUAGE.literal, reference))
        lines += [f"    {line}" for line in wrap_line(f"let reference = [{literals}];", LANGUAGE, "    ")]
        flat = {0: f"&[{result.name}]", 1: f"&{result.name}", 2: f"&{result.name}.concat()"}[
            len(result.shape)
        ]
        call = f'compare("{function.name}: {result.name}", {flat}, &reference)'
        lines.append(f"        failures += i32::from(!{call});")
    return [*lines, "    }"]


RUST = Target(
    name="rust",
    title="Rust",
    language=LANGUAGE,
    files=_files,
    check=("rustc --edition=2021 -O {name}_check.rs -o {name}_check", "./{name}_check"),
)
