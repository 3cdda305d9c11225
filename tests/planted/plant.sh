#!/bin/sh
# plant.sh [--bugs FILE] [--rotate N] [--only GLOB]... [--list | --check]: plants the bugs of bugs.txt one at a time in a copy of the
# project, builds, runs the unit tests there, and reports each bug that they do not catch. Exit 0 when all were caught.
#   --bugs FILE  those of another list; each in the libraries and in the tests, which see headers
#   --rotate N   only N of them, the next N at each commit: in time, all
#   --only GLOB  only those whose name matches one of the globs
#   --check      plants none and builds nothing: says which cannot be planted in today's sources
#   --alone      with --bugs, for a first look: what its tests miss of a file that is compiled alone is missed
# The copy stays in build/planted; a second run starts faster. GLSUM_PLANT_LIMIT_S: seconds that a test program may take on
# a busy machine, 240 otherwise. GLSUM_PLANT_FLAGS: the compiler's, -D_GLIBCXX_ASSERTIONS otherwise; none as the project is built.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
rotate=0
only=
list=no
check=no
alone_only=no
file=$here/bugs.txt
mark=
while [ $# -gt 0 ]; do
    case $1 in
        --rotate) rotate=$2; shift 2 ;;
        --only) only="$only $2"; shift 2 ;;
        --list) list=yes; shift ;;
        --check) check=yes; shift ;;
        --alone) alone_only=yes; shift ;;
        --bugs) file=$2; mark='!'; shift 2 ;;
        *) echo "plant.sh: expected --bugs FILE, --rotate N, --only GLOB, --alone, --list or --check, found $1" >&2; exit 2 ;;
    esac
done

