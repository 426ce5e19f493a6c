"""The build: its location does not matter, nor which Python the PATH has first."""

import os
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_a_folder_may_have_a_space_in_its_name_and_another_python_be_first(tmp_path):
    source = tmp_path / "two words"
    source.mkdir()
    shutil.copy(ROOT / "CMakeLists.txt", source)
    for folder in ("src", "jobs", "postprocess"):
        shutil.copytree(ROOT / folder, source / folder)
    another = tmp_path / "bin/python3"  # one of pyenv or conda, which hasn't the distribution's packages
    another.parent.mkdir()
    another.write_text('#!/bin/sh\nexec /usr/bin/python3 "$@"\n')
    another.chmod(0o755)
    configured = subprocess.run(["cmake", "-S", ".", "-B", "a build", "-G", "Ninja", "-DBUILD_TESTING=OFF"], cwd=source,
                                capture_output=True, text=True, env=os.environ | {"PATH": f"{another.parent}:{os.environ['PATH']}"})
    assert configured.returncode == 0, configured.stderr
    assert "Found Python3: /usr/bin/python3 " in configured.stdout
    # a source that includes HDF5 and MPI, and the header generated for each build
    built = subprocess.run(["cmake", "--build", "a build", "--target", "peterka_commit",
                            "CMakeFiles/peterka_telling.dir/src/map_file/provenance.cpp.o"], cwd=source,
                           capture_output=True, text=True)
    assert built.returncode == 0, built.stdout + built.stderr
