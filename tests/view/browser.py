"""A browser without a window, spoken to through a pipe: the Chrome DevTools Protocol, without a further package."""

from __future__ import annotations

import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from scripts.tools import TOOLS

NAMES = next(tool.commands for tool in TOOLS if tool.name == "chromium")
FLAGS = [
    "--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--no-first-run", "--disable-dev-shm-usage",
    "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
]  # fmt: skip
LAUNCHER = (
    "from os import *; from sys import argv as a; dup2(int(a[1]), 3); dup2(int(a[2]), 4); execv(a[3], a[3:])"
)
"""Puts the pipes where the browser reads and writes: files 3 and 4."""

PATIENCE = 60.0
"""Seconds until an answer is missed."""


class Browser:
    """One page in a browser: what it fetched, what it wrote to the console, and its picture."""

    def __init__(self, to_browser: int, from_browser: int) -> None:
        self._to, self._from = to_browser, from_browser
        self._rest, self._number, self._session = b"", 0, ""
        self.console: list[str] = []
        """Warnings and errors, without the driver's remark on reading pixels."""
        self.requests: list[str] = []

    def open(self, address: str, size: tuple[int, int] = (900, 600)) -> None:
        """Load a page and wait until it is loaded."""
        target = self._call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self._call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self._call(f"{domain}.enable")
        width, height = size
        self._call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )
        self._call("Page.navigate", url=address)
        self.wait_for("location.href != 'about:blank' && document.readyState == 'complete'")

    def evaluate(self, script: str) -> Any:
        """Return the value of an expression of the page."""
        answer = self._call("Runtime.evaluate", expression=script, returnByValue=True)
        if "exceptionDetails" in answer:
            raise AssertionError(answer["exceptionDetails"])
        return answer["result"].get("value")

    def wait_for(self, condition: str) -> None:
        """Wait until an expression of the page is true."""
        end = time.monotonic() + PATIENCE
        while not self.evaluate(condition):
            assert time.monotonic() < end, f"{condition} never became true"
            time.sleep(0.02)

    def picture(self, file: Path) -> Path:
        """Write what the page looks like."""
        data = self._call("Page.captureScreenshot", format="png")["data"]
        file.write_bytes(base64.b64decode(data))
        return file

    def _call(self, method: str, **params: object) -> dict[str, Any]:
        self._number += 1
        message = {"id": self._number, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._to, json.dumps(message).encode() + b"\0")
        for answer in self._messages():
            if answer.get("id") == self._number:
                assert "error" not in answer, f"{method}: {answer['error']}"
                return answer["result"]
            self._note(answer.get("method", ""), answer.get("params", {}))
        raise AssertionError(f"the browser ended at {method}")

    def _messages(self) -> Iterator[dict[str, Any]]:
        while True:
            while b"\0" not in self._rest:
                assert select.select([self._from], [], [], PATIENCE)[0], "the browser doesn't answer"
                more = os.read(self._from, 1 << 20)
                if not more:
                    return
                self._rest += more
            message, self._rest = self._rest.split(b"\0", 1)
            yield json.loads(message)

    def _note(self, event: str, params: dict[str, Any]) -> None:
        if event == "Network.requestWillBeSent":
            self.requests.append(params["request"]["url"])
        elif event == "Runtime.exceptionThrown":
            self.console.append(str(params["exceptionDetails"]))
        elif event == "Runtime.consoleAPICalled" and params["type"] in {"error", "warning", "assert"}:
            self.console.append(" ".join(str(argument.get("value")) for argument in params["args"]))
        elif event == "Log.entryAdded" and "GPU stall" not in params["entry"]["text"]:
            self.console.append(params["entry"]["text"])


def _pipe() -> tuple[int, int]:
    """Return the ends of a pipe, away from the numbers that the browser wants."""
    ends = os.pipe()
    far = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in ends]
    for end in ends:
        os.close(end)
    return far[0], far[1]


@contextmanager
def browser() -> Iterator[Browser]:
    """Start a browser, and end it."""
    chromium = next(filter(None, map(shutil.which, NAMES)))
    (its_input, to_browser), (from_browser, its_output) = _pipe(), _pipe()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        command = [chromium, *FLAGS, f"--user-data-dir={profile}"]
        process = subprocess.Popen(
            [sys.executable, "-c", LAUNCHER, str(its_input), str(its_output), *command],
            pass_fds=(its_input, its_output),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(its_input)
        os.close(its_output)
        try:
            yield Browser(to_browser, from_browser)
        finally:
            process.terminate()
            with suppress(subprocess.TimeoutExpired):
                process.wait(timeout=10)
            process.kill()
            process.wait()
            os.close(to_browser)
            os.close(from_browser)
