# csv.awk - reading CSV files by the names of their columns; to be put before a script with -f

# Fields of a line into out[1], ...; quotes around a field are dropped. Returns how many.
function csv_split(line, out,    count, at, quoted, c, text) {
    if (!index(line, "\"")) return split(line, out, ",")
    count = 1
    for (at = 1; at <= length(line); at++) {
        c = substr(line, at, 1)
        if (c == "\"") quoted = !quoted
        else if (c == "," && !quoted) { out[count++] = text; text = "" }
        else text = text c
    }
    out[count] = text
    return count
}

function csv_columns(line,    names, count, i) {
    split("", csv_column)
    count = csv_split(line, names)
    for (i = 1; i <= count; i++) if (!(names[i] in csv_column)) csv_column[names[i]] = i
}

function csv_read(line) {
    split("", csv_field)
    csv_split(line, csv_field)
}

function csv_has(name) { return name in csv_column }

function csv(name) { return name in csv_column ? csv_field[csv_column[name]] : "" }

function csv_number(text) { return text != "" && text !~ /[infa]/ }

# A column, or the sum of several, as a+b; empty where one is missing or infinite
function csv_sum(names,    parts, count, i, sum) {
    count = split(names, parts, "+")
    for (i = 1; i <= count; i++) {
        if (!csv_number(csv(parts[i]))) return count == 1 ? csv(parts[i]) : ""
        sum += csv(parts[i])
    }
    return sum ""
}

# Whether the row has the values asked for: a=1&b=2/3 is a of 1, and b of 2 or 3
function csv_chosen(where,    parts, count, i, eq, name, wanted) {
    count = split(where, parts, "&")
    for (i = 1; i <= count; i++) {
        eq = index(parts[i], "=")
        name = substr(parts[i], 1, eq - 1)
        wanted = "/" substr(parts[i], eq + 1) "/"
        if (!csv_has(name) || !index(wanted, "/" csv(name) "/")) return 0
    }
    return 1
}

# A comma within a field is written as ;
function csv_text(text) {
    gsub(/;/, ",", text)
    return text
}
