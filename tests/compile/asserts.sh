#!/bin/sh
# The unit tests with every domain condition looked at. Those that leave a function's domain on purpose, to see what
# happens there, are in outside.txt; no other may. usage: asserts.sh FOLDER
folder=$1/asserts
mkdir -p "$folder" || exit 1
. tests/compile/step.sh

outside() {
    gcc -std=c99 $WARN -O2 -include tests/compile/outside.h tests/*.c tests/compile/outside.c examples/common/file.c \
        -o "$folder/tests" -lm && "$folder/tests" --quick > "$folder/tests.txt" || return
    awk '/^outside / { seen[$2] = 1 } /^ok / { for (name in seen) print $2, name; split("", seen) }' "$folder/tests.txt" |
        sort > "$folder/outside.txt"
    grep -v '^#' tests/compile/outside.txt | sort | diff - "$folder/outside.txt" || {
        echo "tests that leave the domain (>) and outside.txt (<) differ"
        return 1
    }
}

step 'unit tests, domain conditions' outside
exit 0
