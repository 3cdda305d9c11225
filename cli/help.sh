#!/bin/sh
# help.sh PROGRAMS [FOLDER]: writes what every program of the folder PROGRAMS says to --help, a page each, to FOLDER (cli/help, from
# which the launcher answers before anything is built), and all options as one table.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
programs=${1:?help.sh: expected the folder of the built programs}
folder=${2:-$here/help}
mkdir -p "$folder"
: >"$folder/options.tsv"
sed '/^ *#/d; /^ *$/d; s/ *|.*//' "$here/commands" | while read -r words; do
    [ "$words" != test ] || continue  # it has no program: its page is written by hand
    program=glsum-$(echo "$words" | tr ' ' '-')
    "$programs/$program" --help >"$folder/$program"
    "$programs/$program" --list-options >>"$folder/options.tsv"
    for part in $(sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p' "$folder/$program"); do
        "$programs/$program" "$part" --help >"$folder/$program-$part"
    done
done
