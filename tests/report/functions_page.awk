# functions_page.awk - functions.csv as sections of Markdown: each function's plot and table (with csv.awk and text.awk
# before it; -v folder=FOLDER, where the plots are)
FNR == 1 { csv_columns($0); next }
{
    csv_read($0)
    key = csv("function") "," csv("inputs")
    if (key != last) {
        write()
        last = key
        plots++
        forms = 0
        head = csv("function")
        about = csv_text(csv("inputs")) (csv("unit") == "" ? "" : ". Errors in " csv_text(csv("unit")))
    }
    forms++
    name[forms] = text_plain(csv_text(csv("form")))
    if (csv("ours") + 0) name[forms] = "**" name[forms] "**"
    ns[forms] = csv("vector_ns")
    most[forms] = csv("max_error")
    vector = text_time("vector_ns")
    scalar = text_time("scalar_ns")
    ratio = csv_number(csv("scalar_ns")) && csv("vector_ns") + 0 > 0 ? sprintf("%.1f", csv("scalar_ns") / csv("vector_ns")) : ""
    cells[forms] = vector " | " scalar " | " ratio " | " text_number(most[forms]) " | " text_number(csv("rms_error"))
}
END { write() }

function size(error) { return error ~ /[infa]/ ? 1e300 : error + 0 }

function write(    i, j, on_front, over, plot, line) {
    if (!forms) return
    print "### " csv_text(head) "\n"
    print text_plain(about) ".\n"
    plot = "functions-" plots ".svg"
    if ((getline line < (folder "/" plot)) > 0) {
        close(folder "/" plot)
        print "![" csv_text(head) ": nanoseconds against errors](" plot ")\n"
    }
    print "| form | ns, vector loop | ns, scalar | scalar / vector | / first | largest error | RMS | |"
    print "|---|---:|---:|---:|---:|---:|---:|---|"
    for (i = 1; i <= forms; i++) {
        on_front = most[i] != ""
        for (j = 1; j <= forms; j++)
            if (j != i && most[j] != "" && ns[j] + 0 <= ns[i] + 0 && size(most[j]) <= size(most[i]) &&
                (ns[j] + 0 < ns[i] + 0 || size(most[j]) < size(most[i]))) on_front = 0
        over = ns[1] + 0 > 0 ? sprintf("%.2f", ns[i] / ns[1]) : ""
        line = cells[i]
        split(line, part, " [|] ")
        print "| " name[i] " | " part[1] " | " part[2] " | " part[3] " | " over " | " part[4] " | " part[5] " | " \
            (on_front && forms > 1 ? "front" : "") " |"
    }
    print ""
}
