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

# A project whose program says where it stands and what it was told, on a machine that has everything.
mkdir -p "$folder/project/build/host/cli" "$folder/my logs"
cp "$program" "$folder/project/glsum"
printf '#!/bin/sh\necho "in $PWD: $*"\n' >"$folder/project/build/host/cli/glsum"
printf '#!/bin/sh\n[ "$PWD" = "%s" ] || { echo "built in $PWD"; exit 1; }\n' "$folder/project" >"$folder/cmake"
printf '#!/bin/sh\necho install ok installed\n' >"$folder/dpkg-query"
chmod +x "$folder/project/build/host/cli/glsum" "$folder/cmake"
ln -s ../project/glsum "$folder/my logs/glsum"
PATH=$folder:$PATH
cd "$folder/my logs" || exit 1
for program in "$folder/project/glsum" ../project/glsum ./glsum; do
    expect 0 "in $folder/my logs: indices --jobs 2 my.csv" indices my.csv --jobs 2
done
[ "$failures" -eq 0 ]
