"""Puts mutants into the code, one by one, and tells which of them the unit tests come upon.

usage: try_mutants.py BUILD COUNT SEED [FOLDER...]

COUNT mutants are drawn at random, all alike, from the files of these folders of src, or of all; the same ones for the same SEED
and code. Each is compiled, with the units that include its file, and linked into a unit_tests of its own; BUILD, whose sources
are compiled file by file, stays as it is. The tests in unit/FOLDER_FILE*.cpp run first, then the folder's, then all; the first
failure, a crash, or taking ten times as long as without the mutant counts as caught. What doesn't compile is drawn anew. Kernels and
headers that more than MOST_UNITS units include take minutes each, and are left out.

Survivors are printed. A line of equivalent.txt, as printed, says of one that it changes nothing that anyone could see, and why.
Writes the rows of these folders into the table of tests/README.md.
"""

import json
import os
import random
import re
import shlex
import subprocess
import sys
import tempfile
import time
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from datetime import date
from pathlib import Path

from mutants import Mutant, mutants_of

ROOT = Path(__file__).parents[2]
MOST_UNITS = 6
LEAST_SECONDS = 60  # before a test counts as endless
BEGIN, END = "<!-- tests/mutation.sh writes this table -->\n", "<!-- end of the mutants -->\n"
HEAD = "| folder | drawn | caught by the file's own tests | by the folder's | by others | equivalent | survived | on |\n|" + "---|" * 8
NO_MUTANT, OWN, FOLDERS, OTHERS, EQUIVALENT, SURVIVED = "none", "own", "folder", "others", "equivalent", "survived"


