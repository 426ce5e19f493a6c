# To be sourced by a script, first of all: its usage is the comment at its top. Tells it on --help, refuses what the script
# doesn't know, and configures a build folder.
script_file=$(realpath "$0")
script=$(basename "$0")

# The comment at the top of the script, without the line that names the shell.
show_usage() { sed -n '1d; /^#/!q; s/^# \{0,1\}//p' "$script_file"; }

refuse() { # REASON
    echo "$script: $1; --help tells the usage" >&2
    exit 2
}

# Sorts the arguments into `options`, all of them among KNOWN_OPTIONS, and MOST_WORDS `words` at most.
read_arguments() { # "KNOWN_OPTIONS" MOST_WORDS [ARGUMENT...]
    local known=" $1 " most=$2 argument
    shift 2
    options=() words=()
    for argument in "$@"; do
        case $argument in
            -h | --help) show_usage; exit ;;
            "") refuse "an argument is empty" ;;
            -*) [[ $known == *" $argument "* ]] || refuse "unknown option $argument"
                options+=("$argument") ;;
            *) words+=("$argument") ;;
        esac
    done
    [ ${#words[@]} -le "$most" ] || refuse "too many arguments: ${words[*]}"
}

has_option() { [[ " ${options[*]} " == *" $1 "* ]]; }

# The absolute path of a folder, which is made where it is missing.
folder_argument() { # FOLDER
    [ ! -e "$1" ] || [ -d "$1" ] || refuse "$1 is not a folder"
    { mkdir -p "$1" && [ -w "$1" ]; } 2>/dev/null || refuse "the folder $1 can't be made or written into"
    realpath "$1"
}

# The absolute path of a program that is built already.
program_argument() { # VARIABLE
    [ -f "${!1}" ] && [ -x "${!1}" ] || refuse "$1=${!1} is not a program"
    realpath "${!1}"
}

# A part of tests/endurance.sh, which tells it where its rows go.
start_as_part() { # [ARGUMENT...]
    read_arguments "" 0 "$@"
    [ -n "${ENDURANCE_ROWS:-}" ] || refuse "this is a part of tests/endurance.sh: tests/endurance.sh ${script%.*}"
}

# cmake for a build folder of this clone, heard only where it fails; from scratch where the folder was configured for another
# clone, with which CMake refuses to go on.
configure() { # BUILD_FOLDER [ARGUMENT...]
    local cache=$1/CMakeCache.txt log
    if [ -f "$cache" ] && ! { [ "$(cached CMAKE_HOME_DIRECTORY)" -ef . ] && [ "$(cached CMAKE_CACHEFILE_DIR)" -ef "$1" ]; }; then
        echo "$script: $1 was configured for $(cached CMAKE_HOME_DIRECTORY), so it is configured anew" >&2
        rm -rf "$cache" "$1/CMakeFiles"
    fi
    log=$(mktemp)
    cmake -S . -B "$@" >"$log" 2>&1 || { cat "$log" >&2; rm -f "$log"; return 1; }
    rm -f "$log"
}
cached() { sed -n "s/^$1:INTERNAL=//p" "$cache"; }
