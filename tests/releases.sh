#!/usr/bin/env bash
# Runs the last commit where its users are: in a bare Debian of each release, with nothing but what the project's own
# scripts install there. Tells how long README's two commands take. Then files of every kind of job, made in each of them, are
# read and gone on with in each other (releases/files.py).
#   tests/releases.sh [--core] [--here] [RELEASE...]     default: bookworm (12) and trixie (13)
#   --core    a coarse map instead of quickstart's own, and tests/run.sh --core instead of --all
#   --here    files of this machine's build/peterka, too, as if it were one of them
# Needs root and the right to mount; installs debootstrap. A release takes 6 GB under TMPDIR while it runs. Exit codes: 0 all
# passed; 1 something failed; 77 no such root can be made on this machine.
set -euo pipefail
. "$(dirname "$0")/../jobs/arguments.sh"
read_arguments "--core --here" 9 "$@"
cd "$(dirname "$0")/.."
for release in "${words[@]}"; do
    [[ $release =~ ^[a-z]+$ ]] || refuse "$release is no name of a release of Debian"
done
[ ${#words[@]} -gt 0 ] || words=(bookworm trixie)
quickstart=(./jobs/quickstart.sh) tests=(./tests/run.sh --all)
! has_option --here || [ -x build/peterka ] || refuse "--here wants build/peterka, which jobs/prepare.sh makes"
! has_option --core || { quickstart+=(jobs/smoke.toml) tests=(./tests/run.sh --core); }

. tests/releases/roots.sh

files() { # PLACE ARGUMENT...     of releases/files.py, in a release's root or here
    local place=$1
    shift
    if [ "$place" = here ]; then
        (cd "$folder/here" && /usr/bin/python3 "$here/tests/releases/files.py" "$@")
    else
        inside "$folder/$place" sh -c 'cd / && exec /usr/bin/python3 project/tests/releases/files.py "$@"' sh "$@"
    fi
}
here=$PWD

failed=0
told=()
tell() { # OUTCOME WORDS
    [ "$1" = passed ] || failed=1
    told+=("$2 $1")
}
for release in "${words[@]}"; do
    root=$folder/$release
    make_root "$release" "$root"
    name="Debian $(cat "$root/etc/debian_version") ($release)"
    for command in "${quickstart[*]}" "${tests[*]}"; do
        echo "== $name: $command"
        begin=$SECONDS
        # shellcheck disable=SC2086
        if inside "$root" $command; then outcome=passed; else outcome=FAILED; fi
        tell $outcome "$name: $command, $((SECONDS - begin)) s:"
    done
done

! has_option --here || { mkdir "$folder/here" && words+=(here); }
for own in "${words[@]}"; do
    if ! files "$own" make files; then tell FAILED "files made in $own:"; fi
done
for own in "${words[@]}"; do
    for other in "${words[@]}"; do
        if [ "$own" = "$other" ] || [ ! -d "$folder/$other/files" ]; then continue; fi
        cp -r "$folder/$other/files" "$folder/$own/files-of-$other"
        echo "== files of $other in $own"
        if files "$own" compare files "files-of-$other"; then outcome=passed; else outcome=FAILED; fi
        tell $outcome "files of $other in $own:"
    done
done
printf '%s\n' "${told[@]}"
exit $failed
