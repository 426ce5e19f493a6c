"""Small faults that can be injected into a C++ file: each a position and its replacement.

Based on the text as formatted by clang-format: binary operators have spaces on both sides, template brackets have none.
Variants that do not compile are not mutants; the caller finds out.
"""

import re
from dataclasses import dataclass

TURNED = {" < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ", " == ": " != ", " != ": " == ",
          " && ": " || ", " || ": " && ", " + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ", " += ": " -= ", " -= ": " += ",
          "std::min(": "std::max(", "std::max(": "std::min(", "true": "false", "false": "true", "if (!": "if ("}
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#[^\n]*|static_assert[^;]*;', re.S | re.M)
INTEGER = re.compile(r"(?<![\w.<'])\d+(?![\w.>'])")
REAL = re.compile(r"(?<![\w.'])(?:\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+)(?![\w'])")
SWAPPED = re.compile(r"\b\w+\(([^(),;{}]+), ([^(),;{}]+)\)")
STATEMENT = re.compile(r"^[ \t]+(?!return\b|co_return\b|using\b|throw\b|break\b|continue\b)"
                       r"[\w.\[\]]+(?:->[\w.\[\]]+)*(?:\([^;{}\n]*\)| [-+*/|&]?= [^;{}\n]*);$", re.M)


@dataclass(frozen=True, order=True)
class Mutant:
    """`after` in place of the file's text from `begin` to `end`."""

    path: str  # below src
    begin: int
    end: int
    after: str

    def put_into(self, text: str) -> str:
        return text[:self.begin] + self.after + text[self.end:]

    def told(self, text: str) -> str:
        """FILE:LINE: the original line -> the mutated line."""
        number, first = text.count("\n", 0, self.begin) + 1, text.rfind("\n", 0, self.begin) + 1
        last = text.find("\n", self.end)
        line = text[first:self.begin] + self.after + text[self.end:last]
        return f"{self.path}:{number}: {' '.join(text[first:last].split())} -> {' '.join(line.split()) or '(left out)'}"


def mutants_of(path: str, text: str) -> list[Mutant]:
    """All mutants of a file, in order."""
    code = NOT_CODE.sub(lambda found: re.sub(r"[^\n]", "\0", found.group()), text)
    found = [(place.start(), place.end(), TURNED[place.group()])
             for place in re.finditer("|".join(map(re.escape, sorted(TURNED, key=len, reverse=True))), code)]
    found += [(place.start(), place.end(), str(int(place.group()) + 1)) for place in INTEGER.finditer(code)]
    found += [(place.start(), place.end(), f"({place.group()} * 1.5)") for place in REAL.finditer(code)]
    found += [(place.start(1), place.end(2), f"{text[slice(*place.span(2))]}, {text[slice(*place.span(1))]}")
              for place in SWAPPED.finditer(code) if text[slice(*place.span(1))] != text[slice(*place.span(2))]]
    found += [(place.start(), place.end(), ";") for place in STATEMENT.finditer(code)]
    return sorted({Mutant(path, *each) for each in found})
