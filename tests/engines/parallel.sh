#!/bin/sh
# GNU parallel for real: its merged sweep is the sweep measured at once. Arguments: the glsum program, the engine's script.
set -u
parallel --version 2>/dev/null | grep -q '^GNU parallel' || { echo "GNU parallel is not installed"; exit 77; }
. "$(dirname "$0")/same_sweep.sh"
GLSUM=$1 "$2" 3 "$folder/merged.json" $options >"$folder/engine.txt" 2>&1 || fail "parallel.sh: $(tail -n 5 "$folder/engine.txt")"
compare_with_whole "$1"
[ ! -e "$folder/merged.json.shards" ] || fail "the shards are still there"

# What was measured is not measured again; what failed is told.
mkdir "$folder/again.json.shards"
for index in 1 2; do
    "$1" bench --shard "$index/3" $options --out "$folder/again.json.shards/$index-of-3.json" >/dev/null 2>&1 || fail "shard $index/3"
done
before=$(stat -c %Y.%i "$folder/again.json.shards/1-of-3.json")
echo damaged >"$folder/again.json.shards/2-of-3.json"
GLSUM=$1 "$2" 3 "$folder/again.json" $options >"$folder/engine.txt" 2>&1 && fail "a damaged shard was merged"
grep -q '2-of-3.json:1: ' "$folder/engine.txt" || fail "expected the damaged shard's name, found $(tail -n 2 "$folder/engine.txt")"
[ "$before" = "$(stat -c %Y.%i "$folder/again.json.shards/1-of-3.json")" ] || fail "a shard was measured again"
GLSUM=$1 "$2" 3 "$folder/bad.json" --orders 3 >/dev/null 2>&1 && fail "a failing shard was not told"
GLSUM=$1 "$2" 0 "$folder/bad.json" >/dev/null 2>&1
[ $? -eq 2 ] || fail "expected status 2 for no shards"
[ "$failures" -eq 0 ]
