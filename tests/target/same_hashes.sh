#!/bin/sh
# same_hashes.sh <folder> <host firmware> <command...>: the command's console shows the hash rows of the firmware
# that runs as a process on the host, to the last bit, and both runs end properly.
set -eu
folder=$1 host=$2
shift 2
mkdir -p "$folder"
"$host" >"$folder/host.csv"
"$@" >"$folder/target.csv"
for console in host target; do
  grep -qx end "$folder/$console.csv" || { echo "the $console run has no end"; exit 1; }
  grep -E '^(stages|hash),' "$folder/$console.csv" >"$folder/$console.hashes"
done
grep -E '^summary,(profile|ticks|state_hash|overruns|max_tick_cycles|stack_peak_bytes),' "$folder/target.csv"
diff "$folder/host.hashes" "$folder/target.hashes" && echo "$(grep -c ^hash, "$folder/target.csv") hash rows are equal"
