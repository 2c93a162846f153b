"""The text of kernels: what a person reads, and that NVRTC compiles it for graphics processors.

The golden file has what differs from model to model. After a wanted change, write it anew with

    SYMBODY_GOLDEN=update .venv/bin/python -m pytest tests/simulation/test_kernel_text.py
"""

from __future__ import annotations

import ctypes
import os
from importlib.resources import files
from importlib.util import find_spec
from math import inf
from pathlib import Path

import pytest

from symbody import Event, models, newton_euler
from symbody.models import ClassicSystem
from symbody.simulation.device.cuda import OPTIONS
from symbody.simulation.device.kernel_text import Kernel, kernel_of
from symbody.simulation.integrate.task_of import task_of

GOLDEN = Path(__file__).parents[1] / "golden" / "cuda" / "pendulum.cu"
LOOP = files("symbody.simulation.device").joinpath("integrator.cu").read_text(encoding="utf-8")
NVRTC = find_spec("nvidia.cuda_nvrtc") if find_spec("nvidia") else None


def kernel(model: ClassicSystem, method: str) -> Kernel:
    """The kernel of a model with an event at the zeros of its first coordinate."""
    equations = newton_euler(model.system)
    return kernel_of(
        task_of(
            equations,
            model.parameters,
            (0.0, 1.0),
            inputs=None,
            method=method,
            rtol=1e-8,
            atol=1e-10,
            outputs=None,
            events=[Event(equations.coordinates[0], direction=1)],
            constraints="projection",
            guess=None,
            max_step=inf,
        )
    )


def test_golden_file() -> None:
    text = kernel(models.n_pendulum(1), "tsit5").text
    assert text.count(LOOP) == 1
    text = text.replace(LOOP, "/* Here follows symbody/simulation/device/integrator.cu. */\n")
    if os.environ.get("SYMBODY_GOLDEN") == "update":
        GOLDEN.parent.mkdir(exist_ok=True)
        GOLDEN.write_text(text, encoding="utf-8")
    assert text == GOLDEN.read_text(encoding="utf-8"), "see the first lines of this file"


def test_a_shortcut_does_not_stand_for_the_general_solution() -> None:
    """Both have the same value; where the conditions of the shortcut fail, the other one must be computed."""
    text = kernel(models.four_bar(), "dop853").text
    assert text.count("rates_briefly(") == 2, "its definition, and its call in the door"
    general = text[text.index("void rates(") : text.index("void position_correction_briefly(")]
    assert "symbody_factor(" in general


def compiled_by_nvrtc(text: str) -> bytes:
    """The code for a virtual processor; the log of the compiler if that fails."""
    assert NVRTC is not None
    (folder,) = NVRTC.submodule_search_locations or [""]
    (path,) = (Path(folder) / "lib").glob("libnvrtc.so.1?")
    nvrtc, program, size = ctypes.CDLL(str(path)), ctypes.c_void_p(), ctypes.c_size_t()
    assert not nvrtc.nvrtcCreateProgram(ctypes.byref(program), text.encode(), b"kernel.cu", 0, None, None)
    options = [option.encode() for option in (*OPTIONS, "--gpu-architecture=compute_80")]
    status = nvrtc.nvrtcCompileProgram(program, len(options), (ctypes.c_char_p * len(options))(*options))
    nvrtc.nvrtcGetProgramLogSize(program, ctypes.byref(size))
    log = ctypes.create_string_buffer(size.value)
    nvrtc.nvrtcGetProgramLog(program, log)
    assert not status, log.value.decode()
    assert not log.value.strip(), log.value.decode()
    nvrtc.nvrtcGetPTXSize(program, ctypes.byref(size))
    code = ctypes.create_string_buffer(size.value)
    nvrtc.nvrtcGetPTX(program, code)
    return code.value


@pytest.mark.skipif(NVRTC is None, reason="the package nvidia-cuda-nvrtc-cu12 is not installed")
@pytest.mark.parametrize(
    ("name", "method"), [("free", "dop853"), pytest.param("loop", "tsit5", marks=pytest.mark.repeated)]
)
def test_nvrtc_compiles_it(name: str, method: str) -> None:
    """For the loop: constraints, a shortcut, systems that are solved at run time, events, energies."""
    model = {"free": models.n_pendulum(2), "loop": models.four_bar()}[name]
    code = compiled_by_nvrtc(kernel(model, method).text)
    assert all(b".entry %s(" % entry in code for entry in (b"advance", b"clear", b"measure"))
