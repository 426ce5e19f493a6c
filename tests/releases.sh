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

cannot() { # REASON
    echo "$script: $1, so no other release was tried" >&2
    exit 77
}
[ "$(id -u)" = 0 ] || cannot "a root of another release needs root"
command -v debootstrap >/dev/null || {
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends -o DPkg::Lock::Timeout=300 \
        debootstrap >/dev/null
} || cannot "debootstrap cannot be installed"

folder=$(mktemp -d)
mounted=()
leave() {
    for place in "${mounted[@]}"; do umount -l "$place"; done
    rm -rf --one-file-system "$folder"
}
trap leave EXIT

# This machine's way to its packages: a mirror, a proxy, certificates.
mirror=$(sed -n 's/^URIs: *//p' /etc/apt/sources.list.d/debian.sources 2>/dev/null | head -n 1)
[ -n "$mirror" ] || mirror=$(awk '$1 == "deb" && $2 ~ /^http.*debian/ {print $2; exit}' /etc/apt/sources.list 2>/dev/null || true)
hand_over() { # ROOT PATH...
    local root=$1 path
    shift
    for path in "$@"; do
        [ ! -e "$path" ] || { mkdir -p "$root$(dirname "$path")" && cp -a --no-target-directory "$path" "$root$path"; }
    done
}

make_root() { # RELEASE ROOT
    local known=/usr/share/debootstrap/scripts/$1 place
    [ -e "$known" ] || ln -s sid "$known"
    debootstrap --variant=minbase --include=ca-certificates "$1" "$2" ${mirror:+"$mirror"} >"$folder/debootstrap" 2>&1 || {
        tail -n 3 "$folder/debootstrap" >&2
        cannot "debootstrap makes no $1 here"
    }
    hand_over "$2" /etc/apt/apt.conf.d /etc/apt/auth.conf.d /etc/hosts /etc/ssl/certs /usr/local/share/ca-certificates
    cp -L /etc/resolv.conf "$2/etc/resolv.conf"
    for place in proc sys dev; do
        mount --rbind "/$place" "$2/$place" || cannot "/$place cannot be mounted"
        mounted+=("$2/$place")
        mount --make-rslave "$2/$place"
    done
    git clone -q . "$2/project"
}

inside() { # ROOT COMMAND...
    local root=$1
    shift
    chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM=dumb \
        ${PETERKA_WARNINGS_AS_ERRORS:+"PETERKA_WARNINGS_AS_ERRORS=$PETERKA_WARNINGS_AS_ERRORS"} \
        "${proxies[@]}" sh -c 'cd /project && exec "$@"' sh "$@" </dev/null
}
mapfile -t proxies < <(env | grep -iE '^(https?|no)_proxy=' || true)

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
