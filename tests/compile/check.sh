#!/bin/sh
# Runs the steps of `make check`, JOBS at a time, the longest first; none stops the others.
# usage: check.sh FOLDER [NAME], which runs only the scripts whose line contains it
folder=$1/check only=${2:-}
mkdir -p "$folder" || exit 1
sanitize='-g -fsanitize=address,undefined -fno-sanitize-recover=all'
default='-O3 -fno-math-errno -fno-trapping-math -march=native'
flags="sh tests/compile/flags.sh $folder"
grep -F -e "$only" > "$folder/steps.txt" << END
sh tests/compile/machines.sh $folder s390x
sh tests/compile/machines.sh $folder aarch64
sh tests/compile/machines.sh $folder windows
sh tests/compile/headers.sh $folder
sh tests/compile/test.sh $folder
$flags gcc-O0 --quick gcc -O0
$flags gcc-sanitized '' gcc -O2 $sanitize
$flags clang-sanitized '' clang -O1 $sanitize
$flags gcc-O2 '' gcc -O2
$flags gcc-fast-native '' gcc -O3 -ffast-math -march=native
$flags gcc-fast '' gcc -O2 -ffast-math
$flags gcc-fma-off '' gcc -O2 -mfma -ffp-contract=off
$flags gcc-fma-fast '' gcc -O3 -mfma -ffp-contract=fast
$flags clang-O0 --quick clang -O0
$flags clang-O3 '' clang $default
$flags clang-fast-native '' clang -O3 -ffast-math -march=native
$flags clang-fast '' clang -O3 -ffast-math
$flags clang-fma-fast '' clang -O2 -mfma -ffp-contract=fast
sh tests/compile/machines.sh $folder i686
sh tests/compile/machines.sh $folder native
sh tests/compile/asserts.sh $folder
sh tests/compile/consumers.sh $folder
sh tests/compile/hostile.sh $folder
sh tests/compile/names.sh $folder
END
[ -s "$folder/steps.txt" ] || { echo "check.sh: no step's line contains '$only'" >&2 && exit 2; }
rm -f "$folder"/*/bounds.txt
tr '\n' '\0' < "$folder/steps.txt" | xargs -0 -n 1 -P "${JOBS:-2}" sh -c | tee "$folder/lines.txt"
for machine in i686 aarch64 s390x windows; do
    [ -s "$folder/native/bounds.txt" ] && [ -s "$folder/$machine/bounds.txt" ] &&
        awk -v machine=$machine -f tests/compile/bounds.awk "$folder/native/bounds.txt" "$folder/$machine/bounds.txt"
done
awk '/^ok / { passed++ } /^FAILED / { failed++ }
     END { print passed + 0 " passed, " failed + 0 " failed"; exit !(passed && !failed) }' "$folder/lines.txt"
