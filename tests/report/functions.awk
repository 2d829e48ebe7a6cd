# functions.awk - functions.csv as plots for gnuplot, one for each function and kind of input: nanoseconds against
# errors, ours blue, others red; a dot is the largest error, a ring the RMS, the grey steps are the Pareto front of each.
# (with csv.awk and style.awk before it; -v folder=FOLDER, where the plots go)
FNR == 1 { csv_columns($0); next }

{
    csv_read($0)
    key = csv("function") "," csv("inputs")
    if (key != last) {
        draw()
        last = key
        plots++
        forms = 0
        title = csv("function")
        unit = csv("unit")
    }
    forms++
    form[forms] = csv("form")
    ours[forms] = csv("ours") + 0
    most[forms] = csv("max_error")
    rms[forms] = csv("rms_error")
    ns[forms] = csv("vector_ns")
    low[forms] = csv("vector_ns_low")
    high[forms] = csv("vector_ns_high")
}

END { draw() }

# Steps through what nothing else is both faster and nearer than
function write_front(name, errors,    i, j, order, t, best, y, drawn) {
    for (i = 1; i <= forms; i++) order[i] = i
    for (i = 2; i <= forms; i++)
        for (j = i; j > 1 && ns[order[j]] + 0 < ns[order[j - 1]] + 0; j--) { t = order[j]; order[j] = order[j - 1]; order[j - 1] = t }
    print name " << EOD"
    for (i = 1; i <= forms; i++) {
        j = order[i]
        if (errors[j] == "") continue
        t = style_place("x", errors[j])
        if (drawn && t >= best) continue
        y = style_place("y", ns[j])
        printf "%.9g %.9g\n%.9g %.9g\n", drawn ? best : style_to["x"], y, t, y
        best = t
        drawn = 1
    }
    printf "%.9g %.9g\nEOD\n", best, style_to["y"]
}

function draw(    i, height, color, list) {
    for (i = 1; i <= forms && most[i] == ""; i++);
    if (forms < 2 || i > forms) return
    split("", style_low); split("", style_high); split("", style_inf); split("", style_zero)
    style_begin()
    for (i = 1; i <= forms; i++) {
        if (most[i] != "") style_add("x", most[i])
        if (rms[i] != "") style_add("x", rms[i])
        style_add("y", ns[i])
    }
    style_close("x")
    style_close("y")
    for (i = 1; i <= forms; i++)
        style_label(style_share("y", ns[i]), style_place("x", most[i] == "" ? rms[i] : most[i]), ns[i], csv_text(form[i]),
            style_color(ours[i] ? 1 : 2))
    height = 240 + (forms > 5 ? (forms - 5) * 24 : 0)
    style_head(folder "/functions-" plots ".svg", height, csv_text(title), "error, in " csv_text(unit), "ns, vector loop")
    style_axis("x")
    style_axis("y")
    style_write_labels(height)
    write_front("$most", most)
    write_front("$rms", rms)
    list = "plot $most with lines lw 1 lc rgb \"#b0b0b0\", $rms with lines lw 1 dt 3 lc rgb \"#b0b0b0\""
    for (i = 1; i <= forms; i++) {
        color = sprintf("lc rgb \"%s\"", style_color(ours[i] ? 1 : 2))
        print "$form" i " << EOD"
        if (rms[i] != "") printf "%.9g %s %s %s\n", style_place("x", rms[i]), ns[i], low[i], high[i]
        if (most[i] != "") printf "%.9g %s %s %s\n", style_place("x", most[i]), ns[i], low[i], high[i]
        print "EOD"
        list = list sprintf(", \\\n     $form%d using 1:2 with lines lw 1 %s", i, color)
        if (most[i] != "") list = list sprintf(", $form%d using 1:2:3:4 every ::%d with yerrorbars pt 7 ps 0.6 lw 0.8 %s", i, rms[i] != "", color)
        if (rms[i] != "") list = list sprintf(", $form%d using 1:2 every ::0::0 with points pt 6 ps 0.6 %s", i, color)
    }
    print list
}
