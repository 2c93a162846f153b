"""What chunks of a study have found, as arrays of bytes in the group "progress" of its file."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .statistics.statistic import Partial

__all__ = ["partials_in", "put_partials", "put_text"]


def put_partials(group: Any, name: str, partials: Sequence[Partial]) -> None:
    """Write partial results as one array of bytes, which are a file ``.npz``."""
    content = BytesIO()
    arrays = {f"{k}/{key}": each for k, partial in enumerate(partials) for key, each in partial.items()}
    np.savez(content, allow_pickle=False, **arrays)
    data = np.frombuffer(content.getvalue(), dtype=np.uint8)
    group["progress"].create_array(name, data=data, chunks=data.shape, overwrite=True)


def put_text(group: Any, name: str, text: str) -> None:
    """Write a text as an array of bytes."""
    data = np.frombuffer(text.encode(), dtype=np.uint8)
    group["progress"].create_array(name, data=data, chunks=data.shape, overwrite=True)


def partials_in(group: Any, name: str) -> list[Partial]:
    """Return partial results as `put_partials` wrote them."""
    found: dict[int, dict[str, NDArray[Any]]] = {}
    with np.load(BytesIO(np.asarray(group["progress"][name][:]).tobytes()), allow_pickle=False) as stored:
        for place, values in stored.items():
            k, key = place.split("/")
            found.setdefault(int(k), {})[key] = values
    return [found[k] for k in sorted(found)]
