"""Compares the calls of a program with the types of the package: python3 calls.py PROGRAM TYPES."""

import ast
import sys


def signatures(path):
    """The names of all functions, classes and methods, and their arguments."""
    found = {}

    def add(name, function):
        spec = function.args
        found[name] = {argument.arg for argument in spec.posonlyargs + spec.args + spec.kwonlyargs} - {"self"}

    for node in ast.parse(open(path).read()).body:
        if isinstance(node, ast.FunctionDef):
            add(node.name, node)
        elif isinstance(node, ast.ClassDef):
            found[node.name] = set()
            for method in node.body:
                if isinstance(method, ast.FunctionDef):
                    add(node.name if method.name == "__init__" else f"{node.name}.{method.name}", method)
    return found


def dotted(node):
    """The name of what is called, or None."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute) and dotted(node.value):
        return f"{dotted(node.value)}.{node.attr}"
    return None


known = signatures(sys.argv[2])
calls = 0
for node in ast.walk(ast.parse(open(sys.argv[1]).read())):
    name = dotted(node.func) if isinstance(node, ast.Call) else None
    if name and name.startswith("azulejo."):
        calls += 1
        name = name.removeprefix("azulejo.")
        assert name in known, f"{sys.argv[1]}: there is no {name}"
        for keyword in node.keywords:
            assert keyword.arg in known[name], f"{sys.argv[1]}: {name} has no {keyword.arg}"
        assert len(node.args) <= len(known[name]), f"{sys.argv[1]}: {name} has too many arguments"
assert calls > 0, f"{sys.argv[1]}: calls nothing"
