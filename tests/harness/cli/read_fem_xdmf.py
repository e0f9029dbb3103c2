# read_fem_xdmf.py PROGRAM: meshio, which is not ours, reads the continuum's fields over time: a mesh that covers the strip, and on it
# d'Alembert's shear pulse. Ends with 77 where meshio is missing.
import pathlib
import subprocess
import sys
import tempfile

try:
    import h5py
    import meshio
except ImportError as error:
    print(f"skipped: {error}; Debian has python3-meshio and python3-h5py")
    sys.exit(77)
import numpy as np

SCENE = """
[assembly]
length = "8 mm"
width = "1 mm"
[boundary]
top_bottom = "periodic"
[initial]
wave = "shear"
shape = "gaussian"
amplitude = "1 um"
width = "0.4 mm"
center = "4 mm"
[continuum]
young_modulus = "10 GPa"
poisson_ratio = 0.25
density = "1700 kg/m3"
degree = 4
elements = [24, 2]
[time]
integrator = "verlet"
step_fraction = 0.1
end = "1 us"
[probes]
points = [["4 mm", "0.5 mm"]]
"""

with tempfile.TemporaryDirectory() as folder:
    scene, hdf5 = pathlib.Path(folder, "scene.toml"), pathlib.Path(folder, "fem.h5")
    scene.write_text(SCENE)
    subprocess.run([sys.argv[1], "fem", scene, "-o", hdf5, "--snapshots", "4"], check=True, capture_output=True)
    with meshio.xdmf.TimeSeriesReader(hdf5.with_suffix(".xdmf")) as reader:
        points, cells = reader.read_points_cells()
        frames = [reader.read_data(k) for k in range(reader.num_steps)]

nodes = (24 * 4 + 1) * (2 * 4 + 1)
assert points.shape == (nodes, 3) and (points[:, 2] == 0).all(), points.shape
assert cells[0].type == "quad" and cells[0].data.shape == (24 * 4 * 2 * 4, 4), cells
corner = points[cells[0].data]
forward = np.roll(corner, -1, axis=1)
area = 0.5 * (corner[..., 0] * forward[..., 1] - forward[..., 0] * corner[..., 1]).sum(axis=1)
assert (area > 0).all() and abs(area.sum() / 8e-6 - 1) < 1e-12, area.sum()

assert len(frames) == 4
speed, width, centre = np.sqrt(10e9 / 2.5 / 1700), 0.4e-3, 4e-3
x = points[:, 0]
for k, (t, fields, _) in enumerate(frames):
    # A step of 0.1 of the critical one: below 1 ns.
    assert (k + 1) * 0.25e-6 * (1 - 1e-9) <= t < (k + 1) * 0.25e-6 + 2e-9, t
    tensors = {f"{name}_{part}" for name in ("stress", "strain") for part in ("xx", "yy", "xy")}
    assert set(fields) == {"displacement", "velocity"} | tensors, set(fields)
    s = (x - centre - speed * t) / width, (x - centre + speed * t) / width
    right, left = (0.5e-6 * np.exp(-0.5 * q**2) for q in s)
    exact = {"displacement": right + left, "velocity": speed / width * (s[0] * right - s[1] * left)}
    for name, wanted in exact.items():
        found = fields[name]
        assert found.shape == (nodes, 3)
        # Eight nodes a width at degree 4, and (omega dt)^2/24 omega t of the leapfrog: 2e-4 and less of the pulse; its slope has
        # three times that. The ends, 10 widths away, have not felt it before 1 us (1.5 mm) is over.
        error = np.linalg.norm(found[:, 1] - wanted) / np.linalg.norm(wanted)
        assert error < 2e-3, (name, t, error)
        assert abs(found[:, 0]).max() < 1e-9 * abs(found[:, 1]).max() and (found[:, 2] == 0).all(), name
    # uy' = 2 eps_xy and G uy' = sigma_xy, G = E/2.5, to the accuracy of the slope; nothing else but round-off.
    slope = -(s[0] * right + s[1] * left) / width
    for name, wanted in {"strain_xy": 0.5 * slope, "stress_xy": 10e9 / 2.5 * slope}.items():
        error = np.linalg.norm(fields[name] - wanted) / np.linalg.norm(wanted)
        assert error < 2e-3, (name, t, error)
    for name in ("stress_xx", "stress_yy"):
        assert abs(fields[name]).max() < 1e-9 * abs(fields["stress_xy"]).max(), name
print(f"{len(frames)} frames of {nodes} nodes are d'Alembert's")
