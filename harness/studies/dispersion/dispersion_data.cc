#include "harness/io/errors.h"
#include "harness/studies/dispersion/dispersion_data.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "dem/assembly/contacts.h"
#include "dem/spectra/bloch.h"
#include "dem/spectra/spectra.h"
#include "harness/references/effective_moduli.h"
#include "harness/references/rayleigh_lamb.h"
#include "harness/run/fem_run.h"
#include "harness/studies/strip/whole.h"
#include "meshes/packings/hexagonal.h"

namespace ddem::harness {
namespace {

constexpr int kColumns = 128, kRows = 4;
constexpr double kRadius = 1e-4;      // m; spectra scale with it
constexpr double kSpacing = std::numbers::sqrt3 * kRadius;
constexpr double kDispersionAmplitude = 1e-9;   // m
constexpr double kDispersionRatio = 0.3;        // k_t/k_n
constexpr double kDispersionStepFraction = 0.1;
constexpr long kSteps = 8000;
constexpr int kSampleEvery = 4;
// Lines of waves with fewer lengths over the strip merge with their reflections.
constexpr double kFewestWaves = 7.5;
constexpr double kZoneBoundary = std::numbers::pi / kSpacing;
constexpr int kBands = 120;  // of the picture; the spectrum's own lines are far finer
constexpr double kNear = 0.04;  // a crest is looked for so near to its branch: rotations and higher modes are in the spectra too

constexpr std::pair kPeriodic{"finite elements", "fem"}, kOpen{"finite elements, free edges", "fem-free"};  // names of panels

bool is_judged(double k) { return k >= kFewestWaves * 2.0 * std::numbers::pi / (kColumns * kSpacing) && k <= 0.501 * kZoneBoundary; }

struct System {
  std::string name, slug;
  DeformationParameters deformation;
};

std::vector<System> systems_of(const StripCampaign& s) {
  DeformationParameters d;
  d.correction = Correction::full;
  d.young_modulus = s.particle_modulus;
  d.poisson_ratio = s.particle_poisson_ratio;
  d.scheme = Scheme::implicit;
  DeformationParameters lagged = d;
  lagged.scheme = Scheme::lagged;
  return {{"DEM", "dem", {}}, {"DDEM F implicit", "implicit-full", d}, {"DDEM F", "lagged-full", lagged}};
}

DispersionBranch branch_of(const std::string& wave, const FkSpectrum& spectrum, const std::function<double(double)>& exact) {
  DispersionBranch branch{wave, {}, {}, {}, 0};
  for (std::size_t row = 0; row < spectrum.wavenumber.size(); ++row) {
    const double k = spectrum.wavenumber[row];
    branch.wavenumber.push_back(k);
    branch.exact.push_back(k > 0.0 ? exact(k) : 0.0);
    if (!is_judged(k)) continue;
    ++branch.expected;
    if (const auto crest = crest_near(spectrum, row, branch.exact.back(), kNear)) branch.ridge.push_back(*crest);
  }
  return branch;
}

FkSpectrum together(FkSpectrum a, const FkSpectrum& b) {
  a.amplitude = (a.amplitude.array().square() + b.amplitude.array().square()).sqrt().matrix();
  return a;
}

ddem::Assembly lattice(const StripCampaign& s) {
  const Packing p = packings::hexagonal({.close_packed = packings::CloseRows::along_y, .columns = kColumns, .rows = kRows, .radius = kRadius, .periodic_y = true});
  return make_assembly(p, bonds_within_gap(p, 0.1 * kRadius), 1.0, s.density);
}

DispersionPanel discs_panel(const StripCampaign& s, const System& system, const ddem::Assembly& a, const Solver& solver) {
  SimulationInput in;
  in.contact.normal_stiffness = s.normal_stiffness;
  in.contact.stiffness_ratio = kDispersionRatio;
  in.deformation = system.deformation;
  in.time_step = kDispersionStepFraction * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = kSteps;
  in.sample_every = kSampleEvery;
  in.initial.ux.assign(a.size(), 0.0);
  for (int row = 0; row < kRows; ++row) in.initial.ux[row * kColumns] = kDispersionAmplitude;
  in.initial.uy = in.initial.ux;
  for (int column = 0; column < kColumns; ++column) in.receivers.push_back({{column}});
  const Signals signals = solver.solve(a, in).signals;

  const double sampled = kSampleEvery * in.time_step;
  const FkSpectrum along = fk_spectrum(signals.ux, kSpacing, sampled), across = fk_spectrum(signals.uy, kSpacing, sampled);
  const HexagonalBloch bloch({kRadius, s.density, 1.0, 0.5 * std::numbers::pi}, in.contact, in.deformation);
  DispersionPanel panel{system.name, system.slug, "", together(along, across), {}};
  // Along the normal of the columns P waves move along x alone, and the slowest branch is shear.
  panel.branches.push_back(branch_of("P", along, [&](double k) {
    const auto branches = bloch.branches({k, 0.0});
    return std::find_if(branches.begin(), branches.end(), [](const Branch& b) { return std::norm(b.motion[0]) > 0.5; })->frequency.real();
  }));
  panel.branches.push_back(branch_of("shear", across, [&](double k) { return bloch.frequencies({k, 0.0}).front().real(); }));
  return panel;
}

/// The continuum of the discs with full correction, in a strip as long and wide as theirs. Free ends reflect plane waves as
/// they are; S0 waves keep their shape at ends that slide, and are released by a pulse beside them.
FemCase continuum(const ContinuumMaterial& material, Wave wave, bool periodic, double sampled) {
  FemCase c;
  c.id = std::string(periodic ? "periodic" : "free") + (wave == Wave::shear ? "-shear" : "-longitudinal");
  c.length = kColumns * kSpacing;
  c.width = kRows * 2.0 * kRadius;
  c.elements = {48, 1};  // the shortest wave looked at, of four columns, is 1.5 of them: crests within 1e-4
  c.degree = 6;
  c.material = material;
  c.periodic = periodic;
  c.left = c.right = periodic ? Edge::free : Edge::fixed_x;
  InitialPulse pulse;
  pulse.wave = wave;
  pulse.shape = periodic ? PulseShape::cosine : PulseShape::gaussian;
  pulse.width = (periodic ? 2.0 : 0.5) * kSpacing;
  // A wave sin(k x) with a node at the pulse would be missing: the first lies at the zone boundary over 1.5.
  pulse.center = periodic ? 0.0 : 1.5 * kSpacing;
  pulse.amplitude = kDispersionAmplitude;
  c.load = pulse;
  c.step = StepSeconds{sampled};
  c.end = static_cast<double>(kSteps / kSampleEvery) * sampled;
  // S0 lives near the edges where it is short.
  const double y = periodic ? 0.5 * c.width : c.width;
  for (int column = 0; column < kColumns; ++column) c.points.push_back({(column + 0.5) * kSpacing, y});
  return c;
}

void add_continuum(DispersionStudy& study, const ContinuumMaterial& material, double sampled) {
  DispersionPanel periodic{kPeriodic.first, kPeriodic.second, "", {}, {}}, open{kOpen.first, kOpen.second, "", {}, {}};
  try {
    const std::vector<FemCase> cases = {continuum(material, Wave::longitudinal, true, sampled), continuum(material, Wave::shear, true, sampled),
                                        continuum(material, Wave::longitudinal, false, sampled)};
    const std::vector<FemResult> results = run_fem(cases);
    for (const FemResult& r : results) {
      if (r.status != "ok") throw std::runtime_error(r.id + ": " + r.status);
    }
    const double dt = results[0].sample_interval;
    const FkSpectrum along = fk_spectrum(results[0].point_ux, kSpacing, dt), across = fk_spectrum(results[1].point_uy, kSpacing, dt);
    periodic.spectrum = together(along, across);
    periodic.branches.push_back(branch_of("P", along, [&](double k) { return k * material.wave_speed(Wave::longitudinal, true); }));
    periodic.branches.push_back(branch_of("shear", across, [&](double k) { return k * material.wave_speed(Wave::shear, true); }));

    // Along the edge S0's displacement u_x changes sign with the wavenumber, u_y does not.
    const FkSpectrum normal = fk_spectrum(results[2].point_uy, kSpacing, dt);
    open.spectrum = together(fk_spectrum(results[2].point_ux, kSpacing, dt), normal);
    const double bar = material.wave_speed(Wave::longitudinal, false);
    open.branches.push_back(branch_of("S0", normal, [&](double k) { return k * bar * references::lamb_s0(k * cases[2].width, material.poisson_ratio).phase; }));
  } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
    throw;
  } catch (const std::exception& e) {
    periodic.failure = open.failure = e.what();
  }
  study.panels.push_back(std::move(periodic));
  study.panels.push_back(std::move(open));
}

/// The largest amplitude of each of kBands bands; what is above the highest frequency is left out.
FkSpectrum coarse(const FkSpectrum& s, double highest) {
  FkSpectrum out{s.wavenumber, {}, Eigen::MatrixXd::Zero(s.amplitude.rows(), kBands)};
  for (int band = 0; band < kBands; ++band) out.frequency.push_back((band + 0.5) * highest / kBands);
  for (std::size_t n = 0; n < s.frequency.size(); ++n) {
    const auto band = static_cast<Eigen::Index>(s.frequency[n] / highest * kBands);
    if (band >= kBands) break;
    out.amplitude.col(band) = out.amplitude.col(band).cwiseMax(s.amplitude.col(static_cast<Eigen::Index>(n)));
  }
  return out;
}

ContinuumMaterial closed_form(const StripCampaign& s) {
  const references::Fabric fabric = references::hexagonal_fabric();
  const references::PlaneModuli m = references::effective_moduli(references::ContactModel::ddem_full, fabric, {s.normal_stiffness, kDispersionRatio},
                                                                 {{s.particle_modulus, s.particle_poisson_ratio}, 1.0});
  const IsotropicModuli isotropic{m.bulk, m.shear};
  return {isotropic.young(), isotropic.poisson(), s.density * fabric.solid_fraction};
}

void require_whole(const DispersionBranch& b) {
  require(!b.wavenumber.empty() && std::ranges::is_sorted(b.wavenumber), "a branch without ascending wavenumbers");
  require_length("frequencies of a branch", b.exact.size(), b.wavenumber.size());
  for (const RidgePoint& p : b.ridge) require(p.wavenumber <= b.wavenumber.back(), "a crest beyond its branch");
}

}  // namespace

