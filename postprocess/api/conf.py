"""Sphinx's settings for jobs/api.sh, which makes pages of the docstrings of the package beside this folder.

Docstrings are plain sentences, written to be read in the code: what reStructuredText would take for markup is escaped here, and paragraphs that are
laid out by spaces (usages, tables, lists of packages, examples) are shown as they stand.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

project = "peterka"
author = "The peterka developers"
release = re.search(r'^version = "(.*)"', (HERE.parent / "pyproject.toml").read_text(), re.MULTILINE).group(1)
extensions = ["sphinx.ext.autodoc"]
default_role = "literal"  # `name` in a docstring
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
highlight_language = "none"
smartquotes = False  # -- stays two hyphens
html_theme = "classic"
html_theme_options = {"nosidebar": "true", "body_max_width": "60em"}
html_copy_source = False
html_show_sourcelink = False
add_module_names = False

CODE = re.compile(r"(`[^`]*`)")
MARKUP = re.compile(r"[*|\\]|(?<=\w)_(?!\w)")


def escaped(line):
    return "".join(part if part.startswith("`") else MARKUP.sub(r"\\\g<0>", part) for part in CODE.split(line))


def is_laid_out(paragraph):
    return any(re.search(r"\S  +\S", line) or line.startswith(" ") for line in paragraph) or paragraph[0].startswith("usage:")


def plain(lines):
    """The lines of a docstring as reStructuredText that shows these lines."""
    result: list[str] = []
    for paragraph in "\n".join(lines).strip("\n").split("\n\n"):
        shown = paragraph.split("\n")
        result += ["::", "", *(f"    {line}" for line in shown)] if is_laid_out(shown) else map(escaped, shown)
        result.append("")
    return result


def setup(app):
    def on_docstring(_app, _what, _name, _object, _options, lines):
        lines[:] = plain(lines)
    app.connect("autodoc-process-docstring", on_docstring)
