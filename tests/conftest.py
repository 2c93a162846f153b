"""What every process that runs tests begins with."""

from __future__ import annotations

import signal


def pytest_configure() -> None:
    """Let Ctrl-C act, which some tests press: shells start what runs in the background with it ignored."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