double DispersionBranch::worst_deviation() const {
  if (ridge.empty()) return std::numeric_limits<double>::infinity();
  double worst = 0.0;
  for (const RidgePoint& p : ridge) {
    const auto at = std::lower_bound(wavenumber.begin(), wavenumber.end(), p.wavenumber * (1.0 - 1e-9)) - wavenumber.begin();
    worst = std::max(worst, std::abs(p.frequency / exact[static_cast<std::size_t>(at)] - 1.0));
  }
  return worst;
}

double highest_frequency(const DispersionStudy& study) {
  double most = 0.0;
  for (const DispersionPanel& panel : study.panels) {
    if (!panel.slug.starts_with("dem")) continue;
    for (const DispersionBranch& b : panel.branches) most = std::max(most, *std::max_element(b.exact.begin(), b.exact.end()));
  }
  return 1.15 * most;
}

void require_whole(const DispersionStudy& found) {
  for (const DispersionPanel& p : found.panels) {
    const FkSpectrum& s = p.spectrum;
    require_length("rows of a spectrum", static_cast<std::size_t>(s.amplitude.rows()), s.amplitude.size() > 0 ? s.wavenumber.size() : 0);
    require_length("columns of a spectrum", static_cast<std::size_t>(s.amplitude.cols()), s.amplitude.size() > 0 ? s.frequency.size() : 0);
    for (const DispersionBranch& b : p.branches) require_whole(b);
  }
}

