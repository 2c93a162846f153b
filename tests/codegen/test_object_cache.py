"""Machine code that is kept on disk: found again, refused where it is damaged or foreign, and never a hindrance."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from symbody import Expr, MachineCode, lambdify, linear_solve, symbols
from symbody.codegen.llvm import jit, object_cache
from symbody.errors import ModelNotice
from tests.codegen.test_long_code import chain

pytestmark = pytest.mark.skipif(not hasattr(os, "getuid"), reason="there is no cache on this system")

x, y = symbols("x y")
LONG: list[Expr] = chain(150)[-1:]
STATE = np.array([[0.3, 0.2]])


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to keep code in."""
    monkeypatch.setenv(object_cache.VARIABLE, str(tmp_path / "kept"))
    return tmp_path / "kept"


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The texts that are compiled from now on."""
    texts: list[str] = []
    compile_now = jit._object
    monkeypatch.setattr(jit, "_object", lambda text: (texts.append(text), compile_now(text))[1])
    return texts


def value(expressions: list[Expr] = LONG) -> NDArray[np.float64]:
    """Some values, by new machine code."""
    out = np.empty((1, len(expressions)))
    MachineCode((x, y), tuple(expressions)).evaluate(STATE, out)
    return out


def only_file(folder: Path) -> Path:
    (file,) = folder.iterdir()
    return file


def test_code_is_compiled_once_and_is_the_same(home: Path, compiled: list[str]):
    first = value()
    assert len(compiled) == 1
    assert np.array_equal(value(), first)
    assert len(compiled) == 1
    assert only_file(home).read_bytes()[32:] == jit._object(compiled[0])
    assert home.stat().st_mode & 0o777 == 0o700
    assert only_file(home).stat().st_mode & 0o777 == 0o600


@pytest.mark.parametrize("word", ["off", "OFF", "0", "no", "false"])
def test_it_is_off_where_the_variable_says_so(
    home: Path, compiled: list[str], monkeypatch: pytest.MonkeyPatch, word: str
):
    monkeypatch.setenv(object_cache.VARIABLE, word)
    monkeypatch.chdir(home.parent)
    assert np.array_equal(value(), value())
    assert len(compiled) == 2
    assert list(home.parent.iterdir()) == []


def test_short_code_is_kept_in_the_process_alone(home: Path, compiled: list[str]):
    jit._short_object.cache_clear()
    assert np.array_equal(value([x * y]), value([x * y]))
    assert len(compiled) == 1
    assert not home.exists()


def flipped(place: int) -> Callable[[Path], None]:
    """What changes one bit of a file."""

    def change(file: Path) -> None:
        data = bytearray(file.read_bytes())
        data[place] ^= 1
        file.write_bytes(data)

    return change


DAMAGES: dict[str, Callable[[Path], object]] = {
    "empty": lambda file: file.write_bytes(b""),
    "short": lambda file: file.write_bytes(file.read_bytes()[:20]),
    "cut off": lambda file: file.write_bytes(file.read_bytes()[:-1]),
    "lengthened": lambda file: file.write_bytes(file.read_bytes() + b"\0"),
    "no code": lambda file: file.write_bytes(bytes(32)),
    "proof changed": flipped(0),
    "code changed": flipped(1000),
    "end changed": flipped(-1),
    "writable by all": lambda file: file.chmod(0o666),
    "linked": lambda file: (file.rename(file.parent.parent / "away"), file.symlink_to("../away")),
    "pipe": lambda file: (file.unlink(), os.mkfifo(file)),
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_what_is_damaged_is_compiled_again_and_mended(
    home: Path, compiled: list[str], damage: Callable[[Path], object]
):
    expected = value()
    damage(only_file(home))
    assert np.array_equal(value(), expected)
    assert len(compiled) == 2
    assert np.array_equal(value(), expected)
    assert len(compiled) == 2
    assert only_file(home).is_file()
    assert not only_file(home).is_symlink()


def test_the_code_of_other_text_under_this_name_is_refused(home: Path, compiled: list[str]):
    value()
    mine = only_file(home)
    value(chain(160)[-1:])
    (other,) = set(home.iterdir()) - {mine}
    mine.write_bytes(other.read_bytes())
    again = value()
    assert len(compiled) == 3
    assert np.array_equal(again, value())


def test_a_folder_in_place_of_a_file_does_no_harm(home: Path, compiled: list[str]):
    expected = value()
    file = only_file(home)
    file.unlink()
    file.mkdir()
    assert np.array_equal(value(), expected)
    assert [each.name for each in home.iterdir()] == [file.name]


def test_another_processor_or_version_has_its_own_code(
    home: Path, compiled: list[str], monkeypatch: pytest.MonkeyPatch
):
    value()
    monkeypatch.setattr(jit, "_identity", lambda: "another one")
    value()
    assert len(compiled) == 2
    assert len(list(home.iterdir())) == 2


def open_to_the_group(home: Path, _: pytest.MonkeyPatch) -> None:
    home.mkdir()
    home.chmod(0o770)


def foreign(home: Path, patch: pytest.MonkeyPatch) -> None:
    home.mkdir(0o700)
    patch.setattr(os, "getuid", lambda: home.stat().st_uid + 1)


def linked_away(home: Path, _: pytest.MonkeyPatch) -> None:
    (home.parent / "elsewhere").mkdir(0o700)
    home.symlink_to("elsewhere")


def a_file(home: Path, _: pytest.MonkeyPatch) -> None:
    home.write_text("no folder")


def below_a_file(home: Path, patch: pytest.MonkeyPatch) -> None:
    home.write_text("no folder")
    patch.setenv(object_cache.VARIABLE, str(home / "inner"))


def no_home(_: Path, patch: pytest.MonkeyPatch) -> None:
    patch.setenv(object_cache.VARIABLE, "~no_user_of_this_name/kept")


def no_name(_: Path, patch: pytest.MonkeyPatch) -> None:
    patch.setattr(object_cache.os.environ, "get", lambda *_: "a\0b")


UNUSABLE = [open_to_the_group, foreign, linked_away, a_file, below_a_file, no_home, no_name]


@pytest.mark.parametrize("spoil", UNUSABLE)
def test_a_folder_that_is_not_ones_own_is_not_used(
    home: Path,
    compiled: list[str],
    monkeypatch: pytest.MonkeyPatch,
    spoil: Callable[[Path, pytest.MonkeyPatch], None],
):
    spoil(home, monkeypatch)
    assert np.array_equal(value(), value())
    assert len(compiled) == 2
    assert object_cache.folder() is None


def test_a_full_disk_does_no_harm(home: Path, compiled: list[str], monkeypatch: pytest.MonkeyPatch):
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(tempfile, "TemporaryDirectory", full)
    assert np.array_equal(value(), value())
    assert len(compiled) == 2
    assert list(home.iterdir()) == []


def test_what_was_not_used_for_longest_goes_first(
    home: Path, compiled: list[str], monkeypatch: pytest.MonkeyPatch
):
    value()
    size = only_file(home).stat().st_size
    monkeypatch.setattr(object_cache, "BOUND", 5 * size)
    for links in range(151, 161):
        for age, file in enumerate(sorted(home.iterdir(), key=lambda file: file.stat().st_mtime_ns)):
            os.utime(file, ns=(age * 10**9, age * 10**9))
        value(chain(links)[-1:])
        value()
        assert sum(file.stat().st_size for file in home.iterdir()) <= object_cache.BOUND
    assert len(compiled) == 11


OTHERS = [
    "main.o",
    f"{64 * 'a'}.o",
    f"{63 * 'a'}.symbody.o",
    f"{64 * 'x'}.symbody.o",
    f"b{64 * 'a'}.symbody.o",
    f"{64 * 'a'}.symbody.o.txt",
    ".symbody.o",
]
"""What a user may keep in the same folder."""


def test_the_files_of_others_are_neither_counted_nor_removed(
    home: Path, compiled: list[str], monkeypatch: pytest.MonkeyPatch
):
    """They are older and larger than what is kept here, and so is a folder in the place of a file."""
    value()
    size = only_file(home).stat().st_size
    monkeypatch.setattr(object_cache, "BOUND", 7 * size // 2)
    for name in OTHERS:
        (home / name).write_bytes(bytes(4 * size))
        os.utime(home / name, ns=(0, 0))
    (home / f"{64 * '0'}.symbody.o").mkdir()
    # A process that was killed left a file, and one of an earlier version another one.
    left = home / ".symbody-ab3_x9zz" / "new" / f"{64 * '1'}.symbody.o"
    left.parent.mkdir(parents=True)
    for file in (left, home / ".ab3_x9zz.symbody.o"):
        file.write_bytes(bytes(size))
        os.utime(file, ns=(0, 0))
    for links in range(151, 153):
        value(chain(links)[-1:])
    assert set(OTHERS) <= {file.name for file in home.iterdir()}
    assert len(list(home.iterdir())) == len(OTHERS) + 1 + 3
    for links in range(153, 157):
        value(chain(links)[-1:])
    assert len(list(home.iterdir())) < len(OTHERS) + 1 + 7
    assert set(OTHERS) <= {file.name for file in home.iterdir()}


def test_the_standard_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.delenv(object_cache.VARIABLE)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    assert object_cache.folder() == tmp_path / ".cache" / "symbody"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "other"))
    assert object_cache.folder() == tmp_path / "other" / "symbody"
    monkeypatch.setenv("XDG_CACHE_HOME", "relative")
    assert object_cache.folder() == tmp_path / ".cache" / "symbody"


PROCESS = """
import numpy as np
from symbody import MachineCode, sin, symbols

