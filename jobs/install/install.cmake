# cmake --install build --prefix PREFIX: the program, the programs of postprocess as peterka-draw and so on, the Python package, jobs
# and rigs to begin with, the manual, completion for bash, and, where src/page/build_wasm.sh can compile it, the page's engine.
# Everything finds everything by its place: a prefix can be moved. jobs/package.sh makes Debian's package of the same.
include(GNUInstallDirs)
# The system's Python has the distribution's modules; another one on the PATH often hasn't.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
set(PETERKA_PYTHON_DIR "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages" CACHE STRING
    "Where the Python package goes, below the prefix; of ~/.local Python looks there by itself")

install(TARGETS peterka RUNTIME)
install(DIRECTORY postprocess/peterka DESTINATION ${PETERKA_PYTHON_DIR}
    FILES_MATCHING REGEX "\\.(py|js|css|html|typed)$" PATTERN __pycache__ EXCLUDE)

# Names and entry points are those of pyproject.toml.
set(made ${CMAKE_BINARY_DIR}/install)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    postprocess/pyproject.toml jobs/install/python_metadata.py)
file(RELATIVE_PATH PETERKA_PYTHON_FROM_BIN /${CMAKE_INSTALL_BINDIR} /${PETERKA_PYTHON_DIR})
execute_process(COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/jobs/install/python_metadata.py
    ${CMAKE_SOURCE_DIR}/postprocess/pyproject.toml ${made} ${PETERKA_PYTHON_FROM_BIN} COMMAND_ERROR_IS_FATAL ANY)
install(DIRECTORY ${made}/dist-info/ DESTINATION ${PETERKA_PYTHON_DIR}/peterka-${PROJECT_VERSION}.dist-info)
install(DIRECTORY ${made}/bin/ DESTINATION ${CMAKE_INSTALL_BINDIR} USE_SOURCE_PERMISSIONS)

install(DIRECTORY jobs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/peterka/jobs FILES_MATCHING PATTERN "*.toml" PATTERN install EXCLUDE
    PATTERN container EXCLUDE PATTERN slurm EXCLUDE PATTERN spack EXCLUDE)
install(FILES jobs/slurm/map.sbatch DESTINATION ${CMAKE_INSTALL_DATADIR}/peterka/jobs/slurm)
install(FILES jobs/mpi_environment.sh DESTINATION ${CMAKE_INSTALL_DATADIR}/peterka)
install(FILES jobs/install/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME peterka)

if(NOT CMAKE_CROSSCOMPILING)  # the manual is what the program tells with --help
    add_custom_command(OUTPUT ${made}/peterka.1
        COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/jobs/install/manual.py $<TARGET_FILE:peterka> ${made}/peterka.1
        DEPENDS peterka jobs/install/manual.py)
    add_custom_target(peterka_manual ALL DEPENDS ${made}/peterka.1)
    install(FILES ${made}/peterka.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

install(CODE "set(engines \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/peterka/page\")
set(sources \"${CMAKE_SOURCE_DIR}\")
set(python \"${Python3_EXECUTABLE}\")")
install(SCRIPT jobs/install/engine.cmake)

# jobs/package.sh: a package for the release on which it is made, whose libraries it names.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The peterka developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, python3, python3-numpy, python3-h5py, python3-xarray, python3-h5netcdf, \
python3-matplotlib, python3-contourpy, python3-scipy, python3-xxhash")
set(CPACK_STRIP_FILES ON)
include(CPack)
