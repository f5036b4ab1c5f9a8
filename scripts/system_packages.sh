#!/bin/sh
# Install the Debian or Ubuntu packages that Emogen needs: as root by itself, else it prints the one line to run.
# usage: scripts/system_packages.sh serve|test
set -eu

purpose=${1:?usage: system_packages.sh serve|test}
wanted="python3-venv libegl1 libgl1 libgl1-mesa-dri"
# The tests drive a real browser and a real PostgreSQL.
if [ "$purpose" = test ]; then
    wanted="$wanted fonts-liberation"
    command -v chromium >/dev/null || command -v google-chrome >/dev/null || wanted="$wanted chromium"
    ls /usr/lib/postgresql/*/bin/initdb >/dev/null 2>&1 || wanted="$wanted postgresql"
fi

if ! command -v dpkg-query >/dev/null; then
    echo "This is not Debian or Ubuntu: install what your system calls $wanted; 'emogen doctor' tells what is missing." >&2
    exit 0
fi

missing=""
for package in $wanted; do
    # A Python from elsewhere brings its own venv module.
    if [ "$package" = python3-venv ] && python3 -c 'import ensurepip, venv' 2>/dev/null; then
        continue
    fi
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -ne 0 ]; then
    echo "Some system packages are missing. Run this line, then make $purpose again:" >&2
    echo "    sudo apt-get update && sudo apt-get install -y --no-install-recommends$missing" >&2
    exit 1
fi
echo "Installing system packages:$missing"
apt-get update -qq
# shellcheck disable=SC2086
DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
