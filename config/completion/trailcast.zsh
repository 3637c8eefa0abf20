#compdef trailcast trailcast-agent trailcast-console trailcast-server trailcast-vda5050
# Completion for zsh: commands, flags, and the values that a flag takes from a list, as the programs
# themselves explain them.
_trailcast_commands() {
  "$@" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/ s/^  \([a-z][a-z-]*\)  *\(.*\)/\1:\2/p'
}
_trailcast() {
  local -a command commands values flags
  local help word before=$words[CURRENT-1]
  command=($words[1])
  commands=(${(f)"$(_trailcast_commands $command)"})
  for word in ${words[2,CURRENT-1]}; do
    (( ${commands[(I)$word:*]} )) || continue
    command+=($word)
    commands=(${(f)"$(_trailcast_commands $command)"})
  done
  help=$($command --help-all 2>/dev/null) || return
  values=(${(s:,:)"$(sed -n "s/^  .*$before [A-Z]*:{\([^}]*\)}.*/\1/p" <<<$help)"})
  flags=(${(f)"$(sed -n 's/^  \(-h,\)\{0,1\}\(--[a-z][a-z0-9-]*\).*/\2/p' <<<$help)"})
  if [[ $before == --* ]] && (( $#values )); then
    compadd -a values
  elif [[ $words[CURRENT] == -* ]]; then
    compadd -a flags
  else
    (( $#commands )) && _describe command commands || _files
  fi
}
_trailcast "$@"
