"""The bytes are those of the Rust calls: tests/sums.txt of the repository."""

import hashlib
import re
from pathlib import Path

import numpy as np
import pytest

import azulejo

SUMS = Path(__file__).parents[3] / "tests" / "sums.txt"
FAR = dict(domain_min=(1000.0, -3.0), domain_max=(1004.0, -1.0))


def ordered_window(threads):
    window = ((1000.0, -2.5), (1000.4, -1.5))
    points = azulejo.kdrt_sample_window(*window, 0.02, order="progressive", coarsest=0.1, threads=threads, **FAR)
    return np.concatenate([points.positions.ravel(), points.ranks])


def equal_classes(threads):
    radii = azulejo.classes_radii([0.01] * 4, 0.7)
    points = azulejo.kdrt_sample_classes(radii, seed=26, boundary="bounded", threads=threads)
    return np.concatenate([points.positions.ravel(), points.classes.astype("<u4").view("<f4")])


CALLS = {
    "maximal periodic": lambda threads: azulejo.maximal_sample(0.01, seed=1, threads=threads).positions,
    "kdrt 20r": lambda threads: azulejo.kdrt_sample(0.002, seed=3, threads=threads).positions,
    "kdrt far": lambda threads: azulejo.kdrt_sample(0.01, seed=7, threads=threads, **FAR).positions,
    "ordered window": ordered_window,
    "classes equal": equal_classes,
}


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("name", CALLS)
def test_the_sum_of_a_call(name, threads):
    line = re.search(rf"^(\w+)  {name} \(", SUMS.read_text(), re.MULTILINE)
    assert hashlib.sha256(CALLS[name](threads).astype("<f4").tobytes()).hexdigest() == line[1]
