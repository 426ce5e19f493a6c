"""Writes the page as a single HTML file with the pictures embedded."""

import re
from base64 import b64encode
from collections.abc import Sequence
from html import escape
from pathlib import Path

from .page import Block, Fields, Heading, Paragraph, Pictures, Table

STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #1a1a1a; }
h1, h2, h3 { line-height: 1.25; } h2 { margin-top: 2.5rem; border-bottom: 1px solid #bbb; } h3 { font-size: 1.05rem; }
table { border-collapse: collapse; display: block; overflow-x: auto; font-size: 0.9rem; }
th, td { border: 1px solid #ccc; padding: 0.3rem 0.5rem; text-align: left; vertical-align: top; }
dl { display: grid; grid-template-columns: 8rem 1fr; margin: 0; } dt { color: #555; } dd { margin: 0; }
figure { display: inline-block; margin: 1rem 1rem 1rem 0; vertical-align: top; width: 22rem; }
figure img { width: 100%; } figcaption { font-size: 0.8rem; color: #555; }
"""


def html(blocks: Sequence[Block], picture_folder: str | Path) -> str:
    """The text of the page; pictures are PNG files in this folder."""
    body = "\n".join(_block(block, Path(picture_folder)) for block in blocks)
    title = next(block.text for block in blocks if isinstance(block, Heading))
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>{escape(title)}</title>\n'
            f"<style>{STYLE}</style>\n</head>\n<body>\n{body}\n</body>\n</html>\n")


def _block(block: Block, folder: Path) -> str:
    match block:
        case Heading(level, text):
            return f"<h{level}>{_text(text)}</h{level}>"
        case Paragraph(text):
            return f"<p>{_text(text)}</p>"
        case Fields(lines):
            return "<dl>" + "".join(f"<dt>{name}</dt><dd>{_text(text)}</dd>" for name, text in lines) + "</dl>"
        case Table(header, rows):
            head = "".join(f"<th>{_text(cell)}</th>" for cell in header)
            body = "".join("<tr>" + "".join(f"<td>{_text(cell)}</td>" for cell in row) + "</tr>" for row in rows)
            return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
        case Pictures(names):
            return "\n".join(_picture(folder, name) for name in names)


def _picture(folder: Path, name: str) -> str:
    data, words = b64encode((folder / f"{name}.png").read_bytes()).decode(), escape(name.replace("_", " "))
    return (f'<figure><img alt="{words}" src="data:image/png;base64,{data}">'
            f"<figcaption>{words}</figcaption></figure>")


def _text(text: str) -> str:
    """Converts the only Markdown that texts use, ** and `."""
    text = re.sub(r"\*\*(.+?)\*\*", r"<strong>\1</strong>", escape(text, quote=False))
    return re.sub(r"`(.+?)`", r"<code>\1</code>", text)
