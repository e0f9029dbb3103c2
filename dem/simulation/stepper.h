#pragma once
// The arrays of a running simulation and the step that advances them; padded to whole slices, in the solver's order.

#include <optional>
#include <vector>

#include "dem/kernel/aligned.h"
#include "dem/kernel/sliced_bonds.h"
#include "dem/kernel/step_data.h"
#include "dem/simulation/chebyshev.h"
#include "dem/simulation/energy.h"
#include "dem/simulation/simulation.h"

namespace ddem {

class Stepper {
 public:
  Stepper(const Assembly& assembly, const SimulationInput& input, InstructionSet isa);

  /// A step is a row of stages: strains to be found first, then the motion. Works on the slices [begin, end) of the
  /// stage that is due; several threads may do this on disjoint ranges, then one of them calls finish_stage.
  void advance(int begin, int end) { due_(data_, begin, end); }
  /// Exchanges what the stage wrote; after the last one the driven edge is imposed at t_{n+1}. True when a step is done.
  bool finish_stage();

  int slices() const { return bonds_.slices; }
  long step() const { return step_number_; }
  int place_of(int disc) const { return position_[disc]; }
  const std::vector<int>& order() const { return position_; }

  const StepData& data() const { return data_; }
  /// The strains that corrected the overlaps of the last step.
  StrainView strains_in_use() const;
  /// Finds a disc whose displacement is not finite or beyond `bound` (m); -1 if there is none.
  int diverged_disc(double bound) const;
  InitialState state() const;

 private:
  void load(const InitialState& initial);
  void start_leapfrog();
  void impose(double time, AlignedVector<double>& ux, AlignedVector<double>& uy) const;
  void bind();
  void swap_strains();
  void begin_stage(int stage);

  SlicedBonds bonds_;
  std::vector<int> position_;
  std::size_t discs_ = 0, padded_ = 0;
  bool rotation_ = false, deformable_ = false;
  std::optional<EdgeDrive> drive_;
  AlignedVector<double> ux_, uy_, theta_, ux_next_, uy_next_, theta_next_;
  AlignedVector<double> vx_, vy_, omega_, kick_x_, kick_y_, kick_theta_;
  AlignedVector<double> exx_, eyy_, exy_, exx_next_, eyy_next_, exy_next_, inverse_volume_;
  AlignedVector<double> previous_dx_, previous_dy_, previous_rotation_, slip_;
  AlignedVector<double> source_xx_, source_yy_, source_xy_, change_xx_, change_yy_, change_xy_;
  StepData data_{};
  StepKernels kernels_;
  SliceFunction due_ = nullptr;
  bool implicit_ = false;
  int stages_ = 1, stage_ = 0;
  std::vector<ChebyshevWeights> chebyshev_;
  long step_number_ = 0;
};

}  // namespace ddem
