#!/bin/sh
# Every loop over one of our functions must become vector code, by -O3 and an instruction set alone: no further flags.
# usage: vectors.sh COMPILER FOLDER, which keeps what is compiled
compiler=$1 folder=$2 failed=0 count=0
case $($compiler --version 2> /dev/null) in
*clang*) remarks='-Rpass=loop-vectorize' ;;
*GCC* | *gcc* | *cc*) remarks='-fopt-info-vec-optimized' ;;
*) echo "skipped vector loops: $compiler does not tell which loops became vector code" && exit 0 ;;
esac
set=-march=x86-64-v3
echo 'int main(void) { return 0; }' > "$folder/probe.c"
$compiler $set -c "$folder/probe.c" -o "$folder/probe.o" 2> /dev/null || set=
for loops in tests/bench/*_loops.c; do
    $compiler -std=gnu99 -O3 $set $remarks -c "$loops" -o "$folder/vectors.o" 2> "$folder/vectors.txt" || {
        cat "$folder/vectors.txt" && exit 1
    }
    for line in $(grep -n '^\(BENCH\|FILTER\)_LOOP(our_' "$loops" | cut -d : -f 1); do
        count=$((count + 1))
        if ! grep -q "^$loops:$line:.*loop vectorized\|^$loops:$line:.*vectorized loop" "$folder/vectors.txt"; then
            echo "FAILED $loops:$line is not vector code: $(sed -n "${line}p" "$loops")"
            failed=1
        fi
    done
    # the header's own loops over rows, where this file calls them
    grep -q '^ROW_FILTER' "$loops" || continue
    for line in $(grep -n '^ *for (x = 0; x < ' bilateral.h | cut -d : -f 1); do
        count=$((count + 1))
        # one that only sets zeros becomes a call of memset
        sed -n "${line}p" bilateral.h | grep -q '= 0;$' && continue
        if ! grep -q "bilateral.h:$line:.*loop vectorized\|bilateral.h:$line:.*vectorized loop" "$folder/vectors.txt"; then
            echo "FAILED bilateral.h:$line is not vector code: $(sed -n "${line}p" bilateral.h)"
            failed=1
        fi
    done
done
[ $failed = 0 ] && echo "ok     $count loops became vector code ($compiler -O3 $set)"
exit $failed