DispersionStudy plan_dispersion(bool with_fem) {
  DispersionStudy study{kZoneBoundary, {}};
  for (const System& system : systems_of({})) study.panels.push_back({system.name, system.slug, "not run", {}, {}});
  if (!with_fem) return study;
  study.panels.push_back({kPeriodic.first, kPeriodic.second, "not run", {}, {}});
  study.panels.push_back({kOpen.first, kOpen.second, "not run", {}, {}});
  return study;
}

DispersionStudy study_dispersion(const StripCampaign& s, bool with_fem, const Solver& solver) {
  DispersionStudy study{kZoneBoundary, {}};
  ContactParameters contact;
  contact.normal_stiffness = s.normal_stiffness;
  contact.stiffness_ratio = kDispersionRatio;
  const ddem::Assembly a = lattice(s);
  for (const System& system : systems_of(s)) {
    try {
      study.panels.push_back(discs_panel(s, system, a, solver));
    } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
      throw;
    } catch (const std::exception& e) {
      study.panels.push_back({system.name, system.slug, e.what(), {}, {}});
    }
  }
  if (with_fem) add_continuum(study, closed_form(s), kSampleEvery * kDispersionStepFraction * 2.0 / largest_frequency(a, contact, {}));
  const double highest = highest_frequency(study);
  for (DispersionPanel& panel : study.panels) {
    panel.spectrum = panel.failure.empty() && highest > 0.0 ? coarse(panel.spectrum, highest) : FkSpectrum{};
  }
  return study;
}

}  // namespace ddem::harness
