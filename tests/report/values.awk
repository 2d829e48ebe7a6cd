# values.awk - what is in a column, each once, in the file's order (with csv.awk before it; -v name=COLUMN, -v where: which
# rows)
FNR == 1 { csv_columns($0); next }
{
    csv_read($0)
    if (!csv_chosen(where)) next
    value = csv(name)
    if (value != "" && !(value in seen)) { seen[value] = 1; print value }
}
