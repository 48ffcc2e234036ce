#!/usr/bin/env bash
# server_figures.sh VOXSHEET: what the server costs beside its pictures, as one JSON object: start to `ready` with
# a warm store, processor time while nothing happens, from an edit of each kind to a reduced picture of the sheet
# (95th percentile of EDITS, curl's start and two requests over one connection included; of a formula: to a
# reduced picture of its cell, once it is computed), and private memory after that with its bound (texture budget
# + memory budget + 150 MB): pages that this process alone has written. Pages of programs and libraries, which it
# shares with others that use them and which the system may drop, are apart. Over nine cells of 128^3 that it
# writes itself, of more bytes than the budgets hold; needs curl.
set -euo pipefail
program="$(readlink -f "$1")"
idle_seconds="${IDLE_SECONDS:-10}"
edits="${EDITS:-20}"
budget=16 # MB, of textures and of memory each

work="$(mktemp -d)"
server=
stop() { [ -z "$server" ] || { kill -TERM "$server" 2>/dev/null && wait "$server" || true; }; server=; }
trap 'stop; rm -rf "$work"' EXIT

# Nine files of 128^3 bytes that differ, so that nothing is shared.
for i in 1 2 3 4 5 6 7 8 9; do
    { printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 128 128 128\nencoding: raw\n\n'
      head -c 2097152 /dev/urandom; } >"$work/v$i.nrrd"
done

now() { date +%s%N; }
milliseconds() { echo $((($1) / 1000000)); }

# Starts the server and sets `ready_ms` and `url`.
start() {
    local began line; began="$(now)"
    rm -f "$work/out"; mkfifo "$work/out"
    "$program" serve "$work"/v?.nrrd --port 0 --no-token --store "$work/store" --texture-budget "${budget}M" \
        --memory-budget "${budget}M" >"$work/out" 2>"$work/err" &
    server=$!
    exec 3<"$work/out"
    read -r -t 60 line <&3
    ready_ms="$(milliseconds "$(now) - began")"
    url="${line#ready }"; url="${url%%\?*}"
}

picture() { curl -fsS -o "$work/picture.png" "${url}api/v1/sheets/Sheet1/image.png?width=768&height=768"; }
ticks() { awk '{ print $14 + $15 }' "/proc/$server/stat"; }

start; cold_ms="$ready_ms"
deadline=$((SECONDS + 60))
until picture 2>/dev/null && [ "$(curl -fsS "${url}api/v1/datasets" | grep -o '"name"' | wc -l)" -ge 9 ]; do
    [ "$SECONDS" -lt "$deadline" ] || { echo "no picture: $(tail -1 "$work/err")" >&2; exit 1; }
    sleep 0.2
done
stop

start; warm_ms="$ready_ms"
picture
sleep 2
before="$(ticks)"; sleep "$idle_seconds"; after="$(ticks)"
idle_percent="$(awk -v t="$((after - before))" -v hz="$(getconf CLK_TCK)" -v s="$idle_seconds" \
    'BEGIN { printf "%.2f", 100 * t / hz / s }')"
# One edit, its body in $1, and the picture that shows it, over one connection as a page has.
edit() {
    local began; began="$(now)"
    curl --fail-with-body -sS -X PATCH "${url}api/v1/sheets/Sheet1/style" -H 'Content-Type: application/json' -d "$1" \
        -o "$work/answer" --next --fail-with-body -sS -o "$work/picture.jpg" \
        "${url}api/v1/sheets/Sheet1/image.jpg?width=768&height=768&quality=half&sampling.distance=1" ||
        { cat "$work/answer" "$work/picture.jpg" >&2 || true; return 1; }
    milliseconds "$(now) - began"
}
# The ninth cell becomes the formula $1. Its picture is asked for every 5 ms, over the same connection (what
# stands behind # is not sent): to start a program for each question would take a processor from the answer.
formula() {
    local began asking status=none cell="${url}api/v1/sheets/Sheet1/cells/C3"; began="$(now)"
    exec 4< <(exec curl --fail-with-body --fail-early -sS --rate 200/s -X PATCH "$cell" \
        -H 'Content-Type: application/json' -d "$1" -o "$work/answer" --next -s -o "$work/answer" \
        -w '%{stderr}%{http_code}\n' "$cell/image.jpg?width=256&height=256&quality=half#[1-6000]" 2>&1)
    asking=$!
    while read -r status <&4 && [ "$status" = 409 ]; do :; done # it is not computed yet
    kill "$asking" 2>/dev/null || true
    exec 4<&-
    [ "$status" = 200 ] || { echo "no picture of $1: $status $(cat "$work/answer")" >&2; return 1; }
    milliseconds "$(now) - began"
}
# p95 NAME BODY [WHAT: edit]: the body's % stands for a number from 0.10 to 0.90.
p95() {
    local i
    for i in $(seq "$edits"); do "${3:-edit}" "${2//%/0.$((10 + i * 80 / edits))}" || exit 1; done | sort -n |
        awk -v name="$1" '{ ms[NR] = $1 } END { printf "\"%s\": %s", name, ms[int(0.95 * NR + 0.5)] }'
}
curl -fsS -o /dev/null -X PATCH "${url}api/v1/sheets/Sheet1/style" -H 'Content-Type: application/json' \
    -d '{"technique": "raycast", "transfer.opacity": [[0, 0], [1, 0.05]]}'
edit_ms="$(p95 camera '{"camera.azimuth": %}'), $(p95 opacity '{"transfer.opacity": [[%, 0], [1, 0.05]]}')"
edit_ms+=", $(p95 range '{"range.mode": "percentile", "range.min": %}'), $(p95 light '{"shading.model": "phong", "shading.ambient": %}')"
edit_ms+=", $(p95 planes '{"shading.model": "none", "clip.units": "fraction", "clip.planes": [[1, 0, 0, %]]}')"
edit_ms+=", $(p95 isovalue '{"technique": "isosurface", "clip.planes": "none", "isovalue": [%]}')"
edit_ms+=", $(p95 formula '{"source": "=B1-A1*%"}' formula)"
private_kb="$(awk '/^Private_Dirty/ { print $2 }' "/proc/$server/smaps_rollup")"
resident_kb="$(awk '/^Rss/ { print $2 }' "/proc/$server/smaps_rollup")"
printf '{"ready_cold_ms": %s, "ready_warm_ms": %s, "idle_cpu_percent": %s, "edit_p95_ms": {%s}, "private_mb": %s, "private_bound_mb": %s, "program_pages_mb": %s}\n' \
    "$cold_ms" "$warm_ms" "$idle_percent" "$edit_ms" "$((private_kb / 1024))" "$((2 * budget + 150))" "$(((resident_kb - private_kb) / 1024))"