def output(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


class Build:
    """How a file is compiled and linked into unit_tests."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.compile = {entry["file"]: entry for entry in json.loads((folder / "compile_commands.json").read_text())}
        commands = output("ninja", "-C", folder, "-t", "commands", "unit_tests").splitlines()
        self.link = next(shlex.split(line.removeprefix(": && ").split(" && ")[0]) for line in reversed(commands)
                         if " -o tests/unit_tests " in line)
        self.units = defaultdict(list)  # {header: objects of the units that include it}
        unit = None
        for line in output("ninja", "-C", folder, "-t", "deps").splitlines():
            unit = unit if line.startswith(" ") else line.split(":")[0]
            if line.startswith(f"    {ROOT}/src/"):
                self.units[line.strip()].append(unit)
        self.source = {self.object_of(entry): file for file, entry in self.compile.items()}

    @staticmethod
    def object_of(entry):
        words = shlex.split(entry["command"])
        return words[words.index("-o") + 1]

    def sources(self, path: Path) -> list[str]:
        """The files to recompile when a file changes."""
        linked = [self.source[unit] for unit in self.units[str(path)] if unit in self.source]
        return [file for file in ([str(path)] if path.suffix == ".cpp" else linked) if "src/page/" not in file]

    def program(self, path: Path, text: str, work: Path) -> Path | None:
        """unit_tests with this text in place of a file; None if it cannot be built."""
        changed = work / "src" / path.relative_to(ROOT / "src")
        changed.parent.mkdir(parents=True)
        changed.write_text(text)
        link = list(self.link)
        for number, file in enumerate(self.sources(path)):
            words = shlex.split(self.compile[file]["command"])
            unit, new = words[words.index("-o") + 1], str(work / f"{number}.o")
            words[words.index("-o") + 1] = new
            words = [str(changed) if word == str(path) else word for word in words if word != "-Werror"]
            if subprocess.run([words[0], f"-I{work}/src", *words[1:], "-w"], cwd=self.folder, capture_output=True).returncode:
                return None
            # ahead of the library, whose own version is then not used
            link = [new if word == unit else word for word in link] if unit in link else [link[0], new, *link[1:]]
        program = work / "unit_tests"
        link[link.index("-o") + 1] = str(program)
        return program if subprocess.run(link, cwd=self.folder, capture_output=True).returncode == 0 else None


def suites(pattern: str) -> list[str]:
    """The names of the tests in unit/PATTERN.cpp."""
    names = (re.findall(r"^TEST(?:_[FP])?\((\w+),", file.read_text(), re.M) for file in (ROOT / "tests/unit").glob(f"{pattern}.cpp"))
    return sorted(set(sum(names, [])))


def stages(path: Path) -> list[tuple[str, str]]:
    """(level at which it is caught, the tests to run), in order."""
    folder, stem = path.parent.name, path.stem.removesuffix("-inl")
    own, folders = suites(f"{folder}_{stem}*"), suites(f"{folder}_*")
    others = [name for name in suites("*") if name not in folders]
    return [(who, ":".join(f"{name}.*:*/{name}.*" for name in names))
            for who, names in ((OWN, own), (FOLDERS, [name for name in folders if name not in own]), (OTHERS, others)) if names]


class Trial:
    def __init__(self, build: Build):
        self.build = build
        self.seconds = {}  # {tests: how long they take without a mutant}

    def limit(self, tests: str) -> float:
        if tests not in self.seconds:
            begin = time.monotonic()
            if self.fails(self.build.folder / "tests/unit_tests", tests, None):
                raise SystemExit(f"a test fails without any mutant: run {self.build.folder}/tests/unit_tests")
            self.seconds[tests] = max(LEAST_SECONDS, 10 * (time.monotonic() - begin))
        return self.seconds[tests]

    @staticmethod
    def fails(program: Path, tests: str, limit: float | None) -> bool:
        try:
            return subprocess.run([program, f"--gtest_filter={tests}", "--gtest_brief=1", "--gtest_fail_fast"], timeout=limit,
                                  capture_output=True, env=os.environ | {"OMPI_MCA_btl": "self"}).returncode != 0
        except subprocess.TimeoutExpired:
            return True

    def outcome(self, mutant: Mutant) -> str:
        path = ROOT / "src" / mutant.path
        with tempfile.TemporaryDirectory() as work:
            program = self.build.program(path, mutant.put_into(path.read_text()), Path(work))
            if program is None:
                return NO_MUTANT
            return next((who for who, tests in stages(path) if self.fails(program, tests, self.limit(tests))), SURVIVED)


def drawn(build: Build, folders: list[str], seed: int):
    """All mutants, in the order of sampling."""
    files = [file for file in sorted((ROOT / "src").glob("*/*.[ch]pp")) if not folders or file.parent.name in folders]
    files = [file for file in files if not file.stem.endswith(("_kernel", "-inl"))
             and 0 < len(build.sources(file)) <= MOST_UNITS and all(each in build.compile for each in build.sources(file))]
    every = [mutant for file in files for mutant in mutants_of(str(file.relative_to(ROOT / "src")), file.read_text())]
    random.Random(seed).shuffle(every)
    return every


def write_table(page: Path, counts: dict[str, Counter]) -> None:
    before, rest = page.read_text().split(BEGIN)
    table, after = rest.split(END)
    rows = {line.split("|")[1].strip(): line for line in table.splitlines()[2:]}
    for folder, count in counts.items():
        numbers = [sum(count.values()), *(count[each] for each in (OWN, FOLDERS, OTHERS, EQUIVALENT, SURVIVED))]
        rows[folder] = f"| {folder} | {' | '.join(map(str, numbers))} | {date.today().isoformat()} |"
    page.write_text(before + BEGIN + HEAD + "\n" + "".join(f"{rows[name]}\n" for name in sorted(rows)) + END + after)


def main(build_folder, count, seed, *folders):
    unknown = [folder for folder in folders if not (ROOT / "src" / folder).is_dir()]
    if unknown:
        sys.exit(f"src has no folder {', '.join(unknown)}")
    build = Build(Path(build_folder).resolve())
    trial, counts, left = Trial(build), defaultdict(Counter), int(count)
    known = {line.split(" # ")[0] for line in (Path(__file__).parent / "equivalent.txt").read_text().splitlines()}
    every = iter(drawn(build, list(folders), int(seed)))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        while left > 0 and (some := [mutant for _, mutant in zip(range(left), every)]):
            for mutant, outcome in zip(some, pool.map(trial.outcome, some)):
                if outcome == NO_MUTANT:
                    continue
                left -= 1
                told = mutant.told((ROOT / "src" / mutant.path).read_text())
                if outcome == SURVIVED and re.sub(r":\d+:", ":", told, count=1) in known:
                    outcome = EQUIVALENT
                counts[mutant.path.split("/")[0]][outcome] += 1
                print(f"{outcome:10} {told}", flush=True)
    write_table(ROOT / "tests/README.md", counts)
    total = sum(counts.values(), Counter())
    print(f"{sum(total.values())} mutants: {total[OWN] + total[FOLDERS] + total[OTHERS]} caught, {total[EQUIVALENT]} equivalent, "
          f"{total[SURVIVED]} survived")


if __name__ == "__main__":
    main(*sys.argv[1:])
