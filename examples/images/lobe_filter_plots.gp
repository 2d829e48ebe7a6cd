# What lobe_filter writes as CSV files that begin with `prefix`.
set terminal pngcairo size 1200,360 font "DejaVu Sans,10"
set datafile separator comma
set multiplot layout 1,3
set key top right
set border 3
set tics nomirror
set style data lines
set linetype 1 lc rgb "#0072B2" lw 1.5
set linetype 2 lc rgb "#009E73" lw 1.5
set linetype 3 lc rgb "#D55E00" lw 1.5
set linetype 4 lc rgb "#CC79A7" lw 1.5
set linetype 5 lc rgb "#E69F00" lw 1.5
set linetype 6 lc rgb "#000000" lw 1.5
sharpness = "1 3 10 30 100 1000"
set title "weights of one lobe each, beta 20: Eq. 11 (lines), Eq. 12 (dots)"
set xlabel "degrees between axes"
set xrange [0:60]
set yrange [0:1.02]
plot for [i=1:6] prefix . '-similarity.csv' using 1:2*i title 'sharpness ' . word(sharpness, i) lt i, \
     for [i=1:6] prefix . '-similarity.csv' using 1:2*i+1 with points pt 7 ps 0.4 lt i notitle
set logscale x
set yrange [0:0.06]
exponents = "10 100 1000"
all = "all three in one picture"
set key off
set title "mean square error by normals, Eq. 4"
set xlabel "variance"
set xrange [1e-6:1]
set format x "10^{%L}"
plot for [i=1:3] prefix . '-normals.csv' using 1:i+1 title 'Phong ' . word(exponents, i) lt i, \
     prefix . '-normals.csv' using 1:14 title all dt 2 lw 2 lt 6
set key on top center
set title "by lobes, Eq. 12"
set xlabel "beta"
set xrange [0.1:300]
set format x "%g"
plot for [i=1:3] prefix . '-lobes.csv' using 1:i+1 title 'Phong ' . word(exponents, i) lt i, \
     prefix . '-lobes.csv' using 1:14 title all dt 2 lw 2 lt 6
