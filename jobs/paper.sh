#!/usr/bin/env bash
# The paper, reproduced: builds what is needed, computes every job that its figures and claims need, draws them, and writes
# one page, claims.md and claims.html: each claim with the number computed, agrees or differs, by how much, and likely why.
# Safe to repeat: what is computed already is not computed again.
#   jobs/paper.sh [--quick] [FOLDER]        default: results/paper; --quick: coarse grids, results/paper_quick
#   PETERKA_BINARY=... jobs/paper.sh        with a program that is built already
set -euo pipefail
shopt -s nullglob
. "$(dirname "$0")/arguments.sh"
read_arguments --quick 1 "$@"
quick=$(! has_option --quick || echo yes)
folder=$(folder_argument "${words[0]:-$(dirname "$0")/../results/paper${quick:+_quick}}")
program=$(realpath -m "$(dirname "$0")/../build/peterka")
[ -z "${PETERKA_BINARY:-}" ] || program=$(program_argument PETERKA_BINARY)
cd "$(dirname "$0")/.."

[ -n "${PETERKA_BINARY:-}" ] || jobs/prepare.sh --program
. jobs/mpi_environment.sh

# full or quick
pick() { if [ -n "$quick" ]; then echo "$2"; else echo "$1"; fi; }
points() { # AXIS FULL QUICK
    echo --set "axes.$1.points=$(pick "$2" "$3")"
}
times() { awk "BEGIN { printf \"%.10g\", $1 * $2 }"; }

damping() { case $1 in 170mm) echo 0.06 ;; 150mm) echo 0.08 ;; 135mm) echo 0.09 ;; esac; }

# Calls `compute NAME JOB [--set ...]` for each file. Gaps of 0, 1, 2 and 3 mm: 0 to 3.3708 A0.
all_files() {
    local rig start gap factor number=0
    for rig in 170mm 150mm 135mm; do
        compute "peterka_$rig" "peterka_$rig" $(points frequency_ratio 512 96) $(points gap_ratio 512 64) \
            --set audit.cells=0
        compute "sweep_$rig" "sweep_$rig" $(points frequency_ratio 1401 281)
        # attractors at gaps of 0 to 3 mm
        compute "drift_$rig" "peterka_$rig" $(points frequency_ratio 1001 257) $(points gap_ratio 4 4) \
            --set audit.cells=0 --set axes.gap_ratio.to=3.370786516853933 --set "title=Drift at gaps of 0 to 3 mm, $rig" \
            --set starts.count=64
    done
    compute gaps_170mm peterka_170mm $(points frequency_ratio 4001 501) $(points gap_ratio 4 4) \
        --set audit.cells=0 --set axes.gap_ratio.to=3.370786516853933 --set "title=Gaps of 0 to 3 mm, 170 mm"
    compute curves_170mm curves_170mm $(points frequency_ratio 128 64) $(points gap_ratio 128 64)
    for job in jobs/trace_*.toml; do
        job=$(basename "$job" .toml)
        compute "$job" "$job"
    done
    compute basin_150mm basin_150mm $(points displacement_ratio 256 24) $(points velocity_ratio 256 24)
    compute basin_150mm_coexisting basin_150mm_coexisting $(points displacement_ratio 256 24) $(points velocity_ratio 256 24)
    compute basin_135mm basin_135mm $(points displacement_ratio 128 24) $(points velocity_ratio 128 24)
    # where force is largest at gap 0 and, with another frequency, at 3 mm
    at_170mm basin_170mm_gap_0 2.0 0
    at_170mm basin_170mm_gap_3 1.37 3.370786516853933
    for start in $(pick "0:0 -3:0 0:4 0:-4 -2:-3 -4:3 1:6 -1:-6" "0:0 -3:0 0:-4"); do
        number=$((number + 1))
        compute "starts/start_$number" peterka_170mm --set audit.cells=0 \
            --set axes.frequency_ratio.from=1.2 --set axes.frequency_ratio.to=3.6 $(points frequency_ratio 241 49) \
            --set axes.gap_ratio.to=3 $(points gap_ratio 181 31) \
            --set "start.displacement_ratio=${start%:*}" --set "start.velocity_ratio=${start#*:}"
    done
    for gap in $(pick "1.60 1.64 1.66 1.67 1.68 1.70 1.72" "1.60 1.70"); do
        compute "nearby_150mm/gap_$gap" basin_150mm $(stop_at "$gap") $(few)
    done
    for gap in $(pick "1.30 1.40 1.45 1.50 1.52 1.54 1.56 1.58" "1.40 1.50"); do
        compute "nearby_135mm/gap_$gap" basin_135mm $(stop_at "$gap") $(few)
    done
    for factor in $(pick "0.4 0.5 0.6 0.7 0.75 0.8 0.9 1.1 1.25 1.5 2" "0.75"); do
        moved "$factor" gap_0 peterka_170mm 170mm --set audit.cells=0 $(points frequency_ratio 2001 501) $(points gap_ratio 2 2)
        moved "$factor" 150mm basin_150mm 150mm $(few)
        moved "$factor" 135mm basin_135mm 135mm $(few)
    done
}
few() { points displacement_ratio 32 12 && points velocity_ratio 32 12; }
# The gap of a basin, whose starts end at the stop: beyond it they would be shot away.
stop_at() { # GAP_RATIO
    echo --set "operating_point.gap_ratio=$1" --set "axes.displacement_ratio.to=$1"
}
at_170mm() { # NAME FREQUENCY_RATIO GAP_RATIO
    compute "$1" basin_150mm --set hammer.natural_frequency_hz=4.5 --set hammer.damping_ns_per_m=0.06 \
        --set hammer.cubic_stiffness_n_per_m3=238.23 --set "operating_point.frequency_ratio=$2" \
        $(stop_at "$3") --set "title=Basins of attraction, 170 mm" \
        $(points displacement_ratio 128 24) $(points velocity_ratio 128 24)
}
# Each parameter in turn times FACTOR. Gaps stay what they are in mm; starts are in A0, but for their end at the stop.
moved() { # FACTOR WHAT JOB RIG [--set ...]
    local name="sensitivity/${2}_$1" gap=""
    case $2 in 150mm) gap=$(stop_at "$(times 1.74 "1/$1")") ;;
               135mm) gap=$(stop_at "$(times 1.60 "1/$1")") ;; esac
    compute "${name}_ci" "$3" --set "contact.damping_ns_per_m=$(times 1200 "$1")" "${@:5}"
    compute "${name}_ki" "$3" --set "contact.stiffness_n_per_m=$(times 5.5e6 "$1")" "${@:5}"
    compute "${name}_A0" "$3" --set "cart.amplitude_m=$(times 0.89e-3 "$1")" $gap "${@:5}"
    compute "${name}_zeta" "$3" --set "hammer.damping_ns_per_m=$(times "$(damping "$4")" "$1")" "${@:5}"
}

