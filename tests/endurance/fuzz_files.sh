#!/usr/bin/env bash
# Files that libFuzzer makes from small ones of every kind, under AddressSanitizer and UBSan: as they are, and with the record
# of their bytes made anew, so that HDF5 reads what it is otherwise kept from. Where it crashes then, that is told apart from a
# fault of ours by the stack.
#   PETERKA_ENDURANCE_FILES=2500 tests/endurance.sh fuzz_files     so many each way
set -euo pipefail
. "$(dirname "$0")/../../jobs/arguments.sh"
start_as_part "$@"
cd "$(dirname "$0")/../.."
command -v clang++ >/dev/null || { echo "skipped: there is no clang++ (jobs/prepare.sh clang libclang-rt-dev libomp-dev)"; exit 77; }

files=${PETERKA_ENDURANCE_FILES:-20000}
tests/sanitized.sh --configure
cmake --build build/sanitized --target fuzz_file_reader
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/files" "$folder/jobs" "$folder/found"
/usr/bin/python3 - "$folder" <<'SMALL_FILES'
import shutil, sys
from pathlib import Path
sys.path.insert(0, "tests/end_to_end")
import damaged_files
folder = Path(sys.argv[1])
for kind in damaged_files.KINDS:
    name = kind.replace(" ", "_")
    (folder / name).mkdir()
    shutil.move(damaged_files.make(folder / name, kind), folder / "files" / f"{name}.h5")
    shutil.move(folder / name / "job.toml", folder / "jobs" / f"{name}.toml")
shutil.copy("tests/data/layout_2.h5", folder / "files")
SMALL_FILES

reader=$PWD/build/sanitized/tests/fuzz_file_reader
export ASAN_OPTIONS=detect_leaks=0 OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_orte_create_session_dirs=0
longest=$(stat -c %s "$folder"/files/* | sort -n | tail -1)
# By the clock: HDF5 has 5 s of the processor for each of three looks at a file without a record.
fuzz() { # OPTION...
    (cd "$folder/jobs" && "$reader" -runs="$files" -timeout=300 -rss_limit_mb=2048 -max_len="$longest" -verbosity=0 -print_final_stats=1 \
        -artifact_prefix="$folder/found/" "$@" "$folder/files" 2>&1)
}
fuzz
echo "bytes of a file from libFuzzer, of eight kinds and layout 2: raw | $files | no crash, no hang, no 2 GB" >>"$ENDURANCE_ROWS"

export FUZZ_RENEWED=1
fuzz -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1 | tail -3 || true  # a crash is its exit code, too
ours=0 of_hdf5=0
for file in "$folder"/found/*; do
    [ -e "$file" ] || continue
    said=$(cd "$folder/jobs" && "$reader" -timeout=300 -rss_limit_mb=2048 "$file" 2>&1) && continue
    # the innermost frame that is neither a sanitizer's nor the C library's
    where=$(grep -E '^ *#[0-9]+ ' <<<"$said" | grep -vE 'asan_|interceptor|fuzzer::|libc\.so|sanitizer' | head -1)
    if [[ $where == *libhdf5* ]]; then of_hdf5=$((of_hdf5 + 1)); else ours=$((ours + 1)); echo "$said" | tail -40; fi
done
version=$("$PETERKA_BINARY" --version | sed -n 's/^HDF5 //p')
row="bytes of a file from libFuzzer, of eight kinds and layout 2: with a record made anew"
[ "$ours" = 0 ] || { echo "$row | $files | **$ours crash or hang in our own code**" >>"$ENDURANCE_ROWS"; exit 1; }
echo "$row | $files | none crashes our own code; $of_hdf5 kinds of crash or hang inside HDF5 $version, from which nothing but the record keeps it" >>"$ENDURANCE_ROWS"
