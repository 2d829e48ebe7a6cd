#!/bin/sh
# examples/consumer, built as others build: by CMake in two ways, and from an installation by pkg-config.
# usage: consumers.sh FOLDER
folder=$1/consumers
rm -rf "$folder" && mkdir -p "$folder" || exit 1
. tests/compile/step.sh
make=${MAKE:-make}
prefix=$folder/prefix

by_cmake() { # name, options...
    build=$folder/$1
    shift
    cmake -S examples/consumer -B "$build" "$@" && cmake --build "$build" && "$build/consumer" > "$build.txt" &&
        cmp "$build.txt" "$folder/direct.txt"
}

direct() { # and the samples agree with the closed form
    g++ -std=c++11 $WARN -I. examples/consumer/main.cpp -o "$folder/direct" -lm && "$folder/direct" > "$folder/direct.txt" &&
        awk '{ x = $3 / $5 - 1 } !(x * x < 1e-4) { exit 1 } END { exit NR != 4 }' "$folder/direct.txt"
}

installed() {
    $make install PREFIX="$prefix" && [ "$(ls "$prefix/include/lobe" | wc -l)" -eq 5 ] || return
    export PKG_CONFIG_PATH="$prefix/share/pkgconfig"
    [ "$(pkg-config --modversion lobe)" = "$(awk '$2 == "LOBE_VERSION" && NF > 2 {
        printf "%d.%d.%d", $3 / 10000, $3 / 100 % 100, $3 % 100; exit }' sg.h)" ] &&
        g++ -std=c++11 $(pkg-config --cflags lobe) examples/consumer/main.cpp -o "$folder/installed" $(pkg-config --libs lobe) &&
        "$folder/installed" > "$folder/installed.txt" && cmp "$folder/installed.txt" "$folder/direct.txt"
}

staged() { # into a folder that a package is made of; nothing is left after uninstall
    $make install PREFIX=/usr DESTDIR="$folder/stage" && grep -q '^prefix=/usr$' "$folder/stage/usr/share/pkgconfig/lobe.pc" &&
        [ -s "$folder/stage/usr/include/lobe/sg.h" ] && $make uninstall PREFIX=/usr DESTDIR="$folder/stage" || return
    left=$(find "$folder/stage" -type f) && [ -z "$left" ] || { echo "left: $left" && return 1; }
    [ ! -e "$folder/stage/usr/include/lobe" ]
}

step 'consumer, directly' direct
if have cmake cmake 'consumer, CMake'; then
    step 'consumer, CMake, add_subdirectory' by_cmake subdirectory
    step 'consumer, CMake, FetchContent' by_cmake fetch -DFETCH=ON
fi
have pkg-config pkg-config 'consumer, installed' && step 'consumer, installed' installed
step 'make install and uninstall' staged
exit 0
