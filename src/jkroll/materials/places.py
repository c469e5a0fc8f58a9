"""Where the user's own materials files are."""

import os
import sys

from ..errors import BadRequest

ENVIRONMENT = "JKROLL_MATERIALS"


def materials_files(option: str | None) -> tuple[str, ...]:
    """The user's own materials files by rising precedence: configuration directory, environment, option."""
    if option == "":
        raise BadRequest("--materials is empty")
    configuration = os.path.join(configuration_directory(), "materials.toml")
    files = [configuration] if _is_there(configuration) else []
    return tuple(dict.fromkeys(files + [path for path in (os.environ.get(ENVIRONMENT), option) if path]))


def _is_there(path: str) -> bool:
    """Whether there is something at a path, be it only what makes it unreadable."""
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return False
    except OSError:
        pass
    return True


def configuration_directory() -> str:
    """Where the user's configuration is kept on this system: as typer and platformdirs have it, without importing them."""
    if sys.platform == "win32":
        parent = os.environ.get("APPDATA") or os.path.expanduser("~")
    elif sys.platform == "darwin":
        parent = os.path.expanduser("~/Library/Application Support")
    else:
        parent = os.environ.get("XDG_CONFIG_HOME") or os.path.expanduser("~/.config")
    return os.path.join(parent, "jkroll")
