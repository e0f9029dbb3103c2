# read_xdmf.py PROGRAM: meshio, which is not ours, reads a run's discs over time; the last frame has the displacement that the
# probes' signals end with. Ends with 77 where meshio is missing.
import csv
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
packing = "hexagonal"
columns = 30
rows = 8
radius = "0.1 mm"
[material]
density = 2000.0
[contact]
normal_stiffness = 1e10
stiffness_ratio = 0.25
[deformation]
scheme = "implicit"
correction = "full"
young_modulus = 4e10
poisson_ratio = 0.3
[boundary]
top_bottom = "periodic"
[initial]
wave = "longitudinal"
amplitude = "1 um"
[time]
steps = 200
[probes]
discs = [12, 40, 133]
"""

with tempfile.TemporaryDirectory() as folder:
    scene, hdf5, signals_file = (pathlib.Path(folder, name) for name in ("scene.toml", "a & b.h5", "signals.csv"))
    scene.write_text(SCENE)
    subprocess.run([sys.argv[1], "run", scene, "-o", hdf5, "--snapshots", "4", "--signals", signals_file], check=True, capture_output=True)
    # Both files may be moved together.
    moved = pathlib.Path(folder, "moved")
    moved.mkdir()
    for file in (hdf5, hdf5.with_suffix(".xdmf")):
        file.rename(moved / file.name)
    with meshio.xdmf.TimeSeriesReader(moved / "a & b.xdmf") as reader:
        points, cells = reader.read_points_cells()
        frames = [reader.read_data(k) for k in range(reader.num_steps)]
    with open(signals_file, newline="") as file:
        signals = list(csv.DictReader(file))

discs = len(points)
assert discs == 240 and points.shape == (240, 3), points.shape
assert cells[0].type == "vertex" and (cells[0].data.ravel() == np.arange(discs)).all()
assert len(frames) == 4
times = [t for t, _, _ in frames]
assert all(a < b for a, b in zip(times, times[1:])), times
for t, fields, _ in frames:
    assert set(fields) >= {"radius", "displacement", "velocity", "rotation", "stress_xx", "stress_xy", "strain_yy"}, set(fields)
    for name, values in fields.items():
        assert values.shape == ((discs, 3) if name in ("displacement", "velocity") else (discs,)), (name, values.shape)
        assert np.isfinite(values).all(), name
    assert (fields["radius"] == 1e-4).all()
    assert (fields["displacement"][:, 2] == 0).all() and (fields["velocity"][:, 2] == 0).all()

last = min(signals, key=lambda row: abs(float(row["time"]) - times[-1]))
assert abs(float(last["time"]) - times[-1]) <= 1e-12 * times[-1] and signals.index(last) >= len(signals) - 2, (last["time"], times[-1])
checked = 0
for name, value in last.items():
    if not name.endswith(("_ux", "_uy")):
        continue
    disc = int(name[4:-3])
    ours = frames[-1][1]["displacement"][disc, 0 if name.endswith("_ux") else 1]
    assert abs(ours - float(value)) <= 1e-9 * abs(float(value)) + 1e-30, (name, ours, value)
    checked += 1
assert checked == 6, checked
# The wave has come somewhere: fields are not all zeros.
for name in ("displacement", "stress_xx", "strain_yy"):
    assert abs(frames[-1][1][name]).max() > 0, name
print(f"{len(frames)} frames of {discs} discs, {checked} displacements agree with the signals")
