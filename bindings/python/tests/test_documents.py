"""What is written: the examples run, the stubs are true, and everything has a docstring."""

import ast
import inspect
import re
from pathlib import Path

import pytest

import azulejo
from meshes import torus

HERE = Path(__file__).parent
PAGES = {"package": HERE.parent / "README.md", "project": HERE.parents[2] / "README.md"}
PUBLIC = [name for name in dir(azulejo) if not name.startswith("_") and name != "azulejo"]


def examples():
    for name, page in PAGES.items():
        for number, code in enumerate(re.findall(r"^```python\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)):
            yield pytest.param(code, id=f"{name}-{number}")


@pytest.mark.parametrize("code", list(examples()))
def test_an_example_runs(code, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    positions, indices = torus()
    with open("mesh.ply", "w") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(positions)}\n")
        file.write("property float x\nproperty float y\nproperty float z\n")
        file.write(f"element face {len(indices)}\nproperty list uchar uint vertex_indices\nend_header\n")
        file.writelines("%r %r %r\n" % tuple(map(float, row)) for row in positions)
        file.writelines("3 %d %d %d\n" % tuple(row) for row in indices)
    exec(compile(code, "example", "exec"), {})


def test_both_pages_have_examples():
    assert {example.id.split("-")[0] for example in examples()} == set(PAGES)


def stubs():
    return ast.parse((Path(azulejo.__file__).parent / "__init__.pyi").read_text()).body


def arguments(function):
    all_of_it = function.args
    names = [argument.arg for argument in all_of_it.args + all_of_it.kwonlyargs if argument.arg != "self"]
    defaults = [ast.literal_eval(value) for value in all_of_it.defaults + all_of_it.kw_defaults if value is not None]
    return names, defaults


def check_arguments(stub, function):
    names, defaults = arguments(stub)
    parameters = [p for p in inspect.signature(function).parameters.values() if p.name != "self"]
    assert names == [p.name for p in parameters], stub.name
    # Lists and negative numbers would be "..." in the signatures that PyO3 writes, and in help().
    assert defaults == [p.default for p in parameters if p.default is not p.empty], stub.name


def test_stubs_name_what_there_is():
    named = {item.name for item in stubs() if isinstance(item, (ast.FunctionDef, ast.ClassDef)) and item.name[0] != "_"}
    assert named == set(PUBLIC)
    assert (Path(azulejo.__file__).parent / "py.typed").exists()


def test_stubs_have_the_arguments_and_defaults():
    for item in stubs():
        if isinstance(item, ast.FunctionDef):
            check_arguments(item, getattr(azulejo, item.name))
        if not isinstance(item, ast.ClassDef) or item.name.startswith("_"):
            continue
        class_ = getattr(azulejo, item.name)
        methods = {method.name: method for method in item.body if isinstance(method, ast.FunctionDef)}
        present = {name for name in vars(class_) if not name.startswith("_")}
        if class_ is not azulejo.Cancelled:
            assert present == {name for name in methods if not name.startswith("_")}, item.name
        for name, method in methods.items():
            runtime = class_ if name == "__init__" else getattr(class_, name)
            # The slots of Python have signatures of their own.
            if callable(runtime) and (name == "__init__" or not name.startswith("__")):
                check_arguments(method, runtime)


def test_everything_has_a_docstring():
    for name in PUBLIC:
        item = getattr(azulejo, name)
        assert item.__doc__, name
        for attribute, value in vars(item).items() if inspect.isclass(item) else ():
            assert attribute.startswith("_") or value.__doc__, (name, attribute)
    for name in PUBLIC:
        assert name in azulejo.__doc__ or name.endswith(("Report", "Cancelled", "Points", "Selection")) or any(
            word in name for word in ("plane_", "space_", "mesh_", "classes_")
        ), name
