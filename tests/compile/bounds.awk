# Two logs of tests --verbose, another machine's after the native one's: how the worst errors differ.
# usage: awk -v machine=NAME -f bounds.awk NATIVE OTHER
/ worst .* limit / {
    share = $NF > 0 ? $(NF - 2) / $NF : 0
    label = $1 " " $2
    key = label " " ++seen[FILENAME, label]
    if (NR == FNR) { native[key] = $(NF - 2); next }
    count++
    if ($(NF - 2) != native[key]) {
        differ++
        if (share > most) { most = share; where = label; here = $(NF - 2); there = native[key]; limit = $NF }
    }
}
END {
    printf "       %s: %d of %d worst errors differ from the native ones", machine, differ, count
    if (differ) printf ", the nearest to its limit: %s %s, native %s, limit %s", where, here, there, limit
    print ""
}
