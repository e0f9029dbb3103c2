#pragma once
// What a scheme does to long waves: numerical damping, or growth, of a wave along x at a given step.

#include <string>
#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/spectra/bloch.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

struct WaveGrowth {
  std::string wave;         ///< shear, p (no lateral strain), bar (free strip), rotation
  double wavelength = 0.0;  ///< m
  double frequency = 0.0;   ///< angular, rad/s
  double growth = 0.0;      ///< |z| - 1 of a step
  bool exact = false;       ///< a Bloch wave of the infinite lattice; else first order in omega dt, from static moduli

  double phase_speed() const;
  /// |z|^steps of one period, less 1.
  double growth_per_period(double time_step) const;
};

/// Mean k_n of the bonds, N/m.
double mean_normal_stiffness(const ddem::Assembly& assembly, const ContactParameters& contact);

/// The infinite lattice of a scene's hexagonal packing.
HexagonalBloch bloch_of(const Scene& scene, const ddem::Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation);

/// Waves of the infinite lattice, exact; `time_step` in s, wavelengths in m.
std::vector<WaveGrowth> lattice_waves(const HexagonalBloch& bloch, double time_step, const std::vector<double>& wavelengths);

/// Long waves of any assembly: frequencies from its static moduli, the damping or growth by strains that lag from its
/// static deformation (dem/spectra/lag_damping.h), first order in omega dt. Throws as scene_moduli(), and InputError where
/// the lagged strains do not converge.
std::vector<WaveGrowth> static_waves(const Scene& scene, double time_step, const std::vector<double>& wavelengths);

}  // namespace ddem::harness
