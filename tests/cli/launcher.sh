#!/bin/sh
# The launcher's own words: help, wrong use, refusal to install. Argument: the launcher.
set -u
launcher=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
expect() {
    status=$1 text=$2
    shift 2
    "$launcher" "$@" >"$folder/said" 2>&1
    found=$?
    if [ "$found" -ne "$status" ] || ! grep -qF -e "$text" "$folder/said"; then
        echo "glsum $*: expected status $status and \"$text\"; found status $found and:"
        head -n 5 "$folder/said"
        failures=$((failures + 1))
    fi
}
expect 0 "./glsum bench" --help
expect 2 "./glsum bench"
expect 2 "expected a command first" --quick
expect 2 "--jobs: expected a number" bench --jobs
expect 2 "found zero" bench --jobs zero
# A machine on which nothing is installed, as far as the launcher can see.
printf '#!/bin/sh\nexit 1\n' >"$folder/dpkg-query"
chmod +x "$folder/dpkg-query"
PATH=$folder:$PATH expect 3 "missing Debian packages: g++ cmake" bench --no-install
PATH=$folder:$PATH expect 3 "libgtest-dev" test --no-install
[ "$failures" -eq 0 ]
