#!/bin/sh
# page.sh FOLDER: the report as Markdown, of the CSV files in FOLDER, and of the plots where they are. FOLDER/machine.txt
# holds lines `name: value` about the run.
set -e
here=$(dirname "$0")
folder=$1

csv() { # a script of awk, a CSV file, options
    script=$1 file=$2
    shift 2
    awk -f "$here/csv.awk" -f "$here/text.awk" "$@" -f "$here/$script.awk" "$folder/$file"
}
table() { # CSV file, columns, rows
    csv table "$1" -v columns="$2" -v where="$3"
}
plot() { # name, what it shows
    [ ! -s "$folder/$1.svg" ] || printf '![%s](%s.svg)\n\n' "$2" "$1"
}
data() { # CSV files, of which all above is
    printf 'Data:'
    for file in "$@"; do
        if [ -e "$folder/$file" ]; then printf ' [%s](%s)' "$file" "$file"; fi
    done
    printf '\n\n'
}
values() { # CSV file, column, rows: what is in it, each once
    awk -f "$here/csv.awk" -v name="$2" -v where="$3" -f "$here/values.awk" "$folder/$1"
}
text() { # paragraphs, as they are
    cat
    echo
}

functions() {
    echo '## Functions'
    echo
    text << 'END'
Nanoseconds a call beside errors, on the same inputs: ours, which are bold and blue, and what one would otherwise write. In
the plots a dot is the largest error and a ring the RMS; the grey steps are the Pareto front of the largest errors, the
dotted ones that of the RMS: what is on them is faster than all that is nearer. An infinite error is at the right edge.
Vector loops are what the compiler makes of a plain loop; ± is half the distance of the quartiles over repetitions.
END
    csv functions_page functions.csv -v folder="$folder"
    data functions.csv
}

sampling() {
    echo '## Filtered importance sampling'
    echo
    echo 'Kernel sizes by `fis_level` and other rules for 1024 kernels: time for each, texels read, error of the level, and what is left out or met twice, in % of the PDF.'
    echo
    values fis.csv pdf | while read -r pdf; do
        echo "### PDF: $pdf" | tr ';' ','
        echo
        table fis.csv 'method=method,level_ns=ns,texels=texels,level_rms=RMS of the level,level_max=largest,gap=gap,overlap=overlap,brightest=brightest / mean,total=total' "pdf=$pdf"
    done
    data fis.csv
}

vsgl() {
    echo '## One-bounce indirect light: vsgl'
    echo
    text << 'END'
Virtual SG lights of a reflective shadow map, against path tracing: the mean absolute error of the indirect light over its
mean. Generation is on one thread, shadow maps and shading are on all.
END
    values vsgl.csv pdf | while read -r pdf; do
        echo "### PDF $pdf"
        echo
        plot "vsgl-$pdf" "error against all of the time, PDF $pdf"
        plot "vsgl-$pdf-generation" "error against the time of generation, PDF $pdf"
        plot "vsgl-$pdf-k" "error against K, PDF $pdf"
        table vsgl.csv 'lights=lights,method=method,k=K,generation_ms=generation ms,shadows_ms=shadows ms,shading_ms=shading ms,gap=gap %,overlap=overlap %,firefly=brightest / mean,flicker_noise=flicker,rmse=RMSE,error=error,power=power' "pdf=$pdf"
    done
    data vsgl.csv vsgl-generation.csv
}

culling() {
    echo '## Stochastic light culling: light_culling'
    echo
    text << 'END'
Glossy caustics of many VPLs, each with a random range beyond which it is left out: the same picture with each bounding
volume. RMSE before the filter; false: glossy lights a pixel that are shaded in vain.
END
    values light_culling.csv scene | while read -r scene; do
        echo "### Scene: $scene"
        echo
        plot "light_culling-$scene" "$scene: RMSE against time as delta falls, by bounding volume"
        table light_culling.csv 'alpha=alpha,delta=delta,volume=volume,lights=lights a pixel,false_positives=false,in_volume=were tiles pixels,bounds_ms=bounds ms,culling_ms=culling ms,shading_ms=shading ms,total_ms=total ms,rmse=RMSE,denoised=denoised' "scene=$scene"
    done
    data light_culling.csv
}

environment() {
    echo '## Environment maps as SG lights: env_lights'
    echo
    echo 'RMSE of spheres against sums over all texels of the map, whose mean radiance is 1.'
    echo
    plot env_lights-diffuse 'diffuse spheres: RMSE against time, by rule'
    plot env_lights-alpha_3 'spheres of alpha .3: RMSE against time, by rule'
    plot env_lights-alpha_1 'spheres of alpha .1: RMSE against time, by rule'
    table env_lights.csv 'lights=lights,rule=rule,build_ms=build ms,sampling_ms=sampling ms,shading_ms=shading ms,diffuse=diffuse,alpha_3=alpha .3,alpha_1=alpha .1,power=power' ''
    data env_lights.csv
}

