#!/bin/sh
# The unit tests on another machine, emulated, with fewer draws; bounds are the same. "native" is what others are
# compared with. usage: machines.sh FOLDER MACHINE
machine=$2 folder=$1/$2
mkdir -p "$folder" || exit 1
. tests/compile/step.sh
case $machine in
native) compiler=gcc packages=gcc runner= ;;
i686) compiler=i686-linux-gnu-gcc packages='gcc-i686-linux-gnu libc6-dev-i386-cross' runner= ;;
aarch64) compiler=aarch64-linux-gnu-gcc packages='gcc-aarch64-linux-gnu libc6-dev-arm64-cross' runner=qemu-aarch64 ;;
s390x) compiler=s390x-linux-gnu-gcc packages='gcc-s390x-linux-gnu libc6-dev-s390x-cross' runner=qemu-s390x ;;
windows) compiler=x86_64-w64-mingw32-gcc packages=gcc-mingw-w64-x86-64 runner=wine ;;
*) echo "machines.sh: unknown machine $machine" >&2 && exit 2 ;;
esac
case $machine in
i686) flags='-std=c99 -msse2 -mfpmath=sse' ;; # the 387 keeps more bits than a float has
s390x) flags=-std=gnu99 ;;                     # its C99 computes floats as doubles
*) flags=-std=c99 ;;
esac

unit_tests() {
    $compiler $flags $WARN -O2 -static tests/*.c examples/common/file.c -o "$folder/tests.exe" -lm || return
    WINEDEBUG=-all WINEPREFIX=$folder/wine $runner "$folder/tests.exe" --quick --verbose > "$folder/bounds.txt"
    status=$?
    grep FAILED "$folder/bounds.txt"
    tail -n 1 "$folder/bounds.txt"
    return $status
}

have $compiler "$packages" "unit tests, $machine" || exit 0
case $runner in
qemu*) have "$runner" qemu-user "unit tests, $machine" || exit 0 ;;
wine) have wine 'wine wine64' "unit tests, $machine" || exit 0 ;;
esac
step "unit tests, $machine" unit_tests
exit 0
