"""Small faults that can be injected into a C++ file: each a position, its replacement, and how a program can hold both.

Based on the text as formatted by clang-format: binary operators have spaces on both sides, template brackets have none.
Variants that do not compile are not mutants; the caller finds out.
"""

import hashlib
import re
from dataclasses import dataclass, field

TURNED = {" < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ", " == ": " != ", " != ": " == ",
          " && ": " || ", " || ": " && ", " + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ", " += ": " -= ", " -= ": " += ",
          "std::min(": "std::max(", "std::max(": "std::min(", "true": "false", "false": "true", "if (!": "if ("}
INFIX = {" < ": ("Less", ">"), " <= ": ("LessEqual", ">="), " > ": ("Greater", "<"), " >= ": ("GreaterEqual", "<="),
         " == ": ("Equal", "=="), " != ": ("NotEqual", "!="), " + ": ("Plus", "+"), " - ": ("Minus", "-"), " * ": ("Times", "*"),
         " / ": ("Over", "/")}
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#[^\n]*|static_assert[^;]*;'
                      r'|PETERKA_EXPECT[^;]*;|\bif constexpr[^\n]*|\bconcept\b[^;]*;|\brequires\b[^\n]*', re.S | re.M)
INTEGER = re.compile(r"(?<![eE][-+])(?<![\w.<'])\d+(?![\w.>'])")
REAL = re.compile(r"(?<![\w.'])(?:\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+)(?![\w'])")
SWAPPED = re.compile(r"\b\w+\(([^(),;{}\n]+), ([^(),;{}\n]+)\)")
DECLARED = re.compile(r"\bconst |[\w>&] [A-Za-z_]\w*$")  # a parameter, not an argument
STATEMENT = re.compile(r"^[ \t]+(?!return\b|co_return\b|using\b|throw\b|break\b|continue\b)"
                       r"[\w.\[\]]+(?:->[\w.\[\]]+)*(?:\([^;{}\n]*\)| [-+*/|&]?= [^;{}\n]*);$", re.M)
OPENING, CLOSING = "([{", ")]}"


@dataclass(frozen=True, order=True)
class Mutant:
    """`after` in place of the file's text from `begin` to `end`."""

    path: str  # below src
    begin: int
    end: int
    after: str
    kind: str  # what `edits` distinguishes
    key: str = field(compare=False, default="")  # the same as long as its line is

    def told(self, text: str) -> str:
        """FILE:LINE: the original line -> the mutated line."""
        number, first = text.count("\n", 0, self.begin) + 1, text.rfind("\n", 0, self.begin) + 1
        last = text.find("\n", self.end)
        line = text[first:self.begin] + self.after + text[self.end:last]
        return f"{self.path}:{number}: {' '.join(text[first:last].split())} -> {' '.join(line.split()) or '(left out)'}"


def code_of(text: str) -> str:
    """The text, of the same length, without comments, strings and what is no code at run time."""
    return NOT_CODE.sub(lambda found: re.sub(r"[^\n]", "\0", found.group()), text)


def mutants_of(path: str, text: str) -> list[Mutant]:
    """All mutants of a file, in order."""
    code = code_of(text)
    found = [(place.start(), place.end(), TURNED[place.group()], "turned")
             for place in re.finditer("|".join(map(re.escape, sorted(TURNED, key=len, reverse=True))), code)]
    found += [(place.start(), place.end(), str(int(place.group()) + 1), "number") for place in INTEGER.finditer(code)]
    found += [(place.start(), place.end(), f"({place.group()} * 1.5)", "number") for place in REAL.finditer(code)]
    found += [(place.start(1), place.end(2), f"{text[slice(*place.span(2))]}, {text[slice(*place.span(1))]}", "swapped")
              for place in SWAPPED.finditer(code) if text[slice(*place.span(1))] != text[slice(*place.span(2))]
              and not any(DECLARED.search(part) for part in place.groups())]
    found += [(place.start() + len(place.group()) - len(place.group().lstrip()), place.end(), ";", "left out")
              for place in STATEMENT.finditer(code) if code[:place.start()].rstrip()[-1:] in (";", "{", "}", ")", "\0", "")]
    mutants, seen = [], {}
    for each in sorted(set(found)):
        name = re.sub(r":\d+:", ":", Mutant(path, *each).told(text), count=1)
        seen[name] = seen.get(name, 0) + 1
        mutants.append(Mutant(path, *each, key=f"{name} [{seen[name]}]"))
    return mutants


