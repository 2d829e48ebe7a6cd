# slug.awk - the name of a heading in links, as GitHub makes it; to be put before a script with -f
function slug(text,    name) {
    name = tolower(text)
    gsub(/&[a-z#0-9]+;/, "", name)
    gsub(/[^a-z0-9_ -]/, "", name)
    gsub(/ /, "-", name)
    if (name in slugs) return name "-" slugs[name]++
    slugs[name] = 1
    return name
}
