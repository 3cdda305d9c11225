#!/bin/sh
# pages.sh ROOT: the pages of a tree. Exit 1 where a relative link or an anchor leads nowhere, where a page does not begin with its
# title, where a README is longer than a screen or two, or where a sentence of one, of docs/ or of the changes is too long. Each with
# its file and line, what was expected and what was found.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$1"
find . -name build -prune -o -name '.?*' -prune -o -name '*.md' -print | sed 's|^\./||' | LC_ALL=C sort | perl "$here/pages.pl"
