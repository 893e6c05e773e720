"""Checks the recipe with the parser of rattler-build, the program that builds it: sections, keys, templates, licence. And
what that does not look at: the version is that of the project, and the files exist."""

import tomllib
from pathlib import Path

from rattler_build import Stage0Recipe

HERE = Path(__file__).parent
ROOT = HERE.parents[1]

(rendered,) = Stage0Recipe.from_file(HERE / "recipe.yaml").render()
recipe = rendered.recipe.to_dict()
manifest = tomllib.loads((ROOT / "Cargo.toml").read_text())
assert recipe["package"]["version"] == manifest["workspace"]["package"]["version"]
(source,) = recipe["source"]
licences = [HERE / source["path"] / name for name in recipe["about"]["license_file"]]
for file in [HERE / recipe["build"]["script"]["file"], *licences]:
    assert file.exists(), file
