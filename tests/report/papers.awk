# papers.awk - the papers' figures beside ours: tests/report/papers.csv and the CSV files of a report, as one more (with
# csv.awk before it; -v folder=FOLDER). A ratio is that to the table's baseline, on the paper's machine and on ours.
/^#/ { next }
!begun { csv_columns($0); begun = 1; next }
{
    csv_read($0)
    rows++
    paper[rows] = csv("paper")
    table[rows] = csv("table")
    entry[rows] = csv("entry")
    unit[rows] = csv("unit")
    theirs[rows] = csv("value")
    base[rows] = csv("baseline")
    file[rows] = csv("file")
    key[rows] = csv("key")
    columns[rows] = csv("columns")
    at[paper[rows], table[rows], entry[rows]] = rows
}

# The first row of a report's file with the key's values
function look_up(name, key, columns,    path, line, found, value) {
    path = folder "/" name
    if ((getline line < path) <= 0) return ""
    csv_columns(line)
    while ((getline line < path) > 0) {
        csv_read(line)
        if (csv_chosen(key)) { value = csv_sum(columns); break }
    }
    close(path)
    return value
}

function over(a, b) { return a != "" && csv_number(b) && b + 0 != 0 ? sprintf("%.6g", a / b) : "" }

END {
    for (i = 1; i <= rows; i++) if (file[i] != "") ours[i] = look_up(file[i], key[i], columns[i])
    print "paper,table,entry,unit,value,value_ratio,ours,ours_ratio,ratio"
    for (i = 1; i <= rows; i++) {
        if (!((paper[i], table[i], base[i]) in at)) { print "papers.csv: no baseline " base[i] > "/dev/stderr"; exit 1 }
        b = at[paper[i], table[i], base[i]]
        r = over(theirs[i], theirs[b])
        mine = over(ours[i], ours[b])
        printf "%s,%s,%s,%s,%s,%s,%s,%s,%s\n", paper[i], table[i], entry[i], unit[i], theirs[i], r, ours[i], mine, over(mine, r)
    }
}
