#!/bin/sh
# plots.sh FOLDER: the report's plots, FOLDER/*.svg, of the CSV files there. Takes gnuplot.
set -e
here=$(dirname "$0")
folder=$1
script=$folder/plots.gp
: > "$script"

draw() { # a script of awk, then its CSV file and options
    name=$1 file=$2
    shift 2
    awk -f "$here/csv.awk" -f "$here/style.awk" "$@" -f "$here/$name.awk" "$folder/$file" >> "$script"
}
curves() { # plot, CSV file, columns of x and y, column of the series, rows, labels of x and y, title, more options
    out=$folder/$1.svg file=$2 x=$3 y=$4 series=$5 where=$6 xlabel=$7 ylabel=$8 title=$9
    shift 9
    draw curves "$file" -v out="$out" -v x="$x" -v y="$y" -v series="$series" -v where="$where" -v xlabel="$xlabel" \
        -v ylabel="$ylabel" -v title="$title" "$@"
}
values() { # CSV file, column, rows: what is in it, each once
    awk -f "$here/csv.awk" -v name="$2" -v where="$3" -f "$here/values.awk" "$folder/$1"
}

draw functions functions.csv -v folder="$folder"
if [ "$(values limits.csv fraction)" ]; then draw limits limits.csv -v out="$folder/limits.svg"; fi

kernels=$(values vsgl.csv lights k=2/4/8 | head -n 1)
sized=$(values vsgl.csv method k=2/4/8 | paste -s -d / -)
values vsgl.csv pdf | while read -r pdf; do
    curves "vsgl-$pdf" vsgl.csv generation_ms+shadows_ms+shading_ms error method "pdf=$pdf&k=1/" \
        'ms: generation, shadow maps and shading' 'mean error / mean' "lights by the PDF $pdf, their number growing from left to right" -v by=lights
    curves "vsgl-$pdf-generation" vsgl.csv generation_ms error method "pdf=$pdf&k=1/" \
        'ms: generation' 'mean error / mean' "the same, over the time of generation alone" -v by=lights
    curves "vsgl-$pdf-k" vsgl.csv k error method "pdf=$pdf&lights=$kernels&method=$sized" \
        'K, size of kernels in shares of a light' 'mean error / mean' "$kernels lights by the PDF $pdf"
done
values light_culling.csv scene | while read -r scene; do
    curves "light_culling-$scene" light_culling.csv total_ms rmse volume "scene=$scene&alpha=0.05" \
        'ms: bounds, culling and shading' 'RMSE' "$scene, alpha .05, delta falling from left to right" -v by=delta
done
for of in diffuse alpha_3 alpha_1; do
    curves "env_lights-$of" env_lights.csv build_ms+sampling_ms+shading_ms $of rule '' \
        'ms: moments, pyramids, sampling and shading' 'RMSE' "$of, lights growing from left to right" -v by=lights
done
count=0
values glossy_plane.csv material | while read -r material; do
    count=$((count + 1))
    curves "glossy_plane-$count" glossy_plane.csv pixel_ns rmse panel "material=$material" 'ns a pixel' 'RMSE' "$material"
done
values lobe_filter.csv scene | while read -r scene; do
    curves "lobe_filter-$scene" lobe_filter.csv filter_ms best_mse method "scene=$scene" 'ms a megapixel' \
        'mean square error, best parameter' "$scene, radius growing from left to right" -v by=radius
done
for kind in normals lobes; do
    [ -e "$folder/lobe_filter-$kind.csv" ] || continue
    awk -f "$here/csv.awk" -f "$here/melt.awk" "$folder/lobe_filter-$kind.csv" > "$folder/melted.tmp"
    values melted.tmp group | while read -r group; do
        curves "lobe_filter-$kind-$group" melted.tmp x value series "group=$group" \
            "$([ $kind = normals ] && echo 'variance of Eq. 4' || echo beta)" 'mean square error' ''
    done
done
# Summing all VPLs at every pixel would take too long: it is measured at fewer pixels.
values growth.csv axis | while read -r axis; do
    if [ "$axis" = VPLs ]; then
        awk -f "$here/csv.awk" -v axis=VPLs -f "$here/per_pixel.awk" "$folder/growth.csv" > "$folder/pixels.tmp"
        curves growth-VPLs pixels.tmp count time pipeline '' VPLs 'microseconds a pixel, one thread' '' -v fit=1
    else
        curves "growth-$axis" growth.csv count time_ms pipeline "axis=$axis" "$axis" 'ms, one thread' '' -v fit=1
    fi
done
rm -f "$folder/melted.tmp" "$folder/pixels.tmp"
gnuplot "$script" && rm "$script"
