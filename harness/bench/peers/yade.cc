// Yade: cohesive bonds with rotations, whose shear force grows step by step. Spheres that stay in a plane, with the discs'
// moment of inertia, stand for discs.
#include <fmt/format.h>

#include <sstream>

#include "harness/bench/lattice.h"
#include "harness/bench/peers/peer.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/subprocess.h"

namespace ddem::harness::bench {
namespace {

std::string script_text(const PeerScene& scene) {
  // k_n = young * radius, k_t = poisson * k_n. There is no collider: nothing but bonds acts. Motion comes first in a step:
  // a bond's shear grows by the velocities that led to the positions at hand. O.run() waits for its end in naps of 40 ms,
  // which O.step() does not.
  return fmt::format(R"(import time
material = CohFrictMat(young=2.0, poisson={:.17g}, density=1, frictionAngle=1.5, isCohesive=True,
                       normalCohesion=1e9, shearCohesion=1e9, momentRotationLaw=False)
O.materials.append(material)

def disc(line):
    x, y, vx, vy = map(float, line.split())
    body = Body()
    body.shape = Sphere(radius=0.5)
    body.material = material
    state = body.state
    state.pos = state.refPos = (x, y, 0)
    state.vel = (vx, vy, 0)
    state.mass = 1
    state.inertia = (0.125, 0.125, 0.125)
    state.blockedDOFs = 'zXY'
    return body

with open('discs.txt') as discs:
    O.bodies.append([disc(line) for line in discs])
O.engines = [NewtonIntegrator(damping=0),
             ForceResetter(),
             InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1.1)],
                             [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)],
                             [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()])]
O.dt = {:.17g}
with open('bonds.txt') as bonds:
    for line in bonds:
        utils.createInteraction(*map(int, line.split()))

start = time.perf_counter()
for step in range({}):
    O.step()
print('Loop time', time.perf_counter() - start, 's')
with open('end.txt', 'w') as end:
    for body in O.bodies:
        ux, uy, uz = body.state.displ()
        end.write(f'{{ux!r}} {{uy!r}}\n')
)",
                     kShearRatio, scene.time_step / scene.unit_of_time(), scene.steps);
}

void write_scene(const PeerScene& scene) {
  const ddem::Assembly& a = scene.assembly;
  const double diameter = scene.diameter(), speed = diameter / scene.unit_of_time();
  std::string discs, bonds;
  for (std::size_t d = 0; d < a.size(); ++d) {
    discs += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", a.packing.x[d] / diameter, a.packing.y[d] / diameter,
                         scene.start.vx[d] / speed, scene.start.vy[d] / speed);
  }
  for (std::size_t b = 0; b < a.bonds.size(); ++b) bonds += fmt::format("{} {}\n", a.bonds.i[b], a.bonds.j[b]);
  write_file(scene.folder / "discs.txt", discs);
  write_file(scene.folder / "bonds.txt", bonds);
  write_file(scene.folder / "strip.py", script_text(scene));
}

PeerRun run(const std::string& program, const PeerScene& scene) {
  write_scene(scene);
  const std::string printed = run_in_folder(scene, program, {"-n", "-x", "-j1", "strip.py"});  // no window, end after it, one thread
  PeerRun result;
  result.seconds = seconds_said(program, printed, "Loop time ", " s");
  std::istringstream lines(read_file(scene.folder / "end.txt"));
  for (double ux, uy; lines >> ux >> uy;) {
    result.ux.push_back(ux * scene.diameter());
    result.uy.push_back(uy * scene.diameter());
  }
  if (result.ux.size() != scene.assembly.size()) throw MachineError(program + ": its last displacements cannot be read");
  return result;
}

std::string version(const std::string& program) {
  return std::string(between(run_program(program, {"--version"}).standard_output, "version: ", " ").value_or("version unknown"));
}

}  // namespace

Peer yade() { return {"Yade", "cohesive bonds, k_t and rotations", true, "yade", "yade", version, run}; }

}  // namespace ddem::harness::bench
