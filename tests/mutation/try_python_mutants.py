"""Puts mutants into postprocess/peterka, all into one copy, and tells which of them the tests in tests/postprocess come upon.

usage: try_python_mutants.py BUILD COUNT SEED

A mutant turns a comparison, a sign, `and` and `or`, moves a number, swaps two arguments or leaves out a call. COUNT of them are drawn at
random, the same ones for the same SEED and code. BUILD/python holds a copy of postprocess in which each stands behind a question for its
number, and a copy of the tests; a first run records which file of tests reaches which mutant, and each is then tried against these alone,
the fastest first. The first failure, or taking ten times as long as without the mutant, counts as caught.

Survivors are printed, with those of equivalent.txt marked. Writes the row of postprocess into the table of tests/README.md.
"""

import ast
import copy
import json
import os
import re
import shutil
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mutants import Mutant, shuffled
from try_mutants import EQUIVALENT, FOLDERS, OWN, ROOT, SURVIVED, run, write_table

TURNED = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.In: ast.NotIn,
          ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div,
          ast.Div: ast.Mult, ast.And: ast.Or, ast.Or: ast.And}
NAMES = {"min": "max", "max": "min", "any": "all", "all": "any", "minimum": "maximum", "maximum": "minimum", "floor": "ceil",
         "ceil": "floor", "argmin": "argmax", "argmax": "argmin"}
MOST_SECONDS = 90  # of a file of tests; slower ones are left out
ASKED = '''"""Which mutant is asked for (tests/mutation/try_python_mutants.py)."""

import atexit
import os

ACTIVE = int(os.environ.get("PETERKA_MUTANT", "0"))
reached = set()


def asked(number):
    reached.add(number)
    return number == ACTIVE


@atexit.register
def record():
    if "PETERKA_REACHED" in os.environ:
        with open(os.environ["PETERKA_REACHED"], "a") as file:
            file.write(" ".join(map(str, reached)) + "\\n")
'''


def is_text(node):
    return isinstance(node, ast.JoinedStr) or isinstance(node, ast.Constant) and isinstance(node.value, str)


def variants(node):
    """(how this node may go wrong) as new nodes that share its children."""
    if isinstance(node, ast.Compare):
        for place, operator in enumerate(node.ops):
            if type(operator) in TURNED:
                yield ast.Compare(node.left, [TURNED[type(each)]() if at == place else each for at, each in enumerate(node.ops)],
                                  node.comparators)
    elif isinstance(node, ast.BinOp) and type(node.op) in TURNED and not any(map(is_text, (node.left, node.right))):
        yield ast.BinOp(node.left, TURNED[type(node.op)](), node.right)
    elif isinstance(node, ast.BoolOp):
        yield ast.BoolOp(TURNED[type(node.op)](), node.values)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.Not, ast.USub)):
        yield node.operand
    elif isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield ast.Constant(not node.value)
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield ast.Constant(node.value + 1 if isinstance(node.value, int) else node.value * 1.5 or 0.5)
    elif isinstance(node, ast.Call):
        if len(node.args) >= 2 and not any(isinstance(each, ast.Starred) for each in node.args) \
                and ast.dump(node.args[0]) != ast.dump(node.args[1]):
            yield ast.Call(node.func, [node.args[1], node.args[0], *node.args[2:]], node.keywords)
        name = node.func.id if isinstance(node.func, ast.Name) else node.func.attr if isinstance(node.func, ast.Attribute) else None
        if name in NAMES:
            free = isinstance(node.func, ast.Name)
            func = ast.Name(NAMES[name], ast.Load()) if free else ast.Attribute(node.func.value, NAMES[name], ast.Load())
            yield ast.Call(func, node.args, node.keywords)


class Put(ast.NodeTransformer):
    """Walks through a module's places, in one order; puts in those of `numbers`, {place: number}."""

    def __init__(self, numbers=None):
        self.numbers, self.found = numbers or {}, []  # found: what each place is, and becomes

    def put(self, node, new, wrap):
        self.found.append((node, ast.unparse(node), ast.unparse(ast.fix_missing_locations(new)) if new else "(left out)"))
        number = self.numbers.get(len(self.found) - 1)
        return wrap(ast.Call(ast.Name("_asked_", ast.Load()), [ast.Constant(number)], [])) if number else None

    def visit(self, node):
        if isinstance(node, (ast.JoinedStr, ast.pattern)):
            return node
        original, out = copy.deepcopy(node) if isinstance(node, (ast.expr, ast.Expr)) else node, None
        for new in variants(original) if isinstance(node, ast.expr) else ():
            out = self.put(original, new, lambda question, new=new: (question, new)) or out
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
            out = self.put(original, None, lambda question: (question, None)) or out
        self.generic_visit(node)
        if out is None:
            return node
        question, new = out
        if new is None:
            return ast.If(ast.UnaryOp(ast.Not(), question), [node], [])
        return ast.IfExp(question, new, node)

    def generic_visit(self, node):
        hints = [(name, getattr(node, name)) for name in ("annotation", "returns") if getattr(node, name, None) is not None]
        for name, _ in hints:
            setattr(node, name, None)
        super().generic_visit(node)
        for name, hint in hints:
            setattr(node, name, hint)
        return node


