#!/bin/sh
# gate.sh: the gate as a step of a foreign project's CI. Runs the gate, writes gate.md, gate.txt and gate.xml, a JUnit report, where it
# stands, and keeps one comment at the merge request, which later runs update in place. Its exit status is the gate's.
# What is gated, in the environment:
#   GLSUM_BASELINE   the baseline's file
#   GLSUM_ELF        functions of this program, GLSUM_FUNCTIONS their globs; or
#   GLSUM_BENCH      options of ./glsum bench: rows of kernels, as "--quick --targets m7"
#   GLSUM_OPTIONS    further options of the gate, as "--core stm32h743"
# Where the comment goes: GitHub's or GitLab's own variables; without a token (GITHUB_TOKEN, GLSUM_TOKEN) there is none.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../../.." && pwd)
marker='<!-- glsum gate -->'
say() { printf 'glsum: %s\n' "$*" >&2; }
fail() { say "$2"; exit "$1"; }
: "${GLSUM_BASELINE:?glsum: GLSUM_BASELINE: expected the file of a baseline}"

# Packages are kept for the cache, which Debian's own containers do not do.
rm -f /etc/apt/apt.conf.d/docker-clean 2>/dev/null || true
command -v curl >/dev/null && command -v jq >/dev/null || {
    as_root=; [ "$(id -u)" -eq 0 ] || as_root=sudo
    { $as_root apt-get update && $as_root apt-get install --yes --no-install-recommends ca-certificates curl jq; } >gate-packages.log 2>&1 ||
        say "no curl and jq: no comment is written (gate-packages.log)"
}

status=0
rm -f gate.md gate.xml  # of an earlier run
if [ -n "${GLSUM_ELF:-}" ]; then
    set -f  # globs are of functions and not of files
    "$root/glsum" gate --elf "$GLSUM_ELF" --functions ${GLSUM_FUNCTIONS:-'*'} --baseline "$GLSUM_BASELINE" \
        --junit gate.xml --markdown gate.md --annotations ${GLSUM_OPTIONS:-} >gate.txt 2>gate.err || status=$?
    set +f
else
    "$root/glsum" bench ${GLSUM_BENCH:---quick --targets m7} --out "$PWD/gate-run.json" >gate-run.txt 2>gate.err || fail $? "the run failed: $(tail -n 1 gate.err)"
    "$root/glsum" gate --baseline "$GLSUM_BASELINE" --current gate-run.json --junit gate.xml --markdown gate.md --annotations ${GLSUM_OPTIONS:-} >gate.txt 2>gate.err || status=$?
fi
cat gate.txt
cat gate.err >&2
[ -s gate.md ] || { printf '## glsum gate\n\n'; tail -n 1 gate.err; } >gate.md
[ -z "${GITHUB_STEP_SUMMARY:-}" ] || cat gate.md >>"$GITHUB_STEP_SUMMARY"

# request METHOD URL HEADER [JSON]: prints the answer; no comment is no reason to fail a build.
request() {
    curl --silent --show-error --fail --max-time 30 --request "$1" --header "$3" --header 'Content-Type: application/json' ${4:+--data "$4"} "$2"
}
# comment LIST-URL HEADER UPDATE-METHOD TEXT-FIELD ITEM-URL: the comment that holds the marker is replaced, or one is made.
comment() {
    body=$({ printf '%s\n' "$marker"; head -c 60000 gate.md; } | jq -Rs --arg field "$4" '{($field): .}')
    found=$(request GET "$1?per_page=100" "$2" | jq -r --arg marker "$marker" 'map(select((.body // "") | startswith($marker))) | .[0].id // empty') || return 1
    if [ -n "$found" ]; then request "$3" "$5/$found" "$2" "$body"; else request POST "$1" "$2" "$body"; fi >/dev/null
}
if command -v curl >/dev/null && command -v jq >/dev/null; then
    if [ -n "${GITHUB_TOKEN:-}" ] && [ -f "${GITHUB_EVENT_PATH:-}" ]; then
        number=$(jq -r '.pull_request.number // empty' "$GITHUB_EVENT_PATH")
        api=$GITHUB_API_URL/repos/$GITHUB_REPOSITORY/issues
        [ -z "$number" ] || comment "$api/$number/comments" "Authorization: Bearer $GITHUB_TOKEN" PATCH body "$api/comments" || say "the comment could not be written"
    elif [ -n "${GLSUM_TOKEN:-}" ] && [ -n "${CI_MERGE_REQUEST_IID:-}" ]; then
        api=$CI_API_V4_URL/projects/$CI_PROJECT_ID/merge_requests/$CI_MERGE_REQUEST_IID/notes
        comment "$api" "PRIVATE-TOKEN: $GLSUM_TOKEN" PUT body "$api" || say "the comment could not be written"
    fi
fi
exit "$status"
