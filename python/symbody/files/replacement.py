"""Files that are whole or as they were."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replacement(file: Path) -> Iterator[Path]:
    """Give a path beside a file; what is written there takes the file's place at the end, in one step.

    A link stays one: what it leads to is replaced. The folder is made if there is none.

    Raises:
        OSError: the file can't be written; what was there before is still there.

    >>> with tempfile.TemporaryDirectory() as home:
    ...     with replacement(Path(home) / "a.txt") as temporary:
    ...         size = temporary.write_text("one")
    ...     [file.name for file in Path(home).iterdir()]
    ['a.txt']
    """
    place = file.resolve()
    place.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".symbody-", dir=place.parent) as folder:
        temporary = Path(folder) / place.name
        yield temporary
        temporary.replace(place)