compute() { files=$((files + 1)); }
files=0
all_files
total=$files

compute() { # NAME JOB [--set ...]
    files=$((files + 1))
    echo "[$files of $total] $1"
    mkdir -p "$(dirname "$folder/$1")"
    mpirun -n "$(ranks_for "$1")" "$program" run "jobs/$2.toml" --output "$folder/$1.h5" --quiet "${@:3}" </dev/null
}
ranks_for() { case $1 in sensitivity/* | nearby*) echo 1 ;; *) echo 2 ;; esac; }
files=0
all_files

# The same for rigs with other ki, ci and gaps, within the errors that a measured rig has.
rigs=$(pick 16 1)
PYTHONPATH=postprocess /usr/bin/python3 -m peterka.claims.drawn_rigs "$folder" "$rigs"
for number in $(seq "$rigs"); do
    echo "[rig $number of $rigs]"
    find "$folder/rigs/$number" -name "*.toml" | sort | while read -r job; do
        mpirun -n 2 "$program" run "$job" --output "${job%.toml}.h5" --quiet </dev/null
    done
done

postprocess() { /usr/bin/python3 "postprocess/$1.py" "${@:2}"; }
echo "drawing"
postprocess draw "$folder"/peterka_*.h5 "$folder"/basin_*.h5 --output-dir "$folder/pictures" --formats png
postprocess draw "$folder"/sweep_1[35]*.h5 "$folder"/trace_*.h5 --output-dir "$folder/pictures" --formats png
postprocess draw "$folder/sweep_170mm.h5" --measured postprocess/paper_measurements.csv \
    --output-dir "$folder/pictures" --formats png
for pair in "170mm 150mm" "170mm 135mm" "150mm 135mm"; do
    postprocess compare "$folder/peterka_${pair% *}.h5" "$folder/peterka_${pair#* }.h5" \
        --output-dir "$folder/pictures" --formats png >/dev/null
done
postprocess claims "$folder"
