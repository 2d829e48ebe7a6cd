# limits.awk - limits.csv as bars for gnuplot, by resource (with csv.awk and style.awk before it; -v out=FILE.svg)
FNR == 1 { csv_columns($0); next }

{
    csv_read($0)
    if (!csv_number(csv("fraction"))) next
    rows++
    name[rows] = csv_text(csv("loop"))
    share[rows] = csv("fraction")
    resource = csv("resource")
    if (!(resource in rank)) { rank[resource] = ++ranks; resources[ranks] = resource }
    of[rows] = rank[resource]
    if (length(name[rows]) > widest) widest = length(name[rows])
}

END {
    if (!rows) { print "no rows for " out > "/dev/stderr"; exit 1 }
    style_begin()
    height = 70 + rows * 18
    style_head(out, height, "", "share of the machine's peak", "")
    left = (widest * STYLE_SIZE * 0.56 + 16) / STYLE_WIDTH
    printf "set lmargin at screen %.4f\nset rmargin at screen 0.97\nset tmargin at screen %.4f\n", left, 1 - 26 / height
    print "set xrange [0:1.05]\nset xtics (\"0\" 0, \"25 %%\" .25, \"50 %%\" .5, \"75 %%\" .75, \"100 %%\" 1)"
    printf "set yrange [%g:0.3]\nset grid noy\nset style fill solid 1 noborder\n", rows + 0.7
    print "set arrow from 1, graph 0 to 1, graph 1 nohead lw 1 dt 2 lc rgb \"#404040\""
    for (i = 1; i <= ranks; i++) {
        printf "set label \"%s\" at screen %.4f, screen %.4f noenhanced tc rgb \"%s\"\n", resources[i], left + (i - 1) * 0.2,
            1 - 12 / height, style_color(i)
    }
    printf "set ytics ("
    for (i = 1; i <= rows; i++) printf "%s%s %d", (i > 1 ? ", " : ""), style_quote(name[i] == name[i - 1] ? "" : name[i]), i
    print ") noenhanced scale 0"
    print "$bars << EOD"
    for (i = 1; i <= rows; i++) {
        color = style_color(of[i])
        sub(/#/, "0x", color)
        printf "%.9g %d %.9g 0.34 %s\n", share[i] / 2, i, share[i] / 2, color
    }
    print "EOD"
    for (i = 1; i <= rows; i++)
        printf "set label \"%.0f %%\" at first %s, first %d offset 0.5,0 noenhanced\n", 100 * share[i], share[i], i
    print "plot $bars using 1:2:3:4:5 with boxxyerror lc rgb variable"
}
