# mutants.awk - every small fault of a header's code, one a line: number of the line, kind, the line with the fault
#
# Comments, guards, checks of domains and sizes of arrays are left alone. A constant
# becomes another of a different leading digit: 0.5 is 0.6, 1e-30 is 1e-20, 0x7F is 0x8F, 3 is 4.

function emit(from, length_, by, kind) {
    printf "%d\t%s\t%s\n", NR, kind, substr(raw, 1, from - 1) by substr(raw, from + length_)
}

function at(place) { return substr(code, place, 1) }
function is_word(c) { return c ~ /[A-Za-z0-9_]/ }

# Next to d, and of as many digits
function bumped(d, digits) { return d == substr(digits, length(digits), 1) ? substr(digits, length(digits) - 1, 1) : substr(digits, index(digits, d) + 1, 1) }

# Another number: of a power, such as 1e-30, the power is other
function other_number(text,    digits, place, start) {
    digits = "0123456789"
    start = 1
    if (text ~ /^0[xX]/) { digits = "0123456789ABCDEF"; start = 3 }
    else if (text ~ /[eE]/) {
        start = match(text, /[eE]/) + 1
        if (substr(text, start, 1) ~ /[-+]/) start++
        place = substr(text, start, 1)
        return substr(text, 1, start - 1) (place == "1" ? "2" : place - 1) substr(text, start + 1)
    }
    for (place = start; place <= length(text); place++)
        if (index(substr(digits, 2), substr(text, place, 1)))
            return substr(text, 1, place - 1) bumped(substr(text, place, 1), digits) substr(text, place + 1)
    if (text ~ /^0[.]/) return "0.1" substr(text, 4)
    return "1" substr(text, 2)
}

# Where a term ends that begins at a place; 0 if not on this line
function term_end(place,    depth, c) {
    for (depth = 0; place <= length(code); place++) {
        c = at(place)
        if (c ~ /[(\[]/) depth++
        if (c ~ /[)\]]/ && --depth < 0) return place
        if (depth == 0 && (c ~ /[,;?:]/ || substr(code, place) ~ /^ ([-+<>&|]|[<>=!]=|&&|\|\|) /)) return place
    }
    return 0
}

BEGIN {
    split("+ - - + * / / * % / & | | & ^ & == != != == && || || && << >> >> << += -= -= += *= /= /= *= |= &= &= |= < <= <= < > >= >= >", pairs, " ")
    for (i = 1; i in pairs; i += 2) other[pairs[i]] = pairs[i + 1]
    split("< > <= >= > < >= <=", pairs, " ")
    for (i = 1; i <= 8; i += 2) turned[pairs[i]] = pairs[i + 1]
    split("lobe_min lobe_max lobe_max lobe_min lobe_at_least lobe_at_most lobe_at_most lobe_at_least lobe_add lobe_sub lobe_sub lobe_add", pairs, " ")
    for (i = 1; i <= 12; i += 2) called[pairs[i]] = pairs[i + 1]
    split(".x .y .y .z .z .x .u .v .v .u _x _y _y _x .u0 .v0 .v0 .u0 .u1 .v1 .v1 .u1", pairs, " ")
    for (i = 1; i <= 22; i += 2) field[pairs[i]] = pairs[i + 1]
}

{
    # the code alone, each character where it was
    raw = $0
    code = ""
    for (i = 1; i <= length(raw); i++) {
        two = substr(raw, i, 2)
        if (comment) {
            if (two == "*/") { comment = 0; code = code " "; i++ }
            code = code " "
        } else if (two == "/*") {
            comment = 1
            code = code "  "
            i++
        } else
            code = code substr(raw, i, 1)
    }
    sub(/ +$/, "", code)
}

/^#/ { constant = /^#define LOBE_[A-Z_]+ [0-9.]/ && !/LOBE_VERSION/ }
/^#/ || directive { directive = raw ~ /\\$/; if (!constant) next }
{ constant = 0 }
code ~ /^typedef struct/ { in_struct = 1 }
in_struct { if (code ~ /^}/) in_struct = 0; next }
code ~ /LOBE_ASSERT|#pragma|^extern/ { next }

{
    head = code ~ /^LOBE_(API|INLINE)/
    for (i = 1; i <= length(code); i++) {
        c = at(i)
        before = i > 1 ? at(i - 1) : " "
        if (!head && before == " " && c ~ /[-+*\/%&|^<>=!]/) {
            for (n = 2; n >= 1; n--) {
                op = substr(code, i, n)
                if (!(op in other) || substr(code, i + n, 1) !~ /^ ?$/) continue
                emit(i, n, other[op], "operator")
                if (op in turned) emit(i, n, turned[op], "operator")
                if ((op == "+" || op == "-") && at(i + 1) == " " && (end = term_end(i + 2)))
                    emit(i - 1, end - i + 1, "", "term")
                break
            }
        }
        if (c == "-" && at(i + 1) ~ /[A-Za-z0-9_(.]/ && (before ~ /[(\[]/ || substr(code, 1, i - 1) ~ /([-+*\/=,?:(<>]|return) $/))
            emit(i, 1, "", "sign")
        if (c ~ /[0-9]/ && !is_word(before) && before != ".") {
            match(substr(code, i), /^0[xX][0-9A-Fa-f]+|^[0-9]*[.]?[0-9]*([eE][-+]?[0-9]+)?/)
            if (substr(code, 1, i - 1) !~ /^ +(float|double|int|unsigned|lobe_vec3) [^=(]*\[$/)
                emit(i, RLENGTH, other_number(substr(code, i, RLENGTH)), "constant")
            i += RLENGTH - 1
            while (is_word(at(i + 1))) i++
            continue
        }
        if (c ~ /[a-z]/ && !is_word(before)) {
            match(substr(code, i), /^[A-Za-z0-9_]+/)
            word = substr(code, i, RLENGTH)
            if (!head && word in called) emit(i, RLENGTH, called[word], "call")
            if (!head && word == "fabsf") emit(i, RLENGTH, "", "call")
            if (!head && (tail = substr(word, RLENGTH - 1)) in field) emit(i + RLENGTH - 2, 2, field[tail], "field")
            if (before == "." && (tail = "." word) in field) emit(i - 1, RLENGTH + 1, field[tail], "field")
            if (substr(code, i - 2, 2) == "->" && (tail = "." word) in field)
                emit(i, RLENGTH, substr(field[tail], 2), "field")
            i += RLENGTH - 1
        }
        if (!head && substr(code, i, 2) == "++") emit(i, 2, "--", "operator")
        if (!head && substr(code, i, 2) == "--" ) { emit(i, 2, "++", "operator"); i++ }
    }
}
