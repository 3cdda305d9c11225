# For scripts that check a program's words: expect STATUS TEXT ARGUMENT... runs $program and holds its exit status and a
# text in what it says against what is expected. End with `[ "$failures" -eq 0 ]`.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

expect() {
    status=$1 text=$2
    shift 2
    "$program" "$@" >"$folder/said" 2>&1
    found=$?
    if [ "$found" -ne "$status" ] || ! grep -qF -e "$text" "$folder/said"; then
        echo "glsum $*: expected status $status and \"$text\"; found status $found and:"
        head -n 5 "$folder/said"
        failures=$((failures + 1))
    fi
}
