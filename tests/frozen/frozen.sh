#!/bin/sh
# frozen.sh make FOLDER [PART...]: writes down in FOLDER what a change of the code's shape must leave alone, a text a part.
# frozen.sh check OLD NEW [--renamed FILE] [PART...]: compares two such folders; a difference is printed, and the status is 1.
#   --renamed FILE  words that have changed on purpose, "OLD NEW" a line: OLD's record is read as if they had been so before
# PART: help, commands, headers, rows, cycles, studies, verdicts; all unless named.
# GLSUM: the program (build/host/cli/glsum). JOBS: threads and emulators at once (2).
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
all="help commands headers rows cycles studies verdicts"
program=$(realpath "${GLSUM:-$here/../../build/host/cli/glsum}")
programs=$(dirname "$program")
root=$(realpath "$programs/../../..")  # the project whose program it is
jobs=${JOBS:-2}
export LC_ALL=C

usage() { sed -n '2,/^set/s/^# //p' "$0" >&2; exit 2; }
fail() { printf 'frozen.sh: %s\n' "$*" >&2; exit 2; }
glsum() { "$program" "$@" --jobs "$jobs"; }

# Every command's page.
part_help() {
    "$root/cli/help.sh" "$programs" "$work/help"
    (cd "$work/help" && for page in *; do sed "s/^/$page: /" "$page"; done)
}

# What each line of commands.txt says and how it ends, in one folder, one after the other. Progress and seconds are no facts.
part_commands() {
    cd "$work"
    sed '/^ *#/d; /^ *$/d' "$here/commands.txt" | while IFS= read -r line; do
        status=0
        (eval "$line") >said 2>&1 </dev/null || status=$?
        printf '%s\n    status %d\n' "$line" $status
        sed -E "/: [0-9]+ of [0-9]+, [0-9]+ s\$/d; s|$work|WORK|g; s|$root|ROOT|g; s/[0-9.]+ s(econds)?\$/T s/" said |
            head -n 40 | sed 's/^/    /'
    done
}

# A hash of each kernel's text, at three orders and lengths.
part_headers() {
    mkdir "$work/headers"
    "$programs/../tests/make_headers" "$work/headers"
    for file in "$work"/headers/*.h; do
        # Its prefix is a number in turn, which a kernel more would shift.
        prefix=$(basename "$file" .h)
        printf '%s %s\n' "$(sed -n '2s/^ \* //p' "$file")" "$(sed "s/\\b$prefix\\b/PREFIX/gI; s/\\b${prefix}_/PREFIX_/gI" "$file" | sha256sum | cut -c 1-64)"
    done
}

# rows FILE: a result file's rows, a line each, without what the clock decides.
rows() {
    awk '
        /^    \{/ { row = ""; name = ""; host = 0; next }
        /^    \}/ { if (name != "") print name row; next }
        /^      "/ {
            key = $1; gsub(/[":]/, "", key)
            value = $0; sub(/^ *"[^"]*": /, "", value); sub(/,$/, "", value)
            if (key == "name") { name = value; gsub(/"/, "", name); host = name ~ /\/host/; next }
            if (key ~ /^(family_index|per_family_instance_index|run_name|record_ms|times_peer|times_measured_peer)$/) next
            # FFTW may choose its plan by timing: then the clock decides its bits.
            if (name ~ /fftwmeasured/ && key ~ /^error_/) next
            if (host && key ~ /^(iterations|real_time|cpu_time|ns_per_sample|cycles_per_sample)$/) next
            row = row " " key "=" value
        }' "$1"
}

# Everything that a quick run measures.
part_rows() {
    glsum bench --quick --benchmark_min_time=0.0001 --out "$work/quick.json" >"$work/quick.txt" 2>&1 ||
        { tail -n 3 "$work/quick.txt" >&2; fail "bench --quick"; }
    rows "$work/quick.json"
}

# Every core file of the Cortex-M7: every kernel at one length, measured silicon, and a foreign program.
part_cycles() {
    cores=$(cd "$root/qemu/cores" && grep -L '"_cortex-m4"' *.toml | sed -n 's/^\([^_].*\)\.toml$/\1/p')
    glsum bench --quick --orders 0.5 --taps 100 --signals step --targets m7 --core "$(echo $cores | tr ' ' ,)" --out "$work/cores.json" \
        >"$work/cores.txt" 2>&1 || { tail -n 3 "$work/cores.txt" >&2; fail "bench with every core"; }
    rows "$work/cores.json" | grep '/m7:'
    for core in $cores; do
        glsum silicon --core "$core" 2>&1 | sed "s/^/silicon $core: /"
        glsum time --elf "$root/build/mps2-an500/targets/biquad.elf" --function main --core "$core" 2>&1 | sed "/0x/d; s|$root|ROOT|g; s/^/time $core: /"
    done
    glsum diagnose cycles --measured "$root/results/silicon/h747_per_sample_fir.csv" --json "$work/cycles.json" >/dev/null
    sed 's/^/diagnose cycles: /' "$work/cycles.json"
}

# Each study in small.
part_studies() {
    study() {
        name=$1
        shift
        glsum bench "$name" "$@" --out "$work/$name.json" >"$work/$name.txt" 2>&1 || { tail -n 3 "$work/$name.txt" >&2; fail "bench $name"; }
        rows "$work/$name.json"
    }
    study models --quick
    study records 1000,4000 --repetitions 1
    study horizons 600,5000
    study equal-cost 16,24 --quick
}

# Blind cases with a model and without: the cases themselves, and what the diagnosis says of them.
part_verdicts() {
    glsum stand --blind 6 --seed 5 --out "$work/given" >"$work/said" 2>&1
    glsum stand --blind 3 --no-model --seed 5 --out "$work/open" >"$work/said" 2>&1
    for set in given open; do
        glsum diagnose --batch "$work/$set" >"$work/said" 2>&1
        (cd "$work/$set" && sha256sum truth.sealed.json */*.csv | sed "s/^/$set cases /")
        (cd "$work/$set" && for case in */verdict.json; do sed "s|^|$set $case: |; s|$work|WORK|g" "$case"; done)
    done
}

