#!/usr/bin/env bash
# Writes a program's man page, made of what it explains of itself and of each of its commands.
#   man_page.sh PROGRAM > PAGE.1
set -euo pipefail
program=$1
name=$(basename "$program")

# Options and commands become tagged paragraphs; examples stay as they are typed. Groups of options
# that all commands share are told once, for the program.
roff() {
  awk -v shared="$1" '
    function escaped(text) {
      gsub(/\\/, "\\e", text); gsub(/-/, "\\-", text); sub(/^[.\047]/, "\\\\\\&&", text)
      return text
    }
    function verbatim(on) { if (on != as_typed) print on ? ".nf" : ".fi"; as_typed = on }
    /^Usage: / || /^$/ { text = 0; next }
    /^[^ ].*:$/ {
      verbatim(0); text = 0; examples = /^Examples/
      left_out = !shared && /^(The program itself|Network):/
    }
    left_out { next }
    /^[^ ].*:$/ {
      print ".SS \"" escaped(substr($0, 1, length($0) - 1)) "\""; next
    }
    /^[^ ]/ { verbatim(0); if (!text) print ".PP"; text = 1; print escaped($0); next }
    examples { verbatim(1); print escaped($0); next }
    /^  [^ ]/ {
      print ".TP"
      if (substr($0, 29, 2) == "  " && length($0) > 30) {
        tag = substr($0, 3, 26); sub(/ +$/, "", tag)
        print ".B " escaped(tag); print escaped(substr($0, 31))
      } else { print ".B " escaped(substr($0, 3)) }
      next
    }
    { sub(/^ +/, ""); print escaped($0) }
    END { verbatim(0) }'
}

commands_of() {
  "$@" --help | sed -n '/^Subcommands:/,/^$/ s/^  \([a-z][a-z-]*\) .*/\1/p'
}

# page_of WORD...: all that a command has, and then its own commands.
page_of() {
  local command shared=$(($# == 1))
  {
    "$@" --help-all | sed '/^Subcommands:/,$d'
    "$@" --help | sed -n '/^Subcommands:/,$p' | sed '1,/^$/d'
  } | roff "$shared"
  for command in $(commands_of "$@"); do
    printf '.SH "%s"\n' "$(printf '%s ' "$name" "${@:2}" "$command" | sed 's/ $//; s/-/\\-/g')"
    page_of "$@" "$command"
  done
}

version=$("$program" --version)
about=$("$program" --help)
about=${about%%$'\n'*} about=${about%.}
printf '.TH %s 1 "" "Trailcast %s"\n.SH NAME\n%s \\- %s\n' "${name^^}" "${version##* }" \
  "${name//-/\\-}" "${about//-/\\-}"
printf '.SH SYNOPSIS\n.B %s\n[OPTIONS] [COMMAND]\n.SH DESCRIPTION\n' "${name//-/\\-}"
page_of "$program"