def known_faults(lines: list[str], text_of) -> list[Mutant]:
    """Those that a list names, `path | text | what replaces it`; the text is in that file once."""
    out = []
    for line in lines:
        path, before, after = line.split(" | ")
        text = text_of(path)
        if text.count(before) != 1:
            raise SystemExit(f"{path} has {before!r} {text.count(before)} times")
        begin = text.index(before)
        out.append(Mutant(path, begin, begin + len(before), after, "left out" if after == ";" else "number", f"known: {line}"))
    return out


def shuffled(mutants: list[Mutant], seed: int) -> list[Mutant]:
    """In an order of chance that changes little where the code does."""
    return sorted(mutants, key=lambda mutant: hashlib.sha1(f"{seed} {mutant.key}".encode()).digest())


BEFORE = re.compile(r"(\|\||[?:]|return) |(<<|>>|[-+*/%&|^])?=[ \n]")  # an operand of || or &&


def operand_begin(code: str, place: int) -> int:
    """Where the operand of || or && that ends here begins."""
    depth, index = 0, place
    while index > 0:
        index -= 1
        if code[index] in CLOSING:
            if depth == 0 and code[index] == "}":
                return index + 1
            depth += 1
        elif code[index] in OPENING:
            if depth == 0:
                return index + 1
            depth -= 1
        elif depth == 0 and (code[index] in ";," or code[index - 1] in " \n\t" and BEFORE.match(code, index)):
            return index + len(re.match(r"\w+|\W+?(?=[ ;,\w(]|$)", code[index:]).group())
    return 0


def operand_end(code: str, place: int) -> int:
    """Where the operand of || or && that begins here ends."""
    depth = 0
    for index in range(place, len(code)):
        if code[index] in OPENING:
            depth += 1
        elif code[index] in CLOSING:
            if depth == 0:
                return index
            depth -= 1
        elif depth == 0 and (code[index] in ";," or code.startswith((" || ", " ? ", " : "), index)):
            return index
    return len(code)


def statement_end(code: str, place: int) -> int:
    """Where what is added here ends: its conditions and alternatives, too."""
    depth = 0
    for index in range(place, len(code)):
        depth += (code[index] in OPENING) - (code[index] in CLOSING)
        if depth < 0 or depth == 0 and code[index] in ";,":
            return index
    return len(code)


class Constants:
    """Where a file's text is in a constexpr function, and where in the definition of a constexpr variable."""

    def __init__(self, code: str):
        self.functions, self.variables = [], []  # (begin, end), the latter from the word constexpr
        for place in re.finditer(r"\bconstexpr\b", code):
            depth, parameters, initialized = 0, False, False
            for index in range(place.end(), len(code)):
                if code[index] in OPENING:
                    if code[index] == "{" and depth == 0 and parameters and not initialized:
                        self.functions.append((place.start(), closing(code, index)))
                        break
                    parameters |= code[index] == "(" and depth == 0
                    depth += 1
                elif code[index] in CLOSING:
                    depth -= 1
                elif depth == 0 and code.startswith(" = ", index):
                    initialized = True
                elif depth == 0 and code[index] == ";":
                    self.variables.append((place.start(), index))
                    break

    def in_function(self, place: int) -> bool:
        return any(begin <= place < end for begin, end in self.functions)

    def variable(self, place: int) -> int | None:
        """Where the constexpr of the variable stands."""
        return next((begin for begin, end in self.variables if begin <= place < end), None)


def closing(code: str, place: int) -> int:
    depth = 0
    for index in range(place, len(code)):
        depth += (code[index] in OPENING) - (code[index] in CLOSING)
        if depth == 0:
            return index + 1
    return len(code)


