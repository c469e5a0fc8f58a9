"""Real shells that receive keys, each on its own terminal."""

import os
import pty
import select
import sys
import time
from pathlib import Path

PATIENCE = 30  # seconds to wait for a shell

# The options that start each shell without the user's configuration, and its first input, which loads the completion.
SHELLS = {
    "bash": (["--norc", "--noprofile", "-i"], "PS1='ready> '; eval \"$(_JKROLL_COMPLETE=source_bash jkroll)\""),
    "zsh": (
        ["-f", "-i"],
        "PS1='ready> '; autoload -U compinit; compinit -u -D; eval \"$(_JKROLL_COMPLETE=source_zsh jkroll)\"",
    ),
    "fish": (
        ["--no-config", "-i"],
        "function fish_prompt; echo -n 'ready> '; end; _JKROLL_COMPLETE=source_fish jkroll | source",
    ),
}
# A stand-in for jkroll: it answers completions as jkroll does, and otherwise writes the words of the call to a file.
STAND_IN = """#!/bin/sh
if [ -n "$_JKROLL_COMPLETE" ]; then exec {python} -m jkroll "$@"; fi
for word in "$@"; do printf '%s\\n' "$word"; done > {words}.new
mv {words}.new {words}
"""


class Shell:
    """A shell with jkroll's completion, in its own directory."""

    def __init__(self, name: str, program: str, directory: Path, **environment: str) -> None:
        """Start the shell, and wait until it has read the completion."""
        self.words, self.screen = directory / "words", b""
        stand_in = directory / "jkroll"
        stand_in.write_text(STAND_IN.format(python=sys.executable, words=self.words), encoding="utf-8")
        stand_in.chmod(0o755)
        environment |= {
            "PATH": f"{directory}:{os.environ['PATH']}", "HOME": str(directory), "TERM": "xterm", "LANG": "C.UTF-8",
            "XDG_CONFIG_HOME": str(directory), "XDG_DATA_HOME": str(directory),
            "PYTHONPATH": os.environ.get("PYTHONPATH", ""),
        }  # fmt: skip
        options, setup = SHELLS[name]
        self.process, self.terminal = pty.fork()
        if self.process == 0:
            os.chdir(directory)
            os.execve(program, [name, *options], environment)
        self.type(f"{setup}; touch {directory}/ready\n")
        self._wait_for(directory / "ready")

    def type(self, keys: str) -> None:
        """Press keys."""
        os.write(self.terminal, keys.encode())

    def words_of(self, keys: str) -> list[str]:
        """Type keys and press Enter; return the arguments with which the command is called."""
        self.words.unlink(missing_ok=True)
        self.type(keys + "\n")  # Enter may follow a TAB at once: the shell reads it after the completion
        self._wait_for(self.words)
        return self.words.read_text(encoding="utf-8").splitlines()

    def close(self) -> None:
        """Close the terminal, and wait until the shell has ended."""
        os.close(self.terminal)
        os.waitpid(self.process, 0)

    def _wait_for(self, path: Path) -> None:
        """Read what the shell writes until a file exists; raise TimeoutError after PATIENCE seconds."""
        deadline = time.monotonic() + PATIENCE
        while not path.exists():
            if time.monotonic() > deadline:
                raise TimeoutError(self.screen.decode("utf-8", "replace"))
            ready, _, _ = select.select([self.terminal], [], [], 0.02)
            if ready:
                self.screen += os.read(self.terminal, 65536)
