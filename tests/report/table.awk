# table.awk - rows of a CSV file as a table of Markdown (with csv.awk and text.awk before it)
#   -v columns='NAME=title,...'  which, or sums a+b of them; -v where='A=1&B=2/3': which rows
FNR == 1 {
    csv_columns($0)
    count = split(columns, names, ",")
    for (i = 1; i <= count; i++) {
        at = index(names[i], "=")
        titles[i] = substr(names[i], at + 1)
        names[i] = substr(names[i], 1, at - 1)
    }
    next
}
{
    csv_read($0)
    if (!csv_chosen(where)) next
    if (!rows++) {
        line = rule = "|"
        for (i = 1; i <= count; i++) {
            line = line " " titles[i] " |"
            rule = rule (csv_sum(names[i]) ~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$|^inf$|^$/ ? "---:|" : "---|")
        }
        print line
        print rule
    }
    line = "|"
    for (i = 1; i <= count; i++) line = line " " (names[i] ~ /[+]/ ? text_number(csv_sum(names[i])) : text_time(names[i])) " |"
    print line
}
END { if (rows) print "" }