x, y = symbols("x y")
out = np.empty((1, 2))
chain = [x]
for _ in range(152):
    chain.append(sin(chain[-1]) + y)
for links in range(150, 153):
    MachineCode((x, y), tuple(chain[links - 1 : links + 1])).evaluate(np.array([[0.3, 0.2]]), out)
    print(out.tobytes().hex())
"""


def test_processes_at_the_same_time_share_it(home: Path):
    root = Path(__file__).parents[2]
    command = [sys.executable, "-c", PROCESS]
    started = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=root) for _ in range(2)]
    reported = {process.communicate()[0] for process in started}
    assert len(reported) == 1
    assert len(reported.pop().split()) == 3
    assert len(list(home.iterdir())) == 3
    assert all(object_cache._read(file) for file in home.iterdir())


def test_equal_code_from_the_folder_keeps_its_own_notices(home: Path, compiled: list[str]):
    """What tells linear systems apart is no part of the code."""
    matrix = [[x * (i + 1) * (j + 1) + (y if i == j else 0) for j in range(12)] for i in range(12)]
    solution = list(linear_solve(matrix, [1 + k for k in range(12)]))
    one, other = (lambdify([x, y], solution, compile=True) for _ in range(2))
    with pytest.warns(ModelNotice, match="of deficient rank"):
        one(1.0, 0.0)
    other(1.0, 2.0)
    assert len(compiled) == 1
    with pytest.warns(ModelNotice, match="of deficient rank"):
        other(1.0, 0.0)
    one(1.0, 2.0)
