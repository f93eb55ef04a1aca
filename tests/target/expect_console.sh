#!/bin/sh
# expect_console.sh <status> <text> <command...>: the command ends with this status and prints this text.
wanted_status=$1 wanted_text=$2
shift 2
output=$("$@" 2>&1)
status=$?
printf '%s\nstatus %s\n' "$output" "$status"
[ "$status" = "$wanted_status" ] || { echo "expected status $wanted_status"; exit 1; }
case $output in *"$wanted_text"*) ;; *) echo "expected the text: $wanted_text"; exit 1 ;; esac
