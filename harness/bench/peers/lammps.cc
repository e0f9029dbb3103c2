// LAMMPS: harmonic bonds, which is the particle method without shear stiffness.
#include <fmt/format.h>

#include <sstream>

#include "harness/bench/peers/peer.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/subprocess.h"

namespace ddem::harness::bench {
namespace {

std::string input_text(const PeerScene& scene) {
  // E = K (r - r0)^2 with K = k_n/2. Lists of neighbours are never renewed: nothing but bonds acts.
  return fmt::format("units lj\ndimension 2\nboundary f f p\natom_style bond\nspecial_bonds lj 1 1 1\n"
                     "pair_style none\nbond_style harmonic\ncomm_modify cutoff 3.0\nneighbor 0.5 bin\n"
                     "neigh_modify delay 0 every 100000000 check no\nread_data strip.data\nbond_coeff 1 0.5 1.0\n"
                     "fix motion all nve\nfix plane all enforce2d\ntimestep {:.17g}\nthermo 100000000\nrun {}\n"
                     "write_dump all custom end.txt id x y modify sort id format float %.17g\n",
                     scene.time_step / scene.unit_of_time(), scene.steps);
}

std::string data_text(const PeerScene& scene) {
  const ddem::Assembly& a = scene.assembly;
  std::string text = fmt::format("discs and bonds\n\n{} atoms\n{} bonds\n1 atom types\n1 bond types\n", a.size(), a.bonds.size());
  const double margin = 2.0, diameter = scene.diameter(), speed = diameter / scene.unit_of_time();
  text += fmt::format("{} {} xlo xhi\n{} {} ylo yhi\n-0.5 0.5 zlo zhi\n\nMasses\n\n1 1.0\n\nAtoms\n\n", -margin,
                      a.packing.length / diameter + margin, -margin, a.packing.width / diameter + margin);
  for (std::size_t d = 0; d < a.size(); ++d) {
    text += fmt::format("{} 1 1 {:.17g} {:.17g} 0\n", d + 1, a.packing.x[d] / diameter, a.packing.y[d] / diameter);
  }
  text += "\nVelocities\n\n";
  for (std::size_t d = 0; d < a.size(); ++d) {
    text += fmt::format("{} {:.17g} {:.17g} 0\n", d + 1, scene.start.vx[d] / speed, scene.start.vy[d] / speed);
  }
  text += "\nBonds\n\n";
  for (std::size_t b = 0; b < a.bonds.size(); ++b) text += fmt::format("{} 1 {} {}\n", b + 1, a.bonds.i[b] + 1, a.bonds.j[b] + 1);
  return text;
}

PeerRun run(const std::string& program, const PeerScene& scene) {
  write_file(scene.folder / "strip.data", data_text(scene));
  write_file(scene.folder / "in.strip", input_text(scene));
  const std::string printed = run_in_folder(scene, program, {"-in", "in.strip", "-log", "none"});
  PeerRun result;
  result.seconds = seconds_said(program, printed, "Loop time of ", " on");
  std::istringstream lines(read_file(scene.folder / "end.txt"));
  std::string line;
  while (std::getline(lines, line) && !line.starts_with("ITEM: ATOMS")) {}
  const Packing& p = scene.assembly.packing;
  const double diameter = scene.diameter();
  std::size_t d = 0;
  for (double id, x, y; d < p.size() && lines >> id >> x >> y; ++d) {
    result.ux.push_back(x * diameter - p.x[d]);
    result.uy.push_back(y * diameter - p.y[d]);
  }
  if (d < p.size()) throw MachineError(program + ": its last positions cannot be read");
  return result;
}

std::string version(const std::string& program) {
  return std::string(between(run_program(program, {"-h"}).standard_output, "Simulator - ", "\n").value_or("version unknown"));
}

}  // namespace

Peer lammps() { return {"LAMMPS", "harmonic bonds, k_t = 0", false, "lmp", "lammps", version, run}; }

}  // namespace ddem::harness::bench
