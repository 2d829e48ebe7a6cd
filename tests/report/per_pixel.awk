# per_pixel.awk - of growth.csv the rows along one axis, and microseconds a pixel where the number of pixels is fixed
# (with csv.awk before it; -v axis=AXIS)
FNR == 1 { csv_columns($0); print "pipeline,count,time,time_low,time_high"; next }
{
    csv_read($0)
    if (csv("axis") != axis) next
    scale = csv("fixed") ~ /^[0-9]+ pixels/ ? 1000 / csv("fixed") : ""
    if (scale == "") { print "growth.csv: " csv("pipeline") " says no pixels" > "/dev/stderr"; exit 1 }
    printf "%s,%s,%.6g,%.6g,%.6g\n", csv("pipeline"), csv("count"), scale * csv("time_ms"), scale * csv("time_ms_low"),
        scale * csv("time_ms_high")
}
