# Completion of peterka's commands, options and job files for bash.
_peterka() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} i command=
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case ${COMP_WORDS[i]} in run | check) command=${COMP_WORDS[i]} && break ;; esac
    done
    case $before in
    --output | --max-wall | --set) mapfile -t COMPREPLY < <([ "$before" = --output ] && compgen -f -- "$word") && return ;;
    esac
    case $command:$word in
    :-*) mapfile -t COMPREPLY < <(compgen -W "--help --version" -- "$word") ;;
    :*) mapfile -t COMPREPLY < <(compgen -W "run check" -- "$word") ;;
    run:-*) mapfile -t COMPREPLY < <(compgen -W "--help --set --output --fresh --max-wall --quiet" -- "$word") ;;
    check:-*) mapfile -t COMPREPLY < <(compgen -W "--help --set" -- "$word") ;;
    *) mapfile -t COMPREPLY < <(compgen -d -S / -- "$word"; compgen -f -X '!*.toml' -- "$word") ;;
    esac
}
complete -o nospace -o filenames -F _peterka peterka
