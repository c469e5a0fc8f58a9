"""Places of the user's own materials files."""

import os
import sys

from ..errors import BadRequest

ENVIRONMENT = "JKROLL_MATERIALS"


def materials_files(option: str | None) -> tuple[str, ...]:
    """Return the user's materials files by rising precedence: configuration directory, environment, option."""
    if option == "":
        raise BadRequest("--materials is empty")
    configuration = os.path.join(configuration_directory(), "materials.toml")
    files = [configuration] if _exists(configuration) else []
    return tuple(dict.fromkeys(files + [path for path in (os.environ.get(ENVIRONMENT), option) if path]))


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
