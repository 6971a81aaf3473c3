"""Generated pages of the documentation, in docs/made/, which is not part of the repository."""

from pathlib import Path

import made_cases
import made_gallery
import made_reference

INCLUDED = ("scene_keys", "columns", "commands", "exit_codes")


def write_pages(docs: Path) -> None:
    """Write the generated pages that have changed. Unchanged files keep their date, so that Sphinx
    does not read them again."""
    made = docs / "made"
    pages = {f"{name}.md": getattr(made_reference, name)() for name in INCLUDED}
    pages["requirements.md"] = made_cases.requirements()
    pages |= {f"cases/{name}.md": text for name, text in made_cases.pages().items()}
    for name, text in pages.items():
        path = made / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    made_gallery.write_gallery(made / "gallery")
