"""Fills in the manifest's wheels and platforms, checks the manifest, and packs the extension. Called by build.sh.

pack.py SOURCE ROOT TARGET WHEEL... makes the directory TARGET and, beside it, the archive ID-VERSION.zip.
pack.py --check SOURCE ROOT checks the manifest of SOURCE, and compiles its files.
"""

import json
import re
import shutil
import sys
import tomllib
import zipfile
from pathlib import Path

MANIFEST = "blender_manifest.toml"
LICENSES = ("LICENSE-MIT", "LICENSE-APACHE")
# Those that extensions.blender.org knows, by what the names of wheels end in.
PLATFORMS = [
    (r"linux\w*_x86_64", "linux-x64"),
    (r"linux\w*_aarch64", "linux-arm64"),
    (r"win_amd64", "windows-x64"),
    (r"win_arm64", "windows-arm64"),
    (r"macosx_\w*x86_64", "macos-x64"),
    (r"macosx_\w*arm64", "macos-arm64"),
]
TEXTS = {"schema_version", "id", "version", "name", "tagline", "maintainer", "type", "blender_version_min"}
LISTS = {"tags", "license", "platforms", "wheels"}


def platform(wheel):
    for pattern, name in PLATFORMS:
        if re.search(pattern + r"\.whl$", wheel.name):
            return name
    raise SystemExit(f"pack.py: {wheel.name}: for no platform of Blender")


def check(source, root):
    """The manifest, by the rules of Blender's manual; and the version, which is that of the library."""
    manifest = tomllib.loads((source / MANIFEST).read_text())
    assert set(manifest) == TEXTS | LISTS, set(manifest) ^ (TEXTS | LISTS)
    assert all(isinstance(manifest[name], str) and manifest[name] for name in TEXTS)
    assert all(isinstance(manifest[name], list) for name in LISTS)
    assert manifest["schema_version"] == "1.0.0" and manifest["type"] == "add-on"
    assert re.fullmatch(r"[a-z][a-z0-9_]*", manifest["id"]) and manifest["id"] == source.name
    assert len(manifest["tagline"]) <= 64 and manifest["tagline"][-1] not in ".!?"
    assert all(each.startswith("SPDX:") for each in manifest["license"])
    version = tomllib.loads((root / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    assert manifest["version"] == version, f"version {manifest['version']}; that of the library is {version}"
    for file in source.glob("*.py"):
        compile(file.read_text(), str(file), "exec")
    return manifest


def main(source, root, target, *wheels):
    source, root, target = Path(source), Path(root), Path(target)
    wheels = [Path(wheel) for wheel in wheels]
    manifest = check(source, root)
    shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
    (target / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy(wheel, target / "wheels")
    for name in LICENSES:
        shutil.copy(root / name, target)
    text = (source / MANIFEST).read_text()
    for name, entries in [
        ("platforms", [platform(wheel) for wheel in wheels]),
        ("wheels", [f"./wheels/{wheel.name}" for wheel in wheels]),
    ]:
        text = text.replace(f"{name} = []", f"{name} = {json.dumps(entries)}")
    (target / MANIFEST).write_text(text)
    archive = target.parent / f"{manifest['id']}-{manifest['version']}.zip"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for file in sorted(target.rglob("*")):
            if file.is_file():
                packed.write(file, file.relative_to(target))
    print(f"{archive}: {archive.stat().st_size} bytes")


if sys.argv[1] == "--check":
    check(Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve())
else:
    main(*sys.argv[1:])
