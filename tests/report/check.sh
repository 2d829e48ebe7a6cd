#!/bin/sh
# check.sh FOLDER: whether a report is whole: each CSV file has its columns and enough rows, each picture that the pages
# name is there without a NaN, and each link leads somewhere. With gnuplot installed there must be plots.
here=$(dirname "$0")
folder=$1
[ -d "$folder" ] || { echo "usage: check.sh FOLDER" >&2; exit 2; }
failed=0
wrong() {
    echo "FAILED $1" >&2
    failed=$((failed + 1))
}

rows() { # CSV file, least rows, columns
    [ -s "$folder/$1" ] || { wrong "$1 is missing"; return; }
    awk -f "$here/csv.awk" -v name="$1" -v least="$2" -v columns="$3" -f "$here/rows.awk" "$folder/$1" >&2 || wrong "$1"
}
spread() { # columns of times: each with its quartiles
    for name in "$@"; do printf ',%s,%s_low,%s_high' "$name" "$name" "$name"; done
}

rows functions.csv 80 "header,function,form,ours,inputs,unit,max_error,rms_error$(spread scalar_ns vector_ns)"
rows limits.csv 8 "loop,resource,unit,amount,peak,fraction$(spread loop_ns)"
rows hard_cases.csv 30 function,case,got,wanted,error,unit,limit,printed_got,printed_error
rows fis.csv 30 "pdf,method,ours,texels,level_rms,level_max,gap,overlap,brightest,total$(spread level_ns)"
rows growth.csv 40 "pipeline,axis,count$(spread time_ms)"
rows vsgl.csv 30 "pdf,lights,method,k,shadows_ms,gap,overlap,firefly,flicker_noise,rmse,error,power$(spread generation_ms shading_ms)"
rows vsgl-generation.csv 16 pdf,method,both_ms
rows glossy_plane.csv 15 "material,panel,rmse,relative$(spread pixel_ns)"
rows light_culling.csv 30 "scene,alpha,delta,volume,lights,false_positives,in_volume,rmse,denoised$(spread bounds_ms culling_ms shading_ms total_ms)"
rows env_lights.csv 12 "lights,rule,diffuse,alpha_3,alpha_1,power$(spread build_ms sampling_ms shading_ms)"
rows lobe_filter.csv 14 "scene,method,radius,best_mse,best_parameter,shared_mse,tap_ns$(spread filter_ms)"
rows papers.csv 60 paper,table,entry,unit,value,value_ratio,ours,ours_ratio,ratio
rows lines_of_code.csv 7 method,lines

# Of the papers' figures most have ours beside them.
awk -F , 'NR > 1 && $7 != "" { ours++ } END { exit !(ours > NR / 2) }' "$folder/papers.csv" || wrong "papers.csv: too few of ours"

for page in index.html report.md; do
    [ -s "$folder/$page" ] || { wrong "$page is missing"; continue; }
    case $page in
        *.html) links='(src|href)="[^"]*"' ;;
        *) links='\]\([^)]*\)' ;;
    esac
    grep -oE "$links" "$folder/$page" | sed 's/^[^"(]*["(]//; s/[")]$//' | sort -u > "$folder/links.tmp"
    [ -s "$folder/links.tmp" ] || wrong "$page has no links"
    while read -r link; do
        case $link in
            \#*) grep -qF "id=\"${link#\#}\"" "$folder/index.html" || wrong "$page: nothing is named $link" ;;
            *:*) wrong "$page needs $link from elsewhere" ;;
            *) [ -s "$folder/$link" ] || wrong "$page: $link is missing" ;;
        esac
    done < "$folder/links.tmp"
    plots=$(grep -c 'svg$' "$folder/links.tmp")
    if command -v gnuplot > /dev/null && [ "$plots" -lt 40 ]; then wrong "$page has $plots plots, not 40"; fi
done
rm -f "$folder/links.tmp"
for plot in "$folder"/*.svg; do
    [ -e "$plot" ] || continue
    name=$(basename "$plot")
    grep -q "\"$name\"" "$folder/index.html" || wrong "$name is on no page"
    grep -q '</svg>' "$plot" || wrong "$name is cut off"
    if grep -qi '\bnan\b' "$plot"; then wrong "$name has a NaN"; fi
done

[ $failed -eq 0 ] || { echo "$failed faults in $folder" >&2; exit 1; }
echo "ok     report of $folder: tables, plots and links"
