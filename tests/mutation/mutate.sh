#!/bin/sh
# mutate.sh BUILD CC COUNT SEED JOBS HEADER... - whether the unit tests notice small faults of the headers
#
# Of each header COUNT faults (mutants.awk; `all` for all), drawn by SEED, are built one at a time with the tests. A
# mutant is killed when a test fails, crashes or takes four times as long as it does; first those of its own header
# are asked, then the others that include it. Not counted: what does not compile, and what a compiler turns into the
# same code. argued.txt names mutants that no test should kill, each with its reason. Survivors are printed; fails if
# of a header's other mutants fewer than 90 % are killed. Files stay in BUILD/mutation.
set -u
build=$1 cc=$2 count=$3 seed=$4 jobs=$5
shift 5
folder=$build/mutation
here=tests/mutation
flags='-std=c99 -O0 -w'
tab=$(printf '\t')

fail() { echo "mutate.sh: $*" >&2; exit 2; }
case $count in all | [1-9]*) ;; *) fail "COUNT is a number or all, not $count" ;; esac
case $count$seed$jobs in *[!0-9al]*) fail "COUNT, SEED and JOBS are numbers" ;; esac
for header; do [ -f "$header" ] || fail "no header $header"; done

# The tests of a header, and those of others that include it
own() { ls "tests/${1%.h}.c" "tests/${1%.h}"_*.c 2> /dev/null; }
others() {
    for test in tests/*.c; do
        $cc -MM "$test" | tr ' ' '\n' | grep -q "/$1\$" && ! own "$1" | grep -q "^$test\$" && echo "$test"
    done
}
names() { # files of tests: the names in their tables
    awk '/^const test_case .*\[\]/ { table = 1 }
         table { while (match($0, /[{]"[^"]*"/)) {
                     print substr($0, RSTART + 2, RLENGTH - 3); $0 = substr($0, RSTART + RLENGTH) } }
         /;$/ { table = 0 }' "$@"
}
link() { # program, folder of objects that replace those of the same name in base
    objects=
    for object in "$folder"/base/*.o; do
        [ -f "$2/${object##*/}" ] && object=$2/${object##*/}
        objects="$objects $object"
    done
    $cc $objects -o "$1" -lm
}
compile() { # folder with tests, folder for objects, tests
    from=$1 to=$2
    shift 2
    for test; do
        $cc $flags -c "$from/$test" -o "$to/$(basename "$test" .c).o" || return 1
    done
}
same_code() { # folder: the header's functions as another compiler run would have them in a library
    $cc -std=c99 -O2 -fno-math-errno -fno-trapping-math -w -DLOBE_API= -I"$1" -c "$folder/$header.c" -o "$1/code.o" &&
        cmp -s "$1/code.o" "$folder/$header.o"
}
within() { # seconds of processor time, command
    { (ulimit -t "$1"; shift; "$@"); } > /dev/null 2>&1
}

pids=
trap '[ -z "$pids" ] || kill $pids; exit 2' INT TERM
rm -rf "$folder"
mkdir -p "$folder/base" || exit 2
echo "compiling the tests" >&2
for source in tests/*.c $here/main.c examples/common/file.c; do
    [ "$source" = tests/main.c ] || $cc $flags -c "$source" -o "$folder/base/$(basename "$source" .c).o" || exit 2
done
link "$folder/base/run" "$folder/base" || exit 2

judge() { # folder, header, line's text: prints what became of the mutant
    copy=$1
    rm -f "$copy"/*.o
    compile "$copy" "$copy" $own 2> /dev/null && link "$copy/run" "$copy" 2> /dev/null || { echo broken; return; }
    within "$own_limit" "$copy/run" "$folder/$header.own" || { echo killed; return; }
    same_code "$copy" && { echo same; return; }
    [ -n "$others" ] || { echo survived; return; }
    compile "$copy" "$copy" $others && link "$copy/run" "$copy" || { echo broken; return; }
    within "$others_limit" "$copy/run" "$folder/$header.others" || { echo killed; return; }
    echo survived
}

worker() { # number: every jobs-th mutant of the sample
    copy=$folder/work.$1
    rm -rf "$copy"
    mkdir -p "$copy/tests"
    cp ./*.h "$copy" && cp tests/*.[ch] "$copy/tests" || exit 2
    awk -v jobs="$jobs" -v job="$1" 'NR % jobs == job % jobs' "$folder/$header.sample" |
        while IFS=$tab read -r number kind text; do
            text=$text awk -v number="$number" 'NR == number { $0 = ENVIRON["text"] } { print }' "$header" > "$copy/$header"
            printf '%s\t%s\t%s\t%s\n' "$(judge "$copy" 2> /dev/null)" "$number" "$kind" "$text"
            echo >> "$folder/$header.done"
            [ ! -t 2 ] || printf '\r%s %d of %d' "$header" "$(wc -l < "$folder/$header.done")" "$(wc -l < "$folder/$header.sample")" >&2
        done > "$folder/$header.results.$1"
}

bad=0
for header; do
    own=$(own "$header") others=$(others "$header")
    printf '#include "%s"\n' "$header" > "$folder/$header.c"
    awk -f $here/mutants.awk "$header" > "$folder/$header.all"
    # A sample without repetition, by a generator that every awk has the same
    awk -v count="$count" -v seed="$seed" '
        { line[NR] = $0 }
        END {
            state = seed % 2147483646 + 1
            if (count == "all" || count > NR) count = NR
            for (i = 1; i <= count; i++) {
                for (k = 0; k < 3; k++) state = state * 16807 % 2147483647
                k = i + state % (NR - i + 1)
                kept = line[k]; line[k] = line[i]; line[i] = kept
                print line[i]
            }
        }' "$folder/$header.all" | sort -n > "$folder/$header.sample"
    $cc -std=c99 -O2 -fno-math-errno -fno-trapping-math -w -DLOBE_API= -I. -c "$folder/$header.c" -o "$folder/$header.o" ||
        exit 2
    # The quickest tests first
    for kind in own others; do
        eval "tests=\$$kind"
        [ -n "$tests" ] || { eval "${kind}_limit=0"; continue; }
        names $tests > "$folder/names"
        "$folder/base/run" --time "$folder/names" > "$folder/times" || fail "without a mutant fails: $(tail -n 1 "$folder/times")"
        sort -n "$folder/times" | sed 's/^[0-9]* //' > "$folder/$header.$kind"
        eval "${kind}_limit=\$(awk '{ sum += \$1 } END { print int(4 * sum / 1000 + 5) }' \"$folder/times\")"
    done
    job=1
    pids=
    while [ "$job" -le "$jobs" ]; do
        worker "$job" &
        pids="$pids $!"
        job=$((job + 1))
    done
    wait $pids
    [ ! -t 2 ] || printf '\r' >&2
    sort -t "$tab" -k 2n "$folder/$header".results.* > "$folder/$header.results"
    awk -v header="$header" -v argued=$here/argued.txt -f $here/score.awk "$folder/$header.all" "$header" "$folder/$header.results" ||
        bad=1
done
exit $bad
