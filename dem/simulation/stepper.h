#pragma once
// The arrays of a running simulation and the step that advances them; padded to whole slices, in the solver's order.

#include <optional>
#include <vector>

#include "dem/kernel/aligned.h"
#include "dem/kernel/sliced_bonds.h"
#include "dem/kernel/step_data.h"
#include "dem/simulation/simulation.h"

namespace ddem {

class Stepper {
 public:
  Stepper(const Assembly& assembly, const SimulationInput& input, InstructionSet isa);

  /// Advances the slices [begin, end) from step n to n + 1. Several threads may do this on disjoint ranges; then one of
  /// them calls finish_step.
  void advance(int begin, int end) { step_(data_, begin, end); }
  /// Imposes the driven edge at t_{n+1}, exchanges the buffers.
  void finish_step();

  int slices() const { return bonds_.slices; }
  long step() const { return step_number_; }
  int place_of(int disc) const { return position_[disc]; }
  const std::vector<int>& order() const { return position_; }

  const StepData& data() const { return data_; }
  /// Finds a disc whose displacement is not finite or beyond `bound` (m); -1 if there is none.
  int diverged_disc(double bound) const;
  InitialState state() const;

 private:
  void load(const InitialState& initial);
  void start_leapfrog();
  void impose(double time, AlignedVector<double>& ux, AlignedVector<double>& uy) const;
  void bind();

  SlicedBonds bonds_;
  std::vector<int> position_;
  std::size_t discs_ = 0, padded_ = 0;
  bool rotation_ = false, deformable_ = false;
  std::optional<EdgeDrive> drive_;
  AlignedVector<double> ux_, uy_, theta_, ux_next_, uy_next_, theta_next_;
  AlignedVector<double> vx_, vy_, omega_, kick_x_, kick_y_, kick_theta_;
  AlignedVector<double> exx_, eyy_, exy_, exx_next_, eyy_next_, exy_next_, inverse_volume_;
  AlignedVector<double> previous_dx_, previous_dy_, previous_rotation_, slip_;
  StepData data_{};
  StepFunction step_ = nullptr;
  long step_number_ = 0;
};

}  // namespace ddem
