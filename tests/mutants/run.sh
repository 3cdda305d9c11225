#!/bin/sh
# run.sh --seed S --count N [--area A] [--alone] | --check: draws N one-line changes of the product's code (draw.pl), makes them one at a
# time in the copy that planted/plant.sh builds, and says which the unit tests notice. A: kernels, bench, qemu, gap or drive; all
# of them in turn unless it is given. --alone: quicker and a bit too strict, as plant.sh has it. The last line: "killed K of M",
# where M leaves out what does not compile and what alters nothing. Exit 0 however many survive.
#   --check  draws none: names the entries of equivalent.txt that are no change in today's code, exit 1 if any
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
[ "${1-}" != --check ] || exec perl "$here/draw.pl" "$source" --check
seed=
count=
area=all
alone=
while [ $# -gt 0 ]; do
    case $1 in
        --seed) seed=$2; shift 2 ;;
        --count) count=$2; shift 2 ;;
        --area) area=$2; shift 2 ;;
        --alone) alone=--alone; shift ;;
        *) echo "run.sh: expected --seed, --count, --area, --alone or --check, found $1" >&2; exit 2 ;;
    esac
done
case $seed$count in '' | *[!0-9]*) echo "run.sh: expected --seed and --count, two numbers, found '$seed' and '$count'" >&2; exit 2 ;; esac
case $area in all | kernels | bench | qemu | gap | drive) ;; *) echo "run.sh: --area: expected kernels, bench, qemu, gap, drive or all, found $area" >&2; exit 2 ;; esac

mkdir -p "$source/build/planted"
drawn=$source/build/planted/mutants
perl "$here/draw.pl" "$source" "$seed" "$count" "$area" >"$drawn"
said=$source/build/planted/mutants.txt
{ sed -n 's/^# //p' "$drawn" && "$source/tests/planted/plant.sh" $alone --bugs "$drawn"; } 2>&1 | tee "$said" || true
grep -q 'planted bugs caught' "$said" || { echo "run.sh: the project could not be built or tested as it is" >&2; exit 1; }
awk '
    / caught by | hangs$/ { ++killed; ++all }
    / missed$/ { ++all }
    END { printf "killed %d of %d\n", killed, all }' "$said"
