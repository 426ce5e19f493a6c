"""A stranger's text made harmless for where it is shown: a terminal, a picture, or a page in Markdown or HTML."""

LONGEST = 160  # letters
# What Markdown or HTML may take for more than a letter; a numeric entity is never anything but a letter.
_MARKUP = frozenset("&<>\"'`*_{}[]#!|~\\$:@")
_NAMES = {"&": "&amp;", "<": "&lt;", ">": "&gt;"}  # as everybody writes them


def harmless(text: object, longest: int | None = LONGEST, page: bool = False) -> str:
    """One line of printable letters: controls, breaks and marks that turn the direction of writing are shown as such (\\x1b),
    and what is longer than so many letters (None: any) is cut. `page`: as a piece of Markdown or HTML that says the same."""
    text = "".join(map(_shown, str(text)[: None if longest is None else longest + 1]))
    if longest is not None and len(text) > longest:
        text = text[: longest - 1] + "…"
    return "".join(_as_entity(text, place) for place in range(len(text))) if page else text


def _shown(letter):
    return letter if letter.isprintable() else letter.encode("unicode_escape").decode()


def _as_entity(text, place):
    """Marks that mean something at the beginning of a line, and a point within a name of a host, too."""
    letter, before, after = text[place], text[:place], text[place + 1:place + 2]
    begins = before.strip("0123456789 ") == ""
    markup = letter in _MARKUP and not (letter == ":" and after == " ")
    if markup or (begins and letter in "-+=.)") or (letter == "." and after.isalpha()):
        return _NAMES.get(letter, f"&#{ord(letter)};")
    return letter
