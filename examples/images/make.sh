#!/bin/sh
# make.sh BUILD: the README's pictures anew, from the examples in BUILD; takes netpbm and gnuplot (Debian packages netpbm,
# gnuplot-nox), and some minutes. Called by `make pictures`.
set -e
build=$1
here=$(dirname "$0")
out=$build/pictures
for tool in pngtopam gnuplot; do
    command -v $tool > /dev/null || { echo "make pictures: $tool is missing: install netpbm and gnuplot-nox" >&2; exit 1; }
done
mkdir -p "$out"

png() { # name: what comes in, as a small PNG file
    pnmtopng -compression 9 2> /dev/null > "$out/$1.png"
}
panel() { # picture, column, row, width, height: one of its panels, without the margins
    pngtopam "$1" | pamcut -left $(($2 * $4 + 18)) -top $(($3 * $5 + 33)) -width 220 -height 150
}
row() { # name, panels...
    name=$1
    shift
    pamcat -leftright "$@" > "$out/$name.pam"
}

"$build/vsgl" --size 400x300 --lights 4096 --method split --pdf brsm --out "$out/vsgl" > "$out/vsgl.txt"
pngtopam "$out/vsgl.png" | png vsgl-all
"$build/vsgl" --size 64x48 --samples 2 --frames 2 --out "$out/kernels" > "$out/kernels.txt"
pngtopam "$out/kernels-kernels.png" | pamscale -reduce 2 | png vsgl_kernels
"$build/glossy_plane" --out "$out/plane" > "$out/plane.txt"
pngtopam "$out/plane.png" | ppmtopgm | png glossy_plane
"$build/env_lights" --out "$out/env" > "$out/env.txt"
pngtopam "$out/env.png" | png env_lights
"$build/light_culling" --out "$out/culling" > "$out/culling.txt"
for kind in ring ring-false-positives; do
    pngtopam "$out/culling-$kind.png" | pamscale -reduce 2 > "$out/$kind.pam"
done
pamcat -leftright "$out/ring.pam" "$out/ring-false-positives.pam" | png light_culling

"$build/lobe_filter" --out "$out/filter" > "$out/filter.txt"
for scene in tiles brushed; do
    for column in 0 1 3 4; do panel "$out/filter-$scene.png" $column 0 256 192 > "$out/$column.pam"; done
    row $scene "$out/0.pam" "$out/1.pam" "$out/3.pam" "$out/4.pam"
done
pamcat -topbottom "$out/tiles.pam" "$out/brushed.pam" | png lobe_filter
panel "$out/filter-weights.png" 0 0 256 192 > "$out/0.pam"
panel "$out/filter-weights.png" 1 0 256 192 > "$out/1.pam"
panel "$out/filter-upsampling.png" 0 0 256 192 > "$out/2.pam"
panel "$out/filter-upsampling.png" 3 0 256 192 > "$out/3.pam"
row more "$out/0.pam" "$out/1.pam" "$out/2.pam" "$out/3.pam"
png lobe_filter_more < "$out/more.pam"
gnuplot -e "prefix = '$out/filter'" -e "set output '$out/lobe_filter_plots.png'" "$here/lobe_filter_plots.gp"

mv "$out/vsgl-all.png" "$here/vsgl.png"
for name in vsgl_kernels glossy_plane env_lights light_culling lobe_filter lobe_filter_more lobe_filter_plots; do
    mv "$out/$name.png" "$here/$name.png"
done
echo "wrote the pictures of $here"
