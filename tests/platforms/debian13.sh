#!/usr/bin/env bash
#
# Runs setup.sh on a fresh Debian 13 (trixie) in a folder, without leaving this system:
#
#   sudo tests/platforms/debian13.sh FOLDER [ARGUMENT...]
#
# FOLDER is made by debootstrap if it is not there (300 MB from Debian's main archive, 4 GB
# with what setup.sh installs) and used again if it is. The arguments are those of setup.sh,
# 'test' if there are none; variables such as NMM_JOBS and NMM_PRESETS reach it. The tree
# that is tested is that of the last commit; it is built in FOLDER/root/nmm. Another release
# is chosen by NMM_RELEASE=bookworm.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."


die()
{
  printf 'debian13.sh: %s\n' "$*" >&2
  exit 1
}


[[ $# -ge 1 ]] || die "name the folder for the system, outside of this tree."
[[ $EUID -eq 0 ]] || die "debootstrap and chroot take root's rights: run this as root."
for command in debootstrap rsync; do
  command -v "$command" >/dev/null || die "install the package '$command' first."
done

# The mounts below are seen by this process only and end with it.
if [[ -z "${NMM_OWN_MOUNTS:-}" ]]; then
  NMM_OWN_MOUNTS=1 exec unshare --mount --propagation private "$0" "$@"
fi

mkdir -p "$1"
readonly system="$(cd "$1" && pwd -P)"
shift
[[ "$system" != "$PWD"/* && "$system" != / ]] ||
  die "$system is no place for another system: name a folder outside of this tree."

if [[ ! -e "$system/etc/debian_version" ]]; then
  debootstrap --variant=minbase "${NMM_RELEASE:-trixie}" "$system" ||
    die "debootstrap failed (its message is above). Remove $system and run this again."
fi

mount -t proc proc "$system/proc"
mount --rbind /sys "$system/sys"
mount --rbind /dev "$system/dev"
# Open MPI's ranks share memory here.
mount -t tmpfs tmpfs "$system/dev/shm"
cp --dereference /etc/resolv.conf "$system/etc/resolv.conf"

# What has not changed keeps its time stamp, so that building goes on where it was.
readonly tree="$system/root/nmm"
readonly fresh="$(mktemp -d)"
trap 'rm -rf "$fresh"' EXIT
git archive HEAD | tar -x -C "$fresh"
mkdir -p "$tree"
rsync --recursive --links --perms --checksum --delete --exclude=/build --exclude=/output \
  "$fresh/" "$tree/"

chroot "$system" /usr/bin/env -i \
  HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 CI="${CI:-}" \
  NMM_JOBS="${NMM_JOBS:-}" NMM_PRESETS="${NMM_PRESETS:-}" \
  NMM_WARNINGS_AS_ERRORS="${NMM_WARNINGS_AS_ERRORS:-OFF}" \
  /root/nmm/setup.sh "${@:-test}"
