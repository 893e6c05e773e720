"""Checks the recipe: it has the sections and keys of conda's schema 1 that it needs, files that exist, and the version of
the project."""

import re
from pathlib import Path

import yaml

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
KEYS = {
    "schema_version": None,
    "context": {"version"},
    "package": {"name", "version"},
    "source": {"path"},
    "build": {"number", "script"},
    "requirements": {"build", "host", "run"},
    "tests": None,
    "about": {"summary", "license", "license_file"},
}

recipe = yaml.safe_load((HERE / "recipe.yaml").read_text())
for section, content in recipe.items():
    assert section in KEYS, f"unknown section {section}"
    if KEYS[section] is not None:
        assert set(content) <= KEYS[section], f"unknown keys in {section}: {set(content) - KEYS[section]}"
for section in ("package", "build", "about"):
    assert section in recipe, f"no {section}"
assert re.search(f'^version = "{recipe["context"]["version"]}"$', (ROOT / "Cargo.toml").read_text(), re.MULTILINE)
assert (HERE / recipe["build"]["script"]["file"]).exists()
for name in recipe["about"]["license_file"]:
    assert (HERE / recipe["source"]["path"] / name).exists(), name
