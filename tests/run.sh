#!/usr/bin/env bash
# Installs what is missing, builds, and runs tests: C++ units, MPI tests, the program under mpirun, the pictures.
#   tests/run.sh                  all but the long ones, marked thorough, and those in a browser
#   tests/run.sh --all            all, as .ci/run does at each commit; three times as long
#   tests/run.sh --core           functions, what ranks do together, bad jobs, files in their readers: two minutes after the build
#   tests/run.sh -R PATTERN       of all, those whose name matches
#   tests/run.sh --rerun-failed   of all, those that failed the last time
# tests/style.sh has formatting and static analysis.
set -euo pipefail
. "$(dirname "$0")/../jobs/arguments.sh"
read_arguments "--all --core -R --rerun-failed" 1 "$@"
! has_option -R || [ ${#words[@]} = 1 ] || refuse "-R wants a pattern"
has_option -R || [ ${#words[@]} = 0 ] || refuse "${words[0]} follows no -R"
[ ${#options[@]} -lt 2 ] || refuse "one option at a time"
cd "$(dirname "$0")/.."

if [ ${#options[@]} = 0 ]; then
    chosen=(--label-exclude thorough)
    jobs/prepare.sh
elif has_option --core; then
    chosen=(-R '^unit[.]|^mpi_tests|^job$|^output$')
    jobs/prepare.sh
else
    has_option --all && chosen=() || chosen=("$@")
    # The page of explore.py: what builds its engine, and a browser. Sphinx: the pages of jobs/api.sh.
    # shellcheck disable=SC2046
    jobs/prepare.sh $(src/page/packages.sh) chromium chromium-driver python3-selenium python3-sphinx
fi
. jobs/mpi_environment.sh
# One more than there are cores: some tests wait for what they have started.
ctest --test-dir build --output-on-failure --no-tests=error -j "$(($(nproc) + 1))" "${chosen[@]}"
