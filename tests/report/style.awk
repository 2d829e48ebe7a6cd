# style.awk - what all plots share: colours, logarithmic axes with edges for 0 and infinity, labels at the right that keep
# apart; to be put after csv.awk. It writes scripts for gnuplot.

# Okabe and Ito's colours, but grey for their yellow, which white paper swallows
function style_begin() {
    split("#0072B2 #D55E00 #009E73 #E69F00 #CC79A7 #56B4E9 #000000 #808080", style_colors, " ")
    split("7 5 9 13 11 15 6 4", style_points, " ")
    STYLE_WIDTH = 640
    STYLE_SIZE = 12
    style_labels = style_most = 0
}

function style_color(i) { return style_colors[(i - 1) % 8 + 1] }
function style_point(i) { return style_points[(i - 1) % 8 + 1] }

function style_quote(text) {
    gsub(/\\/, "\\\\", text)
    gsub(/"/, "'", text)
    return "\"" text "\""
}

function log10(x) { return log(x) / log(10) }
function floor(x) { return int(x) > x ? int(x) - 1 : int(x) }

# ---- an axis: its range grows by style_add, and is closed by style_close ----

function style_add(axis, value) {
    if (value ~ /[infa]/) { style_inf[axis] = 1; return }
    value += 0
    if (value == 0) { style_zero[axis] = 1; return }
    if (value < 0) return
    if (!(axis in style_low) || value < style_low[axis]) style_low[axis] = value
    if (!(axis in style_high) || value > style_high[axis]) style_high[axis] = value
}

function style_close(axis,    span) {
    if (!(axis in style_low)) style_low[axis] = style_high[axis] = 1
    span = log10(style_high[axis] / style_low[axis])
    style_from[axis] = style_low[axis] * 10 ^ -(span * 0.06 + 0.04)
    style_to[axis] = style_high[axis] * 10 ^ (span * 0.06 + 0.04)
    span = log10(style_to[axis] / style_from[axis])
    if (style_inf[axis]) style_to[axis] *= 10 ^ (span * 0.12)
    if (style_zero[axis]) style_from[axis] *= 10 ^ (-span * 0.12)
}

# Where a value is drawn: 0 and infinity at the edges
function style_place(axis, value) {
    if (value ~ /[infa]/) return style_to[axis]
    return value + 0 == 0 ? style_from[axis] : value + 0
}

function style_share(axis, value) {
    return log10(style_place(axis, value) / style_from[axis]) / log10(style_to[axis] / style_from[axis])
}

function style_number(value,    power) {
    if (value >= 0.001 && value < 100000) return sprintf("%.6g", value)
    power = floor(log10(value) + 0.0001)
    return (value / 10 ^ power < 1.001 ? "" : sprintf("%.2g×", value / 10 ^ power)) "10^{" power "}"
}

function style_tics(axis,    wide, from, to, decades, step, steps, parts, count, tics, power, i, value, near) {
    from = style_zero[axis] ? style_low[axis] * 0.999 : style_from[axis]
    to = style_inf[axis] ? style_high[axis] * 1.001 : style_to[axis]
    decades = log10(to / from)
    step = decades > 7 ? int(decades / 7) + 1 : 1
    wide = from < 0.001 || to > 100000
    steps = decades > (wide ? 1.2 : 3) ? "1" : decades > 1.2 || wide ? "1 2 5" : "1 1.5 2 3 4 5 6 8"
    if (decades < 0.45) {
        step = 10 ^ floor(log10(to - from))
        while (step > (to - from) / 2) step /= 2
        for (value = int(from / step + 1) * step; value < to; value += step)
            tics = tics (tics == "" ? "" : ", ") "\"" style_number(value) "\" " value
    } else {
        count = split(steps, parts, " ")
        for (power = floor(log10(from)); power <= log10(to); power++) {
            if ((power % step + step) % step) continue
            for (i = 1; i <= count; i++) {
                value = parts[i] * 10 ^ power
                if (value < from || value > to) continue
                tics = tics (tics == "" ? "" : ", ") "\"" style_number(value) "\" " value
            }
        }
    }
    if (style_zero[axis]) tics = tics (tics == "" ? "" : ", ") "\"0\" " style_from[axis]
    if (style_inf[axis]) tics = tics (tics == "" ? "" : ", ") "\"∞\" " style_to[axis]
    return tics
}

# ---- labels at the right ----

function style_label(share, x, y, text, color) {
    style_labels++
    style_at[style_labels] = share
    style_x[style_labels] = x
    style_y[style_labels] = y
    style_text[style_labels] = text
    style_ink[style_labels] = color
    if (length(text) > style_most) style_most = length(text)
}

function style_head(out, height, title, xlabel, ylabel, edge) {
    style_left = 70 / STYLE_WIDTH
    style_right = 1 - (22 + style_most * STYLE_SIZE * 0.56) / STYLE_WIDTH
    style_bottom = 52 / height
    style_top = 1 - (title == "" ? 14 : 34) / height
    print "reset"
    print "set encoding utf8"
    printf "set terminal svg size %d,%d font \"sans-serif,%d\" background \"white\"\n", STYLE_WIDTH, height, STYLE_SIZE
    print "set output " style_quote(out)
    print "unset key"
    print "set border 3 lw 0.7 lc rgb \"#404040\""
    print "set grid lw 0.5 lc rgb \"#e4e4e4\""
    print "set tics nomirror scale 0.5"
    printf "set lmargin at screen %.4f\nset rmargin at screen %.4f\nset bmargin at screen %.4f\nset tmargin at screen %.4f\n",
        style_left, style_right, style_bottom, style_top
    if (title != "") printf "set label %s at screen %.4f, screen %.4f noenhanced font \"sans-serif,%d\"\n",
        style_quote(title), 12 / STYLE_WIDTH, 1 - 16 / height, STYLE_SIZE + 1
    print "set xlabel " style_quote(xlabel) " noenhanced"
    print "set ylabel " style_quote(ylabel) " noenhanced offset 1,0"
}

function style_axis(axis) {
    print "set logscale " axis
    printf "set %srange [%.9g:%.9g]\n", axis, style_from[axis], style_to[axis]
    print "set " axis "tics (" style_tics(axis) ")"
}

# The labels, apart by a line's height, from the highest down; a thin line leads to each.
function style_write_labels(height,    i, j, order, spot, gap, t, above, below) {
    gap = (STYLE_SIZE + 3) / height
    for (i = 1; i <= style_labels; i++) order[i] = i
    for (i = 2; i <= style_labels; i++)
        for (j = i; j > 1 && style_at[order[j]] > style_at[order[j - 1]]; j--) { t = order[j]; order[j] = order[j - 1]; order[j - 1] = t }
    for (i = 1; i <= style_labels; i++) spot[i] = style_bottom + style_at[order[i]] * (style_top - style_bottom)
    # A few rounds of pushing neighbours apart, then down and up within the picture
    for (t = 0; t < 200; t++)
        for (i = 2; i <= style_labels; i++) {
            above = spot[i - 1]
            below = spot[i]
            if (above - below < gap) { spot[i - 1] = (above + below + gap) / 2; spot[i] = (above + below - gap) / 2 }
        }
    if (style_labels && spot[1] > 1 - gap) spot[1] = 1 - gap
    for (i = 2; i <= style_labels; i++) if (spot[i - 1] - spot[i] < gap) spot[i] = spot[i - 1] - gap
    if (style_labels && spot[style_labels] < gap) spot[style_labels] = gap
    for (i = style_labels - 1; i >= 1; i--) if (spot[i] - spot[i + 1] < gap) spot[i] = spot[i + 1] + gap
    for (i = 1; i <= style_labels; i++) {
        j = order[i]
        printf "set arrow from first %.9g, first %.9g to screen %.4f, screen %.4f nohead back lw 0.5 dt 3 lc rgb \"#a0a0a0\"\n",
            style_x[j], style_y[j], style_right + 8 / STYLE_WIDTH, spot[i]
        printf "set label %s at screen %.4f, screen %.4f left noenhanced tc rgb \"%s\"\n", style_quote(style_text[j]),
            style_right + 12 / STYLE_WIDTH, spot[i], style_ink[j]
    }
    style_labels = 0
}
