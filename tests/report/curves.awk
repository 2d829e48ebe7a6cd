# curves.awk - rows of a CSV file as curves, for gnuplot (with csv.awk and style.awk before it)
#
#   -v out=FILE.svg       what it draws
#   -v x=A+B -v y=C       columns, or sums of them; both axes are logarithmic
#   -v series=COLUMN      a curve each; of one colour in all plots of a file (with fit: of different ones in a plot)
#   -v by=COLUMN          the order of a curve's points; that of x without it
#   -v where='A=1&B=2/3'  which rows
#   -v fit=1              with power laws through the points, and their exponents
#   -v title= -v xlabel= -v ylabel=
BEGIN { style_begin() }

FNR == 1 { csv_columns($0); next }

{
    csv_read($0)
    name = csv_text(csv(series))
    if (!fit) rank_name(name)
    if (!csv_chosen(where)) next
    if (fit) rank_name(name)
    across = csv_sum(x)
    up = csv_sum(y)
    if (!csv_number(across) || across + 0 <= 0 || up == "") next
    count[name]++
    xs[name, count[name]] = across
    keys[name, count[name]] = by == "" ? across : csv(by)
    ys[name, count[name]] = up
    spread = x !~ /[+]/ && csv(x "_low") != "" ? x : fit && csv(y "_low") != "" ? y : ""
    lows[name, count[name]] = spread == "" ? "" : csv(spread "_low")
    highs[name, count[name]] = spread == "" ? "" : csv(spread "_high")
    style_add("x", across)
    style_add("y", up)
}

function rank_name(name) {
    if (!(name in rank)) { rank[name] = ++ranks; names[ranks] = name }
}

# So that a curve does not run back
function sort_points(name,    i, j) {
    for (i = 2; i <= count[name]; i++)
        for (j = i; j > 1 && keys[name, j] + 0 < keys[name, j - 1] + 0; j--) {
            swap(keys, name, j); swap(xs, name, j); swap(ys, name, j); swap(lows, name, j); swap(highs, name, j)
        }
}
function swap(list, name, j,    t) { t = list[name, j]; list[name, j] = list[name, j - 1]; list[name, j - 1] = t }

function find_law(name,    i, n, mx, my, xx, xy) {
    n = count[name]
    for (i = 1; i <= n; i++) { mx += log(xs[name, i]) / n; my += log(ys[name, i]) / n }
    for (i = 1; i <= n; i++) { xx += (log(xs[name, i]) - mx) ^ 2; xy += (log(xs[name, i]) - mx) * (log(ys[name, i]) - my) }
    law = xx > 0 ? xy / xx : 0
    law_scale = exp(my - law * mx)
}

END {
    style_close("x")
    style_close("y")
    for (i = 1; i <= ranks; i++) {
        name = names[i]
        if (!count[name]) continue
        drawn++
        sort_points(name)
        last = 1
        for (j = 2; j <= count[name]; j++) if (xs[name, j] + 0 >= xs[name, last] + 0) last = j
        text = name
        if (fit && count[name] > 1) {
            find_law(name)
            text = sprintf("%s: n^%.2f", name, law)
            laws[i] = sprintf("%s %.9g\n%s %.9g", xs[name, 1], law_scale * xs[name, 1] ^ law, xs[name, count[name]],
                law_scale * xs[name, count[name]] ^ law)
        }
        style_label(style_share("y", ys[name, last]), xs[name, last], style_place("y", ys[name, last]), text, style_color(i))
    }
    if (!drawn) { print "no rows for " out > "/dev/stderr"; exit 1 }
    height = 330 + (drawn > 12 ? (drawn - 12) * 15 : 0)
    style_head(out, height, title, xlabel, ylabel)
    style_axis("x")
    style_axis("y")
    style_write_labels(height)
    for (i = 1; i <= ranks; i++) {
        name = names[i]
        if (!count[name]) continue
        print "$rows" i " << EOD"
        for (j = 1; j <= count[name]; j++) {
            low = lows[name, j] == "" ? (fit ? ys[name, j] : xs[name, j]) : lows[name, j]
            high = highs[name, j] == "" ? (fit ? ys[name, j] : xs[name, j]) : highs[name, j]
            printf "%s %.9g %s %s\n", xs[name, j], style_place("y", ys[name, j]), low, high
        }
        print "EOD"
        if (i in laws) print "$law" i " << EOD\n" laws[i] "\nEOD"
        ink = sprintf("lc rgb \"%s\"", style_color(i))
        list = list (list == "" ? "plot " : ", \\\n     ")
        if (i in laws) list = list sprintf("$law%d using 1:2 with lines lw 1 dt 2 %s, \\\n     ", i, ink)
        else if (count[name] > 1) list = list sprintf("$rows%d using 1:2 with lines lw 1.4 %s, \\\n     ", i, ink)
        list = list sprintf("$rows%d using 1:2:3:4 with %serrorbars pt %d ps %s lw 0.8 %s", i, fit ? "y" : "x", style_point(i),
            fit ? "0.45" : "0.55", ink)
    }
    print list
}
