"""Writes the page in Markdown; pictures are files in a folder beside it."""

from collections.abc import Sequence
from html import escape

from .page import Block, Fields, Heading, Paragraph, Pictures, Table


def markdown(blocks: Sequence[Block], picture_folder: str) -> str:
    """The text of the page; pictures are PNG files in this folder, given relative to the page."""
    return "\n\n".join(_block(block, picture_folder) for block in blocks) + "\n"


def _block(block: Block, folder: str) -> str:
    match block:
        case Heading(level, text):
            return f"{'#' * level} {_text(text)}"
        case Paragraph(text):
            return _text(text)
        case Fields(lines):
            return "\n".join(f"- {name}: {_text(text)}" for name, text in lines)
        case Table(header, rows):
            table = [header, ["---"] * len(header), *rows]
            return "\n".join("| " + " | ".join(_text(cell).replace("|", "\\|") for cell in line) + " |" for line in table)
        case Pictures(names):
            return "\n".join(f"![{name.replace('_', ' ')}]({folder}/{name}.png)" for name in names)


def _text(text: str) -> str:
    return escape(text, quote=False)
