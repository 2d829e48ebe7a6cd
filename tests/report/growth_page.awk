# growth_page.awk - growth.csv as a table of Markdown: the exponent of each power law, by least squares of logarithms, and
# the largest departure from it (with csv.awk and text.awk before it)
FNR == 1 { csv_columns($0); next }
{
    csv_read($0)
    key = csv("pipeline") "," csv("axis") "," csv("fixed")
    if (!(key in count)) { keys[++kinds] = key; first[key] = csv("count"); begin[key] = csv("time_ms") }
    count[key]++
    x[key, count[key]] = log(csv("count"))
    y[key, count[key]] = log(csv("time_ms"))
    last[key] = csv("count")
    finish[key] = csv("time_ms")
    shaded[key, count[key]] = csv("shaded")
}
function fit(key, list,    n, i, mx, my, xx, xy, off) {
    n = count[key]
    departure = 0
    for (i = 1; i <= n; i++) { mx += x[key, i] / n; my += list[key, i] / n }
    for (i = 1; i <= n; i++) { xx += (x[key, i] - mx) ^ 2; xy += (x[key, i] - mx) * (list[key, i] - my) }
    if (xx == 0) return 0
    for (i = 1; i <= n; i++) {
        off = list[key, i] - my - xy / xx * (x[key, i] - mx)
        if (off < 0) off = -off
        if (exp(off) - 1 > departure) departure = exp(off) - 1
    }
    return xy / xx
}
END {
    print "| what | against | from | to | ms | ms | exponent of time | off by, at most | exponent of lights a pixel | fixed |"
    print "|---|---|---:|---:|---:|---:|---:|---:|---:|---|"
    for (i = 1; i <= kinds; i++) {
        key = keys[i]
        split(key, part, ",")
        exponent = fit(key, y)
        off = departure
        lights = ""
        if (shaded[key, 1] + 0 > 0) {
            for (j = 1; j <= count[key]; j++) shades[key, j] = log(shaded[key, j])
            lights = sprintf("%.3f", fit(key, shades))
        }
        printf "| %s | %s | %s | %s | %s | %s | %.3f | %.0f %% | %s | %s |\n", text_plain(csv_text(part[1])), part[2],
            text_number(first[key]), text_number(last[key]), text_number(begin[key]), text_number(finish[key]), exponent,
            100 * off, lights, text_plain(csv_text(part[3]))
    }
    print ""
}
