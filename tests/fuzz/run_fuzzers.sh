#!/bin/sh
# tests/fuzz/run_fuzzers.sh BUILD SECONDS [TARGET...]: each target for so long, from its seeds; findings lie in BUILD/fuzz/TARGET.
set -eu
build=$(realpath "$1") seconds=$2
shift 2
fuzzer=$build/voxsheet-fuzz
[ $# -gt 0 ] || set -- $("$fuzzer" --list)
"$fuzzer" --seeds "$build/fuzz"
failed=
for target; do
    echo "$target: $seconds s"
    (cd "$build/fuzz/$target" && "$fuzzer" "$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 \
        -max_len=8192 -print_final_stats=1 . >log 2>&1) || failed="$failed $target"
    grep -E "number_of_executed_units|^finding|SUMMARY" "$build/fuzz/$target/log" || true
done
[ -z "$failed" ] || { echo "findings in:$failed"; exit 1; }
