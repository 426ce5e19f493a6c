"""Puts mutants into the code, all into one build, and tells which of them the tests come upon.

usage: try_mutants.py BUILD COUNT SEED [FOLDER...]

COUNT mutants are drawn at random, all alike, from the files of these folders of src, or of all; the same ones for the same SEED
and code. A copy of the sources in BUILD/tree holds all of them, each behind a question for its number (mutant.hpp), so that one build
serves all; what doesn't compile is taken out and others are drawn. A first run records which suites of unit tests, tests of ranks and
files of END_TO_END reach which mutant. Each mutant is then tried against these alone, the environment's PETERKA_MUTANT naming it:
suites of unit/FOLDER_FILE*.cpp first, then the folder's, then the others, then the tests of ranks and of the program, then suites that
take long. The first failure, a crash, or taking ten times as long as without the mutant counts as caught.

Survivors are printed. A line of equivalent.txt, as printed, says of one that it changes nothing that anyone could see, and why.
The faults of known_faults.txt, which tests once missed, are tried as well, and not counted. BUILD/outcomes.json keeps what was caught,
which isn't tried again; BUILD/build/passed.json which suites missed what, which are tried again once they change. Writes the rows of
these folders into the table of tests/README.md.
"""

import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from datetime import date
from pathlib import Path

from mutants import Mutant, known_faults, lines_of, mutants_of, shuffled, with_all

ROOT = Path(__file__).parents[2]
HERE = Path(__file__).parent
SPARE = 1.3  # as many are drawn at first, for those that don't compile
MOST = 4000  # as mutant.hpp has room for
SLOW = 3  # seconds of a suite that comes last
MOST_SECONDS = 120  # of a file of tests of the whole program; slower ones are left out
LEAST_SECONDS = 30  # before a test counts as endless
SHARED_MPI = {"OMPI_MCA_rmaps_base_oversubscribe": "1"}
# Tests of the whole program for what unit tests miss, by folder of src.
END_TO_END = {
    "attractors": ["many_starts", "known_motions"], "certificate": ["certificates"], "curves": ["curves", "unstable_branches"],
    "findings": ["sweeps", "sweeps_with_starts"], "hdf5": ["stop_and_resume"], "job": ["commands"], "map_file": ["sweeps_with_starts", "audit_of_starts", "stop_and_resume"],
    "noise": ["mean_lives"], "parallel": ["stop_and_resume"], "refine": ["refinement"], "regime": ["sweeps", "sweeps_with_starts"], "report": ["sweeps_with_starts", "commands"],
    "run": ["failed_cells", "commands", "audit_of_starts"], "study": ["study"], "support": ["commands"], "trace": ["trace"]}
BEGIN, END = "<!-- tests/mutation.sh writes this table -->\n", "<!-- end of the mutants -->\n"
HEAD = ("| folder | tried | caught by the file's own unit tests | by the folder's | by others | by tests of ranks or of the program "
        "| equivalent | survived | on |\n|" + "---|" * 9)
OWN, FOLDERS, OTHERS, WHOLE, EQUIVALENT, SURVIVED = "own", "folder", "others", "whole", "equivalent", "survived"


def output(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


def write(path: Path, text: str) -> None:
    """Leaves a file alone that has this text already, so that nothing is compiled for it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.is_symlink() or path.read_text() != text:
        path.unlink(missing_ok=True)
        path.write_text(text)


def run(command, limit, **variables) -> bool:
    """Whether it fails, or takes too long."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
                               env=os.environ | SHARED_MPI | {"PYTHONDONTWRITEBYTECODE": "1"} | variables)
    try:
        return process.wait(limit) != 0
    except subprocess.TimeoutExpired:
        return True
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


