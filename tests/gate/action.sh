#!/bin/sh
# The gate in a foreign project's CI: the step of action.yml and that of gitlab.yml run as they are written, with a stand-in for the
# service on loopback. A comment is made once and updated in place; a worse function fails the step. Arguments: the launcher on this build's
# programs, the source folder.
set -u
program=$1
source=$2
folder=$(mktemp -d)
server=
trap '[ -z "$server" ] || kill "$server" 2>/dev/null; rm -rf "$folder"' EXIT
failures=0
. "$(dirname "$0")/../foreign/foreign.sh"
fail() { echo "$*"; failures=$((failures + 1)); }
for needed in curl jq perl; do command -v $needed >/dev/null || { echo "no $needed here"; exit 77; }; done
perl -MIO::Socket::INET -e 1 2>/dev/null || { echo "no sockets in perl here"; exit 77; }
# What a service of comments does: lists them, makes one, replaces one. It keeps them in comments.json and each request in requests.
cat >"$folder/service.pl" <<'PERL'
use strict; use IO::Socket::INET;
my ($folder) = @ARGV;
my $listener = IO::Socket::INET->new(LocalAddr => '127.0.0.1', LocalPort => 0, Listen => 5) or die "no socket";
open(my $port, '>', "$folder/port.new") or die; print $port $listener->sockport; close $port; rename "$folder/port.new", "$folder/port";
my @comments;
while (my $client = $listener->accept) {
    my $first = <$client>; my $length = 0; my $token = 0;
    while (defined(my $line = <$client>)) { last if $line =~ /^\r?$/; $length = $1 if $line =~ /^Content-Length: (\d+)/i; $token = 1 if $line =~ /secret/; }
    my $body = ''; read($client, $body, $length) if $length;
    my ($method, $path) = $first =~ /^(\S+) (\S+)/;
    open(my $log, '>>', "$folder/requests"); print $log "$method $path\n"; close $log;
    my ($code, $answer) = (200, '[]');
    if (!$token) { ($code, $answer) = (401, '{}'); }
    elsif ($method eq 'GET') { $answer = '[' . join(',', map { my $one = $comments[$_]; $one =~ s/^\{/{"id":@{[$_ + 1]},/; $one } 0 .. $#comments) . ']'; }
    elsif ($method eq 'POST') { push @comments, $body; $code = 201; }
    elsif ($path =~ m{/(\d+)$}) { $comments[$1 - 1] = $body; }
    open(my $kept, '>', "$folder/comments.json"); print $kept '[' . join(',', @comments) . ']'; close $kept;
    print $client "HTTP/1.1 $code X\r\nContent-Type: application/json\r\nContent-Length: " . length($answer) . "\r\nConnection: close\r\n\r\n$answer";
    close $client;
}
PERL
perl "$folder/service.pl" "$folder" &
server=$!
for _ in 1 2 3 4 5 6 7 8 9 10; do [ -s "$folder/port" ] && break; sleep 0.2; done
service=http://127.0.0.1:$(cat "$folder/port")

# A foreign project: three functions, one of which grows.
mkdir "$folder/project"
cd "$folder/project" || exit 1
program_of() {  # a program whose ctrl_speed holds that statement
    link_foreign project/app.elf -DSPEED="$1" "$foreign/app.S"
}
program_of nop
"$program" gate --elf app.elf --functions 'ctrl_*' --baseline gate.json --update-baseline --reason "first" >/dev/null 2>&1 || fail "no baseline"

# The step as action.yml has it: its one run line, and what its env: hands on of the inputs.
grep -A 20 'shell: sh' "$source/bench/gate/action/action.yml" >step
command=$(sed -n "s/.*run: '\(.*\)'$/\1/p" step)
[ -n "$command" ] || fail "action.yml: expected a run line"
for name in GLSUM_BASELINE GLSUM_ELF GLSUM_FUNCTIONS GLSUM_BENCH GLSUM_OPTIONS GITHUB_TOKEN; do
    grep -q "^ *$name: " step || fail "action.yml: expected $name in its env"
done
echo '{"pull_request": {"number": 12}}' >event.json
GLSUM_PROGRAMS=$(dirname "$program") && export GLSUM_PROGRAMS
on_github() {
    : >summary.md
    GITHUB_ACTION_PATH=$source/bench/gate/action GLSUM_BASELINE=gate.json GLSUM_ELF=app.elf GLSUM_FUNCTIONS='ctrl_*' GLSUM_BENCH= GLSUM_OPTIONS= \
        GITHUB_TOKEN=secret GITHUB_API_URL=$service GITHUB_REPOSITORY=some/project GITHUB_EVENT_PATH=event.json GITHUB_STEP_SUMMARY=summary.md \
        sh -c "$command" >said 2>&1
}
on_github || fail "an unchanged program: expected status 0, found: $(cat said)"
grep -qF 'POST /repos/some/project/issues/12/comments' "$folder/requests" || fail "expected a comment to be made, found: $(cat "$folder/requests")"
grep -qF 'glsum gate: pass' summary.md || fail "expected the gate's words in the summary: $(cat summary.md)"
program_of 'udiv r2, r2, r1'
on_github
[ $? -eq 1 ] || fail "a worse program: expected status 1, found: $(cat said)"
grep -qF 'PATCH /repos/some/project/issues/comments/1' "$folder/requests" || fail "expected the comment to be updated in place: $(cat "$folder/requests")"
[ "$(jq length "$folder/comments.json")" = 1 ] || fail "expected one comment: $(cat "$folder/comments.json")"
jq -r '.[0].body' "$folder/comments.json" | grep -q 'ctrl.*speed |  | cycles' || fail "expected ctrl_speed in it: $(cat "$folder/comments.json")"
jq -r '.[0].body' "$folder/comments.json" | grep -q 'lost to' || fail "expected what the cycles were lost to"
# Whose comment cannot be written still gets the gate's status.
program_of nop
service=http://127.0.0.1:1
on_github || fail "without the service: expected the gate's status 0, found: $(cat said)"
grep -q 'the comment could not be written' said || fail "expected a word of the comment: $(cat said)"
service=http://127.0.0.1:$(cat "$folder/port")

# GitLab: the last line of its script, on its variables; rows of kernels here.
: >"$folder/requests"
"$program" bench --quick --kernels ring_plain_f32 --orders 0.5 --taps 20 --signals step --targets host --out base.json >/dev/null 2>&1 || fail "bench"
line=$(sed -n 's/^    - \.glsum\/\(.*gate\.sh\)$/\1/p' "$source/bench/gate/action/gitlab.yml")
GLSUM_BASELINE=base.json GLSUM_BENCH='--quick --kernels ring_plain_f32 --orders 0.5 --taps 20 --signals step --targets host' GLSUM_TOKEN=secret \
    CI_API_V4_URL=$service CI_PROJECT_ID=7 CI_MERGE_REQUEST_IID=3 "$source/$line" >said 2>&1 || fail "rows: expected status 0, found: $(cat said)"
grep -qF 'PUT /projects/7/merge_requests/3/notes/1' "$folder/requests" || fail "expected the note to be updated: $(cat "$folder/requests")"
for file in gate.md gate.txt gate.xml; do [ -s $file ] || fail "expected the file $file"; done
jq -r '.[0].body' "$folder/comments.json" | grep -q 'glsum gate: pass' || fail "expected the verdict in the note"
[ "$failures" -eq 0 ]
