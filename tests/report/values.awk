# values.awk - what is in a column, each once, in the file's order (with csv.awk before it; -v name=COLUMN)
FNR == 1 { csv_columns($0); next }
{
    csv_read($0)
    value = csv(name)
    if (value != "" && !(value in seen)) { seen[value] = 1; print value }
}
