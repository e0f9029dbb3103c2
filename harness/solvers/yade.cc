// Yade: cohesive bonds with rotations, whose shear force grows step by step. Spheres that stay in a plane, with the discs'
// mass and moment of inertia, stand for discs; in units of the mean diameter, the mean mass and the stiffest bond.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "dem/assembly/bond_stiffness.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/solvers/ready.h"
#include "harness/solvers/reduced.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kTouching = 1e-9;  // of a bond's length

// Motion comes first in a step: a bond's shear grows by the velocities that led to the positions at hand, and after the last step
// the displacements are those of the last motion. There is no collider: nothing but bonds acts. O.run() waits for its end in naps of
// 40 ms, which O.step() does not.
constexpr const char* kScript = R"(import json, math, time
scene = json.load(open('strip.json'))
material = CohFrictMat(young=1.0, poisson=1.0, density=1, frictionAngle=1.5, isCohesive=True, normalCohesion=1e9, shearCohesion=1e9,
                       momentRotationLaw=False)
O.materials.append(material)

def disc(d):
    body = Body()
    body.shape = Sphere(radius=d[2])
    body.material = material
    state = body.state
    state.pos = state.refPos = (d[0], d[1], 0)
    state.vel = (d[6], d[7], 0)
    state.angVel = (0, 0, d[8])
    state.mass = d[3]
    state.inertia = (d[4], d[4], d[4])
    state.blockedDOFs = 'zXY' + d[5]
    return body

O.bodies.append([disc(d) for d in scene['discs']])
O.engines = [NewtonIntegrator(damping=0),
             ForceResetter(),
             InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1.1)],
                             [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)],
                             [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()])]
dt = O.dt = scene['step']
for i, j, kn, kt in scene['bonds']:
    bond = utils.createInteraction(i, j)
    bond.phys.kn, bond.phys.ks = kn, kt

drive = scene['drive']
def moved(t):
    return drive['amplitude'] * math.sin(math.pi * t / drive['duration'])**2 if 0 <= t < drive['duration'] else 0.0

motion = open('motion.txt', 'w')
recorded = [O.bodies[d] for d in scene['recorded']]
def record():
    for body in recorded:
        u = body.state.displ()
        motion.write(f'{u[0]!r} {u[1]!r} {body.state.ori.toAngleAxis()[0] * (body.state.ori.toAngleAxis()[1][2]) if scene["turns"] else 0.0!r}\n')

record()
seconds = 0.0
for step in range(1, scene['steps'] + 1):
    if drive:
        speed = (moved(step * dt) - moved((step - 1) * dt)) / dt
        for d in drive['discs']:
            v = O.bodies[d].state.vel
            v[drive['axis']] = speed
            O.bodies[d].state.vel = v
    start = time.perf_counter()
    O.step()
    seconds += time.perf_counter() - start
    if step % scene['sample_every'] == 0:
        record()
motion.close()
print('Loop time', seconds, 's')
)";

template <class T>
T component(const std::vector<T>& values, std::size_t d) {
  return values.empty() ? T{} : values[d];
}

std::string blocked(const SimulationInput& in, std::size_t d, bool driven) {
  std::string dofs;
  if (component(in.held.x, d) != 0 || (driven && in.drive->direction == Direction::x)) dofs += 'x';
  if (component(in.held.y, d) != 0 || (driven && in.drive->direction == Direction::y)) dofs += 'y';
  if (component(in.held.theta, d) != 0 || !in.contact.has_rotation()) dofs += 'Z';
  return dofs;
}

