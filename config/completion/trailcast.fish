# Completion for fish: commands, flags, and the values that a flag takes from a list, as the programs
# themselves explain them.
function __trailcast_commands
    $argv --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/ s/^  \([a-z][a-z-]*\)  *\(.*\)/\1\t\2/p'
end
function __trailcast_complete
    set -l words (commandline -opc)
    set -l command $words[1]
    set -l commands (__trailcast_commands $command)
    for word in $words[2..]
        string match -q -- $word\t'*' $commands; or continue
        set -a command $word
        set commands (__trailcast_commands $command)
    end
    set -l help ($command --help-all 2>/dev/null)
    set -l values (printf '%s\n' $help | sed -n "s/^  .*$words[-1] [A-Z]*:{\([^}]*\)}.*/\1/p")
    if string match -q -- '--*' $words[-1]; and test -n "$values"
        string split , $values
    else if string match -q -- '-*' (commandline -ct)
        printf '%s\n' $help | sed -n 's/^  \(-h,\)\{0,1\}\(--[a-z][a-z0-9-]*\).*/\2/p'
    else if test -n "$commands"
        printf '%s\n' $commands
    else
        __fish_complete_path (commandline -ct)
    end
end
for program in trailcast trailcast-agent trailcast-console trailcast-server trailcast-vda5050
    complete -c $program -f -a '(__trailcast_complete)'
end
