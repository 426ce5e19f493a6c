# Bare Debians in folders of their own, under $folder, with this machine's way to its packages and a clone of the last commit in
# /project. To be sourced, after jobs/arguments.sh. Needs root and the right to mount; nothing is mounted when the script ends.
cannot() { # REASON
    echo "$script: $1, so no other Debian was tried" >&2
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
