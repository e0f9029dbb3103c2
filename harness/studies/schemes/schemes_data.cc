#include "harness/io/errors.h"
#include "harness/studies/schemes/schemes_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/assembly/contacts.h"
#include "dem/simulation/simulation.h"
#include "dem/spectra/bloch.h"
#include "dem/spectra/spectra.h"
#include "dem/statics/moduli.h"
#include "harness/model/assemble.h"
#include "harness/studies/strip/whole.h"
#include "harness/references/effective_moduli.h"
#include "harness/run/dem_run.h"
#include "meshes/packings/hexagonal.h"

namespace ddem::harness {
namespace {

constexpr double kSchemeAmplitude = 1e-9;  // m; every model here is linear
constexpr long kEnergySteps = 10000;
constexpr std::size_t kFirstSample = 4;  // of 200: step 200
constexpr double kSoftest = 10.0;    // k_n/E_p of the reach curves

DeformationParameters strains(const StripCampaign& s, Scheme scheme, Correction correction, double softness) {
  DeformationParameters d;
  d.scheme = scheme;
  d.correction = correction;
  d.young_modulus = s.normal_stiffness / softness;
  d.poisson_ratio = s.particle_poisson_ratio;
  return d;
}

ContactParameters studied_contact(const StripCampaign& s) {
  ContactParameters contact;
  contact.normal_stiffness = s.normal_stiffness;
  contact.stiffness_ratio = 0.5;
  return contact;
}

/// `critical`: the step of rigid discs, s.
EnergyCurve follow_energy(const ddem::Assembly& a, const StripCampaign& s, double critical, const StudiedScheme& scheme, double fraction, const Solver& solver) {
  SimulationInput in;
  in.contact = studied_contact(s);
  in.deformation = scheme.deformation;
  in.time_step = fraction * critical;
  in.steps = kEnergySteps;
  in.energy_samples = 200;
  for (const double x : a.packing.x) in.initial.ux.push_back(kSchemeAmplitude * std::cos(std::numbers::pi * x / s.length));
  const SimulationResult r = solver.solve(a, in);
  EnergyCurve curve{scheme.name, fraction, {}, {}, r.breakdown ? std::nullopt : r.energy_drift, 0.0};
  if (r.steps_done > 0) {
    curve.nanoseconds_per_bond_step = 1e9 * r.wall_seconds / (static_cast<double>(r.steps_done) * static_cast<double>(a.bonds.size()));
  }
  // Lagged strains start from zero, which costs a quarter of the energy in the first steps.
  for (std::size_t k = kFirstSample; k < r.energy.size(); ++k) {
    curve.time.push_back(r.energy[k].time);
    curve.energy.push_back(r.energy[k].energies.invariant / r.energy[kFirstSample].energies.invariant);
  }
  return curve;
}

std::vector<EnergyCurve> energy_curves(const StripCampaign& s, const Solver& solver) {
  const StripCase c{StripPacking::random, s.seeds.front(), Model::dem, 0.5, Protocol::paper, StripWave::bar};
  const ddem::Assembly a = build_assembly(scene_of(assembly_text(s, c, false), "energy"));
  const double softness = s.normal_stiffness / s.particle_modulus;
  const StudiedScheme rigid{"DEM", {}}, lagged{"lagged F", strains(s, Scheme::lagged, Correction::full, softness)},
      implicit{"implicit F", strains(s, Scheme::implicit, Correction::full, softness)};
  StudiedScheme gradients{"implicit F, conjugate gradients", implicit.deformation};
  gradients.deformation.solver = StrainSolver::conjugate_gradients;
  const double critical = 2.0 / largest_frequency(a, studied_contact(s), {});
  const auto follow = [&](const StudiedScheme& scheme, double fraction) { return follow_energy(a, s, critical, scheme, fraction, solver); };
  return {follow(rigid, 0.2), follow(lagged, 0.2), follow(lagged, 0.05), follow(implicit, 0.2), follow(gradients, 0.2)};
}

StripCase driven_lattice(StripWave wave) { return {StripPacking::hexagonal, 0, Model::implicit_full, 0.0, Protocol::long_wave, wave}; }

/// Between periodic edges, for any softness of its discs.
struct LatticeStrip {
  ddem::Assembly assembly;
  double critical_time_step;  ///< of rigid discs, s
  const Solver* solver;
};

LatticeStrip lattice_strip(const StripCampaign& s, const Solver& solver) {
  const Scene scene = scene_of(assembly_text(s, driven_lattice(StripWave::p), false), "reach");
  LatticeStrip strip{build_assembly(scene), 0.0, &solver};
  strip.critical_time_step = 2.0 / largest_frequency(strip.assembly, contact_parameters(scene), {});
  return strip;
}

/// The campaign's driven pulse in the lattice, P and shear.
std::optional<double> reached_poisson(const StripCampaign& s, const LatticeStrip& strip, const IsotropicModuli& closed, double density,
                                      const std::function<void(DeformationParameters&)>& set_scheme) {
  std::optional<double> speed[2];
  for (const StripWave wave : {StripWave::shear, StripWave::p}) {
    const bool shear = wave == StripWave::shear;
    const double expected = std::sqrt((shear ? closed.shear : closed.bulk + closed.shear) / density);
    Scene scene = scene_of(scene_text(s, driven_lattice(wave), expected), "reach");
    set_scheme(scene.deformation.value());
    if (scene.deformation->scheme == Scheme::lagged) scene.time.integrator = Integrator::verlet;
    RunOptions run_options;
    run_options.expected_speed = expected;
    run_options.critical_time_step = strip.critical_time_step;
    run_options.warn = false;
    run_options.solver = strip.solver;
    const DemRun run = run_assembly(scene, strip.assembly, run_options);
    if (run.result.breakdown || !run.measurement || !run.measurement->speed.speed.ok()) return std::nullopt;
    speed[shear ? 0 : 1] = run.measurement->speed.speed.value().mean;
  }
  return 1.0 - 2.0 * std::pow(*speed[0] / *speed[1], 2);
}

std::vector<ReachCurve> reach_curves(StripCampaign s, double poisson_ratio, const Solver& solver) {
  s.particle_poisson_ratio = poisson_ratio;
  const LatticeStrip strip = lattice_strip(s, solver);
  ReachCurve lagged{"lagged", {}}, relaxed{"lagged, half of the new strain", {}}, implicit{"implicit", {}};
  for (const double softness : {0.05, 0.1, 0.2, 0.4, 0.8, 1.5, 3.0, 6.0, kSoftest}) {
    s.particle_modulus = s.normal_stiffness / softness;
    const references::PlaneModuli m = references::effective_moduli(references::ContactModel::ddem_full, references::hexagonal_fabric(),
                                                                   {s.normal_stiffness, 0.0}, {{s.particle_modulus, poisson_ratio}, 1.0});
    const IsotropicModuli closed{m.bulk, m.shear};
    const double density = s.density * references::hexagonal_fabric().solid_fraction;
    const auto add = [&](ReachCurve& curve, Scheme scheme, double relaxation) {
      curve.points.push_back({softness,
                              reached_poisson(s, strip, closed, density,
                                              [&](DeformationParameters& d) {
                                                d.scheme = scheme;
                                                d.relaxation = relaxation;
                                              }),
                              closed.poisson()});
    };
    add(lagged, Scheme::lagged, 1.0);
    add(relaxed, Scheme::lagged, 0.5);
    add(implicit, Scheme::implicit, 1.0);
  }
  return {implicit, relaxed, lagged};
}

OrderCurve order_of(const StripCampaign& s, const StudiedScheme& scheme, const Solver& solver) {
  constexpr int columns = 16;
  const double radius = s.length / static_cast<double>(2 * s.columns + 1);
  const Packing p = packings::hexagonal({.columns = columns, .rows = 4, .radius = radius, .periodic_x = true, .periodic_y = true});
  const ddem::Assembly a = make_assembly(p, bonds_within_gap(p, 0.1 * radius), 1.0, s.density);
  SimulationInput in;
  in.contact.normal_stiffness = s.normal_stiffness;
  in.deformation = scheme.deformation;
  const double k = std::numbers::pi / (columns * radius);  // one wave over the lattice
  for (const double x : a.packing.x) in.initial.uy.push_back(kSchemeAmplitude * std::cos(k * (x - a.packing.x.front())));
  in.receivers = {{{0}}};
  // Shear along the rows is the slowest branch; the exact wave has converged strains.
  const double omega = HexagonalBloch({radius, s.density, 1.0, 0.0}, in.contact, in.deformation).frequencies({k, 0.0}).front().real();
  const double critical = 2.0 / largest_frequency(a, in.contact, {}), end = 4.0 * std::numbers::pi / omega;
  OrderCurve curve{scheme.name, {}, {}, 0.0};
  for (const double fraction : {0.8, 0.4, 0.2, 0.1, 0.05, 0.025}) {
    in.steps = std::lround(end / (fraction * critical));
    in.time_step = end / static_cast<double>(in.steps);
    const Signals u = solver.solve(a, in).signals;
    double worst = 0.0;
    for (std::size_t n = 0; n < u.time.size(); ++n) worst = std::max(worst, std::abs(u.uy[0][n] / kSchemeAmplitude - std::cos(omega * u.time[n])));
    curve.step_fraction.push_back(fraction);
    curve.error.push_back(worst);
  }
  const std::size_t last = curve.error.size() - 1;
  curve.order = std::log2(curve.error[last - 1] / curve.error[last]);
  return curve;
}

std::vector<OrderCurve> order_curves(const StripCampaign& s, const Solver& solver) {
  const double softness = s.normal_stiffness / s.particle_modulus;
  StudiedScheme implicit{"implicit", strains(s, Scheme::implicit, Correction::full, softness)};
  implicit.deformation.tolerance = 1e-8;  // the stiffness itself is not what is measured here
  return {order_of(s, {"DEM", {}}, solver), order_of(s, {"lagged", strains(s, Scheme::lagged, Correction::full, softness)}, solver), order_of(s, implicit, solver)};
}

}  // namespace

void require_whole(const SchemeStudy& found) {
  GroupNames energy, reach, order;
  for (const EnergyCurve& c : found.energy) {
    energy.add(fmt::format("{}, step {:g}", c.scheme, c.step_fraction));
    require_length("energies", c.energy.size(), c.time.size());
  }
  for (const ReachCurve& c : found.reach) {
    reach.add(c.scheme);
    require(!c.points.empty(), "a curve without points");
  }
  for (const OrderCurve& c : found.order) {
    order.add(c.scheme);
    require_length("errors over the step", c.error.size(), c.step_fraction.size());
  }
}

SchemeStudy study_schemes(const StripCampaign& s, const std::function<void()>& on_progress, const Solver& solver) {
  SchemeStudy study;
  study.reach_poisson_ratio = 0.49;
  try {
    study.energy = energy_curves(s, solver);
    on_progress();
    study.reach = reach_curves(s, study.reach_poisson_ratio, solver);
    on_progress();
    study.order = order_curves(s, solver);
    on_progress();
  } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
    throw;
  } catch (const std::exception& e) {
    study.failure = e.what();
  }
  return study;
}

}  // namespace ddem::harness
