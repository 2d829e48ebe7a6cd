# Names at the headers' file scope, one a line: KIND NAME FILE:LINE, where KIND is name, macro, or parameter.
# Enumerators count as at file scope.
function emit(kind, name) { print kind, name, FILENAME ":" FNR }
function keyword(word) {
    return word ~ /^(const|double|enum|extern|float|inline|int|long|short|signed|size_t|static|struct|typedef|unsigned|void|char)$/
}
FNR == 1 { depth = parens = comment = listing = 0; last = "" }
{
    line = $0
    text = ""
    while (length(line)) { # without comments and strings
        if (comment) {
            end = index(line, "*/")
            if (!end) { line = ""; break }
            line = substr(line, end + 2)
            comment = 0
            continue
        }
        end = index(line, "/*")
        if (!end) { text = text line; break }
        text = text substr(line, 1, end - 1)
        line = substr(line, end + 2)
        comment = 1
    }
    gsub(/"[^"]*"/, "", text)
    if (directive) { directive = text ~ /\\$/; next }
    if (text ~ /^[ ]*#/) {
        directive = text ~ /\\$/
        if (split(text, words, /[ (]+/) > 1 && words[1] == "#define") emit("macro", words[2])
        next
    }
    while (match(text, /[A-Za-z_][A-Za-z_0-9]*|[{}(),;=\[]/)) {
        before = substr(text, 1, RSTART - 1)
        word = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        if (before ~ /[0-9.]$/) continue # a number's end
        if (word == "{") {
            if (kind_of_block == "enum" && !depth) listing = 1
            else depth++
        } else if (word == "}") {
            if (listing) listing = 0
            else depth--
            kind_of_block = last = ""
        } else if (depth) {
            continue
        } else if (word ~ /^[(]$/) {
            parens++
            last = ""
        } else if (word ~ /^[),\[]$/) {
            if (parens && last != "" && !keyword(last)) emit("parameter", last)
            last = ""
            if (word == ")") parens--
        } else if (word == ";" || word == "=") {
            kind_of_block = last = ""
        } else {
            if (word ~ /^(enum|struct)$/) kind_of_block = word
            if (!parens && !keyword(word)) emit("name", word)
            last = word
        }
    }
}