def mutants_of(path: Path) -> list[Mutant]:
    walk, seen, out = Put(), Counter(), []
    text = path.read_text()
    walk.visit(ast.parse(text))
    name = str(path.relative_to(ROOT))
    for place, (node, before, after) in enumerate(walk.found):
        key = f"{name}: {before} -> {after}"
        seen[key] += 1
        line, changed = in_line(text.splitlines()[node.lineno - 1], node, before, after)
        out.append(Mutant(name, place, node.lineno, changed, line, f"{key} [{seen[key]}]"))
    return out


def in_line(line: str, node: ast.AST, before: str, after: str) -> tuple[str, str]:
    """A node's line and what becomes of it, so that it is told from others alike; of a node of several lines, or a whole one, it alone."""
    if node.end_lineno != node.lineno or isinstance(node, ast.Expr):
        return before, after
    code = line.encode()  # columns count bytes
    return line, (code[:node.col_offset] + after.encode() + code[node.end_col_offset:]).decode()


def told(mutant: Mutant) -> str:
    return " ".join(f"{mutant.path}:{mutant.end}: {mutant.kind} -> {mutant.after}".split())


def mutated(path: Path, numbers: dict[int, int]) -> str:
    tree = Put(numbers).visit(ast.parse(path.read_text()))
    at = next(index for index, node in enumerate(tree.body) if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
              or isinstance(node, ast.ImportFrom) and node.module == "__future__"))
    tree.body.insert(at, ast.ImportFrom("peterka._mutant", [ast.alias("asked", "_asked_")], 0))
    return ast.unparse(ast.fix_missing_locations(tree))


def main(build_folder, count, seed):
    build = Path(build_folder).resolve() / "python"
    files = sorted((ROOT / "postprocess/peterka").rglob("*.py"))
    some = dict(enumerate(shuffled([mutant for file in files for mutant in mutants_of(file)], int(seed))[:int(count)], 1))
    shutil.rmtree(build, ignore_errors=True)
    build.mkdir(parents=True)
    for path in ROOT.iterdir():
        if path.name not in ("tests", "postprocess", "build", ".git"):
            (build / path.name).symlink_to(path)
    for name in ("tests", "postprocess"):
        shutil.copytree(ROOT / name, build / name, ignore=shutil.ignore_patterns("__pycache__", ".mypy_cache"))
    (build / "postprocess/peterka/_mutant.py").write_text(ASKED)
    for path in {mutant.path for mutant in some.values()}:
        (build / path).write_text(mutated(ROOT / path, {mutant.begin: number for number, mutant in some.items() if mutant.path == path}))
    known = {line.rpartition(" # ")[0] for line in (Path(__file__).parent / "equivalent.txt").read_text().splitlines()}
    memory = build.parent / "python_outcomes.json"
    caught = json.loads(memory.read_text()) if memory.exists() else {}
    reached, seconds = {}, {}

    def command(name):
        return ["/usr/bin/python3", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", str(build / "tests/postprocess" / name)]

    def look(name):
        record, begin = build / f"{name}.reached", time.monotonic()
        if run(command(name), MOST_SECONDS, PETERKA_REACHED=str(record)):
            return print(f"{name} fails, or takes long, without any mutant: not used", file=sys.stderr, flush=True)
        seconds[name] = time.monotonic() - begin
        reached[name] = set(map(int, record.read_text().split())) if record.exists() else set()

    def outcome(item):
        number, mutant = item
        if mutant.key in caught:
            return caught[mutant.key]
        for name in sorted((name for name in seconds if number in reached[name]), key=seconds.get):
            if run(command(name), max(30, 10 * seconds[name]), PETERKA_MUTANT=str(number)):
                return f"{FOLDERS} {name}"
        return SURVIVED if any(number in each for each in reached.values()) else f"{SURVIVED} unreached"

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(look, sorted(path.name for path in (build / "tests/postprocess").glob("test_*.py"))))
        counts = Counter()
        for (number, mutant), out in zip(some.items(), pool.map(outcome, some.items())):
            if out.startswith(SURVIVED):
                out = EQUIVALENT if re.sub(r":\d+:", ":", told(mutant), count=1) in known else out
            else:
                caught[mutant.key] = out
                memory.write_text(json.dumps(caught, indent=0))
            counts[out.split()[0]] += 1
            print(f"{out:10} {number:4} {told(mutant)}", flush=True)
    write_table(ROOT / "tests/README.md", {"postprocess": counts})
    print(f"{sum(counts.values())} mutants: {counts[FOLDERS] + counts[OWN]} caught, {counts[EQUIVALENT]} equivalent, "
          f"{counts[SURVIVED]} survived")


if __name__ == "__main__":
    main(*sys.argv[1:])
