"""Places of the user's own materials files."""

import os
import sys

from ..errors import BadRequest
from .library import Materials, known_materials

ENVIRONMENT = "JKROLL_MATERIALS"


def materials_of_user(option: str | None) -> Materials:
    """Return the known materials with those of the user's files.

    By rising precedence these are the files of the configuration directory and of the environment, which may add materials but
    change no shipped one, and that of the option, which may.
    """
    if option == "":
        raise BadRequest("--materials is empty")
    configuration = os.path.join(configuration_directory(), "materials.toml")
    files = [configuration] if _exists(configuration) else []
    added = [path for path in (*files, os.environ.get(ENVIRONMENT)) if path and not _is_same(path, option)]
    return Materials(option or (), added=added) if added or option else known_materials()


def _is_same(path: str, other: str | None) -> bool:
    return other is not None and os.path.realpath(path) == os.path.realpath(other)


def _exists(path: str) -> bool:
    """Return whether something is at a path. A file that cannot be reached counts, so that it is reported as unreadable."""
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return False
    except OSError:
        pass
    return True


def configuration_directory() -> str:
    """Return the user's configuration directory on this system, the same as platformdirs without its import."""
    if sys.platform == "win32":
        parent = os.environ.get("APPDATA") or os.path.expanduser("~")
    elif sys.platform == "darwin":
        parent = os.path.expanduser("~/Library/Application Support")
    else:
        parent = os.environ.get("XDG_CONFIG_HOME") or os.path.expanduser("~/.config")
    return os.path.join(parent, "jkroll")