class Tree:
    """The copy of the sources that holds all mutants."""

    def __init__(self, build: Path, mutants: dict[int, Mutant]):
        self.build, self.tree, self.mutants = build / "build", build / "tree", mutants
        self.keys = {number: mutant.key for number, mutant in mutants.items()}
        refused = self.build / "refused.json"  # what didn't compile
        self.refused_before = set(json.loads(refused.read_text())) if refused.exists() else set()
        self.drop([number for number, key in self.keys.items() if key in self.refused_before])
        self.texts = {path: path.read_text() for path in sorted((ROOT / "src").rglob("*")) if path.is_file()}

    def write(self) -> None:
        of_file = defaultdict(dict)
        for number, mutant in self.mutants.items():
            of_file[mutant.path][number] = mutant
        for path, text in self.texts.items():
            name = str(path.relative_to(ROOT / "src"))
            if name in of_file:
                text, left = with_all(text, of_file[name])
                self.drop(left)
            write(self.tree / "src" / name, text)
        for path in (self.tree / "src").rglob("*"):
            if path.is_file() and ROOT / "src" / path.relative_to(self.tree / "src") not in self.texts:
                path.unlink()
        for folder in (ROOT, ROOT / "tests"):
            to = self.tree / folder.relative_to(ROOT)
            to.mkdir(exist_ok=True)
            for path in folder.iterdir():
                if path.name not in ("src", "tests", "unit", "build", ".git", "CMakeLists.txt"):
                    (to / path.name).unlink(missing_ok=True)
                    (to / path.name).symlink_to(path)
        for path in (self.tree / "tests/unit").glob("*"):
            if path.is_symlink() and not path.exists():
                path.unlink()
        for path in (ROOT / "tests/unit").iterdir():
            write(self.tree / "tests/unit" / path.name, path.read_text())
        recorder = (HERE / "record.cpp").read_text()
        write(self.tree / "tests/unit/mutation_record.cpp", "#define PETERKA_RECORD_SUITES\n" + recorder)
        write(self.tree / "src/support/mutation_record.cpp", "#define PETERKA_RECORD_PROGRAM\n" + recorder)
        write(self.tree / "CMakeLists.txt", (ROOT / "CMakeLists.txt").read_text())
        write(self.tree / "tests/CMakeLists.txt", (ROOT / "tests/CMakeLists.txt").read_text())

    def drop(self, numbers) -> None:
        for number in numbers:
            self.mutants.pop(number, None)

    def make(self) -> None:
        """Builds all, without the mutants that don't compile."""
        (self.build / "generated").mkdir(parents=True, exist_ok=True)
        while True:
            self.write()
            log = self.build / "log"
            if not (self.build / "build.ninja").exists():
                # One instruction set of the kernels is enough.
                subprocess.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DBUILD_TESTING=ON",
                                "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON", "-DPETERKA_UNITY_TESTS=ON",
                                f"-DCMAKE_CXX_FLAGS=-w -fmax-errors=0 -include {HERE}/mutant.hpp -DHWY_COMPILE_ONLY_STATIC",
                                "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"], check=True, stdout=subprocess.DEVNULL)
            with log.open("w") as to:
                done = subprocess.run(["ninja", "-C", self.build, "-j2", "-k", "0", "unit_tests", "mpi_tests", "peterka", "dealing_check"],
                                      stdout=to, stderr=to, env=os.environ | {"LC_ALL": "C"})
            if done.returncode == 0:
                return
            refused = self.refused(log.read_text())
            if not refused:
                sys.exit(f"the copy in {self.tree} doesn't build: {log}")
            print(f"{len(refused)} don't compile", file=sys.stderr, flush=True)
            self.drop(refused)
            self.refused_before.update(self.keys[number] for number in refused)
            (self.build / "refused.json").write_text(json.dumps(sorted(self.refused_before), indent=0))

    def refused(self, log: str) -> set[int]:
        """The mutants that the compiler names in errors, or on the lines that it names, or nearest to them."""
        if named := {int(number) for number in re.findall(r" error: .*asked\(\) \[with int number = (\d+);.*in a constant expression", log)}:
            return named
        places = re.findall(r"\btree/src/([^:\s]+):(\d+):\d+:\s+(?:fatal )?(?:error|required)", log)
        at = defaultdict(set)
        for number, mutant in self.mutants.items():
            at[mutant.path].add((number, lines_of(mutant, self.texts[ROOT / "src" / mutant.path])))
        for reach in (0, 2, 8):
            found = {number for path, line in places for number, lines in at[path]
                     if lines.start - reach <= int(line) < lines.stop + reach}
            if found:
                return found
        return set()


