#!/bin/sh
# fresh_debian.sh [COMMAND...]: clones this repository into a Debian 12 that holds nothing but apt and runs the
# README's two commands there as root without sudo (or COMMAND instead). Needs root and mmdebstrap; takes packages from
# wherever this machine's apt takes them. The Debian is made in a temporary folder and removed.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
[ "$(id -u)" -eq 0 ] || { echo "fresh_debian: expected root, found user $(id -un)" >&2; exit 3; }
command -v mmdebstrap >/dev/null || { echo "fresh_debian: mmdebstrap: not found (Debian package mmdebstrap)" >&2; exit 3; }

root=$(mktemp -d --suffix=-fresh-debian)
finish() {
    umount --lazy "$root/proc" 2>/dev/null || true
    rm -rf --one-file-system "$root"
}
trap finish EXIT
echo "fresh_debian: making a Debian 12 in $root"
mmdebstrap --quiet --variant=apt bookworm "$root"
# This machine's sources and how it reaches them.
rm -f "$root/etc/apt/sources.list"
cp -a /etc/apt/sources.list.d /etc/apt/apt.conf.d /etc/apt/auth.conf.d /etc/apt/keyrings /etc/apt/trusted.gpg.d "$root/etc/apt/" 2>/dev/null || true
[ ! -f /etc/apt/sources.list ] || cp /etc/apt/sources.list "$root/etc/apt/"
for folder in usr/share/keyrings etc/ssl/certs usr/local/share/ca-certificates; do
    [ ! -d "/$folder" ] || { mkdir -p "$root/$folder"; cp -aL "/$folder/." "$root/$folder/" 2>/dev/null || true; }
done
cp /etc/resolv.conf /etc/hosts "$root/etc/"
mount -t proc proc "$root/proc"  # /dev: the few nodes that mmdebstrap made are enough

git clone --quiet "$source" "$root/glsum"
run() {
    echo "fresh_debian: $*"
    start=$(date +%s)
    chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 sh -c 'cd /glsum && exec "$@"' sh "$@"
    echo "fresh_debian: $* took $(($(date +%s) - start)) s"
}
if [ $# -gt 0 ]; then
    run "$@"
else
    run ./glsum bench --quick
    run ./glsum test
fi
