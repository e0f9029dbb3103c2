# guide_solvers.py PROGRAM ROOT: runs the commands of harness/guide/solvers.md as they stand there, and holds what ddem export writes
# against its schema. Ends with 77 where numpy or jsonschema is missing.
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import jsonschema
    import numpy  # noqa: F401, the example needs it
except ImportError as error:
    print(f"skipped: {error}; Debian has python3-jsonschema and python3-numpy")
    sys.exit(77)

program, root = sys.argv[1], pathlib.Path(sys.argv[2])
page = (root / "harness/guide/solvers.md").read_text()
commands = [line for block in re.findall(r"```sh\n(.*?)```", page, re.S) for line in block.splitlines()]
assert len(commands) == 10, commands

SCENE = """[assembly]
packing = "hexagonal"
columns = 30
rows = 8
radius = "0.1 mm"
[material]
density = 2000.0
[contact]
normal_stiffness = 1e10
stiffness_ratio = 0.25
{law}[boundary]
top_bottom = "periodic"
[drive]
wave = "shear"
duration = "1 us"
amplitude = "1 nm"
[probes]
pairs = 3
"""
CAMPAIGN = """[[case]]
id = "small"
scene = "scene.toml"
[[case.criterion]]
metric = "wave_speed"
target = "static.shear_velocity"
lower = -0.05
upper = 0.05
unit = "m/s"
derivation = "dispersion of a pulse of eight discs"
"""

schema = json.loads((root / "harness/solvers/scene.schema.json").read_text())
validator = jsonschema.validators.validator_for(schema)(schema)
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for file in ("ddem_numpy.py", "ddem_numpy.toml"):
        shutil.copy(root / "harness/solvers/examples" / file, folder)
    (folder / "scene.toml").write_text(SCENE.format(law=""))
    (folder / "campaign.toml").write_text(CAMPAIGN)
    (folder / "bin").mkdir()
    (folder / "bin/ddem").symlink_to(program)
    environment = dict(os.environ, PATH=f"{folder / 'bin'}:{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}")
    for command in commands:
        run = subprocess.run(command.split(), cwd=folder, env=environment, capture_output=True, text=True)
        assert run.returncode == 0, (command, run.stdout, run.stderr)
        print(command, "->", (run.stdout.splitlines() or [""])[-1])
    for law in ("", '[deformation]\nscheme = "implicit"\nyoung_modulus = 4e10\npoisson_ratio = 0.3\nparticle_volume = "cell"\n'):
        (folder / "scene.toml").write_text(SCENE.format(law=law))
        subprocess.run([program, "export", "scene.toml", "-o", "checked"], cwd=folder, check=True, capture_output=True)
        scene = json.loads((folder / "checked/scene.json").read_text())
        validator.validate(scene)
        for fault in ({"protocol": 2}, {"drive": {}}, {"time": {"step": 0}}, {"colour": 1}):
            try:
                validator.validate({**scene, **fault})
            except jsonschema.ValidationError:
                continue
            raise AssertionError(f"the schema takes {fault}")
