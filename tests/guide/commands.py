# commands.py PROGRAM ROOT: runs every command of the README and of the guide as it stands there, page by page, in a folder that has what the
# pages speak of. `ddem validate` without a campaign gets a small one: its own takes 15 s each time. Of the tutorial's shortest way it
# counts the commands.
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import tempfile

program, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
PAGES = ["README.md", "harness/guide/tutorial.md", "harness/guide/calibrating.md", "harness/guide/nights.md", "harness/guide/lammps.md", "harness/guide/notebooks.md"]
MOST_COMMANDS = 12
# Tested elsewhere (the suite itself, the launcher, installing, Slurm), or of programs that need not be here.
ELSEWHERE = re.compile(r"\s*(\./ddem test|\./ddem validate  +# installs|ctest |sbatch |parallel |cmake |ninja )")
SMALL = '[studies]\nrun = ["statics", "waves"]\n[strip]\nseeds = [1, 2]\nstiffness_ratios = [0.3]\nmodels = ["dem", "implicit-full"]\n'
SMALL_FOR_SOLVERS = '[[case]]\nid = "small"\nscene = "scene.toml"\n[[case.criterion]]\nmetric = "wave_speed"\ntarget = "static.p_velocity"\nlower = -0.03\nupper = 0.03\nderivation = "one packing"\n'
# What the README's examples call their files.
SHOTS = "time,near,far\n" + "".join(
    f"{k * 1e-7:g},{1e-6 * max(0, 1 - abs(k - 60) / 12):g},{1e-6 * max(0, 1 - abs(k - 110) / 12):g}\n" for k in range(200))


def blocks(page, language="sh"):
    return re.findall(rf"^```{language}\n(.*?)^```", (root / page).read_text(), re.S | re.M)


def prepare(folder, page):
    for name in ("harness", "reports", "dem"):
        (folder / name).symlink_to(root / name)
    (folder / "small.toml").write_text(SMALL)
    (folder / "judged.toml").write_text(SMALL_FOR_SOLVERS)
    if not page.endswith("calibrating.md"):  # which makes it
        shutil.copy(root / "harness/scenes/long_wave_p.toml", folder / "scene.toml")
    (folder / "shots.csv").write_text(SHOTS)
    shutil.copy(root / "harness/solvers/examples/ddem_numpy.py", folder)
    shutil.copy(root / "harness/solvers/examples/ddem_numpy.toml", folder / "my-dem.toml")
    shutil.copy(root / "dem/lammps/example/in.pulse", folder)
    launcher = folder / "ddem"
    launcher.write_text(f'''#!/bin/bash
if [[ $1 == validate && " $* " == *" --solver "* ]]; then exec {program} validate {folder}/judged.toml "${{@:2}}"; fi
if [[ $1 == validate && " $* " != *.toml* && " $* " != *" --list "* ]]; then exec {program} validate {folder}/small.toml "${{@:2}}"; fi
exec {program} "$@"
''')
    launcher.chmod(launcher.stat().st_mode | stat.S_IXUSR)


def run(command, folder):
    root_may = dict(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1")
    environment = dict(os.environ, **root_may, PATH=f"{folder}:{program.parent}:{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}")
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)


def run_lines(block, folder):
    lines = [line for line in block.splitlines() if not ELSEWHERE.match(line)]
    return run(["bash", "-euo", "pipefail", "-c", "\n".join(lines)], folder)


def has_python_of_notebooks():
    return subprocess.run([sys.executable, "-c", "import h5py, pandas, matplotlib"], capture_output=True).returncode == 0


def tell(page, block, done):
    print(f"{page}: {block.splitlines()[0]} ...: {done.returncode}")
    if done.returncode != 0:
        print(done.stdout[-2000:], done.stderr[-2000:])
    return int(done.returncode != 0)


shortest = blocks("harness/guide/tutorial.md")[0]
count = len([line for line in re.sub(r"<<'EOF'.*?^EOF$", "", shortest, flags=re.S | re.M).splitlines() if line.strip()])
assert 0 < count <= MOST_COMMANDS, f"the shortest way has {count} commands"

failed = 0
for page in PAGES:
    if page.endswith("lammps.md") and not (program.parent / "ddem-lammps").exists():
        print(f"{page}: skipped, ddem-lammps was not built")
        continue
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prepare(folder, page)
        for block in blocks(page):
            failed += tell(page, block, run_lines(block, folder))
        python = blocks(page, "python")
        if python and has_python_of_notebooks():
            failed += tell(page, python[0], run([sys.executable, "-c", "\n".join(python)], folder))
        for script in blocks(page, "pvpython") if shutil.which("pvpython") else []:
            failed += tell(page, script, run(["pvpython", "-c", script], folder))
sys.exit(1 if failed else 0)
