"""Metadata hook: the URLs of the project and its README with absolute links, both from `address` in `pyproject.toml`.

If `address` is empty, there are no URLs, and the links stay relative.
"""

from pathlib import Path
from runpy import run_path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface


class Addresses(MetadataHookInterface):
    """Adds `readme` and `urls`."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Add the fields."""
        text = Path(self.root, "README.md").read_text(encoding="utf-8")
        if address := self.config["address"]:
            tag = f"v{metadata['version']}"
            text = run_path(str(Path(self.root, ".hatch/readme.py")))["absolute"](text, address, tag)
            metadata["urls"] = {
                "Source": address,
                "Issues": f"{address}/issues",
                "Documentation": f"{address}/tree/{tag}/src/jkroll/guide",
                "Changelog": f"{address}/blob/{tag}/src/jkroll/guide/changes.md",
            }
        metadata["readme"] = {"content-type": "text/markdown", "text": text}
