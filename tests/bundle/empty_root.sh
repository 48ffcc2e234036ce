#!/usr/bin/env bash
# empty_root.sh BUILD: makes a bundle and starts it as a user without rights in a root that holds the bundle, one data
# file, /proc, /dev/null, /dev/urandom and an empty /tmp: no libc, no shell, no fonts. Its picture must be that of the
# program as it was built, and its server must answer. Exit code 77: this machine gives users no namespaces.
set -euo pipefail
build="$(readlink -f "$1")"
source="$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")"
skip() { printf 'skipped: %s\n' "$*"; exit 77; }
fail() { printf 'failed: %s\n' "$*"; exit 1; }

# Root would prove nothing.
user=()
[ "$(id -u)" != 0 ] || user=(setpriv --reuid 65534 --regid 65534 --clear-groups --)
"${user[@]}" unshare --user --map-root-user --mount --pid --fork true 2>/dev/null ||
    skip "this machine lets no ordinary user make namespaces (unshare --user --mount --pid)"

work="$(mktemp -d)"
server=
trap '[ -z "$server" ] || kill -KILL -- "-$server" 2>/dev/null || true; rm -rf "$work"' EXIT
chmod 755 "$work"
root="$work/root"
mkdir -p "$root"/{proc,dev,tmp,some/where/else}
touch "$root/dev/null" "$root/dev/urandom"
chmod 1777 "$root/tmp"

"$source/.ci/bundle" "$build" "$work/bundle.tar"
tar -C "$root/some/where/else" -xf "$work/bundle.tar"
rm "$work/bundle.tar"
mv "$root"/some/where/else/voxsheet-* "$root/some/where/else/moved here"
launcher="/some/where/else/moved here/voxsheet"

# 16^3 bytes: a ramp along x plus another along z.
{
    printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 16 16 16\nencoding: ascii\n\n'
    for z in $(seq 0 15); do for y in $(seq 0 15); do for x in $(seq 0 15); do printf '%d ' $((x * 12 + z * 4)); done; done; done
} >"$root/ramp.nrrd"

# A user of the namespace without any right in it: the second unshare drops what the first one gave for mounting.
in_root() {
    "${user[@]}" env -i PATH=/nowhere "$(command -v unshare)" --user --map-root-user --mount --pid --fork --kill-child \
        /bin/bash -c '
            set -e
            root="$1"; shift
            PATH=/usr/sbin:/usr/bin:/sbin:/bin
            mount -t proc proc "$root/proc" 2>/dev/null || mount --rbind /proc "$root/proc"
            mount --bind /dev/null "$root/dev/null"
            mount --bind /dev/urandom "$root/dev/urandom"
            exec env -i HOME=/tmp "$(command -v unshare)" --user --map-user=1000 --map-group=1000 --root="$root" --wd=/ "$@"
        ' in_root "$root" "$@"
}

look=(--size 320x240 --set background=#203040 --set annotations=all)
in_root "$launcher" info /ramp.nrrd --json >"$work/info.json" || fail "info ended with $?"
grep -q '"dims"' "$work/info.json" || fail "info said $(cat "$work/info.json")"
in_root "$launcher" render /ramp.nrrd -o /tmp/inside.png "${look[@]}" || fail "render ended with $?"
"$build/voxsheet" render "$root/ramp.nrrd" -o "$work/outside.png" --store "$work/store" "${look[@]}"
cmp "$root/tmp/inside.png" "$work/outside.png" || fail "the bundle draws another picture than the program that it is made of"
[ "$(stat -c %s "$work/outside.png")" -gt 3000 ] || fail "the picture is empty"

set -m # a process group of its own, so that no part of it outlives this test
in_root "$launcher" serve /ramp.nrrd --port 0 --no-token >"$work/ready" 2>"$work/log" &
server=$!
set +m
for _ in $(seq 300); do
    [ ! -s "$work/ready" ] || break
    sleep 0.2
done
url="$(sed -n 's/^ready //p' "$work/ready")"
[ -n "$url" ] || fail "the server did not become ready: $(cat "$work/log")"
curl -fsS "${url}api/v1" | grep -q '"renderer"' || fail "GET /api/v1 names no renderer"
curl -fsS "$url" | grep -qi '<!doctype html' || fail "the page is missing"
for _ in $(seq 100); do
    curl -fsS "${url}api/v1/datasets" | grep -q '"ready"' && break
    sleep 0.2
done
curl -fsS -o "$work/cell.png" "${url}api/v1/sheets/Sheet1/cells/A1/image.png?width=64&height=64" || fail "no picture over HTTP"
printf 'a bundle of %s drew and served in an empty root\n' "$(du -sh "$root/some" | cut -f1)"
