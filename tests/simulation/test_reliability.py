"""What goes wrong outside of the equations: full disks, folders that are closed, Ctrl-C, packages that are not there.

Each is a clear error, nothing is half written, and what was computed is kept. Elsewhere:

- ``test_failures.py``: what goes wrong within the equations, in one motion and in many;
- ``test_simulate.py``: rates that are not finite, a singular mass matrix, steps that collapse, begins off the
  constraints, Ctrl-C within `simulate`;
- ``test_many.py``: cases that fail, workers that are lost, Ctrl-C in one process, files of other problems, a process
  killed as it writes;
- ``test_ida.py``: the same of IDA, and a machine without it; ``test_consistent.py``: constraints that can't be met;
- ``tests/codegen/test_generate.py``: generated files, all or none, and a missing C compiler;
- ``tests/view``: pages and figures that can't be written.
"""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

from symbody import ModelNotice, Motion, generate, simulate, simulate_many
from symbody.errors import CodegenError, PictureError, ResultsError, SymbodyError
from symbody.simulation.batch.in_flight import InFlight
from symbody.simulation.batch.stop_flag import StopFlag
from tests.repeated import repeated
from tests.simulation.pendulum_batch import PENDULUM, g, l, m, q1, same, six, thirty
from tests.simulation.test_many import REFERENCE

resource = pytest.importorskip("resource")
ROOT = Path(__file__).parents[2]
MOTION = simulate(PENDULUM, {m: 1.3, l: 1, g: 9.81}, {q1: 0.3}, t=(0, 0.1))

Writer = Callable[[Path], object]


def figure(ending: str) -> Writer:
    return lambda folder: MOTION.plot(path=folder / f"figure.{ending}")


def page(folder: Path) -> object:
    return MOTION.animate(folder / "page.html")


def code(folder: Path) -> object:
    return generate(PENDULUM, "c", folder / "code")


def results(folder: Path) -> object:
    return six(path=folder / "runs.npz")


@contextmanager
def full_disk(left: int) -> Iterator[None]:
    """Let no file grow beyond some bytes: the system refuses in the middle of writing, as it does on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (left, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@contextmanager
def bound_by_modes() -> Iterator[None]:
    """Let the modes of files hold for root as well: it does without its capabilities to pass over them for a while."""
    if os.geteuid() != 0 or not sys.platform.startswith("linux"):
        yield
        return
    libc, header = ctypes.CDLL(None, use_errno=True), (ctypes.c_uint32 * 2)(0x20080522, 0)
    # Twice what is effective, permitted and inheritable: 32 capabilities each.
    had = (ctypes.c_uint32 * 6)()
    assert libc.capget(header, had) == 0
    dac_override, dac_read_search = 1 << 1, 1 << 2
    less = (ctypes.c_uint32 * 6)(had[0] & ~(dac_override | dac_read_search), *had[1:])
    assert libc.capset(header, less) == 0
    try:
        yield
    finally:
        assert libc.capset(header, had) == 0


@contextmanager
def closed_folder() -> Iterator[Path]:
    """Make a folder in which nothing may be written, nor looked for below ``locked``."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "locked").mkdir()
        (folder / "locked").chmod(0)
        folder.chmod(0o555)
        try:
            with bound_by_modes():
                yield folder
        finally:
            folder.chmod(0o755)
            (folder / "locked").chmod(0o755)


def message(error: type[Exception], write: Writer, folder: Path) -> str:
    with pytest.raises(error) as reported:
        write(folder)
    return str(reported.value)


# --- full disks and closed folders -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ending", "left"),
    [("png", 100), ("pdf", 100), ("svg", 5000), *repeated([("png", 5000), ("pdf", 5000), ("svg", 100)])],
)
def test_a_figure_on_a_full_disk(ending: str, left: int, tmp_path: Path) -> None:
    """Whatever the format: the writer of PDF would tell of an inconsistent stream."""
    figure(ending)(tmp_path)
    before = (tmp_path / f"figure.{ending}").read_bytes()
    with full_disk(left):
        reported = message(PictureError, figure(ending), tmp_path)
    assert reported == (
        f"view: {tmp_path}/figure.{ending} can't be written (File too large); nothing was changed there. "
        "Choose another path"
    )
    assert [file.read_bytes() for file in tmp_path.iterdir()] == [before]


