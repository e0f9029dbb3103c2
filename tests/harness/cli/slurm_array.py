# slurm_array.py PROGRAM ARRAY_SCRIPT: a campaign that Slurm runs as an array of shards comes out as the same campaign run
# in one piece. By the cluster that is there, or a Slurm of one node that root starts for the test (Debian: slurmctld, slurmd,
# slurm-client, munge); ends with 77 where there is neither.
import contextlib
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

SHARDS = 3
TOOLS = ("sinfo", "sbatch", "scancel")
SECONDS = 300  # the work is done in a few; the rest is for a busy queue

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
[boundary]
top_bottom = "periodic"
[initial]
wave = "longitudinal"
amplitude = "1 um"
[probes]
pairs = 3
"""

CAMPAIGN = """[[case]]
id = "small"
scene = "scene.toml"
[case.matrix]
"contact.stiffness_ratio" = [0.1, 0.3, 0.5]
"material.density" = [1000.0, 2000.0]
[[case.criterion]]
metric = "wave_speed"
target = "static.p_velocity"
lower = -0.5
upper = 0.5
unit = "m/s"
derivation = "anything near"
"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def why_no_slurm():
    """Empty: there is one that works."""
    for tool in TOOLS:
        if shutil.which(tool) is None:
            return f"no {tool}"
    try:
        nodes = subprocess.run(["sinfo", "--noheader", "--format=%t"], capture_output=True, text=True, timeout=10)
    except subprocess.TimeoutExpired:
        return "sinfo does not answer"
    if nodes.returncode != 0:
        return f"sinfo: {nodes.stderr.strip()}"
    if not any(state.startswith(("idle", "mix", "alloc")) for state in nodes.stdout.split()):
        return f"no node works: {nodes.stdout.split()}"
    return ""


def program_path(name):
    return shutil.which(name) or shutil.which(name, path="/usr/sbin")


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class OneNode:
    """This machine as a Slurm of its own, below a folder; for root alone, as slurmd is."""

    DAEMONS = ("munged", "slurmctld", "slurmd")

    def __init__(self, folder):
        self.folder, self.processes = folder, []

    def configure(self):
        host = socket.gethostname().split(".")[0]
        control, node = free_ports(2)
        for name in ("state", "spool", "munge"):
            (self.folder / name).mkdir()
        (self.folder / "key").write_bytes(os.urandom(1024))
        (self.folder / "key").chmod(0o400)
        (self.folder / "slurm.conf").write_text(
            f"""ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthInfo=socket={self.folder}/munge.socket
SlurmctldPort={control}
SlurmdPort={node}
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MailProg=/bin/true
NodeName={host} NodeAddr=127.0.0.1 CPUs={os.cpu_count()}
PartitionName=all Nodes={host} Default=YES
"""
        )
        os.environ["SLURM_CONF"] = str(self.folder / "slurm.conf")

    def start(self, name, *arguments):
        log = open(self.folder / f"{name}.log", "w")
        self.processes.append(subprocess.Popen([program_path(name), *arguments], stdout=log, stderr=log))

    def __enter__(self):
        self.configure()
        munge = self.folder / "munge"
        self.start("munged", "--foreground", "--force", f"--key-file={self.folder}/key", f"--socket={self.folder}/munge.socket",
                   f"--pid-file={munge}/pid", f"--log-file={munge}/log", f"--seed-file={munge}/seed")  # fmt: skip
        while not (self.folder / "munge.socket").exists() and self.processes[0].poll() is None:
            time.sleep(0.05)
        for name in ("slurmctld", "slurmd"):
            self.start(name, "-D")
        for _ in range(150):
            reason = why_no_slurm()
            if not reason:
                return self
            time.sleep(0.2)
        logs = "".join((self.folder / f"{name}.log").read_text() for name in self.DAEMONS)
        self.__exit__()
        skip(f"a Slurm of its own does not start here: {reason}\n{logs}")

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            process.wait(timeout=60)


def some_slurm(folder):
    """The cluster that is there, or one of this machine's own."""
    reason = why_no_slurm()
    if not reason:
        return contextlib.nullcontext()
    missing = [name for name in (*TOOLS, *OneNode.DAEMONS) if program_path(name) is None]
    if missing or os.geteuid() != 0:
        skip(f"{reason}; and none can be started: " + (f"no {', '.join(missing)}" if missing else "not root"))
    return OneNode(folder)


def outcome(folder):
    summary = json.loads((folder / "summary.json").read_text())
    del summary["wall_seconds"]
    for of_a_machine in ("time", "processor"):
        del summary["provenance"][of_a_machine]
    return summary


def logs(folder):
    return "".join(f"{log.name}:\n{log.read_text()}" for log in sorted(folder.glob("slurm-*.out")))


def run_array(program, script, folder):
    """Until its last shard has ended; a shard that fails makes this fail."""
    command = ["sbatch", "--wait", "--parsable", f"--array=1-{SHARDS}", "--cpus-per-task=1", f"--chdir={folder}"]
    command += [f"--export=ALL,DDEM={program},NIGHT={folder / 'night'}", script, str(folder / "campaign.toml")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as waiting:
        job = waiting.stdout.readline().strip().split(";")[0]
        try:
            status = waiting.wait(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            subprocess.run(["scancel", job], check=False)
            waiting.kill()
            sys.exit(f"job {job} did not end within {SECONDS} s\n{logs(folder)}")
    assert status == 0, f"job {job} ended with {status}\n{logs(folder)}"


program, script = sys.argv[1:]
with tempfile.TemporaryDirectory(dir=".") as name, tempfile.TemporaryDirectory() as of_slurm, some_slurm(pathlib.Path(of_slurm)):
    folder = pathlib.Path(name).resolve()  # which a cluster's nodes see, too
    (folder / "scene.toml").write_text(SCENE)
    (folder / "campaign.toml").write_text(CAMPAIGN)
    whole = [program, "validate", str(folder / "campaign.toml"), "-o", str(folder / "whole")]
    subprocess.run(whole, check=True, capture_output=True)
    run_array(program, script, folder)
    report = folder / "night" / "report"
    assert report.is_dir(), f"the shards were not merged\n{logs(folder)}"
    assert outcome(report) == outcome(folder / "whole"), "merged shards differ from the campaign in one piece"
    cases = outcome(report)["cases"]
    assert len(cases) == 6 and all(c["state"] == "PASS" for c in cases), [c["state"] for c in cases]
print(f"{SHARDS} shards by Slurm make the same campaign")
