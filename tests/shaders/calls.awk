# What the unit tests need to call shaders: awk -v want=c|glsl -f calls.awk headers exempt shaders
#
# c: a header that makes every call of a header's function, which a shader has too, one that asks the GPU.
# glsl: the compute shader that answers those of the function that FUNCTION is defined as: a driver takes long to choose
# among all. A word is 4 bytes, and each argument takes the words of its type.
# A shader's function whose last parameter is a plane gives four of the channels that the header's gives all of.
# A public function that no shader has, and exempt.txt does not name, is an error; so is one that it names in vain, and
# one that is out of its header's order.

function fail(what) {
    print FILENAME ": " what > "/dev/stderr"
    failed = 1
}

function trim(s) {
    gsub(/^[ \t]+|[ \t]+$/, "", s)
    return s
}

# "type name" or "type name[3]": sets type, name and count, which is 0 for what is no array
function declare(s) {
    s = trim(s)
    count = 0
    if (match(s, /\[[A-Z_0-9]+\]$/)) {
        count = substr(s, RSTART + 1, RLENGTH - 2)
        if (count in constant) count = constant[count]
        count += 0
        s = substr(s, 1, RSTART - 1)
    }
    name = s
    sub(/^.*[ *]/, "", name)
    type = trim(substr(s, 1, length(s) - length(name)))
}

function words_of(type) {
    if (type ~ /^(float|int|uint|bool)$/) return 1
    if (type ~ /^[iu]?vec[234]$/) return substr(type, length(type)) + 0
    if (!(type in words)) fail("unknown type " type)
    return words[type]
}

