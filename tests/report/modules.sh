#!/bin/sh
# The page's modules that know no page, in node: modules_test.js. Skipped without node. Then what embed.cmake refuses of a module.
# Argument: the project's folder.
set -eu
source=$1
node=$(command -v node || command -v nodejs) || { echo "no node here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$source"/bench/report/*.js "$source/tests/report/modules_test.js" "$folder"
echo '{"type": "module"}' >"$folder/package.json"  # what the page is told by how it is joined
"$node" "$folder/modules_test.js"

# join TEXT: a module of that text, made part of a page.
join() {
    printf '%s\n' "$1" >"$folder/odd.js"
    cp "$source/bench/report/page.html" "$source/bench/report/page.css" "$folder"
    cmake -D OUT="$folder/parts.cpp" -D FOLDER="$folder" -D SCRIPTS=front.js,odd.js -P "$source/bench/report/embed.cmake" >"$folder/said" 2>&1
}
join 'import {onFront} from "./front.js";
export const none = onFront([]);' || { cat "$folder/said"; exit 1; }
"$node" --input-type=commonjs -e "$(cat "$folder/parts.cpp.js"); if (modules['odd.js'].none.length !== 0) process.exit(1);"
for text in 'import all from "./front.js";' 'import "./front.js";' 'export let now = 1;' 'export {join};' 'export default 1;' 'import {a} from "elsewhere";'; do
    ! join "$text" || { echo "embed.cmake took $text"; exit 1; }
    grep -qF "odd.js: expected" "$folder/said" || { cat "$folder/said"; exit 1; }
done
