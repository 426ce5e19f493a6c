"""Sanitises untrusted text for display in a terminal, a picture, or a page in Markdown or HTML."""

LONGEST = 160  # letters
# Characters with a meaning in Markdown or HTML; a numeric entity is always literal.
_MARKUP = frozenset("&<>\"'`*_{}[]#!|~\\$:@")
_NAMES = {"&": "&amp;", "<": "&lt;", ">": "&gt;"}  # the customary named entities


def harmless(text: object, longest: int | None = LONGEST, page: bool = False) -> str:
    """One line of printable characters: controls, line breaks and bidirectional marks are escaped (\\x1b), and text longer
    than `longest` (None: unlimited) is cut. `page`: as Markdown or HTML source that displays this text."""
    text = "".join(map(_shown, str(text)[: None if longest is None else longest + 1]))
    if longest is not None and len(text) > longest:
        text = text[: longest - 1] + "…"
    return "".join(_as_entity(text, place) for place in range(len(text))) if page else text


def _shown(letter: str) -> str:
    return letter if letter.isprintable() else letter.encode("unicode_escape").decode()


def _as_entity(text: str, place: int) -> str:
    """Whether a character has a meaning at this place: at the beginning of a line, or a point within a host name."""
    letter, before, after = text[place], text[:place], text[place + 1:place + 2]
    begins = before.strip("0123456789 ") == ""
    markup = letter in _MARKUP and not (letter == ":" and after == " ")
    if markup or (begins and letter in "-+=.)") or (letter == "." and after.isalpha()):
        return _NAMES.get(letter, f"&#{ord(letter)};")
    return letter
