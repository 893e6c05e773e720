#!/usr/bin/env bash
# Unpacks Debian's Python for arm64, which qemu-user can run, into a folder: nothing is installed.
#
#   bindings/python/arm64-python.sh FOLDER
#
# Prints the path of the program. With the library of C++, which numpy needs. Needs apt-get.
set -euo pipefail

folder=$(mkdir -p "${1:?usage: arm64-python.sh FOLDER}" && cd "$1" && pwd)
mkdir -p "$folder"/{state/lists,cache/archives}/partial "$folder/root"
touch "$folder/status"
cat >"$folder/apt.conf" <<END
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "root";
Dir::State "$folder/state";
Dir::State::status "$folder/status";
Dir::Cache "$folder/cache";
END
export APT_CONFIG=$folder/apt.conf
apt-get update -qq
apt-get install -qq --yes --download-only --no-install-recommends python3 libstdc++6 >/dev/null
for package in "$folder"/cache/archives/*.deb; do
    dpkg-deb -x "$package" "$folder/root"
done
realpath "$folder/root/usr/bin/python3"
