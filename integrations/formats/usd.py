"""Reads USD files of samples by Pixar's library, asks its validators, and compares with the same samples as CSV.

usd.py FOLDER: points.usda and instances.usda beside points.csv and instances.csv.
"""

import csv
import pathlib
import sys

import numpy as np
from pxr import Tf, Usd, UsdGeom, UsdValidation

folder = pathlib.Path(sys.argv[1])


def columns(name):
    with open(folder / name, newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows], np.float32) for key in rows[0]}


def positions(samples):
    zeros = np.zeros_like(samples["x"])
    return np.stack([samples["x"], samples["y"], samples.get("z", zeros)], axis=1)


def errors(stage):
    """What the validators say, and what they do not look for: as many values as samples, and prototypes that are there."""
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    found = [error.GetMessage() for error in UsdValidation.ValidationContext(validators).Validate(stage)]
    prim = stage.GetDefaultPrim()
    if prim.IsA(UsdGeom.Points):
        count = len(UsdGeom.Points(prim).GetPointsAttr().Get())
        for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvars():
            if primvar.GetInterpolation() == "vertex" and len(primvar.Get()) != count:
                found.append(f"{primvar.GetName()} has {len(primvar.Get())} values for {count} points")
        attributes = [UsdGeom.Points(prim).GetNormalsAttr(), UsdGeom.Points(prim).GetIdsAttr()]
    else:
        instancer = UsdGeom.PointInstancer(prim)
        count = len(instancer.GetPositionsAttr().Get())
        targets = instancer.GetPrototypesRel().GetTargets()
        found += [f"there is no prototype {path}" for path in targets if not stage.GetPrimAtPath(path)]
        attributes = [instancer.GetProtoIndicesAttr(), instancer.GetScalesAttr(), instancer.GetIdsAttr()]
    for attribute in attributes:
        if len(attribute.Get()) != count:
            found.append(f"{attribute.GetName()} has {len(attribute.Get())} values for {count} points")
    return found


def check_points():
    samples = columns("points.csv")
    stage = Usd.Stage.Open(str(folder / "points.usda"))
    assert not errors(stage), errors(stage)
    points = UsdGeom.Points(stage.GetDefaultPrim())
    assert (np.array(points.GetPointsAttr().Get()) == positions(samples)).all()
    normals = np.stack([samples["nx"], samples["ny"], samples["nz"]], axis=1)
    assert (np.array(points.GetNormalsAttr().Get()) == normals).all()
    assert list(points.GetWidthsAttr().Get()) == [np.float32(0.08)]
    assert points.GetWidthsInterpolation() == UsdGeom.Tokens.constant
    rank = UsdGeom.PrimvarsAPI(points).GetPrimvar("rank").Get()
    assert (np.array(rank) == samples["rank"]).all() and np.isinf(rank[0])
    return len(samples["x"])


def check_instances():
    samples = columns("instances.csv")
    stage = Usd.Stage.Open(str(folder / "instances.usda"))
    assert not errors(stage), errors(stage)
    instancer = UsdGeom.PointInstancer(stage.GetDefaultPrim())
    assert (np.array(instancer.GetPositionsAttr().Get()) == positions(samples)).all()
    assert (np.array(instancer.GetProtoIndicesAttr().Get()) == samples["class"]).all()
    # One that all are drawn by.
    assert len(instancer.ComputeInstanceTransformsAtTime(0, 0)) == len(samples["x"])
    targets = instancer.GetPrototypesRel().GetTargets()
    assert [stage.GetPrimAtPath(path).GetTypeName() for path in targets] == ["Sphere", "Sphere"]
    return len(samples["x"])


def check_that_damage_is_found():
    """A file that is cut, one that lacks a rank, one that lacks a prototype, and one without the unit of its lengths."""
    points, instances = (folder / "points.usda").read_text(), (folder / "instances.usda").read_text()
    damaged = folder / "damaged.usda"

    damaged.write_text(points[: len(points) // 2])
    try:
        Usd.Stage.Open(str(damaged))
    except Tf.ErrorException:
        pass
    else:
        raise AssertionError("half a file is read")

    for text, old, new in [
        (points, "primvars:rank = [inf, ", "primvars:rank = ["),
        (instances, "</samples/prototypes/class1>", "</samples/prototypes/nothing>"),
        (points, "    metersPerUnit = 1\n", ""),
    ]:
        assert old in text
        damaged.write_text(text.replace(old, new))
        stage = Usd.Stage.Open(str(damaged))
        stage.Reload()
        assert errors(stage), f"{old} is not missed"


print(f"usd-core {'.'.join(map(str, Usd.GetVersion()))}: {check_points()} points, {check_instances()} instances")
check_that_damage_is_found()
