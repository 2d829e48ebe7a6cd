# Read by the scripts of `make check`: one line of progress a step. $folder keeps what a step makes and says.
case $folder in /*) ;; *) folder=$PWD/$folder ;; esac
WARN='-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wdouble-promotion -Werror'
HEADERS='sg.h asg.h fis.h ggx_bound.h bilateral.h'

step() { # name, command...
    step_name=$1 step_begun=$(date +%s) step_log=$folder/$(echo "$1" | tr -c 'A-Za-z0-9+\n' -).log
    shift
    if "$@" > "$step_log" 2>&1; then
        echo "ok     $step_name, $(($(date +%s) - step_begun)) s"
    else
        { echo "FAILED $step_name: $step_log ends with" && tail -n 12 "$step_log" | sed 's/^/       /'; }
    fi
}

have() { # tool, package, name of the step that needs it
    command -v "$1" > /dev/null && return
    echo "skipped $3: install $2 (make setup)"
    return 1
}

fails() { # what it must say, command...: is refused, and says why
    wanted=$1
    shift
    if said=$("$@" 2>&1); then
        echo "not refused: $*"
        return 1
    fi
    case $said in
    *"$wanted"*) ;;
    *) echo "refused, but not with '$wanted': $*" && echo "$said" && return 1 ;;
    esac
}
