#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# in_root.sh SUITE FOLDER WORD...: runs ./run WORD... on a bare Debian of the given suite (trixie, bookworm). The system's root is
# FOLDER/root, which debootstrap makes on the first call. Every call copies the working tree's tracked files into this root.
# Packages and build folders stay for the next call. If RIIS_ROOT_INPUT names a folder, its files are copied to /riis.input in the
# root.
#
# The mounts are in a separate namespace, which ends with its last process. After any end of this script, nothing stays mounted,
# so FOLDER can be removed.
set -euo pipefail

suite=$1 folder=$(realpath -m -- "$2")
shift 2
root=$folder/root
debian_keyring=/usr/share/keyrings/debian-archive-keyring.gpg

say() { printf '==> %s\n' "$*"; }
give_up() {
  printf '==> %s\n' "$*" >&2
  exit 1
}

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || give_up "$suite: making a root and entering it takes root rights, and there is no sudo"
  as_root=(sudo)
fi
# in_namespace COMMAND...: runs the command in a namespace. Other processes do not see the mounts of this namespace. All processes
# in the namespace end with the command or with this script. The first process in the namespace waits for a lock that this script
# holds, so the process ends with this script.
in_namespace() {
  # shellcheck disable=SC2016
  "${as_root[@]}" unshare --mount --pid --fork --kill-child bash -c '
    trap "exit 130" INT
    trap "exit 143" TERM
    { flock "$1" true && kill -TERM "$$"; } &
    shift
    "$@" <&0 &
    wait "$!"' bash "$folder/lock" "$@" 9>&-
}

remove() { "${as_root[@]}" rm -rf --one-file-system -- "$@"; }
write() { "${as_root[@]}" tee -- "$1" >/dev/null; }

# ---------------------------------------------------------------------------------------------------------------------
# The host's mirror: address, key and proxy
# ---------------------------------------------------------------------------------------------------------------------

mirror='' keyring=$debian_keyring proxy=''

