# score.awk - of a header's mutants (all of them), the header and the results: the survivors and the score
#
# -v header=NAME -v argued=FILE, a list of "NAME: line with the fault" and below it, indented, why no test should see it

function trimmed(text) { gsub(/^ +| +$/, "", text); return text }

BEGIN {
    FS = "\t"
    while ((getline entry < argued) > 0) {
        if (index(entry, header ": ") == 1) { last = trimmed(substr(entry, length(header) + 3)); reason[last] = "" }
        else if (entry ~ /^ / && last != "") reason[last] = reason[last] " " trimmed(entry)
        else last = ""
    }
}
FNR == 1 { file++ }
file == 1 { possible[trimmed($3)] = 1 }
file == 2 { line[FNR] = trimmed($0) }
file == 3 {
    count[$1]++
    text = trimmed($4)
    if ($1 == "killed" && text in reason) print header ":" $2 ": killed, though argued: " text
    if ($1 != "survived") next
    is_argued = text in reason
    print header ":" $2 ": survived" (is_argued ? ", argued:" reason[text] : "")
    print "    - " line[$2]
    print "    + " text
    if (is_argued) argued_count++
}
END {
    for (text in reason) {
        if (!(text in possible)) { print argued ": no mutant of " header ": " text; stale = 1 }
        if (reason[text] == "") { print argued ": no reason for " header ": " text; stale = 1 }
    }
    judged = count["killed"] + count["survived"]
    rest = judged - argued_count
    printf "%s: %d of %d mutants killed, %.1f %%; without %d argued ones %.1f %%; %d not compiled, %d the same code\n",
        header, count["killed"], judged, judged ? 100 * count["killed"] / judged : 0, argued_count,
        rest ? 100 * count["killed"] / rest : 0, count["broken"], count["same"]
    exit stale || count["killed"] < 0.9 * rest || rest == 0
}
