#!/usr/bin/env bash
# A million texts for the job reader, which libFuzzer makes from the bad and the shipped jobs, under AddressSanitizer and
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
cp tests/job/bad/*.toml jobs/*.toml "$folder"
build/sanitized/tests/fuzz_job_reader -runs=$texts -timeout=1 -max_len=8192 -verbosity=0 -print_final_stats=1 \
    -artifact_prefix="$PWD/build/sanitized/" "$folder"
echo "job of random text, from libFuzzer | $texts | no crash, no hang; sound ones read back equal" >>"$ENDURANCE_ROWS"
