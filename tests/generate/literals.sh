#!/bin/sh
# A sum is written once: no string literal of what writes headers states one, and no text of a header. Argument: the source folder.
set -u
root=$1
here=$root/tests/generate
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() { echo "$*"; failures=$((failures + 1)); }

{ echo "$root/bench/generate/header.h.in"; find "$root/kernels" -name '*.h.in'; } >"$folder/files"
[ "$(wc -l <"$folder/files")" -gt 15 ] || fail "expected the texts of headers"
find "$root/bench/generate" "$root/bench/texts" "$root/bench/steppers" "$root/bench/verify" -name '*.cpp' -o -name '*.hpp' -o -name '*.cpp.in' >>"$folder/files"
xargs perl "$here/literals.pl" <"$folder/files" >"$folder/found" ||
    fail "a sum is stated in a literal and in kernels/glsum: $(cat "$folder/found")"

# What it is there to find, whatever puts the statement together.
finds() {
    printf '%s\n' "$1" >"$folder/planted.cpp"
    perl "$here/literals.pl" "$folder/planted.cpp" >/dev/null && fail "not found: $1"
}
finds 'text += "    sum = @name@_multiply_add(sum, @name@_table[i], x[i]);\n";'
finds 'text = "    for (;;) {\n        sum = " + product + "(sum, a[i], x[i]);\n    }\n";'
finds 'text = fmt::format("{:{}}s{} = {}(s{}, c{}, x{});\n", "", indent, q, add, q, i, r);'
finds 'const char* const step = R"(    return lost + (total - grown);
)";'
finds 'text += "    sum += " + product + ";\n";'
finds 'text = "    const @sample@ block = younger + past[at];\n";'

printf '%%section sum\n%%if past\n    sum = @name@_multiply_add(sum, table[i], x[i]);\n%%end\n' >"$folder/planted.h.in"
perl "$here/literals.pl" "$folder/planted.h.in" >/dev/null && fail "not found in a text of headers"
printf '    %%text plain\n    const @sample@ held = before + past[at];\n' >"$folder/planted.h.in"
perl "$here/literals.pl" "$folder/planted.h.in" >/dev/null && fail "not found behind a kernel's statement"

# And what is none.
passes() {
    printf '%s\n' "$1" >"$folder/planted.cpp"
    perl "$here/literals.pl" "$folder/planted.cpp" || fail "found, but no sum: $1"
}
passes 'text = "    const @coefficient@ *weight = @name@_table + @NAME@_PAST;\n";'
passes 'words = {{"product(", "@name@_product("}, {"sum", "s0"}};'
passes 'text = "    /* sum = sum + 1; */\n    const @sample@ added = S->past[@NAME@_PAST - 1U];\n";  // "sum = sum + x;"'
[ "$failures" -eq 0 ]
