# rows.awk - whether a CSV file has its columns and enough rows (with csv.awk before it; -v name=FILE -v least=COUNT
# -v columns=A,B)
FNR == 1 {
    csv_columns($0)
    wide = csv_split($0, heads)
    count = split(columns, wanted, ",")
    for (i = 1; i <= count; i++) if (!csv_has(wanted[i])) { print name " has no column " wanted[i]; bad = 1 }
    next
}
csv_split($0, fields) != wide { print name ", line " FNR ": not as many fields as there are columns"; bad = 1 }
END {
    if (NR - 1 < least) { printf "%s has %d rows, not %d\n", name, NR - 1, least; bad = 1 }
    exit bad
}
