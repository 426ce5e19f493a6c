"""The build: its location does not matter."""

import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_a_folder_may_have_a_space_in_its_name(tmp_path):
    source = tmp_path / "two words"
    source.mkdir()
    shutil.copy(ROOT / "CMakeLists.txt", source)
    for folder in ("src", "jobs", "postprocess"):
        shutil.copytree(ROOT / folder, source / folder)
    configured = subprocess.run(["cmake", "-S", ".", "-B", "a build", "-G", "Ninja", "-DBUILD_TESTING=OFF"], cwd=source,
                                capture_output=True, text=True)
    assert configured.returncode == 0, configured.stderr
    # a source that includes HDF5 and MPI, and the header generated for each build
    built = subprocess.run(["cmake", "--build", "a build", "--target", "peterka_commit",
                            "CMakeFiles/peterka_core.dir/src/map_file/provenance.cpp.o"], cwd=source,
                           capture_output=True, text=True)
    assert built.returncode == 0, built.stdout + built.stderr
