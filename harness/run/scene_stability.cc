#include "harness/run/scene_stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem/spectra/step_map.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/model/held_edges.h"
#include "harness/model/memory_need.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kLargestFlutterSearch = 5000;  // discs; a minute
constexpr std::size_t kMostUnknowns = 2000;          // of a step whose eigenvalues are sought: 20 s
constexpr double kSlowestGrowth = 1e-6;              // a step; of longer runs a mode that grows by e in all of their steps

double scene_step(const Scene& scene, double dem_critical) {
  if (const auto* seconds = std::get_if<StepSeconds>(&scene.time.step)) return seconds->seconds;
  return std::get<StepFraction>(scene.time.step).of_critical * dem_critical;
}

double slowest_growth(const Scene& scene, double step) {
  double steps = 1.0 / kSlowestGrowth;
  if (const auto* end = std::get_if<EndSteps>(&scene.time.end)) steps = std::max(steps, static_cast<double>(end->steps));
  if (const auto* end = std::get_if<EndTime>(&scene.time.end)) steps = std::max(steps, end->seconds / step);
  return 1.0 / steps;
}

/// An assembly may be too small or too floppy for static moduli, and still have a critical step.
void find_static_waves(const Scene& scene, const std::vector<double>& wavelengths, SceneStability& s) {
  try {
    s.waves = static_waves(scene, s.time_step, wavelengths);
  } catch (const InputError& e) {
    s.no_waves = e.what();
  } catch (const SolverError& e) {
    s.no_waves = e.what();
  }
}

/// Four radii is the shortest wave that discs in a row can carry.
std::vector<double> check_wavelengths(const ddem::Assembly& a, std::vector<double> wavelengths) {
  const double shortest = 4.0 * mean_radius(a.packing), length = a.packing.length;
  if (wavelengths.empty()) {
    for (const double share : {1.0, 2.0, 4.0, 8.0}) {
      if (length / share >= shortest) wavelengths.push_back(length / share);
    }
  }
  for (const double w : wavelengths) {
    if (!(w >= shortest) || !std::isfinite(w)) {
      throw InputError(fmt::format("--wavelength {:.6g} m: discs carry no wave shorter than four mean radii, {:.6g} m", w, shortest));
    }
  }
  return wavelengths;
}

void find_limits(SceneStability& s, const ddem::Assembly& a, const ContactParameters& contact, const HeldDofs& held, bool hexagonal) {
  s.critical = critical_step(a, contact, s.deformation, held);
  if (!s.deformation.active()) return;
  s.softness = mean_normal_stiffness(a, contact) / (s.deformation.young_modulus * a.thickness);
  s.fixed_point_radius = fixed_point_radius(a, contact, s.deformation);
  if (s.deformation.scheme == Scheme::lagged) {
    s.radius_limit = 2.0 / s.deformation.relaxation - 1.0;
    s.softness_limit = s.softness * s.radius_limit / *s.fixed_point_radius;
    const auto factor = stable_softness_factor(a, contact, s.deformation, held, s.time_step);
    if (factor) s.softness_limit_at_step = {factor->at_least * s.softness, factor->at_most * s.softness};
  }
  if (!s.has_energy() && !hexagonal) {
    if (a.size() <= kLargestFlutterSearch) {
      s.flutter = find_flutter(a, contact, s.deformation, held);
    } else {
      s.noise_flutter = flutter_from_noise(a, contact, s.deformation, held);
    }
  }
  if (s.critical_step_decides()) return;
  if (step_unknowns(a, contact, s.deformation) <= kMostUnknowns) {
    s.step_growth = step_growth(a, contact, s.deformation, held, s.time_step);
    return;
  }
  SimulationInput in;
  in.contact = contact;
  in.contact.kinematics = Kinematics::linear;
  in.deformation = s.deformation;
  in.held = held;
  in.time_step = s.time_step;
  s.noise = run_noise(a, in);
}

}  // namespace