parts_of() {
    for part in "$@"; do
        case " $all " in *" $part "*) ;; *) fail "expected some of: $all; found $part" ;; esac
    done
    echo "${*:-$all}"
}

make() {
    [ $# -ge 1 ] || usage
    folder=$1
    shift
    parts=$(parts_of "$@")
    mkdir -p "$folder"
    folder=$(realpath "$folder")
    for part in $parts; do
        work=$(mktemp -d)
        start=$(date +%s)
        ("part_$part") >"$work/made"
        case $part in
            # One after the other, as a person reads them.
            help | commands | verdicts) cp "$work/made" "$folder/$part.txt" ;;
            *) sort "$work/made" >"$folder/$part.txt" ;;
        esac
        rm -rf "$work"
        printf '%-9s %6d lines, %d s\n' "$part" "$(wc -l <"$folder/$part.txt")" $(($(date +%s) - start))
    done
}

check() {
    [ $# -ge 2 ] || usage
    old=$1 new=$2
    shift 2
    renamed=/dev/null
    if [ "${1:-}" = --renamed ]; then
        renamed=${2:?--renamed: expected a file}
        shift 2
    fi
    parts=$(parts_of "$@")
    before=$(mktemp)
    differ=0
    for part in $parts; do
        for side in "$old" "$new"; do
            [ -f "$side/$part.txt" ] || fail "$side/$part.txt: expected a record; frozen.sh make $side $part writes it"
        done
        # Whole words, so that a new name that holds the old one is left alone.
        perl -e '
            open my $pairs, "<", shift or die; my %new;
            while (<$pairs>) { my ($from, $to) = split; $new{$from} = $to if defined $to; }
            my $any = join "|", map quotemeta, sort { length $b <=> length $a } keys %new;
            while (<>) { s/(?<![\w.-])($any)(?![\w.-])/$new{$1}/g if $any ne ""; print; }' "$renamed" "$old/$part.txt" |
            case $part in help | commands | verdicts) cat ;; *) sort ;; esac >"$before"
        diff -u --label "$old/$part.txt" --label "$new/$part.txt" "$before" "$new/$part.txt" || differ=1
    done
    rm "$before"
    [ $differ -eq 0 ] || exit 1
    echo "the same: $parts"
}

[ $# -ge 1 ] || usage
what=$1
shift
case $what in make | check) "$what" "$@" ;; *) usage ;; esac
