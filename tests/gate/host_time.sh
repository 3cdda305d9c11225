#!/bin/sh
# host_time.sh [--gates N] [--slower M] [--folder DIR]: how often the gate's host time raises an alarm, by real runs of five
# kernels, about 4 s each on an idle machine, longer on a busy one.
#   --gates N    (200) nothing has changed: each of N + 1 runs is gated against the one before, and against the first
#   --slower M   (100) runs of a copy of the project in which ring_plain_q31 is planted to work a tenth longer where it is
#                told to, each gated against a run of the same copy beside it that was not, until M were judged
# The runs stay in DIR (build/gate); a series that was stopped goes on where it was. Prints each alarm, then the counts.
# Every run sits on the machine as it is: how busy it is belongs to the answer.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
programs=$root/build/host/cli
gates=200
slower=100
folder=$root/build/gate
while [ $# -gt 0 ]; do
    case $1 in
        --gates) gates=$2; shift 2 ;;
        --slower) slower=$2; shift 2 ;;
        --folder) folder=$2; shift 2 ;;
        *) echo "host_time.sh: expected --gates N, --slower M or --folder DIR, found $1" >&2; exit 2 ;;
    esac
done
mkdir -p "$folder"
# The programs as they are now: a build in the meantime must not change the series.
for program in glsum-bench glsum-gate; do
    [ -x "$folder/$program" ] || cp "$programs/$program" "$folder/$program"
done

# The planted copy: where SLOWER is in its environment, ring_plain_q31 sums every tenth sample twice. One program for both:
# another build lays its loops elsewhere, which alone moved them by up to 30 %. The sum itself is untouched.
plant() {
    copy=$folder/slower/source
    planted=kernels/glsum/sum.cpp
    [ ! -x "$folder/slower/glsum-bench" ] || return 0
    (cd "$root" && git ls-files) | while IFS= read -r file; do
        [ -f "$root/$file" ] || continue
        mkdir -p "$copy/$(dirname "$file")"
        cp -p "$root/$file" "$copy/$file"
    done
    perl -0pi -e '
        s/(#include <limits>\n)/#include <cstdlib>\n$1/ &&
        s/(template <class History, class Technique, class Format>\nauto Sum<History, Technique, Format>::step)/
            "namespace {\nconst bool slower = std::getenv(\"SLOWER\") != nullptr;\nunsigned turn = 0;\n" .
            "template <class Technique, class Format, class... Arguments>\n[[gnu::noinline]] auto sum_of(const Arguments&... of) {\n" .
            "    return Technique::template sum<Format>(of...);\n}\n}  \/\/ namespace\n\n$1"/e &&
        s/const auto sum = Technique::template sum<Format>(\(state\.table, window, newest, state\.scale\));/
            "if constexpr (std::is_same_v<History, Ring> && std::is_same_v<Technique, Plain> && std::is_same_v<Format, Q31>) {\n" .
            "    if (slower && ++turn % 10 == 0) {\n        auto again = sum_of<Technique, Format>$1;\n" .
            "        asm volatile(\"\" : : \"r\"(again) : \"memory\");\n    }\n}\n" .
            "const auto sum = sum_of<Technique, Format>$1;"/e or exit 1' "$copy/$planted" ||
        { echo "host_time.sh: the plant does not match in $planted" >&2; exit 2; }
    cmake -S "$copy" -B "$folder/slower/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DGLSUM_DRIVE=OFF -DGLSUM_TESTS=OFF >"$folder/log" &&
        cmake --build "$folder/slower/build" --target glsum-bench >"$folder/log" || { tail "$folder/log" >&2; exit 1; }
    cp "$folder/slower/build/cli/glsum-bench" "$folder/slower/glsum-bench"
}

# record PROGRAM NAME
record() {
    [ ! -s "$folder/$2.json" ] || return 0
    "$1" --quick --targets host --orders 0.5 --taps 600 --signals step --repetitions 200 --out "$folder/$2.json" \
        --kernels ring_plain_f32,ring_horner_f32,mirror_multi_f32,mirror_simd_f32,ring_plain_q31,peer_std_f32,peer_eigen_f32,peer_std_q31 >"$folder/log" 2>&1 ||
        { tail "$folder/log" >&2; exit 1; }
    rm -f "$folder/$2.csv" "$folder/$2.svg" "$folder/$2.png"
}

# gate BASELINE CURRENT: its exit status; what it says of times is in $folder/said
gate() {
    "$folder/glsum-gate" --baseline "$folder/$1.json" --current "$folder/$2.json" --thresholds "$root/results/thresholds.toml" \
        >"$folder/all" 2>&1
    status=$?
    sed -n "/^Failures/,/^\$/s|^  host_time  *\(gl/.*\)|$2: \1|p" "$folder/all" >"$folder/said"
    unsettled=no
    ! grep -q 'whose code is not ours, moved' "$folder/all" || unsettled=yes
    [ $status -le 1 ] || { cat "$folder/all" >&2; exit 1; }
    return $status
}

[ "$slower" -eq 0 ] || plant
alarms=0 against_first=0 moved=0 tried=0 caught=0 named=0 slower_moved=0
[ "$gates" -eq 0 ] || record "$folder/glsum-bench" run0
i=1
while [ $i -le "$gates" ] || [ $tried -lt "$slower" ]; do
    if [ $i -le "$gates" ]; then
        record "$folder/glsum-bench" "run$i"
        gate "run$((i - 1))" "run$i" || { alarms=$((alarms + 1)); cat "$folder/said"; }
        [ $unsettled = no ] || moved=$((moved + 1))
        gate run0 "run$i" || against_first=$((against_first + 1))
    fi
    if [ $tried -lt "$slower" ]; then
        record "$folder/slower/glsum-bench" "asis$i"
        SLOWER=1 record "$folder/slower/glsum-bench" "slower$i"
        alarm=no
        gate "asis$i" "slower$i" || alarm=yes
        if [ $unsettled = yes ]; then
            slower_moved=$((slower_moved + 1))
        else
            tried=$((tried + 1))
            [ $alarm = no ] || caught=$((caught + 1))
            ! grep -q ring_plain_q31 "$folder/said" || named=$((named + 1))
        fi
    fi
    i=$((i + 1))
done
[ "$gates" -eq 0 ] || echo "nothing changed: $alarms of $gates gates against the run before raise an alarm, $against_first of $gates against the first run;" \
    "in $moved of $gates the machine moved and times were not judged"
[ "$slower" -eq 0 ] || echo "a tenth slower: $caught of $slower gates raise an alarm, $named name the kernel;" \
    "$slower_moved more were not judged, as the machine moved"
