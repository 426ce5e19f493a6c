"""Spack's recipe, for Spack 1.0 or later, which builds this checkout:

    spack repo add jobs/spack/spack_repo/peterka
    spack dev-build -d . peterka@1.0.0
"""

from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Peterka(CMakePackage):
    """Peterka maps and basins of attraction of a vibro-impact hammer, in parallel."""

    version("1.0.0")  # from a checkout: no archive of it is published

    variant("python", default=True, description="What the Python package and the programs that draw need at run time")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("python@3.11:", type=("build", "run"))

    depends_on("mpi")
    depends_on("hdf5@1.10:+mpi+hl")
    depends_on("sundials@6.4:+CVODE+ARKODE")
    depends_on("eigen@3.4:")
    depends_on("fmt@8:")
    depends_on("cli11")
    depends_on("highway")
    depends_on("tomlplusplus")
    depends_on("xxhash")
    depends_on("flint@3:")

    with when("+python"):
        extends("python")
        for package in ("numpy@1.24:", "contourpy@1.0:", "h5py@3.7:", "matplotlib@3.6:", "scipy@1.10:", "xarray@2023.1:", "xxhash@3.2:"):
            depends_on(f"py-{package}", type="run")

    def cmake_args(self):
        return [
            self.define("BUILD_TESTING", False),
            self.define("CMAKE_UNITY_BUILD", True),
            self.define("Python3_EXECUTABLE", self.spec["python"].command.path),
        ]
