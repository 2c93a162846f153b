"""Compilation in the process, from text of LLVM's intermediate representation to machine code."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cache, lru_cache, partial
from importlib.metadata import version
from typing import Any

try:
    import llvmlite
    import llvmlite.binding as llvm
except (
    Exception
) as error:  # without it the tape is evaluated; what can't be loaded is an OSError, among others
    llvm, _failure = None, error

from symbody.codegen.llvm.assembly import Assembly
from symbody.codegen.llvm.object_cache import SHORTEST, kept_or_made
from symbody.errors import CodegenError
from symbody.symbolic.given.arguments import brief
from symbody.symbolic.numeric.kernel import kernel_address

__all__ = ["Compiled", "check_available", "compile_assembly", "is_available", "lanes", "watched"]

_OPTIONS: dict[str, Any] = {"opt": 1, "jit": True, "reloc": "pic", "codemodel": "large"}
"""Code addresses its constants relative to itself, as in a shared library: absolute addresses take a register each.

Code and its constants may lie more than 2 GB apart in a process with much memory: addresses of 32 bits would not
reach, and LLVM would abort the process. A higher level of the selection of instructions takes a third more time,
and code runs as fast with this one.
"""

_LEVEL = 1
"""The level of optimisation. Straight-line code gains nothing from higher levels, which take twice the time."""

_WATCHER: ContextVar[Callable[[int, int], None]] = ContextVar("watcher", default=lambda _part, _parts: None)


def is_available() -> bool:
    """Return whether code can be compiled here."""
    return llvm is not None


def check_available() -> None:
    """Check that code can be compiled here.

    Raises:
        CodegenError: llvmlite isn't installed, or can't be loaded.
    """
    if llvm is not None:
        return
    if isinstance(_failure, ModuleNotFoundError) and _failure.name == "llvmlite":
        raise CodegenError(
            "machine code needs the package llvmlite, which is not installed here: pip install llvmlite"
        )
    raise CodegenError(
        f"machine code needs the package llvmlite, which is installed and can't be loaded here "
        f"({brief(f'{type(_failure).__name__}: {_failure}')}): "
        "pip install --force-reinstall llvmlite"
    )


@dataclass(frozen=True, eq=False)
class Compiled:
    """Machine code; it lives as long as this object.

    Attributes:
        address: where the function begins.
        engines: what owns the memory.
    """

    address: int
    engines: tuple[Any, ...]

    def function(self, *arguments: Any) -> Any:
        """Return the function for Python, with arguments of these C types; it releases the interpreter."""
        return ctypes.CFUNCTYPE(None, *arguments)(self.address)


@cache
def _target() -> Any:
    """Return the kind of this processor; the functions that compiled code calls are registered once."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    for name in ("factor", "solve"):
        llvm.add_symbol(f"symbody_{name}", kernel_address(name))
    return llvm.Target.from_default_triple()


def _machine() -> Any:
    """Return a description of this processor; a new one for each engine, which takes ownership."""
    features = llvm.get_host_cpu_features().flatten()
    return _target().create_target_machine(cpu=llvm.get_host_cpu_name(), features=features, **_OPTIONS)


@cache
def lanes() -> int:
    """Return how many doubles a vector of the processor holds.

    Raises:
        CodegenError: LLVM is missing.
    """
    check_available()
    features = llvm.get_host_cpu_features()
    if features.get("avx512dq"):
        return 8
    return 4 if features.get("avx2") else 2


def compile_assembly(assembly: Assembly, name: str) -> Compiled:
    """Compile and load one function.

    Python gets control between two modules, so that Ctrl-C can interrupt.

    Args:
        assembly: its modules.
        name: its name.
    """
    *objects, last = _objects([*(part.text for part in assembly.parts), assembly.entry])
    entry = _loaded(last)
    engines = [_loaded(made) for made in objects]
    addresses = [
        engine.get_function_address(part_name)
        for engine, part in zip(engines, assembly.parts, strict=True)
        for part_name in part.names
    ]
    if addresses:
        table = (ctypes.c_void_p * len(addresses)).from_address(entry.get_global_value_address("parts"))
        table[:] = addresses
    return Compiled(entry.get_function_address(name), (entry, *engines))


@contextmanager
def watched(watcher: Callable[[int, int], None]) -> Iterator[None]:
    """Report each module before it is compiled in this context: its number, and how many the function has."""
    token = _WATCHER.set(watcher)
    try:
        yield
    finally:
        _WATCHER.reset(token)


def _objects(texts: Sequence[str]) -> list[bytes]:
    objects = []
    for number, text in enumerate(texts, 1):
        _WATCHER.get()(number, len(texts))
        objects.append(_short_object(text) if len(text) < SHORTEST else _long_object(text))
    return objects


@lru_cache(maxsize=256)
def _short_object(text: str) -> bytes:
    """Return the machine code of a module from this process, which remembers the last ones: a few MB of them."""
    return _object(text)


def _long_object(text: str) -> bytes:
    """Return the machine code of a module from the folder that processes share."""
    return kept_or_made(_identity(), text, partial(_object, text))


@cache
def _identity() -> str:
    """Return the dependencies of machine code other than its text."""
    features = llvm.get_host_cpu_features().flatten()
    versions = (version("symbody"), llvmlite.__version__, llvm.llvm_version_info)
    return repr((*versions, llvm.get_default_triple(), llvm.get_host_cpu_name(), features, _OPTIONS, _LEVEL))


def _loaded(made: bytes) -> Any:
    """Return an engine for one module: an engine expects all constants near those of its first module."""
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _machine())
    engine.add_object_file(llvm.ObjectFileRef.from_data(made))
    engine.finalize_object()
    return engine


def _object(text: str) -> bytes:
    """Return the machine code of one module, not loaded yet."""
    machine = _machine()
    module = llvm.parse_assembly(text)
    module.triple, module.data_layout = machine.triple, str(machine.target_data)
    options = llvm.create_pipeline_tuning_options(speed_level=_LEVEL)
    options.slp_vectorization = False
    options.loop_vectorization = False
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    made: bytes = machine.emit_object(module)
    return made
