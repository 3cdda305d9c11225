#!/bin/sh
# release.sh VERSION: what has to hold before that version is given out, a line each. Exit 1 unless all of it does; nothing is changed.
#   --ci  also runs the whole of .ci/run in a clean clone
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
version=${1:?release.sh: expected a version, as 0.1.0}
cd "$root" || exit 2
failures=0
# holds WHAT COMMAND...: the command is silent or says what is wrong
holds() {
    what=$1
    shift
    if said=$("$@" 2>&1); then
        printf 'ok       %s\n' "$what"
    else
        printf 'missing  %s\n' "$what"
        printf '%s\n' "$said" | head -n 5 | sed 's/^/           /'
        failures=$((failures + 1))
    fi
}
is_version() { echo "$version" | grep -qxE '[0-9]+\.[0-9]+\.[0-9]+'; }
has() { grep -qF -e "$2" "$1" || { echo "$1: expected $2"; return 1; }; }
is_clean() { [ -z "$(git status --porcelain)" ] || { git status --short; return 1; }; }
is_new() { ! git rev-parse --quiet --verify "refs/tags/v$version" >/dev/null || { echo "the tag v$version is there"; return 1; }; }
is_dated() { grep -qE "^## $version \([0-9]{4}-[0-9]{2}-[0-9]{2}\)$" CHANGELOG.md || { echo "CHANGELOG.md: expected a heading '## $version (YYYY-MM-DD)', found: $(grep -m 1 '^## ' CHANGELOG.md)"; return 1; }; }
has_licence() { [ -s LICENSE ] || { echo "no file LICENSE: nobody may use what has no terms"; return 1; }; }
whole_run() {
    clone=$(mktemp -d) && git clone --quiet . "$clone/glsum" && (cd "$clone/glsum" && CI=true .ci/run >"$clone/log" 2>&1) || { tail -n 5 "$clone/log"; return 1; }
    rm -rf "$clone"
}

holds "$version is three numbers" is_version
holds "CMakeLists.txt has it" has CMakeLists.txt "project(glsum VERSION $version "
holds "CITATION.cff has it" has CITATION.cff "version: $version"
holds "CHANGELOG.md says what is new in it, and when" is_dated
holds "there is a licence" has_licence
holds "everything is committed" is_clean
holds "its tag is free" is_new
holds "pages: links lead somewhere, READMEs are short" sh tests/docs/pages.sh .
holds "every schema is described" sh tests/docs/schemas.sh .
holds "who includes whom" sh tests/arrows/arrows.sh .
holds "every planted bug can be planted" sh tests/planted/plant.sh --check
holds "pages of help are what the programs say" sh tests/cli/help.sh "$root/glsum" "$root/build/host/cli" "$root"
[ "${2:-}" != --ci ] || holds ".ci/run in a clean clone" whole_run
[ "$failures" -eq 0 ]
