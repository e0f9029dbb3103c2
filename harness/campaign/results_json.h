#pragma once
// Results to and from JSON: every member, every number as it is. For .cc files only: it is long to compile.

#include <nlohmann/json.hpp>

#include "harness/campaign/results.h"
#include "harness/campaign/strip_waves.h"

namespace nlohmann {

/// null: empty.
template <class T>
struct adl_serializer<std::optional<T>> {
  static void to_json(json& j, const std::optional<T>& value) {
    if (value)
      j = *value;
    else
      j = nullptr;
  }
  static void from_json(const json& j, std::optional<T>& value) {
    if (j.is_null())
      value.reset();
    else
      value = j.template get<T>();
  }
};

/// {rows, columns, values by rows}.
template <int rows, int columns>
struct adl_serializer<Eigen::Matrix<double, rows, columns>> {
  using Matrix = Eigen::Matrix<double, rows, columns>;

  static void to_json(json& j, const Matrix& m) {
    std::vector<double> values;
    for (Eigen::Index r = 0; r < m.rows(); ++r) {
      for (Eigen::Index c = 0; c < m.cols(); ++c) values.push_back(m(r, c));
    }
    j = json{{"rows", m.rows()}, {"columns", m.cols()}, {"values", values}};
  }
  static void from_json(const json& j, Matrix& m) {
    const auto values = j.at("values").template get<std::vector<double>>();
    const auto r = j.at("rows").template get<Eigen::Index>(),
               c = j.at("columns").template get<Eigen::Index>();
    if (r < 0 || c < 0 || (r > 0 && static_cast<Eigen::Index>(values.size()) / r != c) ||
        static_cast<Eigen::Index>(values.size()) != r * c) {
      throw std::invalid_argument("a matrix whose size is not that of its values");
    }
    m.resize(r, c);
    for (Eigen::Index k = 0; k < r * c; ++k) m(k / c, k % c) = values[static_cast<std::size_t>(k)];
  }
};

}  // namespace nlohmann

namespace ddem {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Period, x, y)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Packing, x, y, radius, period, length, width)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(IsotropicModuli, bulk, shear)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Energies, kinetic, contact, particle, invariant)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EnergySample, time, energies)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InitialState, ux, uy, theta, vx, vy, omega)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TensorField, xx, yy, xy)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Snapshot, time, state, stress, strain)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StripTension, axial_stiffness, mass_per_length, lateral_contraction)

}  // namespace ddem

namespace ddem::references {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlaneModuli, bulk, shear)

}  // namespace ddem::references

namespace ddem::reports {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Probe, x, y, label)

}  // namespace ddem::reports

namespace ddem::harness::bench {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PrecisionPoint, solver, scheme, mesh, discs_or_dofs, step_fraction, steps,
                                   seconds, error, error_to_continuum, status)

}  // namespace ddem::harness::bench

namespace ddem::harness {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StripCampaign, title, stiffness_ratios, models, seeds, length, width,
                                   discs, columns, rows, coordination, density, normal_stiffness,
                                   particle_modulus, particle_poisson_ratio, step_fraction,
                                   long_wave_step_fraction, pulse_length,
                                   fem_degree, fem_elements, full_stability)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StripCase, packing, seed, model, stiffness_ratio, protocol, wave)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SceneModuli, discs, bonds, rattlers, coordination, solid_fraction,
                                   bulk_density, method, stiffness, strip)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StripMaterial, packing, seed, model, stiffness_ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Speeds, bar, shear, p)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BlochLimit, shear, p, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StaticOutcome, key, failure, moduli, speeds, sections, kinematic,
                                   kinematic_speeds, critical_time_step, cell, bloch, solve_seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PickedSignal, probe, x, values, window_end, pick_time, pick_amplitude,
                                   pick_failure)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Recording, sample_interval, signals)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PickedSpeeds, peak, centroid, correlation)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WaveOutcome, c, scene, failure, diverged, diverged_step, diverged_disc,
                                   speed, speed_stddev, centroid_speed, correlation_speed, s0, good_pairs,
                                   static_speed, kinematic_speed, section_speed, time_step,
                                   critical_time_step, steps, seconds, recording)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StripPicture, packing, time, displacement, probe_x, probe_y, probe_labels)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FilmedRun, model, packing, frames, energy)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StripFilm, failure, stiffness_ratio, runs, probes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MaterialOutcome, statics, waves, picture)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StabilityOutcome, key, failure, expected_unstable, diverged_step, steps)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FemOutcome, key, wave, uniaxial, failure, speed, analytical_speed, dofs,
                                   steps, solve_seconds, recording)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EnergyCurve, scheme, step_fraction, time, energy, drift,
                                   nanoseconds_per_bond_step)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReachPoint, softness, poisson, closed_form)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReachCurve, scheme, points)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(OrderCurve, scheme, step_fraction, error, order)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SchemeStudy, failure, reach_poisson_ratio, energy, reach, order)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PoissonRange, lowest, highest)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RangeCurve, particle_poisson_ratio, ranges)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RangeStudy, failure, softness, rigid, curves)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CalibratedPacking, seed, young_modulus, poisson_ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CalibrationOutcome, id, failure, target_young, target_poisson, feasible,
                                   stiffness_ratio, normal_stiffness, softness, particle_poisson_ratio,
                                   highest_rigid, highest_implicit, fitted, unseen)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DesignPoint, young_over_stiffness, poisson_ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SoftnessCurve, particle_poisson_ratio, random, lattice)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DesignStudy, stiffness_ratio, softness, curves)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StabilityKey, packing, scheme, correction, stiffness_ratio,
                                   particle_poisson_ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StabilityPoint, softness, step_fraction, predicted, measured, noise_grew,
                                   noise_should_grow, unseen)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StabilityMap, key, failure, softness, step_fraction, points,
                                   boundary_softness, boundary_fraction)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RidgePoint, wavenumber, frequency, amplitude)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FkSpectrum, wavenumber, frequency, amplitude)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DispersionBranch, wave, wavenumber, exact, ridge, expected)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DispersionPanel, system, slug, failure, spectrum, branches)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DispersionStudy, zone_boundary, panels)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Discrimination, parameter, share, case_id, metric, failure, tolerances)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DiscriminationStudy, defects)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SceneOverride, key, value)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CaseCriterion, metric, target, reference, lower, upper, unit, derivation)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(UserCase, id, title, scene, text, overrides, criteria)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(UserCaseOutcome, failure, diverged_step, metrics, missing)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WidthBias, strip, bulk)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SizedWave, measured, reference, s0)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SizedStrip, packing, refinement, seed, failure, discs, cells,
                                   radius_over_width, bias, bar, shear, p)

}  // namespace ddem::harness
