#!/usr/bin/env python3
"""Bonded discs, rigid (DEM) or with lagged uniform strains (DDEM), from a folder of `ddem export`: python3 ddem_numpy.py FOLDER

The equations are those of harness/guide/solvers.md. A template for your own solver, and the proof that the folder is enough."""
import json
import os
import sys
import time

import numpy as np


def read(folder, name):  # a table as a dictionary of columns
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        names = file.readline().strip().split(",")
        rows = [line.strip().split(",") for line in file]
    columns = [list(column) for column in zip(*rows)] or [[] for _ in names]
    return {n: np.array(c, dtype=str) if n == "receiver" else np.array(c, dtype=float) for n, c in zip(names, columns)}


class Bonds:
    """Overlaps, forces and stresses of all bonds at once."""

    def __init__(self, folder, scene, discs):
        b = read(folder, "bonds.csv")
        self.i, self.j = b["i"].astype(int), b["j"].astype(int)
        self.n, self.t = np.stack([b["nx"], b["ny"]]), np.stack([-b["ny"], b["nx"]])
        self.arm_i, self.arm_j, self.kn, self.kt = (b[c] for c in ("arm_i", "arm_j", "normal_stiffness", "shear_stiffness"))
        self.count, self.law = len(discs["x"]), scene["deformation"]
        if self.law:
            self.volume = self.law["volume_over_disc"] * scene["thickness"] * np.pi * discs["radius"] ** 2
            young, nu = self.law["young_modulus"], self.law["poisson_ratio"]
            if self.law["plane"] == "strain":
                young, nu = young / (1.0 - nu**2), nu / (1.0 - nu)
            self.compliance = 1.0 / young, -nu / young, (1.0 + nu) / young

    def sum(self, to_i, to_j):  # what each bond adds to its ends, for each disc
        return np.bincount(self.i, to_i, self.count) + np.bincount(self.j, to_j, self.count)

    def strained(self, strain, axis):
        """(a_i eps_i + a_j eps_j).n along an axis: by how much the boundaries approach each other."""
        xx, yy, xy = self.arm_i * strain[:, self.i] + self.arm_j * strain[:, self.j]
        return axis[0] * (xx * self.n[0] + xy * self.n[1]) + axis[1] * (xy * self.n[0] + yy * self.n[1])

    def forces(self, u, theta, strain):  # F_n and F_t
        du = u[:, self.j] - u[:, self.i]
        u_n = (self.n * du).sum(0)
        u_t = (self.t * du).sum(0) - self.arm_i * theta[self.i] - self.arm_j * theta[self.j]
        if self.law:
            u_n -= self.strained(strain, self.n)
            u_t -= self.strained(strain, self.t) if self.law["correction"] == "full" else 0.0
        return self.kn * u_n, self.kt * u_t

    def loads(self, f_n, f_t):  # force and moment on each disc
        f = f_n * self.n + f_t * self.t
        return np.stack([self.sum(f[0], -f[0]), self.sum(f[1], -f[1])]), self.sum(self.arm_i * f_t, self.arm_j * f_t)

    def strains(self, f_n, f_t):
        """eps = D : sigma, sigma = (1/V) sum of s (x) F, symmetrised; s F is the same from either end, but for the arm."""
        f = f_n * self.n + (0.0 if self.law["correction"] == "normal_only_stress" else f_t) * self.t
        xx, yy, xy = self.n[0] * f[0], self.n[1] * f[1], 0.5 * (self.n[0] * f[1] + self.n[1] * f[0])
        s = [self.sum(self.arm_i * c, self.arm_j * c) / self.volume for c in (xx, yy, xy)]
        direct, coupling, shear = self.compliance
        return np.stack([direct * s[0] + coupling * s[1], coupling * s[0] + direct * s[1], shear * s[2]])


def simulate(folder):
    with open(os.path.join(folder, "scene.json"), encoding="utf-8") as file:
        scene = json.load(file)
    law, contact, drive = scene["deformation"], scene["contact"], scene["drive"]
    if scene["protocol"] != 1 or contact["kinematics"] != "linear" or contact["new_contacts"] or (law and law["scheme"] != "lagged"):
        sys.exit("this example does linear kinematics without new contacts, rigid or lagged, of protocol 1")
    discs, receivers = read(folder, "discs.csv"), read(folder, "receivers.csv")
    bonds = Bonds(folder, scene, discs)
    driven = read(folder, "drive.csv")["disc"].astype(int) if drive else None
    u, theta = np.stack([discs["ux"], discs["uy"]]), discs["theta"].copy()
    v, omega = np.stack([discs["vx"], discs["vy"]]), discs["omega"].copy()
    strain = np.zeros((3, bonds.count))
    dt, steps, sample_every = (scene["time"][key] for key in ("step", "steps", "sample_every"))
    kick = dt / discs["mass"] * np.stack([discs["held_x"] == 0, discs["held_y"] == 0])
    turn = dt / discs["inertia"] * (discs["held_theta"] == 0) * (contact["stiffness_ratio"] > 0)

    def evaluate(strain):  # forces, after the further evaluations that the law asks for; the strains that they leave
        for _ in range(law["evaluations"] if law else 1):
            f_n, f_t = bonds.forces(u, theta, strain)
            used = strain
            if law:
                strain = (1.0 - law["relaxation"]) * used + law["relaxation"] * bonds.strains(f_n, f_t)
        return bonds.loads(f_n, f_t), strain

    names = list(dict.fromkeys(receivers["receiver"]))
    of = [receivers["disc"][receivers["receiver"] == name].astype(int) for name in names]
    sample = lambda: [np.mean(c[d]) for d in of for c in (*u, theta)]
    samples = [sample()]
    (force, moment), _ = evaluate(strain)  # v at -dt/2; the strains begin at rest
    v, omega = v - 0.5 * kick * force, omega - 0.5 * turn * moment
    start = time.perf_counter()
    for step in range(1, steps + 1):
        (force, moment), strain = evaluate(strain)
        v, omega = v + kick * force, omega + turn * moment
        u, theta = u + dt * v, theta + dt * omega
        if drive:
            phase = step * dt / drive["duration"]
            u["xy".index(drive["component"]), driven] = drive["amplitude"] * np.sin(np.pi * phase) ** 2 if phase < 1.0 else 0.0
        if step % sample_every == 0:
            samples.append(sample())
    seconds = time.perf_counter() - start
    with open(os.path.join(folder, "signals.csv"), "w", encoding="utf-8") as file:
        file.write(",".join(["time"] + [f"{name}_{c}" for name in names for c in ("ux", "uy", "theta")]) + "\n")
        for n, row in enumerate(samples):
            file.write(",".join(repr(float(x)) for x in [n * sample_every * dt, *row]) + "\n")
    with open(os.path.join(folder, "solver.json"), "w", encoding="utf-8") as file:
        json.dump({"name": "ddem_numpy", "status": "ok", "wall_seconds": seconds}, file)


if __name__ == "__main__":
    if sys.argv[1:] == ["--version"]:
        print("ddem_numpy 1, numpy", np.__version__)
    else:
        simulate(sys.argv[1])
