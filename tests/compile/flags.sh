#!/bin/sh
# The unit tests under one set of flags. usage: flags.sh FOLDER NAME "TEST ARGUMENTS" COMPILER FLAGS...
name=$2 arguments=$3 compiler=$4
folder=$1/$2
shift 4
mkdir -p "$folder" || exit 1
. tests/compile/step.sh
have "$compiler" "$compiler" "unit tests, $name" || exit 0

unit_tests() {
    "$compiler" -std=c99 $WARN "$@" tests/*.c examples/common/file.c -o "$folder/tests" -lm &&
        "$folder/tests" $arguments
}

echo 'int main(void) { return 0; }' > "$folder/probe.c"
if "$compiler" "$@" "$folder/probe.c" -o "$folder/probe" 2> /dev/null && "$folder/probe"; then
    step "unit tests, $name" unit_tests "$@"
else
    echo "skipped unit tests, $name: $compiler has no $* here"
fi
exit 0
