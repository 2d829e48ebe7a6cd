#!/bin/sh
# After headers that leave macros behind, and with vector types of others, the values are those of the plain build.
# usage: hostile.sh FOLDER
folder=$1/hostile
mkdir -p "$folder" || exit 1
. tests/compile/step.sh

values() { # name, how to compile...
    program=$folder/$1
    shift
    "$@" $WARN $relaxed -I. tests/compile/values.c -o "$program" -lm && "$program" > "$program.txt"
}
same() { # name, how to compile...
    values "$@" && cmp "$folder/$1.txt" "$folder/plain.txt"
}

relaxed=
step 'values, plain' values plain gcc -std=c99
for compiler in gcc clang; do
    have $compiler $compiler "hostile macros, $compiler" || continue
    relaxed=
    step "hostile macros, $compiler, C" same "macros-$compiler" $compiler -std=c99 '-DHOSTILE="hostile.h"'
    step "hostile macros, $compiler, C++" same "macros++-$compiler" $compiler -x c++ -std=c++17 '-DHOSTILE="hostile.h"'
    # the vector types' own unions are what these allow
    case $compiler in
    gcc) extensions=-Wno-pedantic ;;
    clang) extensions='-Wno-gnu-anonymous-struct -Wno-nested-anon-types' ;;
    esac
    for vector in 0 1 2 3; do
        set -- "-DVEC3=\"vectors.h\"" -DVECTOR=$vector
        relaxed=
        [ $vector = 3 ] || step "vector type $vector, $compiler, C" same "vector$vector-$compiler" $compiler -std=c11 "$@"
        relaxed=$extensions
        step "vector type $vector, $compiler, C++" same "vector++$vector-$compiler" $compiler -x c++ -std=c++11 "$@"
    done
done
exit 0