plane() {
    echo '## A sphere light over a glossy plane: glossy_plane'
    echo
    echo 'Reflection and light as SGs and as anisotropic SGs, against numerical integration, which is what the truth is.'
    echo
    count=0
    values glossy_plane.csv material | while read -r material; do
        count=$((count + 1))
        plot "glossy_plane-$count" "$material: RMSE against time, by form"
    done
    table glossy_plane.csv 'material=material,panel=form,rmse=RMSE,relative=relative,pixel_ns=ns a pixel' ''
    data glossy_plane.csv
}

filter() {
    echo '## Filters that know the lobes: lobe_filter'
    echo
    echo 'Mean square errors of noisy glossy light, filtered by weights of normals and of lobes, each at its best parameter, over the radius of the kernel.'
    echo
    values lobe_filter.csv scene | while read -r scene; do
        echo "### Filtered: $scene"
        echo
        plot "lobe_filter-$scene" "$scene: mean square error against time as the radius grows, by method"
        table lobe_filter.csv 'method=method,radius=radius,best_mse=MSE,best_parameter=at,shared_mse=MSE at the shared one,filter_ms=ms,tap_ns=ns a tap' "scene=$scene"
    done
    echo '### One parameter for all materials'
    echo
    echo 'Errors over the variance of normals and over beta of lobes, one material a picture: the nearer the minima are to each other, the better one parameter serves all.'
    echo
    for group in 1 2 3 4; do
        plot "lobe_filter-normals-$group" 'mean square error over the variance of normals'
        plot "lobe_filter-lobes-$group" 'mean square error over beta of lobes'
    done
    data lobe_filter.csv lobe_filter-normals.csv lobe_filter-lobes.csv lobe_filter-similarity.csv lobe_filter-upsampling.csv
}

papers() {
    echo '## Beside the papers'
    echo
    text << 'END'
What the papers print beside what is measured here. They timed GPUs, so that only ratios compare: each to the first of its
kind, theirs and ours, and ours over theirs. Scenes are not the papers' own.
END
    values papers.csv paper | while read -r paper; do
        case $paper in
            002) title='Modified filtered importance sampling (2016)' ;;
            003) title='Stochastic light culling (2017)' ;;
            004) title='Specular lobe-aware filtering (2015)' ;;
            *) title=$paper ;;
        esac
        printf '### %s\n\n' "$title"
        values papers.csv table "paper=$paper" | while read -r name; do
            printf '**%s**\n\n' "$name" | tr ';' ','
            table papers.csv 'entry=,value=paper,unit=unit,value_ratio=ratio,ours=ours,ours_ratio=our ratio,ratio=ours / theirs' "paper=$paper&table=$name"
        done
    done
    data papers.csv lines_of_code.csv
}

hard() {
    echo '## Hard cases'
    echo
    echo 'Inputs at which formulas break, beside what they give in float as printed. Errors are in the unit of the header'"'"'s bound, which is the limit.'
    echo
    table hard_cases.csv 'function=function,case=case,got=ours,wanted=wanted,error=error,limit=limit,unit=unit,printed_got=as printed,printed_error=its error' ''
    data hard_cases.csv
}

growth() {
    echo '## Growth of costs'
    echo
    echo 'Times on one thread over sizes, and the power laws through them.'
    echo
    values growth.csv axis | while read -r axis; do plot "growth-$axis" "time against $axis, with exponents"; done
    csv growth_page growth.csv
    data growth.csv
}

limits() {
    echo '## Distance to the limit'
    echo
    echo 'Vector loops beside the peak that was measured in the same run: multiply-adds, memory, or divisions, whichever binds.'
    echo
    plot limits 'share of the peak, by loop'
    table limits.csv 'loop=loop,resource=resource,amount=for each element,unit=of,loop_ns=ns,peak=peak; a ns,fraction=share' ''
    data limits.csv
}

# In the order of the page, each heading once
sections() {
    functions
    sampling
    vsgl
    culling
    environment
    plane
    filter
    papers
    hard
    growth
    limits
}

sections > "$folder/sections.tmp"
echo '# Speed against error'
echo
awk '{ at = index($0, ": "); print "- **" substr($0, 1, at - 1) "** " substr($0, at + 2) }' "$folder/machine.txt"
echo
[ -s "$folder/vsgl-flux.svg" ] || printf 'No plots: gnuplot was missing.\n\n'
echo '## Contents'
echo
awk -f "$here/slug.awk" -f "$here/contents.awk" "$folder/sections.tmp"
echo
cat "$folder/sections.tmp"
rm "$folder/sections.tmp"