std::string scene_text(const Exchange& e) {
  const ddem::Assembly& a = e.assembly;
  const SimulationInput& in = e.input;
  const std::vector<double> k_n = normal_stiffnesses(a, in.contact);
  const ReducedUnits u = reduced_units(e, k_n);
  std::set<int> driven;
  if (in.drive) driven.insert(in.drive->discs.begin(), in.drive->discs.end());
  fmt::memory_buffer text;
  const auto write = [&text]<class... Args>(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
  };
  write("{{\"step\": {}, \"steps\": {}, \"sample_every\": {}, \"turns\": {}, \"discs\": [", in.time_step / u.time(), in.steps, in.sample_every,
        in.contact.has_rotation());
  for (std::size_t d = 0; d < a.size(); ++d) {
    write("{}[{}, {}, {}, {}, {}, \"{}\", {}, {}, {}]", d == 0 ? "" : ", ", a.packing.x[d] / u.length, a.packing.y[d] / u.length, a.packing.radius[d] / u.length,
          a.mass[d] / u.mass, a.inertia[d] / (u.mass * u.length * u.length), blocked(in, d, driven.contains(static_cast<int>(d))),
          component(in.initial.vx, d) / u.speed(), component(in.initial.vy, d) / u.speed(), component(in.initial.omega, d) * u.time());
  }
  write("], \"bonds\": [");
  for (std::size_t b = 0; b < a.bonds.size(); ++b) {
    const double k = k_n[b] / u.stiffness;
    write("{}[{}, {}, {}, {}]", b == 0 ? "" : ", ", a.bonds.i[b], a.bonds.j[b], k, in.contact.stiffness_ratio * k);
  }
  write("], \"recorded\": [{}], \"drive\": ", fmt::join(recorded_discs(in), ", "));
  if (in.drive) {
    write("{{\"discs\": [{}], \"axis\": {}, \"amplitude\": {}, \"duration\": {}}}", fmt::join(driven, ", "), in.drive->direction == Direction::x ? 0 : 1,
          in.drive->amplitude / u.length, in.drive->duration / u.time());
  } else {
    write("null");
  }
  write("}}\n");
  return {text.data(), text.size()};
}

void write_yade_input(const fs::path& folder, const Exchange& e) {
  write_file(folder / "strip.json", scene_text(e));
  write_file(folder / "strip.py", kScript);
}

/// Rows of displacements and rotations, disc by disc, sample by sample.
SimulationResult read_yade_motion(const fs::path& folder, const Exchange& e, const std::string& printed) {
  SimulationResult result;
  result.wall_seconds = number_between(printed, "Loop time ", " s");
  const double unit = reduced_units(e, normal_stiffnesses(e.assembly, e.input.contact)).length;
  const std::vector<int> recorded = recorded_discs(e.input);
  SampleMaker samples(e.input);
  std::ifstream file(folder / "motion.txt");
  std::vector<double> ux(e.assembly.size()), uy = ux, theta = ux;
  std::string x, y, turn;
  for (long n = 0; n < sample_count(e.input); ++n) {
    for (const int d : recorded) {
      if (!(file >> x >> y >> turn)) throw InputError(fmt::format("it left {} samples, not {}", n, sample_count(e.input)));
      const auto k = static_cast<std::size_t>(d);
      ux[k] = std::strtod(x.c_str(), nullptr) * unit, uy[k] = std::strtod(y.c_str(), nullptr) * unit, theta[k] = std::strtod(turn.c_str(), nullptr);
    }
    samples.add(ux, uy, theta);
  }
  result.signals = samples.take();
  return result;
}

/// Its bonds begin unstrained where discs touch, with the arms of touching discs, and its shear begins at nothing.
std::string beyond_yade(const ddem::Assembly& a, const SimulationInput& in) {
  const auto is_gapped = [&](std::size_t b) {
    return std::abs(a.packing.radius[a.bonds.i[b]] + a.packing.radius[a.bonds.j[b]] - a.bonds.length[b]) > kTouching * a.bonds.length[b];
  };
  for (std::size_t b = 0; b < a.bonds.size(); ++b) {
    if (is_gapped(b)) return "bonds of discs that do not touch";
  }
  for (const auto* displacement : {&in.initial.ux, &in.initial.uy, &in.initial.theta}) {
    if (std::ranges::any_of(*displacement, [](double v) { return v != 0.0; })) return "a start from displacements";
  }
  return "";
}

}  // namespace

std::shared_ptr<const Solver> yade_solver(const ReadyOptions& o) {
  SolverDescription d;
  d.name = "yade";
  const std::string program = o.program.empty() ? "yade" : o.program;
  d.command = {program, "-n", "-x", "-j1", "strip.py"};  // no window, end after it, one thread
  d.version_command = {program, "--version"};
  d.may_write = {"/tmp"};  // whatever TMPDIR says
  d.abilities.laws = {"dem"};
  d.abilities.periodic = false;
  return external_solver(std::move(d), {write_yade_input, read_yade_motion, [](const std::string& said) { return std::string(between(said, "version: ", " ")); }, beyond_yade});
}

}  // namespace ddem::harness
