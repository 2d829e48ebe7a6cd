#!/bin/sh
# readme.sh COMPILER BUILD: the pages say what is true: the README's first block of C compiles and runs, every function that
# is named exists, every make target does, and every local link leads somewhere.
compiler=$1 build=$2 status=0
wrong() {
    echo "FAILED $1" >&2
    status=1
}

awk '/^```/ { if (inside) exit; inside = /^```c$/; next } inside' README.md > "$build/readme.c"
$compiler -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror -I. "$build/readme.c" \
    -o "$build/readme" -lm && "$build/readme" > /dev/null || wrong 'the snippet of the README'

for page in README.md CHANGELOG.md examples/README.md; do
    for name in $(grep -oE '`(sg|asg|vsgl|vsl|ggx|fis|bilateral)_[a-z0-9_]+`' $page | tr -d '`' | sort -u); do
        grep -qE "(^|[^a-z_])$name(\(| - |;)" ./*.h || [ -n "$(ls examples/shaders/glsl/$name.* 2> /dev/null)" ] ||
            wrong "$page names $name, which no header has"
    done
    for target in $(grep -oE '(^|`|^\| `)make [a-z_-]+' $page | awk '{ print $NF }' | sort -u); do
        grep -qE "^($target:|EXAMPLES = .*$target( |\$))" Makefile || wrong "$page names make $target, which the Makefile lacks"
    done
    for link in $(grep -oE '\]\([^)]+\)' $page | tr -d '()' | sed 's/^]//' | grep -v '^http'); do
        [ -e "$(dirname $page)/$link" ] || wrong "$page links to $link, which is not there"
    done
done
[ $status -eq 0 ] && echo 'ok     snippet, functions, targets and links of the pages'
exit $status