# The library that a file belongs to, and the tests that are to notice.
library_of() {
    case $1 in
        kernels/glsum/design/band* | kernels/glsum/design/derivative* | kernels/glsum/design/filter.cpp | kernels/glsum/design/rational.cpp)
            echo kernels/glsum/design/libglsum_filters.a ;;
        kernels/glsum/design/*) echo kernels/glsum/design/libglsum_design.a ;;
        kernels/glsum/model/pid*) echo bench/libglsum_generate_steppers.a ;;
        kernels/glsum/model/*) echo kernels/glsum/model/libglsum_model.a ;;
        kernels/*) echo kernels/libglsum.a ;;
        base/*) echo base/libglsum_base.a ;;
        reference/*) echo reference/libglsum_reference.a ;;
        bench/rows/*) echo bench/libglsum_results.a ;;
        bench/sweep/*) echo bench/libglsum_sweep.a ;;
        bench/host/*) echo bench/libglsum_host.a ;;
        bench/target/*) echo bench/libglsum_target.a ;;
        bench/studies/horizons.cpp | bench/studies/model*.cpp | bench/studies/records.cpp) echo bench/libglsum_drive_studies.a ;;
        bench/studies/bands* | bench/studies/derivative*) echo bench/libglsum_band_study.a ;;
        bench/studies/*) echo bench/libglsum_studies.a ;;
        bench/report/best.cpp | bench/report/curves.cpp | bench/report/front_table.cpp | bench/report/table.cpp | bench/report/plot.cpp | bench/report/plot_message.cpp | bench/report/discretisation_table.cpp) echo bench/libglsum_shown.a ;;
        bench/gate/*) echo bench/gate/libglsum_gate.a ;;
        bench/choose/*) echo bench/libglsum_choose.a ;;
        bench/report/*) echo bench/libglsum_report.a ;;
        bench/steppers/*) echo bench/libglsum_generate_steppers.a ;;
        bench/generate/*) echo bench/libglsum_generate.a ;;
        bench/texts/*) echo bench/libglsum_texts.a ;;
        bench/verify/*) echo bench/libglsum_verify.a ;;
        bench/*) echo bench/libglsum_bench.a ;;
        docs/site/*) echo docs/site/libglsum_docs_facts.a ;;
        drive/stand/*) echo drive/stand/libglsum_stand.a ;;
        drive/tune/*) echo drive/tune/libglsum_tune.a ;;
        drive/*) echo drive/libglsum_drive.a ;;
        gap/cycles/*) echo gap/cycles/libglsum_gap_cycles.a ;;
        gap/exam/*) echo gap/exam/libglsum_exam.a ;;
        gap/verdict/*) echo gap/verdict/libglsum_gap_verdict.a ;;
        gap/*) echo gap/libglsum_gap.a ;;
        qemu/timing/*) echo qemu/timing/libglsum_timing.a ;;
        qemu/emulate/answers.cpp | qemu/emulate/elf.cpp) echo qemu/libglsum_readers.a ;;
        qemu/emulate/*) echo qemu/libglsum_qemu.a ;;
        qemu/*) echo qemu/libglsum_stream.a ;;
        *) echo "plant.sh: no library is known for $1" >&2; return 2 ;;
    esac
}
tests_of() {
    case $1 in
        kernels/glsum/design/held.hpp) echo choose_tests ;;
        kernels/glsum/design/rational.cpp) echo bench_tests choose_tests ;;
        kernels/glsum/design/band_fit_body.hpp) echo band_fit_tests modes_tests ;;
        kernels/glsum/design/*) echo modes_tests ;;
        kernels/glsum/model/pid*) echo controller_tests ;;
        kernels/glsum/model/*) echo drive_tests ;;
        kernels/*) echo kernel_tests modes_tests bench_tests ;;
        base/*) echo base_tests bench_tests ;;
        bench/choose/*) echo choose_tests ;;
        bench/steppers/*) echo controller_tests ;;
        bench/texts/*) echo texts_tests choose_tests make_headers ;;
        bench/generate/* | bench/verify/*) echo choose_tests make_headers ;;
        bench/report/table.* | bench/report/plot* | bench/report/discretisation_table.* | reference/*) echo bench_tests qemu_tests ;;
        bench/report/*) echo bench_tests browser_tests ;;
        bench/studies/horizon* | bench/studies/model* | bench/studies/record*) echo studies_tests ;;
        bench/studies/bands* | bench/studies/derivative*) echo choose_tests ;;
        bench/*) echo bench_tests qemu_tests ;;
        docs/site/*) echo docs_tests ;;
        drive/tune/*) echo tune_tests ;;
        drive/*) echo drive_tests ;;
        gap/cycles/*) echo gap_cycles_tests ;;
        gap/*) echo gap_parts_tests gap_tests ;;
        qemu/timing/marked_timer.*) echo qemu_tests bench_tests ;;
        qemu/timing/* | qemu/emulate/measured_* | qemu/emulate/predicted_* | qemu/emulate/rows_* | qemu/emulate/silicon*) echo timing_tests ;;
        *) echo qemu_tests bench_tests ;;
    esac
}
bugs=$(sed "/^ *#/d; /^ *\$/d; s/^/$mark/" "$file")
total=$(printf '%s\n' "$bugs" | wc -l)
[ "$list" = no ] || { printf '%s\n' "$bugs" | cut -d '|' -f 1; echo "$total bugs"; exit 0; }
if [ "$check" = yes ]; then
    status=0
    printf '%s\n' "$bugs" | perl "$here/plant.pl" --check "$source" || status=1
    for file in $(printf '%s\n' "$bugs" | sed '/^!/d' | cut -d '|' -f 2 | sort -u); do library_of "$file" >/dev/null || status=1; done
    [ "$status" -ne 0 ] || echo "$total bugs can be planted"
    exit "$status"
fi
if [ "$rotate" -gt 0 ]; then
    commits=$(git -C "$source" rev-list --count HEAD 2>/dev/null || echo 0)
    first=$((commits * rotate % total))
    bugs=$(printf '%s\n%s\n' "$bugs" "$bugs" | sed -n "$((first + 1)),$((first + rotate))p")
fi

# The copy: what git tracks, as it is in the working tree; unchanged files keep their times, so that ninja keeps its objects.
# Its build folder lies as the project's own does, so that a compiler cache, where one is in use, knows its objects again.
# The standard library checks indices there: what is read beyond an end fails, whatever lies behind it. Without that every object
# is one that the project's own build has made, which saves CI a second build of everything.
copy=$source/build/planted/source
build=$copy/build/host
mkdir -p "$copy" "$build"
export CCACHE_BASEDIR="$copy" CCACHE_NOHASHDIR=1
exec 9>"$source/build/planted/lock"
flock --nonblock 9 || { echo "plant.sh: another run is at work in build/planted" >&2; exit 2; }
(cd "$source" && git ls-files --cached --others --exclude-standard) | while IFS= read -r file; do
    [ -f "$source/$file" ] || continue
    cmp -s "$source/$file" "$copy/$file" && continue
    mkdir -p "$copy/$(dirname "$file")"
    cp -p "$source/$file" "$copy/$file"
    touch "$copy/$file"
done
# What runs on the emulated board: its own tests notice, where there is a board.
firmware=${GLSUM_FIRMWARE_BUILD:-$source/build/mps2-an500}
of_firmware() {
    case $1 in
        qemu/emulate/firmware.* | qemu/emulate/model_run.* | qemu/emulate/watched.*)
            [ -e "$firmware/targets/measure.elf" ] && command -v "${GLSUM_QEMU:-qemu-system-arm}" >/dev/null ;;
        *) false ;;
    esac
}
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
file=none
program=
compile() { ninja -C "$build" -j "$jobs" "$@" >"$source/build/planted/build.log" 2>&1; }
# A listed bug is one of a program: what does not build tells nothing of the tests, unless an assertion of the code stops it.
not_built() {
    if grep -q 'static assertion' "$source/build/planted/build.log"; then echo 'caught by a static assertion'; else echo "stale: it does not $1"; fi
}
run_tests() {
    for test in "$@"; do
        # Emulator tests need firmware and time: the bugs here are of the host's libraries.
        case $test in
            qemu_tests)
                only_these='Thumb.*:*CallCounter*.*:Function*.*:Disassemble.*:TimedProgram.*:Answers.*:Words.*:Elf.*:SoftwareDouble.*:MarkedTimer.*:TimedCalls.*:ModelledCalls.*:Emulat*:Replay.*:Board.*:Measure*:TargetRows.*:MadeElf.*'
                # The real emulator takes minutes: those of its tests that look at counts, cycles and faults.
                ! of_firmware "$file" || only_these="$only_these:FirmwareTest.C*R*:FirmwareTest.M*:FirmwareTest.A*:ModelRun.*"
                ;;
            timing_tests) only_these='-Objdump.*' ;;
            *) only_these='*' ;;
        esac
        ended=0
        limit=${GLSUM_PLANT_LIMIT_S:-240}
        ! of_firmware "$file" || limit=$((4 * limit))
        [ "$test" != gap_tests ] || limit=$((4 * limit))  # whole diagnoses
        log=$source/build/planted/tests.log
        case $test in
            # Headers of every kernel, compiled and run here.
            make_headers)
                timeout "$limit" env -u GLSUM_REQUIRE_FIRMWARE sh "$copy/tests/generate/compilers.sh" "${program:-$build/tests/make_headers}" "$copy" none >"$log" 2>&1 ||
                    { ended=$?; echo '[  FAILED  ] generate.compilers' >>"$log"; }
                ;;
            *)
                # What takes long comes last: most bugs are caught before.
                case $test in
                    drive_tests) long='ClosedLoop.Direct*:PublishedSeeds.*:*PublishedOpenSeeds.*:BlindCases.*:Fit.*:RealtimeController.*:StepResponse.IsTheOracle*:OpenCases.*:WholeRecord.StaysWithin*:Coverage.*' ;;
                    tune_tests) long='Tune.*:Stability.By*:Margins.*' ;;
                    bench_tests) long='EqualCost.*:Accuracy.Of*:GateTime.*:Report.*' ;;
                    gap_tests) long='NextExperiment.*:Deployed.*:Exam.*:FittedBase.*:Oracle.*:Verdict.*:Base.*:JointGap.*:Simulated.*:Candidates.*:GapIdentifiable.*:Gap/*' ;;
                    *) long= ;;
                esac
                for part in "${long:+$only_these-$long}" "${long:-$only_these}"; do
                    [ -n "$part" ] && [ "$ended" -eq 0 ] || continue
                    timeout "$limit" "${program:-$build/tests/$test}" --gtest_brief=1 --gtest_fail_fast --gtest_filter="$part" >"$log" 2>&1 || ended=$?
                done
                ;;
        esac
        [ "$ended" -eq 0 ] || [ "$ended" -eq 77 ] || return "$ended"  # 77: no browser is here
    done
}
wanted() {
    set -f
    for glob in ${only:-*}; do
        case $1 in $glob) set +f; return 0 ;; esac
    done
    set +f
    return 1
}
# Not by IFS='|': read takes a | that ends the line for the end of a field, and "& => |" would take the & out.
fields() {  # LINE
    name=${1%%|*} change=${1#*|}
    file=${change%%|*} change=${change#*|}
    symbol=${change%%|*} change=${change#*|}
}
printf '%s\n' "$bugs" | while IFS= read -r line; do
    fields "$line"
    name=$(echo $name) file=$(echo $file)
    ! wanted "${name#!}" || printf '%s|%s|%s|%s\n' "$name" "$file" "$(echo "$symbol" | sed 's/^ *//; s/ *$//')" \
        "$(printf '%s' "$change" | sed 's/^ *//; s/ *$//')"
