#!/bin/sh
# run_fuzzer.sh <fuzzer> <longest input, bytes>: a seeded slice, or 10^7 inputs with PALPATE_SOAK=1. An input that fails
# is left beside the fuzzer.
set -eu
runs=20000
[ "${PALPATE_SOAK:-0}" = 0 ] || runs=10000000
exec "$1" -seed=1 -runs="$runs" -max_len="$2" -artifact_prefix="$1." -print_final_stats=1 -verbosity=0
