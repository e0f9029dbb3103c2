#pragma once
// A Gaussian shear pulse in the periodic hexagonal lattice, exactly: the sum of its plane waves, each with the frequency
// and the rotation of the discs that Bloch's theorem gives it (dem/spectra/bloch.h), strains of the discs converged.

#include <vector>

#include "dem/simulation/simulation.h"
#include "harness/bench/assemblies.h"

namespace ddem::harness::bench {

class LatticePulse {
 public:
  /// exp(-s^2/(2 width^2)) in u_y around the middle of a period `columns` discs long (m), along close-packed rows.
  LatticePulse(const Law& law, int columns, double radius, double width);

  /// At rest.
  ddem::InitialState start(const ddem::Assembly& assembly) const;
  /// u_y at x and t of the lattice, and of the continuum: d'Alembert with the closed-form velocity.
  double lattice(double x, double t) const { return sum(x, t, &Mode::frequency); }
  double continuum(double x, double t) const { return sum(x, t, &Mode::continuum_frequency); }
  /// Half a period over the velocity: the two halves of the pulse meet again, s.
  double passage() const { return 0.5 * length_ / speed_; }

 private:
  struct Mode {
    double wave_number, amplitude, frequency, continuum_frequency;
    double rotation_cosine, rotation_sine;  ///< theta = (.. cos k(x - x0) + .. sin k(x - x0)) u_y's amplitude, 1/m
  };
  double sum(double x, double t, double Mode::* frequency) const;

  double length_, middle_, speed_;
  std::vector<Mode> modes_;
};

}  // namespace ddem::harness::bench
