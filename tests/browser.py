"""A headless Chromium, driven by Debian's chromedriver over the WebDriver protocol, and a folder served on loopback."""

import base64
import json
import shutil
import subprocess
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any
from urllib.error import HTTPError
from urllib.parse import urlsplit

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
QUIET = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
    "--disable-background-networking", "--disable-component-update", (
        "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE "
        "127.0.0.1"
    ),
]  # fmt: skip
KEYS = {
    "Enter": "\ue007",
    "Tab": "\ue004",
    "ArrowUp": "\ue013",
    "ArrowDown": "\ue015",
    "ArrowRight": "\ue014",
    "Escape": "\ue00c",
}


class _Silent(SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None:
        """Print nothing."""


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """Serve a folder on loopback; yield its address."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Silent, directory=str(folder)))
    Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/"
    finally:
        server.shutdown()
        server.server_close()


class Browser:
    """A browser window."""

    def __init__(self, port: int, profile: Path) -> None:
        self.driver = f"http://127.0.0.1:{port}"
        log = profile / "requests.json"  # for hosts_asked
        options = {"binary": CHROMIUM, "args": [*QUIET, f"--user-data-dir={profile}", f"--log-net-log={log}"]}
        wanted = {"capabilities": {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": options}}}
        self.session = f"/session/{self.call('POST', '/session', wanted)['sessionId']}"
        self._spare = self._new_tab()

    def call(self, method: str, path: str, body: Any = None) -> Any:
        """Send a command of the protocol; return its value."""
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.driver + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=300) as answer:
                return json.loads(answer.read())["value"]
        except HTTPError as error:
            error.add_note(error.read().decode())  # the driver's message
            raise

    def _new_tab(self) -> Any:
        """Open a tab in the background; return its handle."""
        return self.call("POST", f"{self.session}/window/new", {"type": "tab"})["handle"]

    def open(self, address: str, width: int = 1000, height: int = 900) -> None:
        """Open a page in a window of a given size, in the spare tab if Chromium's tab has crashed."""
        try:
            self._show(address, width, height)
        except HTTPError as error:
            if "tab crashed" not in "".join(error.__notes__):
                raise
            self.call("POST", f"{self.session}/window", {"handle": self._spare})
            self._spare = self._new_tab()
            self._show(address, width, height)

    def _show(self, address: str, width: int, height: int) -> None:
        self.call("POST", f"{self.session}/window/rect", {"width": width, "height": height})
        self.call("POST", f"{self.session}/url", {"url": address})

    def script(self, code: str, *arguments: Any) -> Any:
        """Run a script; return its value."""
        return self.call("POST", f"{self.session}/execute/sync", {"script": code, "args": list(arguments)})

    def wait(self, condition: str, seconds: float = 120) -> None:
        """Wait until an expression is true."""
        end = time.monotonic() + seconds
        while not self.script(f"return Boolean({condition})"):
            if time.monotonic() > end:
                raise TimeoutError(condition)
            time.sleep(0.05)

    def type(self, text: str) -> None:
        """Type a text, or a key of KEYS, into the focused element."""
        element = self.call("GET", f"{self.session}/element/active")
        self.call(
            "POST", f"{self.session}/element/{next(iter(element.values()))}/value", {"text": KEYS.get(text, text)}
        )

    def click(self, selector: str) -> None:
        """Wait for an element that a CSS selector matches; click with the mouse on the first one."""
        self.wait(f"document.querySelector({json.dumps(selector)})")
        found = self.call("POST", f"{self.session}/element", {"using": "css selector", "value": selector})
        self.call("POST", f"{self.session}/element/{next(iter(found.values()))}/click", {})

    def clipboard(self) -> str:
        """Return the text in the clipboard."""
        self.call("POST", f"{self.session}/permissions", {"descriptor": {"name": "clipboard-read"}, "state": "granted"})
        return str(self.script("return navigator.clipboard.readText()"))

    def save_downloads(self, folder: Path) -> None:
        """Save files that pages offer for download in a folder."""
        params = {"behavior": "allow", "downloadPath": str(folder)}
        self.call("POST", f"{self.session}/goog/cdp/execute", {"cmd": "Browser.setDownloadBehavior", "params": params})

    def picture(self, path: Path) -> None:
        """Save a screenshot of the window."""
        path.write_bytes(base64.b64decode(self.call("GET", f"{self.session}/screenshot")))


def hosts_asked(profile: Path) -> set[str | None]:
    """Return the hosts to which pages and workers sent requests, from the log of a browser that has ended.

    Requests by the browser itself are left out: they have no initiator, or an internal page such as chrome://newtab.
    """
    events = json.loads((profile / "requests.json").read_text(encoding="utf-8"))["events"]
    requests = [event["params"] for event in events if "initiator" in event.get("params", {})]
    return {urlsplit(each["url"]).hostname for each in requests if not _is_of_browser(each["initiator"])}


def _is_of_browser(initiator: str) -> bool:
    """Return whether the browser itself initiated a request, by the initiator in the log.

    The initiator of a sandboxed page is neither "not an origin" nor an internal page.
    """
    return initiator == "not an origin" or urlsplit(initiator).scheme.startswith("chrome")


@contextmanager
def browser(profile: Path) -> Iterator[Browser]:
    """Run a headless browser with a new profile."""
    assert DRIVER is not None
    with subprocess.Popen(
        [DRIVER, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        assert process.stdout is not None
        try:
            line = next(line for line in process.stdout if "successfully on port" in line)
            window = Browser(int(line.rpartition("port ")[2].rstrip(".\n")), profile)
            try:
                yield window
            finally:
                window.call("DELETE", window.session)
        finally:
            process.terminate()