function base_of(path) {
    sub(/^.*\//, "", path)
    sub(/\.[a-z]*$/, "", path)
    return path
}

# A shader has its header's functions in its header's order; only the first that is out of it is told.
function follow() {
    if (home[name] != base_of(FILENAME)) fail(name " is one of " home[name] ".h")
    else if (FILENAME in last && place[name] < place[last[FILENAME]]) {
        if (!(FILENAME in strays)) fail(name " comes after " last[FILENAME] ", in " home[name] ".h before it")
        strays[FILENAME] = 1
    }
    last[FILENAME] = name
}

FNR == 1 { kind = FILENAME ~ /\.h$/ ? "header" : FILENAME ~ /\.txt$/ ? "exempt" : "shader" }

kind == "exempt" {
    if ($1 != "" && $1 !~ /^#/) exempt[$1] = 1
    next
}

kind == "header" && /^LOBE_(API|INLINE) / { statement = "" }
kind == "header" { statement = statement " " trim($0) }
kind == "header" && /\{$/ {
    if (statement ~ /^ LOBE_(API|INLINE) / && statement !~ /^[^(]* lobe_[a-z0-9_]*\(/) {
        open = index(statement, "(")
        head = substr(statement, 2, open - 2)
        sub(/^LOBE_(API|INLINE) /, "", head)
        declare(head)
        place[name] = publics
        home[name] = base_of(FILENAME)
        public[publics++] = name
        returns[name] = type
        close_at = index(statement, ") {")
        arguments[name] = substr(statement, open + 1, close_at - open - 1)
    }
    statement = ""
}

kind == "shader" && /^const int / {
    value = $0
    sub(/^.*= */, "", value)
    sub(/;.*$/, "", value)
    constant[$3] = value
}
kind == "shader" && /^struct / {
    inside = $2
    structs[struct_count++] = inside
    next
}
kind == "shader" && inside != "" && /^};/ { inside = ""; next }
kind == "shader" && inside != "" {
    sub(/\/\/.*$/, "")
    sub(/\/\*.*$/, "")
    if (!index($0, ";")) next
    field_type = $1
    rest = $0
    sub(/^[ \t]*[a-z_0-9]+[ \t]+/, "", rest)
    sub(/;.*$/, "", rest)
    parts = split(rest, list, ",")
    for (k = 1; k <= parts; k++) {
        declare(field_type " " list[k])
        fields[inside, field_count[inside] + 0] = type " " name " " count
        field_count[inside]++
        words[inside] += words_of(type) * (count ? count : 1)
    }
    next
}
kind == "shader" && /^[a-z_0-9]+ [a-z_0-9]+\(/ { statement = "" }
kind == "shader" && /^[^ \/]|^ +[a-z]/ { statement = statement " " trim($0) }
kind == "shader" && /\) \{$/ {
    if (statement ~ /^ [a-z_0-9]+ [a-z_0-9]+\(/) {
        open = index(statement, "(")
        declare(substr(statement, 2, open - 2))
        if (!(name in shader)) {
            if (name in place) follow()
            shader[name] = 1
            shader_returns[name] = type
            close_at = index(statement, ") {")
            shader_arguments[name] = substr(statement, open + 1, close_at - open - 1)
        }
    }
    statement = ""
}

function write_c(which, list, n, i, in_words, out_words, s, pass, before, results, size, planes) {
    n = split(shader_arguments[callee], list, ",")
    in_words = out_words = 0
    for (i = 1; i <= n; i++) {
        s = trim(list[i])
        before = s ~ /^out /
        sub(/^(out|in|const) /, "", s)
        declare(s)
        size[i] = count
        planes = name == "plane"
        if (before) out_words += words_of(type) * (count ? count : 1)
        else in_words += words_of(type) * (count ? count : 1)
    }
    if (shader_returns[callee] != "void") out_words += words_of(shader_returns[callee])
    printf "static inline %s shader_%s(%s) {\n", returns[callee], callee, arguments[callee]
    n = split(arguments[callee], list, ",")
    pass = results = ""
    if (planes) {
        for (i = 1; i <= n; i++) pass = pass (i > 1 ? ", " : "") name_of(list[i])
        printf "    int plane;\n    %s(%s);\n", callee, pass
        printf "    for (plane = 0; 4 * plane < %s->channels; plane++) {\n", name_of(list[1])
        printf "    shader_begin(%d, \"%s\", %d, %d);\n    shader_in_planes(%s);\n", which, callee, in_words, out_words, name_of(list[1])
        for (i = 2; i < n; i++) printf "    shader_in(&%s, sizeof %s);\n", name_of(list[i]), name_of(list[i])
        printf "    shader_in(&plane, sizeof plane);\n    shader_find();\n"
        printf "    shader_out(%s + 4 * plane, sizeof *%s * (size_t)(%s->channels < 4 * plane + 4 ? %s->channels - 4 * plane : 4));\n    }\n}\n", name_of(list[n]), name_of(list[n]), name_of(list[1]), name_of(list[1])
        printf "#define %s shader_%s\n\n", callee, callee
        return
    }
    printf "    shader_begin(%d, \"%s\", %d, %d);\n", which, callee, in_words, out_words
    for (i = 1; i <= n; i++) {
        s = trim(list[i])
        declare(s)
        pass = pass (i > 1 ? ", " : "") name_of(s)
        if (s ~ /^const fis_pyramid \*/)
            printf "    shader_in_pyramid(%s);\n", name_of(s)
        else if (s ~ /^const .*\*/ && list[i + 1] ~ /^ *int (n[ij]|count)$/)
            printf "    shader_in_some(%s, sizeof *%s, %s, %d);\n", name_of(s), name_of(s), name_of(trim(list[i + 1])), size[i]
        else if (s ~ /^const .*\*/)
            printf "    shader_in(%s, sizeof *%s);\n", name_of(s), name_of(s)
        else if (s ~ /^const .*\]$/)
            printf "    shader_in(%s, %d * sizeof *%s);\n", name_of(s), count, name_of(s)
        else if (s ~ /\*/ && size[i])
            results = results sprintf("    shader_out_some(%s, sizeof *%s, count, %d);\n", name_of(s), name_of(s), size[i])
        else if (s ~ /\*/)
            results = results sprintf("    shader_out(%s, sizeof *%s);\n", name_of(s), name_of(s))
        else if (s ~ /\]$/)
            results = results sprintf("    shader_out(%s, %d * sizeof *%s);\n", name_of(s), count, name_of(s))
        else
            printf "    shader_in(&%s, sizeof %s);\n", name_of(s), name_of(s)
    }
    if (returns[callee] == "void")
        printf "    %s(%s);\n    shader_find();\n%s}\n", callee, pass, results
    else
        printf "    {\n    %s result = %s(%s);\n    shader_find();\n    shader_out(&result, sizeof result);\n%s    return result;\n    }\n}\n", returns[callee], callee, pass, results
    printf "#define %s shader_%s\n\n", callee, callee
}

function name_of(s) {
    s = trim(s)
    sub(/\[[^\]]*\]$/, "", s)
    sub(/^.*[ *]/, "", s)
    return s
}

function read_into(target, type, count, indent, k) {
    if (!count) return indent target " = next_" type "(at);\n"
    return indent "for (k = 0; k < " count "; k++) " target "[k] = next_" type "(at);\n"
}

function write_from(source, type, count, indent) {
    if (!count) return indent "put_" type "(to, " source ");\n"
    return indent "for (k = 0; k < " count "; k++) put_" type "(to, " source "[k]);\n"
}

function write_struct(type, i, part) {
    printf "%s next_%s(inout uint at) {\n    %s v;\n    int k;\n", type, type, type
    for (i = 0; i < field_count[type]; i++) {
        split(fields[type, i], part, " ")
        printf "%s", read_into("v." part[2], part[1], part[3] + 0, "    ")
    }
    printf "    return v;\n}\n\nvoid put_%s(inout uint to, %s v) {\n    int k;\n", type, type
    for (i = 0; i < field_count[type]; i++) {
        split(fields[type, i], part, " ")
        printf "%s", write_from("v." part[2], part[1], part[3] + 0, "    ")
    }
    print "}\n"
}

function write_case(which, list, n, i, s, is_out, in_words, out_words, reads, writes, pass, declared) {
    n = split(shader_arguments[callee], list, ",")
    in_words = out_words = 0
    reads = writes = pass = declared = ""
    for (i = 1; i <= n; i++) {
        s = trim(list[i])
        is_out = s ~ /^out /
        sub(/^(out|in|const) /, "", s)
        declare(s)
        declared = declared "        " type " a" i (count ? "[" count "]" : "") ";\n"
        if (is_out) {
            out_words += words_of(type) * (count ? count : 1)
            writes = writes write_from("a" i, type, count, "        ")
        } else {
            in_words += words_of(type) * (count ? count : 1)
            reads = reads read_into("a" i, type, count, "        ")
        }
        pass = pass (i > 1 ? ", " : "") "a" i
    }
    if (shader_returns[callee] != "void") out_words += words_of(shader_returns[callee])
    printf "#if FUNCTION == %d\n%s        at *= %du;\n        to *= %du;\n%s", which, declared, in_words, out_words, reads
    if (shader_returns[callee] == "void") printf "        %s(%s);\n", callee, pass
    else printf "        put_%s(to, %s(%s));\n", shader_returns[callee], callee, pass
    printf "%s#endif\n", writes
}

END {
    for (i = 0; i < publics; i++) {
        name = public[i]
        if (name in exempt) {
            if (name in shader) fail("exempt.txt names " name ", which the shaders have")
            exempt_seen[name] = 1
        } else if (!(name in shader)) fail("no shader has " name)
    }
    for (name in exempt) if (!(name in exempt_seen)) fail("exempt.txt names " name ", which no header has")
    if (failed) exit 1
    if (want == "c") print "/* Made by calls.awk: every call that a shader has too asks the GPU. */"
    else {
        for (i = 0; i < struct_count; i++) write_struct(structs[i])
        print "layout(local_size_x = 64) in;\nvoid main() {\n    uint at = gl_GlobalInvocationID.x, to = at;\n    int k;"
    }
    for (i = which = 0; i < publics; i++) {
        callee = public[i]
        if (callee in exempt) continue
        if (want == "c") write_c(which)
        else write_case(which)
        which++
    }
    if (want == "c") printf "enum { SHADER_FUNCTIONS = %d };\n", which
    else print "}"
}