done >"$source/build/planted/bugs"
all_tests=$(while IFS='|' read -r name file symbol change; do tests_of "$file"; done <"$source/build/planted/bugs" | tr ' ' '\n' | sort -u)
# A run that was killed left a bug in objects whose source looks older: none of them can be trusted.
[ ! -e "$build/marker" ] || find "$build" -name '*.o' -delete
(cd "$copy" && cmake --preset host -D CMAKE_CXX_FLAGS="${GLSUM_PLANT_FLAGS--D_GLIBCXX_ASSERTIONS}" -D GLSUM_FIRMWARE_BUILD="$firmware") >"$source/build/planted/configure.log" 2>&1 ||
    { tail -n 20 "$source/build/planted/configure.log" >&2; exit 3; }
compile $all_tests || { tail -n 20 "$source/build/planted/build.log" >&2; echo "plant.sh: the project does not build without a bug" >&2; exit 1; }
run_tests $all_tests || { tail -n 20 "$source/build/planted/tests.log" >&2; echo "plant.sh: the tests fail without a bug" >&2; exit 1; }

# A file that one library compiles is compiled by itself and linked before it, where the first of two definitions counts: no
# bundle of files is compiled, and nothing has to be made as it was. What the bundle's other files inlined of it is not seen so:
# what is missed like this is built in whole. It need not be fast: -O1.
alone=$source/build/planted/alone
compile_alone() {  # FILE
    perl -e '
        my ($build, $file, $copy, $object) = @ARGV;
        my %holds = map { $_ => 1 } grep { open my $in, "<", $_; grep { m{/\Q$file\E"} } <$in> } grep { !/glsum_plugin/ } glob "$build/{*,*/*}/CMakeFiles/*.dir/Unity/*.cxx";
        open my $in, "<", "$build/compile_commands.json" or die;
        my ($command, @found);
        while (<$in>) {
            $command = $1 if /"command": "(.*)",$/;
            push @found, $command if m{"file": "(.*)"} && ($1 eq "$copy/$file" || $holds{$1}) && $command !~ /glsum_plugin\.dir/;
        }
        exit 1 unless @found == 1;
        ($command = $found[0]) =~ s/\\(.)/$1/g;
        $command =~ s{ -o \S+ -c \S+$}{ -O1 -o $object -c $copy/$file} or exit 1;
        print $command' "$build" "$1" "$copy" "$alone.o" >"$alone.sh" && (cd "$build" && sh "$alone.sh") >"$alone.log" 2>&1
}
link_alone() {  # TEST
    ninja -C "$build" -t commands "tests/$1" | tail -n 1 |
        sed "s/^: && //; s/ && .*//; s| -o [^ ]* | -Wl,--allow-multiple-definition -o $alone $alone.o |" >"$alone.sh" &&
        (cd "$build" && sh "$alone.sh") >"$alone.log" 2>&1
}
caught_alone() {  # FILE TEST...
    case $1 in *.cpp) ;; *) return 1 ;; esac
    compile_alone "$1" || return 1
    shift
    # What an earlier bug was built into in whole is built again without it; this one's file is as it was meanwhile.
    cp -p "$copy/$file" "$build/changed"
    cp -p "$build/original" "$copy/$file"
    compile "$@"
    touch "$build/marker"
    cp -p "$build/changed" "$copy/$file"
    touch "$copy/$file"
    for test in "$@"; do
        link_alone "$test" || return 1
        status=0
        program=$alone
        run_tests "$test" || status=$?
        program=
        [ "$status" -eq 0 ] || return 0
    done
    judged=yes
    return 1
}

judged=no
caught=0
missed=''
number=0
count=$(wc -l <"$source/build/planted/bugs")
while IFS= read -r line <&3; do
    fields "$line"
    number=$((number + 1))
    tests=$(tests_of "$file")
    cp -p "$copy/$file" "$build/original"
    touch "$build/marker"
    how=missed
    stale=$(perl "$here/plant.pl" "$copy/$file" "$symbol" "$change" 2>&1) || how="stale: in $file: $stale"
    status=0
    case $how$name in
        stale*) ;;
        missed!*)
            judged=no
            if ! caught_alone "$file" $tests && [ "$alone_only$judged" != yesyes ]; then
                # One after the other: what the first test catches is not built into the others.
                for test in $tests; do
                    compile "$test" || how='caught (does not compile)'
                    [ "$how" = missed ] && run_tests "$test" || { status=$?; break; }
                done
            fi
            ;;
        *)
            # Only the library sees the bug; then the file is old again, and the tests are linked, not compiled.
            compile "$(library_of "$file")" || how=$(not_built compile)
            cp -p "$build/original" "$copy/$file"
            [ "$how" != missed ] || compile $tests || how=$(not_built link)
            [ "$how" != missed ] || run_tests $tests || status=$?
            ;;
    esac
    if [ "$how" = missed ] && [ "$status" -ne 0 ]; then
        how="caught by $(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$source/build/planted/tests.log" | sed '1q;d')"
        [ "$how" != "caught by " ] || how='caught by a crash'
        [ "$status" -ne 124 ] || how=hangs
    fi
    # As it was: the file with its time, and no object that saw the bug.
    cp -p "$build/original" "$copy/$file"
    case $name in !*) saw=$build ;; *) saw=$build/$(dirname "$(library_of "$file")") ;; esac
    find "$saw" -name '*.o' -newer "$build/marker" -delete
    rm "$build/marker"
    printf '%3d/%d  %-34s %s\n' "$number" "$count" "${name#!}" "$how"
    case $how in missed | stale*) missed="$missed ${name#!}" ;; *) caught=$((caught + 1)) ;; esac
done 3<"$source/build/planted/bugs"
echo "$caught planted bugs caught, $(echo $missed | wc -w) missed:$missed"
[ -z "$missed" ]
