#include "harness/solvers/solver.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "dem/assembly/contacts.h"

namespace ddem::harness {

SimulationResult Solver::solve_exact(const ddem::Assembly&, const SimulationInput&, const Sampling&) const {
  throw std::logic_error(name() + " is not exact in time");
}

namespace {

bool holds_some(const HeldDofs& held) {
  const auto some = [](const std::vector<std::uint8_t>& dofs) { return std::ranges::find_if(dofs, [](auto is_held) { return is_held != 0; }) != dofs.end(); };
  return some(held.x) || some(held.y) || some(held.theta);
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

double displacement_put_in(const SimulationInput& in) {
  const double duration = in.time_step * static_cast<double>(in.steps);
  return std::hypot(largest(in.initial.ux), largest(in.initial.uy)) + (in.drive ? std::abs(in.drive->amplitude) : 0.0) +
         duration * std::hypot(largest(in.initial.vx), largest(in.initial.vy));
}

bool may_close_gaps(const ddem::Assembly& a, const SimulationInput& in) {
  if (in.new_contacts == ContactWatch::off) return false;
  try {
    std::vector<std::pair<int, int>> bonded;
    for (std::size_t b = 0; b < a.bonds.size(); ++b) bonded.emplace_back(std::minmax(a.bonds.i[b], a.bonds.j[b]));
    std::ranges::sort(bonded);
    return std::ranges::any_of(close_pairs(a.packing, 4.0 * displacement_put_in(in)), [&](const ClosePair& p) { return !std::ranges::binary_search(bonded, std::pair(p.i, p.j)); });
  } catch (const std::invalid_argument&) {  // further than half a period
    return true;
  }
}

std::string law_of(const DeformationParameters& d) {
  if (!d.active()) return "dem";
  const char* correction = d.correction == Correction::normal ? "normal" : d.correction == Correction::full ? "full" : "normal-only-stress";
  return fmt::format("{}-{}", d.scheme == Scheme::lagged ? "lagged" : "implicit", correction);
}

std::string refusal(const Solver& solver, const ddem::Assembly& a, const SimulationInput& in) {
  const Abilities can = solver.abilities();
  const std::string law = law_of(in.deformation);
  if (std::ranges::find(can.laws, law) == can.laws.end())
    return fmt::format("{} has no law {}; it has {}", solver.name(), law, fmt::join(can.laws, ", "));
  const auto lacks = [&](bool asked, bool able, const char* what) {
    return asked && !able ? fmt::format("{} cannot do {}", solver.name(), what) : std::string();
  };
  for (const std::string& reason : {lacks(in.contact.kinematics == Kinematics::nonlinear, can.nonlinear, "nonlinear kinematics"),
                                    lacks(!can.new_contacts && may_close_gaps(a, in), can.new_contacts, "new contacts, which this load may close (or set contact.new_contacts = \"off\")"),
                                    lacks(a.packing.period.x > 0.0 || a.packing.period.y > 0.0, can.periodic, "periodic edges"),
                                    lacks(holds_some(in.held), can.held_discs, "held discs"), lacks(in.drive.has_value(), can.driven_edge, "a driven edge"),
                                    lacks(in.energy_samples > 0, can.energies, "energies"), lacks(in.snapshots > 0, can.snapshots, "snapshots")}) {
    if (!reason.empty()) return reason;
  }
  return solver.further_refusal(a, in);
}

}  // namespace ddem::harness
