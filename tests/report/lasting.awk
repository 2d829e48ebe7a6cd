# lasting.awk - a CSV file without its times and what times give (with csv.awk before it)
FNR == 1 {
    count = csv_split($0, names)
    for (i = 1; i <= count; i++) timed[i] = names[i] ~ /_(ns|ms)(_low|_high)?$|^(ratio|fraction|peak)$/
}
{
    csv_split($0, fields)
    for (i = 1; i <= count; i++) if (!timed[i]) printf "%s,", fields[i]
    print ""
}
