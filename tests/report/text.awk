# text.awk - numbers and words as the page shows them (with csv.awk before it)

function text_power(exponent) { return "10^" exponent }

function text_number(value,    size) {
    if (value == "") return ""
    if (value ~ /inf/) return value ~ /^-/ ? "-∞" : "∞"
    if (value ~ /nan/) return "no number"
    if (value !~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$/) return text_plain(csv_text(value))
    size = value < 0 ? -value : value + 0
    if (size == int(size) && size < 1e7) return sprintf("%d", value)
    if (size >= 0.001 && size < 1e5) return sprintf(size >= 100 ? "%.0f" : "%.3g", value)
    return sprintf("%.2g", value)
}

# What tables of Markdown and HTML would take for their own
function text_plain(text) {
    gsub(/&/, "\\&amp;", text)
    gsub(/</, "\\&lt;", text)
    gsub(/>/, "\\&gt;", text)
    gsub(/\|/, "\\&#124;", text)
    gsub(/\*/, "\\&#42;", text)
    return text
}

# With half the distance of its quartiles, in percent
function text_time(name,    value, low, high) {
    value = csv(name)
    low = csv(name "_low")
    high = csv(name "_high")
    if (!csv_number(value) || !csv_number(low) || !csv_number(high) || value + 0 == 0) return text_number(value)
    return text_number(value) sprintf(" ± %.0f %%", 50 * (high - low) / value)
}