def suites(pattern: str) -> set[str]:
    """The names of the suites in unit/PATTERN.cpp."""
    return {name for file in (ROOT / "tests/unit").glob(f"{pattern}.cpp")
            for name in re.findall(r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+),", file.read_text(), re.M)}


def versions() -> dict[str, str]:
    """{suite: hash of the files of its tests}."""
    texts = defaultdict(str)
    for file in sorted((ROOT / "tests/unit").glob("*.cpp")):
        for name in suites(file.stem):
            texts[name] += file.read_text()
    return {name: hashlib.sha1(text.encode()).hexdigest() for name, text in texts.items()}


class Trial:
    def __init__(self, tree: Tree):
        self.build = tree.build
        self.versions = versions()
        self.passed_file = self.build / "passed.json"  # {mutant: {suite that missed it: its version}}
        self.passed = json.loads(self.passed_file.read_text()) if self.passed_file.exists() else {}
        self.unit = [str(self.build / "tests/unit_tests"), "--gtest_brief=1", "--gtest_fail_fast"]
        self.whole = {"mpi": ["mpiexec", "-n", "2", str(self.build / "tests/mpi_tests")]}
        self.whole |= {name: ["/usr/bin/python3", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider",
                              str(ROOT / f"tests/end_to_end/test_{name}.py")] for name in sum(END_TO_END.values(), [])}
        self.variables = {"PETERKA_BINARY": str(self.build / "peterka"), "MPIEXEC": shutil.which("mpiexec"),
                          "PYTHONPATH": f"{ROOT}/tests/endurance:{ROOT}/tests/end_to_end"}
        self.reached, self.seconds = {}, {}  # {suite or name: numbers}, {the same: seconds}

    def look(self) -> None:
        """Records what reaches which mutant, and how long it takes: of suites that are new or changed."""
        file, record = self.build / "looked.json", self.build / "reached"
        looked = json.loads(file.read_text()) if file.exists() else {}  # {suite: [version, seconds, numbers]}
        listed = output(self.unit[0], "--gtest_list_tests")
        names = [line.split("#")[0].strip().rstrip(".") for line in listed.splitlines()[1:] if not line.startswith(" ")]
        new = [name for name in names if name not in looked or looked[name][0] != self.version(name)]
        record.unlink(missing_ok=True)
        parts = [part for part in (new[place::os.cpu_count()] for place in range(os.cpu_count())) if part]
        told = [self.build / f"unit_{place}.json" for place in range(len(parts))]

        def fails(place):
            names = ":".join(f"{name}.*" for name in parts[place])
            return run([self.unit[0], f"--gtest_output=json:{told[place]}", f"--gtest_filter={names}"], None, PETERKA_REACHED=str(record))

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            if any(pool.map(fails, range(len(parts)))):
                sys.exit(f"a test fails without any mutant: run {self.unit[0]}")
        reached, always = defaultdict(set), set()
        for name, numbers in (line.rsplit(":", 1) for line in record.read_text().splitlines()) if parts else ():
            (reached[name] if name else always).update(map(int, numbers.split()))
        for suite in (suite for each in told for suite in json.loads(each.read_text())["testsuites"]):
            name = suite["name"]
            looked[name] = [self.version(name), float(suite["time"].rstrip("s")), sorted(reached[name] | always)]
        file.write_text(json.dumps(looked))
        self.seconds = {name: looked[name][1] for name in names if name in looked}
        self.reached = {name: set(looked[name][2]) for name in names if name in looked}

    def look_at_the_whole(self, folders: set[str], pool) -> None:
        """The same of the tests of ranks, and of the program for these folders."""
        wanted = [name for name in self.whole if name == "mpi" or any(name in END_TO_END.get(folder, []) for folder in folders)]
        self.whole = {name: self.whole[name] for name in wanted}

        def look(name):
            record, begin = self.build / f"reached_{name.replace('/', '_')}", time.monotonic()
            record.unlink(missing_ok=True)
            fails = run(self.whole[name], MOST_SECONDS, PETERKA_REACHED=str(record), **self.variables)
            return name, fails, time.monotonic() - begin, record

        for name, fails, seconds, record in pool.map(look, wanted):
            if fails:
                print(f"{name} fails, or takes long, without any mutant: not used", file=sys.stderr, flush=True)
                del self.whole[name]
                continue
            self.seconds[name] = seconds
            self.reached[name] = {int(each) for line in record.read_text().splitlines() for each in line.rsplit(":", 1)[1].split()}
        self.whole = dict(sorted(self.whole.items(), key=lambda item: self.seconds[item[0]]))

    def by_units(self, number: int, mutant: Mutant) -> str | None:
        """Which unit tests catch it, of suites that don't take long."""
        return self.by_suites(number, mutant, False)

    def by_suites(self, number: int, mutant: Mutant, slow: bool) -> str | None:
        path = Path(mutant.path)
        folder, stem = path.parent.name, path.stem.removesuffix("-inl")
        own, folders = suites(f"{folder}_{stem}*"), suites(f"{folder}_*")
        passed = self.passed.setdefault(mutant.key, {})
        names = [name for name in self.reached if number in self.reached[name] and name not in self.whole
                 and passed.get(name, "none") != self.version(name) and slow == (self.seconds[name] > SLOW)]
        of = {name: OWN if bare in own else FOLDERS if bare in folders else OTHERS for name in names for bare in [name.split("/")[-1]]
              + ([name.split("/")[0]] if name.split("/")[0] in folders else [])}
        rank = [OWN, FOLDERS, OTHERS].index
        left = sorted(names, key=lambda name: (rank(of[name]), self.seconds[name]))
        while left:
            now = [left.pop(0)]
            while left and of[left[0]] == of[now[0]] and sum(map(self.seconds.get, now)) + self.seconds[left[0]] < 2:
                now.append(left.pop(0))
            limit = max(LEAST_SECONDS, 10 * sum(map(self.seconds.get, now)))
            if run([*self.unit, "--gtest_filter=" + ":".join(f"{name}.*" for name in now)], limit, PETERKA_MUTANT=str(number)):
                return of[now[0]]
            passed.update({name: self.version(name) for name in now})
        return None

    def version(self, name: str) -> str | None:
        return next((self.versions[part] for part in reversed(name.split("/")) if part in self.versions), None)

    def by_the_whole(self, number: int, mutant: Mutant) -> str:
        """Which others do."""
        for name, command in self.whole.items():
            if name != "mpi" and name not in END_TO_END.get(mutant.path.split("/")[0], []):
                continue
            if number in self.reached[name] and run(command, max(LEAST_SECONDS, 10 * self.seconds[name]), PETERKA_MUTANT=str(number),
                                                    **self.variables):
                return f"{WHOLE} {name}"
        if out := self.by_suites(number, mutant, True):
            return out
        return SURVIVED if any(number in some for some in self.reached.values()) else f"{SURVIVED} unreached"


def drawn(folders: list[str], seed: int) -> list[Mutant]:
    """All mutants, in the order of sampling."""
    files = [file for file in sorted((ROOT / "src").glob("*/*.[ch]pp")) if not folders or file.parent.name in folders]
    files = [file for file in files if file.parent.name != "page"]  # compiled for browsers, and tested there
    return shuffled([mutant for file in files for mutant in mutants_of(str(file.relative_to(ROOT / "src")), file.read_text())], seed)


def numbered(file: Path, wanted: list, known_ones: list[Mutant], draw) -> dict[int, Mutant]:
    """The mutants of a build: those drawn for it before, as far as the code still has them, so that little is compiled anew."""
    everywhere = {mutant.key: mutant for mutant in [*known_ones, *drawn([], 0)]}
    before = json.loads(file.read_text()) if file.exists() else {}
    if before.get("wanted") != wanted:
        before = {"wanted": wanted, "keys": [mutant.key for mutant in [*known_ones, *draw()]]}
    before["keys"] += [mutant.key for mutant in known_ones if mutant.key not in before["keys"]]
    file.write_text(json.dumps(before, indent=0))
    return {number: everywhere[key] for number, key in enumerate(before["keys"], 1) if key in everywhere}


def write_table(page: Path, counts: dict[str, Counter]) -> None:
    before, rest = page.read_text().split(BEGIN)
    table, after = rest.split(END)
    rows = {line.split("|")[1].strip(): line for line in table.splitlines()[2:]}
    for folder, count in counts.items():
        numbers = [sum(count.values()), *(count[each] for each in (OWN, FOLDERS, OTHERS, WHOLE, EQUIVALENT, SURVIVED))]
        rows[folder] = f"| {folder} | {' | '.join(map(str, numbers))} | {date.today().isoformat()} |"
    page.write_text(before + BEGIN + HEAD + "\n" + "".join(f"{rows[name]}\n" for name in sorted(rows)) + END + after)


def main(build_folder, count, seed, *folders):
    unknown = [folder for folder in folders if not (ROOT / "src" / folder).is_dir()]
    if unknown:
        sys.exit(f"src has no folder {', '.join(unknown)}")
    build, count = Path(build_folder).resolve(), int(count)
    known = {line.split(" # ")[0] for line in (HERE / "equivalent.txt").read_text().splitlines()}
    memory = build / "outcomes.json"
    caught = json.loads(memory.read_text()) if memory.exists() else {}
    known_ones = known_faults((HERE / "known_faults.txt").read_text().splitlines(), lambda path: (ROOT / "src" / path).read_text())
    tree = Tree(build, numbered(build / "drawn.json", [count, seed, *folders], known_ones,
                                lambda: drawn(list(folders), int(seed))[:min(MOST, int(count * SPARE))]))
    tree.make()
    trial = Trial(tree)
    some = {number: mutant for number, mutant in tree.mutants.items() if mutant in known_ones}
    some |= dict([(number, mutant) for number, mutant in tree.mutants.items() if mutant not in known_ones][:count])
    counts = defaultdict(Counter)

    def told(mutant):
        return mutant.told((ROOT / "src" / mutant.path).read_text())

    def outcomes(tried, ones, pool):
        for (number, mutant), out in zip(ones, pool.map(lambda one: caught.get(one[1].key) or tried(*one), ones)):
            if out and not out.startswith(SURVIVED):
                caught[mutant.key] = out
                memory.write_text(json.dumps(caught, indent=0))
            else:
                trial.passed_file.write_text(json.dumps(dict(trial.passed), indent=0))
            print(f"{out or 'not yet':10} {number:4} {told(mutant)}", flush=True)
            yield number, out

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        result = {}
        if any(mutant.key not in caught for mutant in some.values()):
            trial.look()
            result = dict(outcomes(trial.by_units, list(some.items()), pool))
            trial.look_at_the_whole({mutant.path.split("/")[0] for number, mutant in some.items() if not result[number]}, pool)
        result |= dict(outcomes(trial.by_the_whole, [(number, mutant) for number, mutant in some.items() if not result.get(number)], pool))
    for number, mutant in some.items():
        if mutant not in known_ones:
            out = result[number].split()[0]
            out = EQUIVALENT if out == SURVIVED and re.sub(r":\d+:", ":", told(mutant), count=1) in known else out
            counts[mutant.path.split("/")[0]][out] += 1
    write_table(ROOT / "tests/README.md", counts)
    total = sum(counts.values(), Counter())
    print(f"{sum(total.values())} mutants: {total[OWN] + total[FOLDERS] + total[OTHERS]} caught by unit tests, {total[WHOLE]} by others, "
          f"{total[EQUIVALENT]} equivalent, {total[SURVIVED]} survived")


if __name__ == "__main__":
    main(*sys.argv[1:])
