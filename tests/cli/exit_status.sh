#!/bin/sh
# Exit statuses and messages of wrong use, bad input and missing tools. Argument: the glsum program.
set -u
program=$1
. "$(dirname "$0")/expect.sh"

small="--quick --kernels null --taps 1 --signals step --out $folder/out.json"
expect 0 "Example:" bench --help
expect 0 "0." --version
expect 2 "expected a command first" --quick
expect 2 "bnech" bnech
expect 2 "--no-such-option" bench --no-such-option
expect 2 "--orders: expected a number in (-2, 2], found 3" bench --orders 3
expect 2 "found -2" bench --orders -2,0.5
expect 2 "--orders: expected a number in (-2, 2], found half" bench --orders half
expect 2 "--jobs: expected a number of at least 1, found 0" bench --jobs 0
expect 2 "--step-s: expected a number above 0, found -1" simulate --model any.json --step-s -1
expect 2 "--out: expected a name that ends in .html, found page.pdf" report --out page.pdf
expect 2 "found backlash.width; the nearest is backlash." stand --set backlash.width=1
expect 2 "the nearest is backlash" stand --without bcklash
expect 2 "--taps: expected a number of at least 1 and at most 1000000, full, or near taps and modes as 2+7, found 0" bench --taps 0
expect 2 "found 1000001" bench --taps 1000001
expect 2 "--jobs" bench --jobs 1000000
expect 2 "found 50x" bench --taps 50x
expect 2 "found square" bench --signals square
expect 2 "found gpu" bench --targets gpu
expect 2 "no kernel is called nothing*" bench --kernels 'nothing*'
expect 2 "--benchmark_no_such_flag" bench $small --targets host --benchmark_no_such_flag=1
expect 2 "has no rows" bench --quick --kernels peer_std_f32 --targets m7 --out "$folder/out.json"
expect 2 "cannot write" bench --quick --out /proc/glsum/out.json
expect 2 "expected to match some timing" bench $small --targets host --benchmark_filter=no-such-row
GLSUM_QEMU=no-such-emulator expect 3 "qemu-system-arm" bench $small --targets m7
expect 0 "rows in" bench $small --targets host --benchmark_min_time=0.01
[ "$failures" -eq 0 ]
