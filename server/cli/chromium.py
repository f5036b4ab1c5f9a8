"""A real browser for measurements: the system's Chromium, or the one that Playwright installed."""

from __future__ import annotations

import shutil
from contextlib import contextmanager
from typing import TYPE_CHECKING

from .common import stop

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser

SWITCHES = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
]  # fmt: skip


@contextmanager
def chromium() -> Iterator[Browser]:
    """Start a headless Chromium; end the command in one sentence when there is none."""
    try:
        # An optional extra, which only measurements in a browser need.
        from playwright.sync_api import Error, sync_playwright  # noqa: PLC0415
    except ImportError as error:
        raise stop("This drives a browser: install Emogen with its extra 'bench', for example  .[bench]") from error
    with sync_playwright() as playwright:
        try:
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=SWITCHES)
        except Error as error:
            raise stop("No Chromium was found: run  playwright install chromium") from error
        try:
            yield browser
        finally:
            browser.close()
