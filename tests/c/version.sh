# Sourced by the tests of packages: the version of azulejo, and what of it names the ABI. They set root, the project's
# folder, before.
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
# Before 1.0 each minor version has an ABI of its own.
abi=${version%.*}
