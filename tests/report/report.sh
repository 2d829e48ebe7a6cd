#!/bin/sh
# report.sh BUILD QUICK MAKE COMPILER: builds what the report takes, measures, and writes BUILD/report: a page (index.html,
# and the same as report.md), its plots, and all figures as CSV files. QUICK, if it is 1: less of each, some minutes less.
here=$(dirname "$0")
build=$1 quick=$2 make=$3 compiler=$4
folder=$build/report
steps=6 step=0
begun=$(date +%s)

fail() {
    echo "report: $1" >&2
    exit 1
}
note_plots() {
    command -v gnuplot > /dev/null ||
        echo 'report: no plots without gnuplot: on Debian, install gnuplot-nox, or run make setup' >&2
}
run() { # what it is, command...
    step=$((step + 1))
    what=$1 since=$(date +%s)
    shift
    echo "report: step $step of $steps, $what" >&2
    "$@" || fail "$what failed"
    echo "report: step $step of $steps took $(($(date +%s) - since)) s" >&2
}

programs() {
    "$make" -s "$build/bench" "$build/growth" "$build/vsgl" "$build/glossy_plane" "$build/light_culling" \
        "$build/env_lights" "$build/lobe_filter" >&2
}
functions() { "$build/bench" --csv "$folder" ${less:+"$less"} > "$folder/bench.txt"; }
sizes() { "$build/growth" --csv "$folder/growth.csv" ${less:+"$less"} > "$folder/growth.txt"; }
pipelines() { sh "$here/examples.sh" "$folder" "$build" "$quick"; }
papers() {
    sh "$here/../../examples/lines_of_code.sh" > "$folder/lines.tmp" &&
        awk '{ print $1 "," $2 }' "$folder/lines.tmp" | sed '1s/.*/method,lines/' > "$folder/lines_of_code.csv" &&
        awk -f "$here/csv.awk" -v folder="$folder" -f "$here/papers.awk" "$here/papers.csv" > "$folder/papers.tmp" &&
        rm "$folder/lines.tmp" && mv "$folder/papers.tmp" "$folder/papers.csv"
}
plots() {
    ! command -v gnuplot > /dev/null || sh "$here/plots.sh" "$folder"
}
machine() { # what the page begins with
    model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2> /dev/null | head -n 1)
    [ "$model" ] || model=$(sysctl -n machdep.cpu.brand_string 2> /dev/null) || model=$(uname -m)
    echo "Processor: $model"
    echo "Cores: ${OMP_NUM_THREADS:-$(getconf _NPROCESSORS_ONLN)} for shading, one for all else"
    echo "Compiler: $($compiler --version | head -n 1)"
    echo "Flags: $(cat "$build/flags")"
    echo "Date: $(date -u '+%Y-%m-%d %H:%M UTC')"
    echo "Measured in: $(($(date +%s) - begun)) s$([ "$quick" != 1 ] || echo ', quick: fewer repetitions and sizes')"
}
pages() {
    machine > "$folder/machine.txt" && sh "$here/page.sh" "$folder" > "$folder/report.tmp" &&
        awk -f "$here/slug.awk" -f "$here/html.awk" "$folder/report.tmp" > "$folder/index.tmp" &&
        mv "$folder/report.tmp" "$folder/report.md" && mv "$folder/index.tmp" "$folder/index.html"
}

less=
[ "$quick" != 1 ] || less=--quick
mkdir -p "$folder" || fail "cannot make $folder"
rm -f "$folder"/index.html "$folder"/report.md "$folder"/*.svg "$folder"/*.csv "$folder"/*.tmp || fail "cannot empty $folder"
note_plots
run 'builds the programs' programs
run 'functions, by bench' functions
run 'growth of costs' sizes
run 'pipelines, by the examples' pipelines
run "the papers' figures, and plots" eval 'papers && plots'
run 'pages' pages
note_plots
echo "wrote $folder/index.html, in $(($(date +%s) - begun)) s"
