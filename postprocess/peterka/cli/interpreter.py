"""Imported first by every program here: continues in an interpreter that has the packages.

python3 on the PATH may belong to pyenv or conda and lack the packages, while the system's python3 has the distribution's. If
neither has them, one line reports it.
"""

import importlib
import os
import subprocess
import sys
from pathlib import Path

PACKAGES = ("numpy", "h5py", "matplotlib", "scipy")
OLDEST = (3, 11)
SYSTEMS = "/usr/bin/python3"
BAD_INTERPRETER = 2


def use_one_with_packages() -> None:
    """Returns if this interpreter has all packages; otherwise restarts the process in one that has them, or exits."""
    lacking = what_is_lacking()
    if not lacking:
        return
    if sys.executable != SYSTEMS and has_packages(SYSTEMS):
        os.execv(SYSTEMS, [SYSTEMS, *sys.argv])
    print(f"{Path(sys.argv[0]).name}: {sys.executable or 'this Python'} lacks {lacking}, and so does {SYSTEMS}; install "
          "that (Debian: python3-numpy python3-h5py python3-matplotlib python3-scipy), or start this with another one: "
          f"PYTHON {sys.argv[0]} ...", file=sys.stderr)
    sys.exit(BAD_INTERPRETER)


def what_is_lacking() -> str:
    """What this interpreter lacks, in words; empty if nothing."""
    if sys.version_info < OLDEST:
        return f"Python {'.'.join(map(str, OLDEST))}"
    return " and ".join(name for name in PACKAGES if not can_import(name))


def can_import(name: str) -> bool:
    """Whether this interpreter has the package."""
    try:
        importlib.import_module(name)
    except ImportError:
        return False
    return True


def has_packages(python: str) -> bool:
    """Whether another interpreter has what this one lacks, in the same environment."""
    question = f"import sys, {', '.join(PACKAGES)}; sys.exit(sys.version_info < {OLDEST})"
    try:
        return subprocess.run([python, "-c", question], capture_output=True, check=False).returncode == 0
    except OSError:
        return False


use_one_with_packages()
