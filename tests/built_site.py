"""The built site in a headless browser, for the tests of its pages."""

import hashlib
import os
import subprocess
import tarfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from browser import CHROMIUM, DRIVER, Browser, browser, hosts_asked, served

ROOT = Path(__file__).parents[1]
DOCS, SITE = ROOT / ".docs", ROOT / ".docs" / "site"
IS_CI = bool(os.environ.get("CI"))
MARKS = [
    pytest.mark.slow,
    pytest.mark.skipif(not DOCS.exists(), reason="the sdist has no .docs"),
    pytest.mark.skipif(not (CHROMIUM and DRIVER) and not IS_CI, reason="needs chromium and chromedriver"),
    pytest.mark.skipif(not SITE.exists() and not IS_CI, reason="needs the built site"),
]

AXE, AXE_SHA256 = "axe-core@4.14.1", "e6b0ce02b84d892e2e33e403485e7f3d6c29e2be6df65daf44d89ba564139745"


def axe(folder: Path) -> str:
    """Return the script of axe-core, a checker of accessibility; npm downloads it into a folder."""
    packed = subprocess.run(["npm", "pack", "--silent", AXE], cwd=folder, check=True, capture_output=True, text=True)
    archive = folder / packed.stdout.strip()
    assert hashlib.sha256(archive.read_bytes()).hexdigest() == AXE_SHA256
    with tarfile.open(archive) as content:
        member = content.extractfile("package/axe.min.js")
        assert member is not None
        return member.read().decode()


@contextmanager
def site_in_browser(profile: Path) -> Iterator[tuple[Browser, str]]:
    """Yield a browser and the address of the site.

    Fails if the site is older than its sources, or, at the end, if a page sent requests to another host.
    """
    tracked = subprocess.run(["git", "ls-files", ".docs", "src", "*.md"], cwd=ROOT, capture_output=True, text=True)
    newest = max((ROOT / name).stat().st_mtime for name in tracked.stdout.split() if (ROOT / name).exists())
    assert newest < (SITE / "index.html").stat().st_mtime, "the site is older than its sources: build it"
    with served(SITE) as address, browser(profile) as window:
        yield window, address
    assert hosts_asked(profile) == {"127.0.0.1"}
