# Completion for bash: commands, flags, and the values that a flag takes from a list, as the programs
# themselves explain them.
_trailcast() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local command=("${COMP_WORDS[0]}") commands help values i
  COMPREPLY=()
  commands=$(_trailcast_commands "${command[@]}")
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ " $commands " == *" ${COMP_WORDS[i]} "* ]] || continue
    command+=("${COMP_WORDS[i]}")
    commands=$(_trailcast_commands "${command[@]}")
  done
  help=$("${command[@]}" --help-all 2>/dev/null) || return 0
  values=$(sed -n "s/^  .*$before [A-Z]*:{\([^}]*\)}.*/\1/p" <<<"$help")
  if [[ $before == --* && -n $values ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${values//,/ }" -- "$current")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_trailcast_flags <<<"$help")" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
    ((${#COMPREPLY[@]})) || mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}
_trailcast_flags() { sed -n 's/^  \(-h,\)\{0,1\}\(--[a-z][a-z0-9-]*\).*/\2/p'; }
_trailcast_commands() {
  "$@" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/ s/^  \([a-z][a-z-]*\) .*/\1/p' | tr '\n' ' '
}
complete -o filenames -F _trailcast trailcast trailcast-agent trailcast-console trailcast-server trailcast-vda5050
