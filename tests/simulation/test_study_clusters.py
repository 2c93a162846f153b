"""Pools of MPI and Ray, as docs/studies.md uses them: skipped where these packages are not installed."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

_MPI = """
from mpi4py.futures import MPIPoolExecutor
from tests.simulation.test_study import REFERENCE, kept, same
if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        print(same(kept(executor=executor), REFERENCE))
"""

_RAY = """
from concurrent.futures import Executor
import ray
from tests.simulation.test_study import REFERENCE, kept, same

class RayExecutor(Executor):
    def submit(self, function, /, *given):
        return call.remote(function, given).future()

ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, object_store_memory=10**8)
call = ray.remote(max_retries=3)(lambda function, given: function(*given))
print(same(kept(executor=RayExecutor()), REFERENCE))
"""


def printed(command: list[str], program: str, folder: Path) -> str:
    """Run a program that can import the tests, and return what it prints."""
    file = folder / "program.py"
    file.write_text(program)
    paths = [str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])]
    env = os.environ | {"PYTHONPATH": os.pathsep.join(paths), "HOME": str(folder)}
    finished = subprocess.run([*command, str(file)], env=env, capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stderr
    return finished.stdout


@pytest.mark.repeated
def test_a_pool_of_mpi_gives_the_same(tmp_path: Path) -> None:
    pytest.importorskip("mpi4py")
    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("mpiexec is not installed")
    is_root = hasattr(os, "geteuid") and os.geteuid() == 0
    is_open_mpi = (
        "Open" in subprocess.run([mpiexec, "--version"], capture_output=True, text=True, check=True).stdout
    )
    options = ["--oversubscribe", *(["--allow-run-as-root"] if is_root else [])] if is_open_mpi else []
    command = [mpiexec, *options, "-n", "3", sys.executable, "-m", "mpi4py.futures"]
    assert printed(command, _MPI, tmp_path).split() == ["True"]


@pytest.mark.repeated
def test_tasks_of_ray_give_the_same(tmp_path: Path) -> None:
    pytest.importorskip("ray")
    assert printed([sys.executable], _RAY, tmp_path).split() == ["True"]
