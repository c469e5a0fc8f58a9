"""Build hook: writes the materials of `materials.toml` into the wheel as a Python module.

A call that names a shipped material then parses no TOML; Python compiles the module only once. A checkout has no such
module, since its `materials.toml` may be edited.
"""

import sys
import tempfile
from pathlib import Path
from runpy import run_path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

MODULE = "jkroll/materials/shipped.py"


class ShippedMaterials(BuildHookInterface[Any]):
    """Adds the module to a wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Write the module to a temporary directory, from which the build copies it."""
        if version == "editable":
            return
        sys.path.insert(0, str(Path(self.root, "src")))
        self.folder = tempfile.TemporaryDirectory()
        module = Path(self.folder.name, "shipped.py")
        module.write_text(run_path(str(Path(self.root, ".hatch/module.py")))["text"](), encoding="utf-8")
        build_data["force_include"][str(module)] = MODULE

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:  # noqa: ARG002
        """Remove the temporary directory."""
        if version != "editable":
            self.folder.cleanup()
