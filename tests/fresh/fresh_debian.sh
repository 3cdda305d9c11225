#!/bin/sh
# fresh_debian.sh [--suite NAME] [--shared FOLDER] [--keep FOLDER] [COMMAND...]: clones this repository into a Debian that
# holds nothing but apt and runs COMMAND there as root without sudo (the README's two commands unless it is given).
#   --suite NAME     bookworm (Debian 12, the default) or trixie (Debian 13)
#   --shared FOLDER  is seen there beside the project, read-only, and named by GLSUM_SHARED
#   --keep FOLDER    a compiler cache that outlives the Debian; no package does
# Needs root and mmdebstrap; takes packages from wherever this machine's apt takes them. The Debian lies in a temporary
# folder and goes with the command. Exit status: the command's, or 125 where the Debian could not be made.
set -eu
fail() { echo "fresh_debian: $*" >&2; exit 125; }
[ "$(id -u)" -eq 0 ] || fail "expected root, found user $(id -un)"
command -v mmdebstrap >/dev/null || fail "mmdebstrap: not found (Debian package mmdebstrap)"
# In a mount and process namespace of its own: however this ends, nothing stays mounted and nothing goes on running.
if [ "${FRESH_DEBIAN_APART:-}" != yes ]; then
    unshare --mount --propagation private true 2>/dev/null || fail "this machine grants no mount namespace"
    FRESH_DEBIAN_APART=yes exec unshare --mount --pid --fork --kill-child --propagation private sh "$0" "$@"
fi

suite=bookworm
shared=
keep=
while [ $# -gt 0 ]; do
    case $1 in
        --suite) suite=$2; shift 2 ;;
        --shared) shared=$(cd "$2" && pwd) || fail "--shared: expected a folder, found $2"; shift 2 ;;
        --keep) mkdir -p "$2" && keep=$(cd "$2" && pwd) || fail "--keep: expected a folder, found $2"; shift 2 ;;
        --*) fail "expected --suite, --shared or --keep, found $1" ;;
        *) break ;;
    esac
done
source=$(cd "$(dirname "$0")/../.." && pwd)
root=$(mktemp -d --suffix=-fresh-debian)
finish() {
    for folder in proc shared root/.cache; do umount --lazy "$root/$folder" 2>/dev/null || true; done
    rm -rf --one-file-system "$root"
}
trap finish EXIT
trap 'exit 130' INT TERM

start=$(date +%s)
mmdebstrap --quiet --variant=apt "$suite" "$root" || fail "no Debian $suite could be made"
# This machine's sources and how it reaches them; another suite by its name.
rm -f "$root/etc/apt/sources.list"
cp -a /etc/apt/sources.list.d /etc/apt/auth.conf.d /etc/apt/keyrings /etc/apt/trusted.gpg.d "$root/etc/apt/" 2>/dev/null || true
[ ! -f /etc/apt/sources.list ] || cp /etc/apt/sources.list "$root/etc/apt/"
find "$root/etc/apt" -name '*.list' -o -name '*.sources' | xargs -r sed -i "s/bookworm/$suite/g"
cp -a /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
echo 'Acquire::Retries "3";' >"$root/etc/apt/apt.conf.d/80retries"
for folder in usr/share/keyrings etc/ssl/certs usr/local/share/ca-certificates; do
    [ ! -d "/$folder" ] || { mkdir -p "$root/$folder"; cp -aL "/$folder/." "$root/$folder/" 2>/dev/null || true; }
done
cp /etc/resolv.conf /etc/hosts "$root/etc/"
mount -t proc proc "$root/proc"  # /dev: the few nodes that mmdebstrap made are enough
environment="HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8${CI:+ CI=$CI}"
if [ -n "$shared" ]; then
    mkdir "$root/shared"
    mount --bind -o ro "$shared" "$root/shared"
    environment="$environment GLSUM_SHARED=/shared"
fi
if [ -n "$keep" ]; then
    mkdir -p "$root/root/.cache"
    mount --bind "$keep" "$root/root/.cache"
fi
git clone --quiet "$source" "$root/glsum" || fail "$source could not be cloned"
echo "fresh_debian: a Debian $suite that holds nothing but apt, made in $(($(date +%s) - start)) s"

run() {
    echo "fresh_debian: $*"
    start=$(date +%s)
    status=0
    chroot "$root" /usr/bin/env -i $environment sh -c 'cd /glsum && exec "$@"' sh "$@" || status=$?
    echo "fresh_debian: $* took $(($(date +%s) - start)) s (status $status)"
    [ "$status" -eq 0 ] || exit "$status"
}
if [ $# -gt 0 ]; then
    run "$@"
else
    packages() { chroot "$root" dpkg-query -W -f='${Installed-Size}\n' | awk '{ n++; k += $1 } END { printf "%d packages of %.0f MB", n, k / 1024 }'; }
    echo "fresh_debian: $(packages)"
    for command in "bench --quick" test; do
        run ./glsum $command
        echo "fresh_debian: then $(packages), build/ of $(du -sm "$root/glsum/build" | cut -f 1) MB"
    done
fi
