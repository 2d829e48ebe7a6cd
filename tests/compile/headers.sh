#!/bin/sh
# Each header alone and with the others, in every language and by every compiler that is here.
# usage: headers.sh FOLDER
folder=$1/headers
mkdir -p "$folder" || exit 1
. tests/compile/step.sh

# Sources: each header twice and nothing else; all; all in every order.
for header in $HEADERS; do
    printf '#include "%s"\n#include "%s"\n' "$header" "$header" > "$folder/${header%.h}.c"
done
for header in $HEADERS; do echo "#include \"$header\""; done > "$folder/all.c"
echo $HEADERS | awk -v folder="$folder" '
    function arrange(rest, text, count, names, i, k, left) {
        count = split(rest, names, " ")
        if (!count) { printf "%s", text > (folder "/order" ++orders ".c"); close(folder "/order" orders ".c") }
        for (i = 1; i <= count; i++) {
            left = ""
            for (k = 1; k <= count; k++) if (k != i) left = left " " names[k]
            arrange(left, text "#include \"" names[i] "\"\n")
        }
    }
    { arrange($0, "") }'

knows() { # compiler and flags: whether it has the language and its library
    echo '#include <math.h>' | "$@" -fsyntax-only - > /dev/null 2>&1
}

each() { # compiler and flags: every header alone, all of them, and all with asserts
    for part in $HEADERS all.h; do "$@" -I. -fsyntax-only "$folder/${part%.h}.c" || return; done
    "$@" -I. -include assert.h '-DLOBE_ASSERT(condition)=assert(condition)' -fsyntax-only "$folder/all.c"
}

orders() { # which of them, compiler and flags
    which=$1
    shift
    for order in "$folder"/order$which.c; do "$@" -I. -fsyntax-only "$order" || return; done
}

other_version() { # compiler
    for header in $HEADERS; do
        fails 'different versions of Lobe' "$1" -DLOBE_VERSION=1 -I. -fsyntax-only "$folder/${header%.h}.c" || return
    done
}

# values.c by one way of compiling, twice in one program: one way for each copy.
pair() { # how to compile the first, and the second
    $1 $WARN -I. -DVALUES=first_values -c tests/compile/values.c -o "$folder/first.o" &&
        $2 $WARN -I. -DVALUES=second_values -c tests/compile/values.c -o "$folder/second.o" &&
        $1 $WARN -c tests/compile/two.c -o "$folder/two.o" &&
        g++ "$folder/two.o" "$folder/first.o" "$folder/second.o" -o "$folder/two" -lm &&
        "$folder/two" > "$folder/two.txt" || return
    awk '{ line[NR] = $0 } END { for (i = 1; i <= NR / 2; i++) if (line[i] != line[NR / 2 + i]) exit 1
        exit !(NR > 100 && NR % 2 == 0) }' "$folder/two.txt" || {
        echo "two copies of the headers differ: $folder/two.txt"
        return 1
    }
}

# Functions that one unit defines for all: another, without the headers, calls them.
external() { # language, compiler, linkage
    cat > "$folder/caller.c" << END
#include <math.h>
#ifdef __cplusplus
extern "C" {
#endif
float sg_integral(float sharpness);
float lobe_exp(float x);
float bilateral_depth_exponent(float zi, float zj);
int fis_levels(int width, int height);
#ifdef __cplusplus
}
#endif
int main(void) {
    return !(fabsf(sg_integral(0) - 12.566371f) < 1e-5f && lobe_exp(0) == 1 && bilateral_depth_exponent(1, 3) == -4 &&
             fis_levels(512, 3) == 10);
}
END
    $2 $WARN $1 -O1 "-DLOBE_API=$3" -I. -c "$folder/all.c" -o "$folder/defined.o" &&
        $2 $WARN $1 -c "$folder/caller.c" -o "$folder/caller.o" &&
        $2 "$folder/caller.o" "$folder/defined.o" -o "$folder/external" -lm && "$folder/external"
}

overridden() { # compiler and flags; compiled in full, as gcc tells only then what is unused
    "$@" '-DLOBE_API=static inline __attribute__((unused))' -I. -c "$folder/all.c" -o "$folder/all.o" &&
        "$@" '-DLOBE_API=static inline' '-DLOBE_FIS_READ(value)=(value)' -I. -c "$folder/all.c" -o "$folder/all.o"
}

# Without what gcc and clang add to the language: the way that other compilers go.
plain() { # compiler
    $1 -U__GNUC__ -U__clang__ -std=c99 $WARN -I. -fsyntax-only "$folder/all.c" &&
        $1 -U__GNUC__ -U__clang__ -x c++ -std=c++17 $WARN -I. -fsyntax-only "$folder/all.c"
}

# Of all warnings that clang has, only these are off: casts of a function's value mean what they say; casts in C's way
# are the only ones that are C too; nothing is lost where C++98 differs, which is compiled as well; and arrays come by
# pointer, as C has no other way.
everything() { # flags
    each clang "$@" -Weverything -Werror -Wno-unknown-warning-option -Wno-bad-function-cast -Wno-old-style-cast \
        -Wno-c++98-compat -Wno-c++98-compat-pedantic -Wno-unsafe-buffer-usage
}

# Only whether it compiles: tcc 0.9.27 computes calls within calls wrongly where they pass structs.
tiny() {
    tcc -std=c99 -Wall -Werror -I. tests/compile/values.c -o "$folder/tiny" -lm && "$folder/tiny" > "$folder/tiny.txt"
}

for compiler in gcc clang; do
    have $compiler $compiler "headers, $compiler" || continue
    for language in c99 c11 c17 c2x c++98 c++11 c++14 c++17 c++20; do
        case $language in *++*) x=c++ ;; *) x=c ;; esac
        if knows $compiler -x $x -std=$language; then
            step "headers, $compiler, $language" each $compiler -x $x -std=$language $WARN
        else
            echo "skipped headers, $compiler, $language: unknown to it, or its library is not here"
        fi
    done
    step "headers in 12 orders, $compiler, C++" orders '*1' $compiler -x c++ -std=c++11 $WARN
    step "functions not used, $compiler, C" overridden $compiler -std=c99 $WARN -Wunused-function
    step "functions not used, $compiler, C++" overridden $compiler -x c++ -std=c++17 $WARN -Wunused-function
    step "headers of other versions, $compiler" other_version $compiler
    step "extern functions, $compiler, C" external '-std=c99' $compiler 'extern inline'
    # what is always inlined is not declared inline here, which gcc doubts to be possible
    step "extern functions, $compiler, C++" external '-x c++ -std=c++17 -Wno-attributes' $compiler 'extern "C"'
done
step 'headers in all 120 orders, gcc, C' orders '*' gcc -std=c99 $WARN
step 'two units, C and C' pair 'gcc -std=c99' 'gcc -std=c99'
step 'two units, C and C++' pair 'gcc -std=c99' 'g++ -x c++ -std=c++17'
step 'two units, C++ and C++' pair 'g++ -x c++ -std=c++11' 'g++ -x c++ -std=c++20'
if have clang clang 'headers, all warnings'; then
    step 'two units, C by gcc and C++ by clang' pair 'gcc -std=c99' 'clang -x c++ -std=c++17'
    for language in c99 c2x; do step "headers, all warnings, $language" everything -x c -std=$language; done
    for language in c++98 c++20; do step "headers, all warnings, $language" everything -x c++ -std=$language; done
    step 'headers without extensions' plain clang
fi
have tcc tcc 'headers, tcc' && step 'headers, tcc' tiny
exit 0
