#!/bin/sh
# same.sh FOLDER1 FOLDER2: whether two reports have the same errors and counts, byte for byte: all columns of their CSV files
# but those of times and of what times give. Of papers.csv, which is made of the others, nothing.
here=$(dirname "$0")
[ -d "$1" ] && [ -d "$2" ] || { echo "usage: same.sh FOLDER1 FOLDER2" >&2; exit 2; }
lasting() { # CSV file: without its times
    awk -f "$here/csv.awk" -f "$here/lasting.awk" "$1"
}
compared=0 failed=0
for file in "$1"/*.csv "$2"/*.csv; do
    name=$(basename "$file")
    [ "$name" != papers.csv ] || continue
    if [ ! -e "$1/$name" ] || [ ! -e "$2/$name" ]; then
        echo "FAILED $name is in one of them only" >&2
        failed=$((failed + 1))
        continue
    fi
    [ "$file" = "$1/$name" ] || continue
    lasting "$1/$name" > "$1/same.tmp"
    lasting "$2/$name" > "$1/same2.tmp"
    compared=$((compared + 1))
    diff "$1/same.tmp" "$1/same2.tmp" >&2 || { echo "FAILED $name differs" >&2; failed=$((failed + 1)); }
done
rm -f "$1/same.tmp" "$1/same2.tmp"
[ $failed -eq 0 ] && [ $compared -gt 0 ] || { echo "$failed of $compared files differ" >&2; exit 1; }
echo "ok     $compared files of $1 and $2 are the same but for times"
