#pragma once
// What translations have in common: units in which numbers are near 1, and motions as signals.

#include <vector>

#include "harness/solvers/exchange.h"

namespace ddem::harness {

/// The mean diameter, the mean mass of a disc, the stiffest bond.
struct ReducedUnits {
  double length, mass, stiffness;  ///< m, kg, N/m
  double time() const;             ///< s
  double speed() const { return length / time(); }
};
ReducedUnits reduced_units(const Exchange& exchange, const std::vector<double>& normal_stiffness);

/// The discs of all receivers, ascending.
std::vector<int> recorded_discs(const SimulationInput& input);

/// Samples, one after the other, from the displacements (m, rad) of all discs, of which only recorded ones are looked at.
class SampleMaker {
 public:
  explicit SampleMaker(const SimulationInput& input);

  /// Throws NonFiniteSignal.
  void add(const std::vector<double>& ux, const std::vector<double>& uy, const std::vector<double>& theta);
  /// Throws InputError where samples are missing, or too many.
  Signals take();

 private:
  const SimulationInput& input_;
  Signals signals_;
};

}  // namespace ddem::harness
