# html.awk - the report's Markdown as a page of HTML that needs nothing else: headings, paragraphs, lists, tables, links,
# pictures, bold and code, as page.sh writes them (with slug.awk before it)
BEGIN {
    print "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">"
    print "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
    print "<title>Lobe: report</title>\n<style>"
    print ":root { color-scheme: light dark; --ink: #222; --paper: #fff; --line: #ccc; --faint: #f3f3f3; --link: #0060a0 }"
    print "@media (prefers-color-scheme: dark) { :root { --ink: #ddd; --paper: #16181b; --line: #444; --faint: #22252a; --link: #7cc0ee } }"
    print "body { margin: 0 auto; padding: 0 1rem 3rem; max-width: 60rem; color: var(--ink); background: var(--paper);"
    print "       font: 1rem/1.5 system-ui, sans-serif; overflow-wrap: break-word }"
    print "h1, h2, h3 { line-height: 1.2 } h2 { margin-top: 3rem; border-bottom: 1px solid var(--line) } h3 { margin-top: 2rem }"
    print "a { color: var(--link) }"
    print "figure, .table { margin: 1rem 0; overflow-x: auto }"
    print "img { display: block; max-width: 100%; min-width: 28rem; border-radius: 4px }"
    print "table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums }"
    print "th, td { padding: .2rem .6rem; border-bottom: 1px solid var(--line); text-align: left; white-space: nowrap }"
    print "th { background: var(--faint) } .n { text-align: right }"
    print "code { font-size: .9em }"
    print "</style>\n</head>\n<body>"
}

function close_all() {
    if (open == "p") print "</p>"
    if (open == "ul") print "</li></ul>"
    if (open == "table") print "</tbody></table></div>"
    open = ""
}

function inline(text,    at, middle, label, target, before) {
    while (match(text, /\[[^]]*\]\([^)]*\)/)) {
        label = substr(text, RSTART + 1, RLENGTH - 2)
        at = index(label, "](")
        target = substr(label, at + 2)
        label = substr(label, 1, at - 1)
        before = substr(text, 1, RSTART - 1)
        text = substr(text, RSTART + RLENGTH)
        if (before ~ /!$/)
            done = done substr(before, 1, length(before) - 1) "<img src=\"" target "\" alt=\"" label "\" loading=\"lazy\">"
        else done = done before "<a href=\"" target "\">" label "</a>"
    }
    text = done text
    done = ""
    while (match(text, /\*\*[^*]+\*\*/))
        text = substr(text, 1, RSTART - 1) "<b>" substr(text, RSTART + 2, RLENGTH - 4) "</b>" substr(text, RSTART + RLENGTH)
    while (match(text, /`[^`]+`/))
        text = substr(text, 1, RSTART - 1) "<code>" substr(text, RSTART + 1, RLENGTH - 2) "</code>" substr(text, RSTART + RLENGTH)
    return text
}

/^$/ { close_all(); next }

/^#/ {
    close_all()
    level = index($0, " ") - 1
    text = substr($0, level + 2)
    print "<h" level " id=\"" slug(text) "\">" inline(text) "</h" level ">"
    next
}

/^!\[/ { close_all(); print "<figure>" inline($0) "</figure>"; next }

/^\|/ {
    line = substr($0, 2, length($0) - 2)
    count = split(line, cells, "|")
    if (open != "table") {
        close_all()
        open = "table"
        for (i = 1; i <= count; i++) heads[i] = cells[i]
        getline
        split(substr($0, 2, length($0) - 2), rules, "|")
        printf "<div class=\"table\"><table>\n<thead><tr>"
        for (i = 1; i <= count; i++) { right[i] = rules[i] ~ /:$/ ? " class=\"n\"" : ""; printf "<th%s>%s</th>", right[i], inline(trim(heads[i])) }
        print "</tr></thead>\n<tbody>"
        next
    }
    printf "<tr>"
    for (i = 1; i <= count; i++) printf "<td%s>%s</td>", right[i], inline(trim(cells[i]))
    print "</tr>"
    next
}

function trim(text) {
    sub(/^ +/, "", text)
    sub(/ +$/, "", text)
    return text
}

/^- / {
    if (open == "ul") print "</li>"
    else { close_all(); print "<ul>"; open = "ul" }
    printf "<li>%s", inline(substr($0, 3))
    next
}

{
    if (open == "") { print "<p>"; open = "p" }
    print inline($0)
}

END { close_all(); print "</body>\n</html>" }