def test_a_page_and_code_on_a_full_disk(tmp_path: Path) -> None:
    with full_disk(1000):
        reported = [message(PictureError, page, tmp_path), message(CodegenError, code, tmp_path)]
    assert reported == [
        (
            f"view: {tmp_path}/page.html can't be written (File too large); nothing was changed there. "
            "Choose another path"
        ),
        (
            f"generate: the folder {tmp_path}/code can't be written (File too large); nothing was changed there. "
            "Choose another folder as path"
        ),
    ]
    assert list(tmp_path.iterdir()) == []


def test_results_on_a_full_disk_come_back_all_the_same(tmp_path: Path) -> None:
    with full_disk(20_000), pytest.warns(ModelNotice) as notices:
        runs = six(path=tmp_path / "runs.npz")
    assert [str(notice.message) for notice in notices] == [
        (
            f"simulate_many: {tmp_path}/runs.npz can't be written (File too large); nothing was changed there. "
            "Choose another path"
        )
    ]
    assert same(runs, REFERENCE)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("below", ["", "locked/new", *repeated(["new", "locked"])])
@pytest.mark.parametrize(
    ("write", "error", "expected"),
    [
        (figure("png"), PictureError, "view: {}/figure.png can't be written ({}); "),
        (page, PictureError, "view: {}/page.html can't be written ({}); "),
        (results, ResultsError, "simulate_many: {}/runs.npz can't be written ({}); "),
        (code, CodegenError, "generate: the folder {}/code can't be written ({}); "),
    ],
)
def test_folders_that_are_closed(
    write: Writer, error: type[SymbodyError], expected: str, below: str, tmp_path: Path
) -> None:
    write(tmp_path)  # imports what it needs, which may be out of reach for whom the folder is closed
    with closed_folder() as closed:
        reported = message(error, write, closed / below)
        way_out = "Choose another folder as path" if write is code else "Choose another path"
        assert reported == (
            expected.format(closed / below, "Permission denied") + f"nothing was changed there. {way_out}"
        )


@pytest.mark.parametrize(
    ("write", "error", "expected"),
    [
        (
            lambda: MOTION.plot(path=3),
            PictureError,
            "view: 3 is not a path; expected one, such as 'motion.png'",
        ),
        (
            lambda: MOTION.animate(3),
            PictureError,
            "view: 3 is not a path; expected one, such as 'motion.html'",
        ),
        (
            lambda: generate(PENDULUM, "c", 3),
            CodegenError,
            "generate: 3 is not a path; expected a folder, such as 'generated'",
        ),
    ],
)
def test_paths_that_are_none(write: Callable[[], object], error: type[SymbodyError], expected: str) -> None:
    assert message(error, lambda _: write(), Path()) == expected


def test_links_stay_links(tmp_path: Path) -> None:
    """The file is on another disk, perhaps: what is written goes there."""
    (tmp_path / "far").mkdir()
    for name, write in {"figure.svg": figure("svg"), "page.html": page, "runs.npz": results}.items():
        (tmp_path / name).symlink_to(tmp_path / "far" / name)
        write(tmp_path)
        assert (tmp_path / name).is_symlink()
        assert (tmp_path / "far" / name).stat().st_size > 1000
    assert same(six(path=tmp_path / "runs.npz"), REFERENCE)


def test_a_name_that_has_just_room(tmp_path: Path) -> None:
    """What is written beside a file has no longer name than the file."""
    file = tmp_path / ("r" * 251 + ".npz")
    assert same(six(path=file), REFERENCE)
    assert same(six(path=file), REFERENCE)
    assert list(tmp_path.iterdir()) == [file]


# --- the file of results ---------------------------------------------------------------------------------------------


def refusal_of(file: Path) -> str:
    return message(ResultsError, lambda folder: six(path=folder / file.name), file.parent)


