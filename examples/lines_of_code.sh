#!/bin/sh
# Lines of code of each way to generate VSGLs, beside those of paper 002 (table 3, C++ and HLSL): of the functions that
# it runs, wherever they are, without comments and blank lines. The sums and lights of sg.h, which all share, are left
# out. Fails if a function is not found.
cd "$(dirname "$0")/.." || exit 1

lines() { # file, functions...
    file=$1
    shift
    for function in "$@"; do
        awk -v name="$function" '
            !inside && /^[a-zA-Z]/ && index($0, name "(") && !/;$/ &&
                match($0, "(^|[ *])" name "\\(") { inside = 1 }
            inside && /^ *\/\*/ { comment = 1 }
            inside && !comment && NF { count++ }
            /\*\/ *$/ { comment = 0 }
            inside && /^}/ { found = 1; exit }
            END { if (!found) exit 1; print count }' "$file" || { echo "$file has no $function" >&2; echo missing; }
    done
}

total() { awk '/missing/ { bad = 1 } { sum += $1 } END { if (bad || !sum) exit 1; print sum }'; }

GENERATE=examples/common/vsgl_generate.c KMEANS=examples/common/kmeans.c

pyramid() {
    lines fis.h lobe_fis_clamp lobe_fis_clean_pdf lobe_fis_area lobe_fis_size fis_levels lobe_fis_layout \
        lobe_fis_halve lobe_fis_fill lobe_fis_total fis_build_pdf
}
warp() { lines fis.h fis_lattice lobe_fis_choose fis_warp && lines $GENERATE sample_center; }
block() { lines $GENERATE store load find_block; }
filtered() {
    pyramid
    warp
    lines fis.h lobe_fis_clean fis_build lobe_fis_shrink lobe_fis_locate lobe_fis_mix lobe_fis_bilinear fis_fetch \
        lobe_fis_relative
    block
    lines $GENERATE texel_moments find_halved_moments fetch_moments sample_filtered generate_filtered
}
density() {
    filtered
    lines fis.h lobe_fis_texels lobe_fis_density_level fis_level_density lobe_fis_density_scale fis_scale_density
    lines $GENERATE kernel_density
}
bisection() {
    filtered
    lines fis.h fis_level_bisect fis_scale
    lines $GENERATE kernel_bisection
}
fast() {
    filtered
    lines fis.h lobe_fis_share lobe_fis_root fis_level fis_scale
    lines $GENERATE kernel_fast
}
split() {
    lines fis.h lobe_fis_clean lobe_fis_clean_pdf fis_split_build lobe_fis_mass lobe_fis_strip lobe_fis_split \
        fis_split lobe_fis_inside lobe_fis_overlap fis_cell_sum
    block && lines $GENERATE find_moments generate_split
}
labelling() { pyramid && warp && lines $GENERATE sample_texels lights_of_sums; }
kmeans() { # where texels are
    labelling
    lines $KMEANS swap select_middle widest_axis build kmeans_build squared_distance kmeans_nearest kmeans_sort
    lines $GENERATE texel_moments "$1" label_by_tree sum_sorted generate_kmeans
}
transform() {
    labelling
    lines $KMEANS label_columns kmeans_label_image
    block && lines $GENERATE sum_in_place generate_transform
}

row() { # name, the paper's figure, command...
    name=$1 paper=$2
    shift 2
    count=$("$@" | total) || exit 1
    printf '%-10s %6s %8s\n' "$name" "$count" "$paper"
}

printf '%-10s %6s %8s\n' method lines paper
row density 222 density
row bisection 232 bisection
row fast - fast
row split - split
row kmeans2d 1143 kmeans place_in_image
row kmeans3d 1172 kmeans place_in_world
row transform - transform
