#!/bin/sh
# host_time.sh [--gates N] [--slower M] [--folder DIR]: how often the gate's host time raises an alarm, by real runs of five
# kernels, about 4 s each on an idle machine, longer on a busy one.
#   --gates N    (200) nothing has changed: each of N + 1 runs is gated against the one before, and against the first
#   --slower M   (100) runs of a copy of the project in which ring_plain_q31 is planted to work a tenth longer, each gated
#                against the run of this build beside it, until M were judged
# The runs stay in DIR (build/gate); a series that was stopped goes on where it was. Prints each alarm, then the counts.
# Every run sits on the machine as it is: how busy it is belongs to the answer.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
program=$root/build/host/cli/glsum
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
# The program as it is now: a build in the meantime must not change the series.
[ -x "$folder/glsum" ] || cp "$program" "$folder/glsum"
program=$folder/glsum

# The planted copy: the plain loop of 64-bit accumulators does a part of its work twice, as much as made it 10.3 % slower
# where it was tuned. Where the linker puts the loop moves that, up to 30 % was seen: check what the copy takes before
# believing. The sum itself is untouched, so its answers stay right.
plant() {
    copy=$folder/slower/source
    planted=kernels/glsum/technique/plain.hpp
    [ ! -x "$folder/slower/glsum" ] || return 0
    (cd "$root" && git ls-files) | while IFS= read -r file; do
        [ -f "$root/$file" ] || continue
        mkdir -p "$copy/$(dirname "$file")"
        cp -p "$root/$file" "$copy/$file"
    done
    perl -0pi -e 's/(static typename Format::Accumulator sum\(const typename Format::Coefficient\* table,\s+const Window<typename Format::Sample>& window,\s+typename Format::Sample newest, const typename Format::Scale& scale\) \{\n)/$1        if constexpr (std::is_same_v<typename Format::Accumulator, long> \&\& sizeof(typename Format::Sample) == 4) {\n            auto again = Format::start(newest, scale);\n            for (std::size_t i = 0; i < (window.newer_count + window.older_count) \/ 7; ++i) {\n                again = accumulate<Format, false>(again, table[i], window.newer[0]);\n                asm volatile("" : "+r"(again));\n            }\n        }\n/' "$copy/$planted"
    ! cmp -s "$root/$planted" "$copy/$planted" || { echo "host_time.sh: the plant does not match in $planted" >&2; exit 2; }
    cmake -S "$copy" -B "$folder/slower/build" -G Ninja -DCMAKE_BUILD_TYPE=Release >"$folder/log" &&
        cmake --build "$folder/slower/build" --target glsum_cli >"$folder/log" || { tail "$folder/log" >&2; exit 1; }
    cp "$folder/slower/build/cli/glsum" "$folder/slower/glsum"
}

# record PROGRAM NAME
record() {
    [ ! -s "$folder/$2.json" ] || return 0
    "$1" bench --quick --targets host --orders 0.5 --taps 600 --signals step --repetitions 200 --out "$folder/$2.json" \
        --kernels ring_plain_f32,ring_horner_f32,mirror_multi_f32,mirror_simd_f32,ring_plain_q31,peer_std_f32,peer_eigen_f32,peer_std_q31 >"$folder/log" 2>&1 ||
        { tail "$folder/log" >&2; exit 1; }
    rm -f "$folder/$2.csv" "$folder/$2.svg" "$folder/$2.png"
}

# gate BASELINE CURRENT: its exit status; what it says of times is in $folder/said
gate() {
    "$program" gate --baseline "$folder/$1.json" --current "$folder/$2.json" --thresholds "$root/results/thresholds.toml" \
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
record "$program" run0
i=1
while [ $i -le "$gates" ] || [ $tried -lt "$slower" ]; do
    record "$program" "run$i"
    if [ $i -le "$gates" ]; then
        gate "run$((i - 1))" "run$i" || { alarms=$((alarms + 1)); cat "$folder/said"; }
        [ $unsettled = no ] || moved=$((moved + 1))
        gate run0 "run$i" || against_first=$((against_first + 1))
    fi
    if [ $tried -lt "$slower" ]; then
        record "$folder/slower/glsum" "slower$i"
        alarm=no
        gate "run$i" "slower$i" || alarm=yes
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
echo "nothing changed: $alarms of $gates gates against the run before raise an alarm, $against_first of $gates against the first run;" \
    "in $moved of $gates the machine moved and times were not judged"
[ "$slower" -eq 0 ] || echo "a tenth slower: $caught of $slower gates raise an alarm, $named name the kernel;" \
    "$slower_moved more were not judged, as the machine moved"