find_mirror() {
  command -v apt-get >/dev/null || return 0
  # shellcheck disable=SC2016 # apt's variables
  local fields='$(RELEASE) $(REPO_URI) $(SOURCESENTRY)'
  local release uri entry file line host_codename
  # shellcheck source=/dev/null
  host_codename=$(. /etc/os-release && [[ ${ID:-} == debian ]] && echo "${VERSION_CODENAME:-}") || host_codename=
  # Uses the first of apt's sources that has this suite. If no source has this suite, uses the source from which the host was
  # installed.
  while read -r release uri entry; do
    [[ $uri =~ ^https?:// ]] || continue # a disc or a folder of the host is not visible inside the root
    [[ $release == "$suite" || ($host_codename && $release =~ ^($host_codename|stable|oldstable|testing)$) ]] || continue
    mirror=$uri
    break
  done < <(apt-get indextargets --format "$fields" 'Identifier: Packages' 'Component: main')
  [[ $mirror ]] || return 0

  file=${entry%:*} line=${entry##*:}
  [[ $file == *.sources ]] && line='1,$' # in these files the number counts stanzas, which share the file's key
  local signed_by
  signed_by=$(sed -n "${line}p" -- "$file" | grep -v '^ *#' | grep -ioPm1 'signed-by\s*[:=]\s*\K/[^], ]+' || true)
  keyring=${signed_by:-$keyring}

  local host setting found
  host=$(sed -E 's,^[a-z]+://([^/@]*@)?([^/:]*).*,\2,' <<<"$mirror")
  for setting in "Proxy::$host" Proxy; do
    found=
    eval "$(apt-config shell found "Acquire::${mirror%%:*}::$setting")"
    proxy=${proxy:-$found}
  done
  if [[ ! $proxy && $(apt-config dump) == *Proxy-Auto-Detect* ]]; then
    proxy=$(/usr/lib/apt/apt-helper auto-detect-proxy "$mirror" | grep -oP "^Using proxy '\K[^']+" || true)
  fi
  [[ $proxy != DIRECT ]] || proxy=
}

# Prints the host's apt settings for fetching. Other settings, such as hooks and kept files, matter only on the host.
apt_settings() {
  command -v apt-config >/dev/null || return 0
  apt-config dump Acquire | grep -E '^Acquire::(http|https|Retries|ForceIPv4|ForceIPv6|Check-Date|Check-Valid-Until)\b' |
    grep -vi 'auto-detect' || true
  [[ ! $proxy ]] || printf 'Acquire::%s::Proxy "%s";\n' "${mirror%%:*}" "$proxy"
}

# Prints the environment's variables for fetching.
proxy_variables() { env | grep -iE '^(http|https|ftp|all|no)_proxy=' || true; }

# ---------------------------------------------------------------------------------------------------------------------
# The root
# ---------------------------------------------------------------------------------------------------------------------

install_debootstrap() {
  command -v debootstrap >/dev/null || [[ -x /usr/sbin/debootstrap ]] && return
  command -v apt-get >/dev/null || give_up "debootstrap is missing (a package of most distributions)"
  say "missing packages: debootstrap"
  if ! { "${as_root[@]}" apt-get update && "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y \
    --no-install-recommends debootstrap debian-archive-keyring; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    give_up "apt-get failed: $log"
  fi
}

check_keyring() {
  [[ -r $keyring ]] || give_up "no keyring $keyring to check Debian with (package debian-archive-keyring)"
  # Debian's keyring package also has each suite's key as a separate file.
  [[ $keyring != "$debian_keyring" ]] || compgen -G "/usr/share/keyrings/debian-archive-$suite-stable.*" >/dev/null ||
    give_up "the package debian-archive-keyring is too old to know Debian's suite $suite: upgrade it" \
      "(apt-get install --only-upgrade debian-archive-keyring)"
}

make_root() {
  local log=$folder/debootstrap.log
  install_debootstrap
  check_keyring
  [[ -e /usr/share/debootstrap/scripts/$suite ]] ||
    give_up "debootstrap does not know the suite $suite: upgrade it, if that is one of Debian's"
  local options=(--variant=minbase "--keyring=$keyring")
  [[ $mirror != https:* ]] || options+=(--include=ca-certificates)
  say "debootstrap $suite from ${mirror:-debootstrap\'s own mirror} (some minutes; $log)" | sed -E 's,//[^/@]*@,//,'
  remove "$root.part"
  local variables=() line
  while read -r line; do variables+=("$line"); done < <(proxy_variables)
  [[ ! $proxy ]] || variables+=("http_proxy=$proxy" "https_proxy=$proxy")
  if ! in_namespace env "PATH=$PATH:/usr/sbin:/sbin" "${variables[@]}" debootstrap "${options[@]}" "$suite" "$root.part" \
    ${mirror:+"$mirror"} >"$log" 2>&1 </dev/null; then
    tail -n 20 "$log" >&2
    ! grep -q 'unknown key' "$log" ||
      give_up "$keyring does not have the key that $suite is signed with: upgrade debian-archive-keyring"
    grep -q '^I: ' "$log" || give_up "unshare or debootstrap could not start; in a container they need the right to mount"
    give_up "debootstrap failed: $log"
  fi
  "${as_root[@]}" mv -- "$root.part" "$root"
}

# Copies the host's network settings, which may have changed since the last call.
configure_root() {
  local file
  for file in /etc/resolv.conf /etc/hosts; do
    [[ ! -r $file ]] || write "$root$file" <"$file"
  done
  "${as_root[@]}" mkdir -p "$root/etc/apt/keyrings" "$root/usr/local/share/ca-certificates"
  if [[ $mirror ]]; then
    local copy=/etc/apt/keyrings/host-${keyring##*/}
    write "$root$copy" <"$keyring"
    write "$root/etc/apt/sources.list" <<<"deb [signed-by=$copy] $mirror $suite main"
  fi
  "${as_root[@]}" find /etc/apt/ -maxdepth 1 -name 'auth.conf*' -exec cp -R -- {} "$root/etc/apt/" \;
  apt_settings | write "$root/etc/apt/apt.conf.d/90host"
  # Copies certificates that the administrator may have added.
  if [[ -d /usr/local/share/ca-certificates ]]; then
    "${as_root[@]}" cp -R /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates/"
  fi
}

# Copies the tracked files of the working tree with their times, so that only changed files are built again.
copy_tree() {
  local files=() file fresh=$root/riis.part
  if [[ -e .git ]]; then
    while IFS= read -r -d '' file; do [[ ! -e $file ]] || files+=("$file"); done < <(git ls-files -z)
    local others
    others=$(git ls-files --others --exclude-standard | tr '\n' ' ')
    [[ ! $others ]] || say "not tracked by git, not copied: $others"
  else
    while IFS= read -r -d '' file; do files+=("$file"); done \
      < <(find . -mindepth 1 -maxdepth 1 ! -name 'build*' ! -name out -print0)
  fi
  ((${#files[@]})) || give_up "no files to copy from $PWD"
  remove "$fresh"
  "${as_root[@]}" mkdir -p "$fresh"
  printf '%s\0' "${files[@]}" | tar -c --null -T - | "${as_root[@]}" tar -x --no-same-owner -C "$fresh"
  for file in "$root"/riis/build* "$root"/riis/out; do
    [[ ! -e $file ]] || "${as_root[@]}" mv -- "$file" "$fresh/"
  done
  remove "$root/riis" "$root/riis.input"
  "${as_root[@]}" mv -- "$fresh" "$root/riis"
  [[ ! ${RIIS_ROOT_INPUT:-} ]] || "${as_root[@]}" cp -R -- "$RIIS_ROOT_INPUT" "$root/riis.input"
}

# This script runs inside the namespace. /dev has no graphics or compute devices, so only the processor is used.
# shellcheck disable=SC2016
inside='
set -e
root=$1
shift
mount -t proc proc "$root/proc"
mount -t sysfs -o ro sysfs "$root/sys"
mount -t tmpfs -o mode=755 tmpfs "$root/dev"
for device in null zero full random urandom tty; do
  touch "$root/dev/$device"
  mount --bind "/dev/$device" "$root/dev/$device"
done
ln -s /proc/self/fd "$root/dev/fd"
for stream in 0:stdin 1:stdout 2:stderr; do ln -s "/proc/self/fd/${stream%:*}" "$root/dev/${stream#*:}"; done
mkdir -m 1777 "$root/dev/shm"
mkdir "$root/dev/pts"
mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
mount -t devpts -o newinstance,ptmxmode=666,mode=620,gid=5 devpts "$root/dev/pts"
ln -s pts/ptmx "$root/dev/ptmx"
chroot "$root" "$@"
'

mkdir -p "$folder"
exec 9>"$folder/lock"
flock -n 9 || give_up "$folder is in use by another call"
((EUID == 0)) || sudo -v # so that sudo asks for the password at once
find_mirror
[[ -d $root ]] || make_root
configure_root
copy_tree
variables=()
while read -r line; do variables+=("$line"); done < <(proxy_variables)
say "in $root: ./run $*"
# shellcheck disable=SC2016
in_namespace bash -c "$inside" bash "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
  "TERM=${TERM:-dumb}" "${variables[@]}" bash -c '
    dpkg --configure -a >/dev/null # finishes the work of an interrupted call
    ! command -v update-ca-certificates >/dev/null || update-ca-certificates >/dev/null
    cd /riis && exec ./run "$@"' bash "$@"