bool SceneStability::has_energy() const {
  return !deformation.active() || stiffness_ratio == 0.0 || deformation.correction != Correction::normal;
}

bool SceneStability::critical_step_decides() const { return has_energy() && critical.bound != StepBound::feeding; }

std::vector<std::string> SceneStability::instabilities() const {
  std::vector<std::string> reasons;
  const bool feeds = critical.bound == StepBound::feeding;
  if (step_growth && !(*step_growth > kGrowthRoundOff)) return reasons;
  if (critical.bound == StepBound::fixed_point) {
    reasons.push_back("the lagged strains do not converge: no step is stable");
  } else if (feeds && (step_growth || deformation.relaxation == 1.0)) {
    reasons.push_back("an even number of evaluations overshoots the converged strains and adds energy");
  } else if (critical.step && time_step > *critical.step) {
    reasons.push_back("the step is above the critical one");
  }
  if (step_growth) {
    reasons.push_back(fmt::format("a motion grows by {:.3g} a step: the largest |z| - 1 of the step's eigenvalues", *step_growth));
    return reasons;
  }
  const bool flutters = (flutter && flutter->frequency) || (noise_flutter && noise_flutter->found);
  if (flutters && deformation.scheme == Scheme::implicit) {
    reasons.push_back("the normal-only correction flutters at any step: it has no energy");
  }
  if (noise && noise->grew()) {
    reasons.push_back(fmt::format("noise grows in a run of this scheme, by {:.3g} a step", noise->growth));
  }
  // Where there is an energy, the critical step of the finite assembly is the sharper criterion.
  if (!has_energy() && lattice && lattice->worst.growth > kNoGrowth) {
    reasons.push_back(fmt::format("a plane wave of the infinite lattice grows by {:.3g} a step", lattice->worst.growth));
  }
  return reasons;
}

StabilityVerdict SceneStability::verdict() const {
  if (!instabilities().empty()) return StabilityVerdict::unstable;
  return critical_step_decides() || step_growth || whole_lattice ? StabilityVerdict::stable : StabilityVerdict::undecided;
}

double SceneStability::steps_needed() const { return std::ceil(steps_to_see(slowest_growth, static_cast<std::size_t>(discs))); }

SceneStability scene_stability(const Scene& scene, std::vector<double> wavelengths) {
  require_memory_of_discs(scene, DiscWork::limits);
  const ddem::Assembly a = build_assembly(scene);
  const ContactParameters contact = contact_parameters(scene);
  const HeldDofs held = held_dofs(scene, a);
  SceneStability s;
  s.discs = static_cast<int>(a.size());
  s.bonds = static_cast<int>(a.bonds.size());
  s.deformation = deformation_parameters(scene);
  s.stiffness_ratio = contact.stiffness_ratio;
  const std::vector<double> chosen = check_wavelengths(a, std::move(wavelengths));
  try {
    s.dem_critical_step = 2.0 / largest_frequency(a, contact, held);
    s.time_step = scene_step(scene, s.dem_critical_step);
    const bool hexagonal = std::holds_alternative<HexagonalPacking>(scene.assembly.packing);
    find_limits(s, a, contact, held, hexagonal);
    s.slowest_growth = slowest_growth(scene, s.time_step);
    if (hexagonal) {
      s.whole_lattice = scene.assembly.periodic.x && scene.assembly.periodic.y;
      const HexagonalBloch bloch = bloch_of(scene, a, contact, s.deformation);
      s.lattice = {bloch.worst_wave(s.time_step), bloch.largest_stable_step()};
      s.waves = lattice_waves(bloch, s.time_step, chosen);
    } else {
      find_static_waves(scene, chosen, s);
    }
  } catch (const std::invalid_argument& e) {
    throw InputError(scene.path.string() + ": " + e.what());
  } catch (const InputError&) {
    throw;
  } catch (const SolverError&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw SolverError(std::string("stability: ") + e.what());
  }
  return s;
}

}  // namespace ddem::harness
