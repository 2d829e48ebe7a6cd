# contents.awk - a list of links to the sections of a page of Markdown, and in each to its parts (with
# slug.awk before it)
/^## / { text = substr($0, 4); printf "%s- [%s](#%s)", (begun++ ? "\n" : ""), text, slug(text); parts = 0 }
/^### / { text = substr($0, 5); printf "%s[%s](#%s)", (parts++ ? ", " : ": "), text, slug(text) }
END { print "" }