def edits(mutant: Mutant, number: int, text: str, code: str, constants: Constants) -> list[tuple[int, int, str]]:
    """What to write in place of which text, so that the program has both: the mutated way where `number` is asked for."""
    begin, end, variable = mutant.begin, mutant.end, constants.variable(mutant.begin)
    in_constexpr = variable is None and constants.in_function(begin)
    template = f"<{number}, {'true' if in_constexpr else 'false'}"
    asked = f"peterka_mutant::asked{template}>()"
    before, out = text[begin:end], []
    if variable is not None and "\n" in code[variable:begin]:
        return []  # a table, from which others are computed when it is compiled
    if variable is not None:
        out.append((variable, variable + len("constexpr"), "const"))
    if mutant.kind == "number":
        return out + [(begin, begin, f"({asked} ? ({mutant.after}) : ("), (end, end, "))")]
    if mutant.kind == "left out":
        return out + [(begin, begin, f"{{ if (!{asked}) {{ "), (end, end, " } }")]
    if mutant.kind == "swapped":
        first, second = before.split(", ")
        return out + [(begin, end, f"{asked} ? ({second}) : ({first}), {asked} ? ({first}) : ({second})")]
    if before in INFIX:
        name, second = INFIX[before]
        return out + [(end, end, f"peterka_mutant::{name}{template}>{{}} {second} ")]
    if before in (" && ", " || "):
        left, right = operand_begin(code, begin), operand_end(code, end)
        left += len(code[left:]) - len(code[left:].lstrip())
        return out + [(left, left, "((bool("), (begin, begin, f") != {asked})"), (end, end, "(bool("),
                      (right, right, f") != {asked})) != {asked}")] if left < begin else []
    if before in (" += ", " -= "):
        return out + [(end, end, f"({asked} ? -1 : 1) * ("), (last := statement_end(code, end), last, ")")]
    if before in ("true", "false"):
        return out + [(begin, end, f"({'!' if before == 'true' else ''}{asked})")]
    if before == "if (!":
        return out + [(end - 1, end - 1, f"{asked} != ")]
    name = "true" if before == "std::min(" else "false"
    return out + [(begin, end, f"peterka_mutant::bound{template}, {name}>(")]


def with_all(text: str, mutants: dict[int, Mutant]) -> tuple[str, list[int]]:
    """The text with these mutants, {number: mutant}, and the numbers of those that found no place beside the others."""
    code = code_of(text)
    constants = Constants(code)
    pieces, taken, left = [], [], []
    for number, mutant in sorted(mutants.items(), key=lambda item: (item[1].kind == "swapped", item[1].end - item[1].begin)):
        mine = edits(mutant, number, text, code, constants)
        spans = [(begin, end) for begin, end, what in mine if end > begin and what != "const"]
        if not mine or any(begin < other_end and other_begin < end or begin < place < end
                           for begin, end in spans for other_begin, other_end, place in taken) \
                or any(other_begin < place < other_end for place, _, _ in mine for other_begin, other_end, _ in taken):
            left.append(number)
            continue
        taken += [(begin, end, begin) for begin, end, _ in mine]
        # of insertions at one place: what closes first, the inner before the outer; then operators; then what opens, outer first
        first, last = min(begin for begin, _, _ in mine), max(end for _, end, _ in mine)
        infix = len([1 for _, _, what in mine if what != "const"]) == 1
        for index, (begin, end, what) in enumerate(mine):
            closes = not infix and end == begin and what.startswith((")", " }"))
            order = (0, last - first) if closes else (1, 0) if infix and end == begin else (2, -(last - first))
            pieces.append((begin, *order, index, end, what))
    out, done = [], 0
    for begin, _, _, _, end, what in sorted(set(pieces)):
        if begin < done:  # a constexpr that another mutant of the variable has turned already
            continue
        out += [text[done:begin], what]
        done = end
    return "".join(out) + text[done:], left


def lines_of(mutant: Mutant, text: str) -> range:
    first = text.count("\n", 0, mutant.begin) + 1
    return range(first, first + text.count("\n", mutant.begin, mutant.end) + 1)
