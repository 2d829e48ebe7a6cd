# melt.awk - a wide CSV file as a long one: x, group, series, value. A group ends with a column named mean.
# (with csv.awk before it)
FNR == 1 {
    columns = csv_split($0, names)
    group = 1
    for (i = 2; i <= columns; i++) {
        gsub(/,/, ";", names[i])
        groups[i] = group
        if (names[i] ~ /^mean/) group++
    }
    print "x,group,series,value"
    next
}
{
    csv_split($0, fields)
    for (i = 2; i <= columns; i++) print fields[1] "," groups[i] "," names[i] "," fields[i]
}
