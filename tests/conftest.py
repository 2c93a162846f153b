"""What every process that runs tests begins with."""

from __future__ import annotations

import os
import signal


def pytest_configure() -> None:
    """Let Ctrl-C act, which some tests press: shells start what runs in the background with it ignored.

    All code is compiled anew, and nothing is left in the user's folder.
    """
    os.environ["SYMBODY_CACHE"] = "off"
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
