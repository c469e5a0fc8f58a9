"""Builds what `materials.toml` says into the wheel as a module, which the interpreter compiles once.

The file stays the one copy in the repository. A checkout, which may be edited, has no such module and parses the file.
"""

import tempfile
import tomllib
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class ShippedMaterials(BuildHookInterface[Any]):
    """Adds `jkroll/materials/shipped.py` to a wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Write the module beside the checkout and have it included."""
        if version == "editable":
            return
        data = tomllib.loads(Path(self.root, "materials.toml").read_text(encoding="utf-8"))
        self.folder = tempfile.TemporaryDirectory()
        module = Path(self.folder.name, "shipped.py")
        module.write_text(
            f'"""What materials.toml says, made from it when the wheel was built."""\n\nDATA = {data!r}\n',
            encoding="utf-8",
        )
        build_data["force_include"][str(module)] = "jkroll/materials/shipped.py"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:  # noqa: ARG002
        """Remove it."""
        if version != "editable":
            self.folder.cleanup()
