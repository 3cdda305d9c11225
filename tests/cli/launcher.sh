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
# Each command asks for what it needs, and for no more.
asks() {
    PATH=$folder:$PATH expect 3 "missing Debian packages" $1 --no-install
    for package in $2; do
        grep -qw -e "$package" "$folder/said" || { echo "$1: expected to ask for $package"; failures=$((failures + 1)); }
    done
    for package in $3; do
        ! grep -qw -e "$package" "$folder/said" || { echo "$1: expected not to ask for $package"; failures=$((failures + 1)); }
    done
}
asks bench "qemu-system-arm gnuplot-nox" "libceres-dev libgtest-dev chromium node-d3"
asks "bench records" "libceres-dev libfftw3-dev" "qemu-system-arm"
asks "bench --drive" "libceres-dev qemu-system-arm" "libgtest-dev"
asks report "node-d3 gnuplot-nox" "qemu-system-arm libceres-dev"
asks stability "libceres-dev" "qemu-system-arm libgtest-dev"
asks gate "g++" "qemu-system-arm gnuplot-nox libceres-dev"
asks test "libgtest-dev libgmock-dev qemu-system-arm libceres-dev node-d3 gnuplot-nox" ""

# A project whose program says where it stands and what it was told, on a machine that has everything.
mkdir -p "$folder/project/build/host/cli" "$folder/my logs"
cp "$program" "$folder/project/glsum"
mkdir "$folder/project/cli"
touch "$folder/project/build/host/build.ninja"
echo GLSUM_DRIVE:BOOL=ON >"$folder/project/build/host/CMakeCache.txt"
cp "$(dirname "$program")/cli/commands" "$folder/project/cli/"
printf '#!/bin/sh\necho "in $PWD: $*"\n' >"$folder/project/build/host/cli/glsum-indices"
printf '#!/bin/sh\n[ "$PWD" = "%s" ] || { echo "built in $PWD"; exit 1; }\n' "$folder/project" >"$folder/cmake"
printf '#!/bin/sh\necho install ok installed\n' >"$folder/dpkg-query"
chmod +x "$folder/project/build/host/cli/glsum-indices" "$folder/cmake"
ln -s ../project/glsum "$folder/my logs/glsum"
PATH=$folder:$PATH
cd "$folder/my logs" || exit 1
for program in "$folder/project/glsum" ../project/glsum ./glsum; do
    expect 0 "in $folder/my logs: --jobs 2 my.csv" indices my.csv --jobs 2
done
program=./glsum
found=$("$program" indices --no-run 2>&1)
[ -z "$found" ] || { echo "--no-run: expected no word, found $found"; failures=$((failures + 1)); }
expect 3 "glsum-resample: not built; ./glsum resample --no-run builds it" resample

# The firmware's compiler is missing. Here it is found once the host's programs are built, as on a machine where both go on at once,
# or after ten seconds, never; the command runs after both.
cat >"$folder/dpkg-query" <<'end'
#!/bin/sh
case $* in *arm-none-eabi*) exit 1 ;; esac
echo install ok installed
end
cat >"$folder/apt-get" <<end
#!/bin/sh
[ "\$1" != update ] || exit 0
for second in 1 2 3 4 5 6 7 8 9 10; do
    [ ! -e "$folder/built" ] || exit \$(cat "$folder/status")
    sleep 1
done
echo "nothing was built beside"
exit 1
end
printf '#!/bin/sh\nexec "$@"\n' >"$folder/sudo"
printf '#!/bin/sh\ncase $* in *"preset host"*) touch "%s/built" ;; esac\n' "$folder" >"$folder/cmake"
chmod +x "$folder/apt-get" "$folder/sudo"
mkdir "$folder/project/targets"
echo mps2-an500 >"$folder/project/targets/emulated"
cp "$folder/project/build/host/cli/glsum-indices" "$folder/project/build/host/cli/glsum-time"
echo 0 >"$folder/status"
expect 0 "in $folder/my logs: --jobs 2" time --jobs 2
rm "$folder/built"
echo 1 >"$folder/status"
expect 3 "could not install: gcc-arm-none-eabi" time --jobs 2
[ "$failures" -eq 0 ]
