"""What a call costs beside the work: microseconds for calls that have next to none.

    python bench.py
"""

import time

import numpy as np

import azulejo

POINT = np.full((1, 2), 0.5, np.float32)
PLANE = azulejo.KdrtPlane(0.3)
CALLS = {
    "a window of one sample": lambda threads: PLANE.window((0.0, 0.0), (0.01, 0.01)),
    "the distance of one point": lambda threads: azulejo.plane_smallest_distance(POINT, threads=threads),
    "the same, from a list": lambda threads: azulejo.plane_smallest_distance([[0.5, 0.5]], threads=threads),
    "a set of one sample": lambda threads: azulejo.kdrt_sample(2.0, threads=threads),
}


def microseconds(call, threads, count=2000, rounds=7):
    best = float("inf")
    for _ in range(rounds):
        start = time.perf_counter()
        for _ in range(count):
            call(threads)
        best = min(best, (time.perf_counter() - start) / count)
    return 1e6 * best


if __name__ == "__main__":
    print(f"{'microseconds':28}{'1 thread':>10}{'all':>10}")
    for name, call in CALLS.items():
        print(f"{name:28}" + "".join(f"{microseconds(call, threads):10.2f}" for threads in (1, 0)))
