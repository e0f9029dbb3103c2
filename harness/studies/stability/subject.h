#pragma once
// What a map of stability is made with: an assembly, and the motion that grows fastest in it.

#include <complex>
#include <vector>

#include "dem/spectra/bloch.h"
#include "harness/studies/stability/stability_map.h"

namespace ddem::harness {

using Complex = std::complex<double>;

/// A motion to start from, q_0 and its factor.
struct Start {
  Complex factor;
  std::vector<Complex> ux, uy, theta;  ///< a disc each; theta in rad times the mean radius
  double motionless = 0.0;             ///< ln of the largest factor beyond 1 of strains that move no disc
};

/// The assembly of a map with its predictions.
class Subject {
 public:
  Subject(ddem::Assembly assembly, bool lattice, const ContactParameters& contact);
  const ddem::Assembly& assembly() const { return a_; }
  const ContactParameters& contact() const { return contact_; }
  double critical_step() const { return critical_; }

  Start worst(const DeformationParameters& d, double dt) const;
  /// The largest at which no motion grows, s; 0: none.
  double largest_step(const DeformationParameters& d) const;

 private:
  HexagonalBloch bloch(const DeformationParameters& d) const;
  Start worst_wave(const DeformationParameters& d, double dt) const;
  Start worst_mode(const DeformationParameters& d, double dt) const;

  ddem::Assembly a_;
  bool lattice_;
  ContactParameters contact_;
  double critical_ = 0.0;
  std::vector<WaveVector> waves_;
};

Subject subject_of(const StripCampaign& campaign, const StabilityGrid& grid, const StabilityKey& key);

}  // namespace ddem::harness
