#!/bin/sh
# The launcher's own words: help, wrong use, refusal to install. Argument: the launcher.
set -u
program=$1
. "$(dirname "$0")/expect.sh"
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