def test_results_that_were_cut_or_changed(tmp_path: Path) -> None:
    file = tmp_path / "runs.npz"
    six(path=file)
    whole = file.read_bytes()
    changed = bytearray(whole)
    changed[len(whole) // 2] ^= 1
    for content, reason in (
        (whole[: len(whole) // 2], "File is not a zip file"),
        (whole[:-1], "File is not a zip file"),
        (bytes(changed), "Bad CRC-32 for file 'states.npy'"),
    ):
        file.write_bytes(content)
        assert refusal_of(file) == (
            f"simulate_many: {file} can't be read as a results file ({reason}); the file was not changed. Give "
            "another path, or remove the file"
        )
        assert file.read_bytes() == content


def test_two_processes_write_one_file(tmp_path: Path) -> None:
    """Both save after each few motions; neither reads what is half written, and in the end the file is whole."""
    program = (
        "import sys; from symbody.simulation.batch import many; from tests.simulation.pendulum_batch import thirty\n"
        "many.SAVE_EVERY = many.SAVE_PAUSE = 0.0\n"
        "for _ in range(2): thirty(sys.argv[1])\n"
    )
    file = tmp_path / "runs.npz"
    command = [sys.executable, "-W", "error", "-c", program, str(file)]
    with subprocess.Popen(command, cwd=ROOT) as one, subprocess.Popen(command, cwd=ROOT) as other:
        assert (one.wait(), other.wait()) == (0, 0)
    assert same(thirty(file), thirty(None))
    assert list(tmp_path.iterdir()) == [file]


# --- Ctrl-C ----------------------------------------------------------------------------------------------------------

_LONG = """
import sys, warnings
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import nullcontext
from multiprocessing import get_context
from pathlib import Path
from threading import get_native_id
import numpy as np
from symbody import simulate_many
from symbody.simulation.batch import many, workers
from tests.simulation.pendulum_batch import PENDULUM, g, l, m, q1

def long(**options):
    lengths = np.array([1.0, 0.5, 0.6, 0.7])
    with warnings.catch_warnings(record=True) as notices:
        runs = simulate_many(PENDULUM, {m: 1, g: 9.81}, {q1: 1}, [0, 1, 1e7], cases={l: lengths}, **options)
    return runs, *[str(notice.message) for notice in notices]

def mark(name):
    Path(sys.argv[2], name).touch()

def run(*given, run=workers.run_cases):
    mark(f"motion-{get_native_id()}")
    return run(*given)

workers.run_cases = run  # in workers, too, which read this file as they begin
many.progress_bar = lambda *_, **__: nullcontext(lambda _: mark("call"))

if __name__ == "__main__":
    if sys.argv[1] == "native":
        reported = long(threads=2)
    else:
        spawned = ProcessPoolExecutor(int(sys.argv[3]), get_context("spawn"))
        kind = ThreadPoolExecutor(2) if sys.argv[1] == "threads" else spawned
        with kind as executor:
            reported = long(executor=executor)
    print(*reported, sep="\\n")
"""


@pytest.mark.parametrize(
    ("workers", "begun", "reach"),
    [
        ("native", ["motion"], os.killpg),
        ("threads", ["motion", "motion"], os.killpg),
        ("processes", ["motion", "motion"], os.killpg),
        pytest.param("processes", ["motion"], os.kill, id="processes that get no signal"),
        pytest.param("processes", ["call"], os.killpg, id="processes that have not begun"),
    ],
)
def test_ctrl_c_in_a_terminal_ends_motions_that_take_long(
    workers: str, begun: list[str], reach: Callable[[int, int], None], tmp_path: Path
) -> None:
    """It goes to all processes of the terminal, or to this one alone; nobody waits for what workers have under way."""
    (tmp_path / "long.py").write_text(_LONG)
    signs, marks = tmp_path / "signs", tmp_path / "marks"
    signs.mkdir()
    marks.mkdir()
    command = [sys.executable, str(tmp_path / "long.py"), workers, str(marks), str(len(begun))]
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": str(ROOT), "TMPDIR": str(signs)},
        start_new_session=True,
    ) as process:
        try:
            while len(list(marks.glob(f"{begun[0]}*"))) < len(begun):
                assert process.poll() is None
                time.sleep(0.01)
            reach(process.pid, signal.SIGINT)
            reported, errors = process.communicate()
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
    assert reported == (
        "Runs(4 cases, 3 instants, 4 not run)\n"
        "simulate_many: 4 of 4 motions were not run (interrupted); they are in .not_run, and their values are NaN; "
        "give a path to keep results for another call\n"
    )
    assert "InvalidStateError" not in errors
    assert list(signs.iterdir()) == []


def test_workers_of_a_pool_that_broke_stop() -> None:
    """A worker that starts while another one dies is unknown to a broken pool, and would take the next task."""
    with ProcessPoolExecutor(1, get_context("forkserver")) as executor:
        flight = InFlight("a call", executor, lambda _: executor.submit(os._exit, 1), 1, StopFlag())
        assert list(flight.results([0], lambda: flight.lost is None)) == []
        assert isinstance(flight.lost, BrokenExecutor)
        assert flight.flag.is_set()


@pytest.mark.parametrize("write", [page, figure("png"), code], ids=["page", "figure", "code"])
def test_ctrl_c_in_the_middle_of_writing(
    write: Writer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path)
    before = {file: file.read_bytes() for file in tmp_path.rglob("*") if file.is_file()}
    for name in ("write_text", "write_bytes"):
        whole = getattr(Path, name)

        def cut(path: Path, content: str | bytes, whole: Writer = whole, **options: str) -> None:
            whole(path, content[:100], **options)  # type: ignore[call-arg]
            os.kill(os.getpid(), signal.SIGINT)

        monkeypatch.setattr(Path, name, cut)
    with pytest.raises(KeyboardInterrupt):
        write(tmp_path)
    monkeypatch.undo()
    assert {file: file.read_bytes() for file in tmp_path.rglob("*") if file.is_file()} == before


# --- packages that are not there -------------------------------------------------------------------------------------


def test_machines_without_a_compiler_of_machine_code() -> None:
    """By each way of integration; SUNDIALS is an extra."""
    methods = ("dop853", "bdf", *(["ida"] if find_spec("sksundae") else []))
    program = (
        "import sys\nsys.modules['llvmlite'] = None\nfrom symbody import Body, System, functions_of_time, "
        "newton_euler, simulate, translate\nfrom symbody.errors import CodegenError\nx = "
        "functions_of_time('x')\neqs = newton_euler(System([Body(translate(x, 0, 0), 1)], coordinates=[x]))\n"
        f"for method in {methods}:\n    try:\n        simulate(eqs, {{}}, {{x: 1}}, t=(0, 1), method=method)\n"
        "    except CodegenError as error:\n        print(error)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, cwd=ROOT
    )
    said = "machine code needs the package llvmlite, which is not installed here: pip install llvmlite"
    assert done.stdout.splitlines() == [said] * len(methods)


# --- what was computed -----------------------------------------------------------------------------------------------


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Press Ctrl-C, once in a call, as soon as something is done."""

    @contextmanager
    def bar(*_: object, **__: object) -> Iterator[Callable[[float], None]]:
        shown: list[float] = []

        def show(done: float) -> None:
            if shown and done > max(shown) == shown[0]:
                os.kill(os.getpid(), signal.SIGINT)
            shown.append(done)

        yield show

    for name in ("motion.simulate", "batch.many"):
        monkeypatch.setattr(import_module(f"symbody.simulation.{name}"), "progress_bar", bar)


@pytest.mark.usefixtures("impatient")
def test_what_an_interruption_left_can_be_used(tmp_path: Path) -> None:
    """A motion that Ctrl-C ended is drawn, evaluated and taken up again like any other."""
    values = {m: 1.3, l: 1, g: 9.81}
    with pytest.warns(ModelNotice, match="interrupted at t = .*; what was computed is kept"):
        part: Motion = simulate(PENDULUM, values, {q1: 0.3}, t=np.arange(0, 1e6, 10))
    assert not part.completed
    assert 0 < part.t[-1] < 1e6 - 10
    assert np.isfinite(part[q1]).all()
    assert simulate(PENDULUM, values, part.state_at(-1), t=(part.t[-1], part.t[-1] + 1)).completed
    assert part.animate(tmp_path / "part.html").exists()


@pytest.mark.usefixtures("impatient")
def test_interrupted_calls_go_on_where_the_last_one_was(tmp_path: Path) -> None:
    """Ctrl-C twice: the second call has what the first one has written, bit by bit, and adds to it."""
    file = tmp_path / "runs.npz"
    found = []
    for _ in range(2):
        with pytest.warns(ModelNotice, match="the same call goes on with the rest"):
            found.append(
                simulate_many(
                    PENDULUM,
                    {m: 1, g: 9.81},
                    {q1: 1},
                    [0, 15, 30],
                    cases={l: np.linspace(0.5, 1, 20_000)},
                    path=file,
                )
            )
        with np.load(file) as stored:
            np.testing.assert_array_equal(stored["states"], found[-1].states)
    first, second = found
    assert 0 < first.completed.sum() < second.completed.sum() < 20_000
    np.testing.assert_array_equal(second.states[first.completed], first.states[first.completed])
