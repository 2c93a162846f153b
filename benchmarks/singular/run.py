"""Scan motions through singular positions: what passes, what is reported, and the energy lost.

    python -m benchmarks.singular.run [--quick]

A full run takes three minutes and writes docs/benchmarks/singular.md and .svg; with --quick the tables are printed.
"""

from __future__ import annotations

import argparse

from ..page import FOLDER, write_page
from . import report
from .plot import write_plot
from .scan import losses, others


def main() -> None:
    """Parse the command line, scan, report."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.singular.run", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--quick", action="store_true", help="few mechanisms, tolerances and speeds: seconds")
    if parser.parse_args().quick:
        print(quick())
        return
    found = losses()
    write_plot(found, FOLDER / "singular.svg")
    write_page("singular.md", report.written(found, others()))


def quick() -> str:
    """Return the tables of a few motions."""
    found = losses(names=("one", "kite"), tolerances=(1e-4, 1e-8), every=30)
    return report.written(found, others(names=("one",), speeds=1))


if __name__ == "__main__":
    main()
