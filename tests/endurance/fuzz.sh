#!/usr/bin/env bash
# A million texts for the job reader, which libFuzzer makes from the bad and the shipped jobs and the rigs that they name, under AddressSanitizer and
# UBSan: none crashes it or takes a second, and every sound job comes back equal from its resolved text.
set -euo pipefail
. "$(dirname "$0")/../../jobs/arguments.sh"
start_as_part "$@"
cd "$(dirname "$0")/../.."
command -v clang++ >/dev/null || { echo "skipped: there is no clang++ (jobs/prepare.sh clang libclang-rt-dev libomp-dev)"; exit 77; }

texts=1000000
tests/sanitized.sh --configure
cmake --build build/sanitized --target fuzz_job_reader
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/texts"
cp tests/job/bad/*.toml jobs/*.toml "$folder/texts"
cp -r jobs/rigs "$folder"  # that these jobs name
found=$PWD/build/sanitized
(cd "$folder" && "$found/tests/fuzz_job_reader" -runs=$texts -timeout=1 -max_len=8192 -verbosity=0 -print_final_stats=1 \
    -artifact_prefix="$found/" texts)
echo "job of random text, from libFuzzer | $texts | no crash, no hang; sound ones read back equal" >>"$ENDURANCE_ROWS"
