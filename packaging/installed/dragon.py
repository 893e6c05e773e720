"""Samples the mesh of a file and writes the positions as floats: dragon.py MESH RADIUS SEED OUT"""

import sys

import azulejo

mesh, radius, seed, out = sys.argv[1:]
azulejo.psp_sample(azulejo.Mesh.load(mesh), float(radius), seed=int(seed)).positions.tofile(out)
