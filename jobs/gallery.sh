#!/usr/bin/env bash
# Runs the jobs of jobs/gallery, each of which answers the question in its first line, draws them, and writes the page
# gallery.md, with the pictures in gallery/.
#   jobs/gallery.sh [FOLDER]     into FOLDER (default: postprocess/examples); about a minute on 2 cores
# A job's comment names its picture and which lines of the summary the page shows. Uses the program PETERKA_BINARY
# (default: build/peterka).
set -euo pipefail
. "$(dirname "$0")/arguments.sh"
read_arguments "" 1 "$@"
folder=$(folder_argument "${words[0]:-$(dirname "$0")/../postprocess/examples}")
[ -z "${PETERKA_BINARY:-}" ] || PETERKA_BINARY=$(program_argument PETERKA_BINARY)
cd "$(dirname "$0")/.."

[ -n "${PETERKA_BINARY:-}" ] || jobs/prepare.sh --program
peterka=${PETERKA_BINARY:-build/peterka}
. jobs/mpi_environment.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder/gallery"
page=$work/gallery.md
order=(gap hysteresis drift knock start others stop blow power settle)

comment() { sed -n 's/^# \{0,1\}//p' "$1"; }
field() { comment "$1" | sed -n "s/^$2: //p"; }
run_timed() { # JOB FILE SUMMARY, and the processor time of both ranks into `seconds`
    local TIMEFORMAT='%U %S'
    seconds=$({ time mpirun -n 2 "$peterka" run "$1" --output "$2" </dev/null >"$3" 2>"$3.words"; } 2>&1 | awk '{printf "%.1f", $1 + $2}')
}

cat >"$page" <<'END'
# Ten questions

Written by `jobs/gallery.sh`: each question is a job, its picture is what `postprocess/draw.py --units si` makes of it, and the lines
below are what the program told. The rigs are those of the paper. Times are those of the processor, of both ranks together.
END
for name in "${order[@]}"; do
    job=jobs/gallery/$name.toml picture=$(field "jobs/gallery/$name.toml" picture)
    run_timed "$job" "$work/$name.h5" "$work/$name.txt" || { cat "$work/$name.txt.words" >&2; exit 1; }
    tr '|' '\n' <<<"$(field "$job" told)" | while read -r line; do
        grep -q -E "$line" "$work/$name.txt" || { echo "$job: no line of its summary is told by '$line'" >&2; exit 1; }
    done
    /usr/bin/python3 postprocess/draw.py "$work/$name.h5" --only "$picture" --units si --format png --dpi 130 --output-dir "$work" >/dev/null
    mv "$work/${name}_$picture.png" "$folder/gallery/$name.png"
    {
        printf '\n## %s\n\n' "$(comment "$job" | head -n 1)"
        comment "$job" | sed '1,4d'
        printf '\n![%s](gallery/%s.png)\n\n```text\n' "$(sed -n 's/^title = "\(.*\)"/\1/p' "$job")" "$name"
        sed '/^Work$/,$d' "$work/$name.txt" | grep -E "$(field "$job" told)"
        printf '```\n\n`%s`, %s s:\n\n```toml\n' "$job" "$seconds"
        sed '/^#/d' "$job" | sed '/./,$!d'
        printf '```\n'
    } >>"$page"
    echo "$name: $seconds s"
done
mv "$page" "$folder/gallery.md"
