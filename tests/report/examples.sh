#!/bin/sh
# The examples' part of the report: runs the programs of BIN and writes FOLDER/vsgl.csv and so on, one file each with the
# numbers of all of its runs, and into FOLDER/examples what else they write. QUICK=1: small pictures and short sweeps.
set -u
folder=${1:-} bin=${2:-} quick=${3:-}
if [ $# -lt 2 ] || [ $# -gt 3 ] || [ ! -d "$bin" ]; then
    echo "usage: $0 FOLDER BIN [QUICK]: BIN is the folder of the built examples, QUICK 1 for a short run" >&2
    exit 2
fi
out=$folder/examples step=0 steps=7
mkdir -p "$out" || exit 1

run() { # name of the output, what is measured, program, arguments...
    name=$1 about=$2 program=$3
    shift 3
    step=$((step + 1))
    echo "examples $step of $steps: $program, $about" >&2
    rm -f "$out/$name".csv "$out/$name"-*.csv
    "$bin/$program" "$@" --out "$out/$name" > "$out/$name.txt" || { echo "$0: $program failed" >&2; exit 1; }
}

# Rows of several runs under one head. What the first columns name is taken from the first run that has it.
join_runs() { # file, number of those columns, files of the runs...
    joined=$1 keys=$2
    shift 2
    awk -F , -v keys="$keys" '
        FNR == 1 { if (NR == 1) print head = $0; else if ($0 != head) { bad = FILENAME; exit }; next }
        { key = $1; for (i = 2; i <= keys; i++) key = key "," $i; if (!seen[key]++) print }
        END { if (bad) { print bad ": other columns than in the first run" > "/dev/stderr"; exit 1 } }' \
        "$@" > "$joined.part" || { rm -f "$joined.part"; exit 1; }
    mv "$joined.part" "$joined" || exit 1
}

move() { # name of each file
    for file in "$@"; do mv "$out/$file.csv" "$folder/$file.csv" || exit 1; done
}

case $quick in
'' | 0)
    vsgl='--size 160x120 --frames 3 --view 1920x1088' lights=16,64,256,1024,4096 some=1024 kernels=2,4,8
    plane=
    culling='--size 480x360'
    env='--lights 4,16,64,256,1024'
    filter='--size 160x120 --samples 8 --reference 256 --radius 8,2,4,12'
    ;;
*)
    vsgl='--size 48x36 --samples 16 --frames 2 --view 160x96 --view-lights 128' lights=16,64 some=64 kernels=4
    plane='--size 64x80 --samples 768'
    culling='--size 96x72 --tile 4 --deltas 6.4,0.1'
    env='--size 32x32 --lights 4,16,64'
    filter='--size 64x48 --reference 16 --scene tiles --radius 8,4'
    ;;
esac

# Options are words.
# shellcheck disable=SC2086
{
    run vsgl 'numbers of lights' vsgl $vsgl --lights $lights
    run vsgl-fast 'sizes of kernels by the fast solver' vsgl $vsgl --lights $some --method fast --k $kernels
    run vsgl-density 'sizes of kernels by density' vsgl $vsgl --lights $some --method density --k $kernels
    run glossy_plane 'forms of lobes' glossy_plane $plane
    run light_culling 'volumes and deltas' light_culling $culling
    run env_lights 'numbers of lights' env_lights $env
    run lobe_filter 'filters, their radii and parameters' lobe_filter $filter
}
join_runs "$folder/vsgl.csv" 4 "$out/vsgl.csv" "$out/vsgl-fast.csv" "$out/vsgl-density.csv"
move vsgl-generation glossy_plane light_culling env_lights lobe_filter lobe_filter-similarity lobe_filter-normals \
    lobe_filter-lobes lobe_filter-upsampling
