#pragma once
// The arrays of a running simulation and the step that advances them; padded to whole slices, in the solver's order.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "dem/kernel/aligned.h"
#include "dem/kernel/sliced_bonds.h"
#include "dem/kernel/step_data.h"
#include "dem/simulation/audit.h"
#include "dem/simulation/conjugate_gradients.h"
#include "dem/simulation/new_contacts.h"
#include "dem/simulation/simulation.h"
#include "dem/simulation/stage.h"
#include "dem/simulation/taps.h"
#include "dem/spectra/strain_polynomial.h"

namespace ddem {

class Stepper {
 public:
  Stepper(const Assembly& assembly, const SimulationInput& input, InstructionSet isa);

  /// A step is a row of stages: strains to be found first, then the motion. Does a thread's share of the stage that is
  /// due; when all threads have, one of them calls finish_stage.
  void advance(int thread);
  /// Exchanges what the stage wrote. True when a step is done.
  bool finish_stage();

  /// Threads that share the slices up to the front of the motion.
  int threads() const { return static_cast<int>(range_begin_.size()) - 1; }
  /// Between two steps.
  void share_among(int threads);
  long step() const { return step_number_; }
  /// How many steps the next sweep may take, and that it shall take so many.
  int steps_at_once() const;
  void take_steps(int count);
  /// The steps of the last sweep, and the discs tapped after each of them but where it was one.
  int steps_taken() const { return steps_taken_; }
  const Taps& taps() const { return taps_; }
  /// Of the arrays that a step works on.
  std::size_t array_bytes() const;
  int place_of(int disc) const { return position_[disc]; }
  double radius(int disc) const { return assembly_.packing.radius[disc]; }
  const std::vector<int>& order() const { return position_; }

  const StepData& data() const { return data_; }
  /// The new contacts that pushed in the last step, and what they amounted to since the start.
  const std::vector<NewContact>& contacts_in_use() const { return in_use_; }
  const std::optional<NewContactCount>& new_contacts() const { return count_; }
  Assembly all_closed() const { return watch_->all_closed(); }
  /// The strains that corrected the overlaps of the last step.
  StrainView strains_in_use() const { return {implicit_ ? strain_.data() : strain_next_.data()}; }
  VelocityView velocities() const { return {data_.vx, data_.vy, data_.omega, data_.kick_x, data_.kick_y, data_.kick_theta}; }
  /// The displacements before the last step, kQuad a disc.
  AlignedVector<double> motion_before() const;
  /// Set once the strains of a step could not be found; the motion must not go on.
  std::optional<Breakdown> breakdown() const;
  /// Finds a disc whose displacement is not finite or beyond `bound` (m); -1 if there is none.
  int diverged_disc(double bound) const;
  InitialState state() const { return state_of(motion_.data()); }
  /// The displacements of an array of motions, and the velocities.
  InitialState state_of(const double* motion) const;
  /// values[stride p], one value a disc in the order of the assembly; zero for a null pointer.
  std::vector<double> in_order(const double* values, int stride = 1) const;
  /// The same of what the solver keeps times the radius.
  std::vector<double> over_radius(const double* values, int stride = 1) const;

 private:
  struct Kept {
    AlignedVector<double>* array;
    AlignedVector<double> before;
  };

  void size_arrays(const SimulationInput& input);
  void set_parameters(const Assembly& assembly, const SimulationInput& input);
  void prepare_strains(const Assembly& assembly, const SimulationInput& input);
  // The start, stepper_start.cc.
  void load(const InitialState& initial);
  void turn_bonds();
  void start_leapfrog();
  void impose(double time, AlignedVector<double>& motion) const;
  void bind();
  void swap_strains();
  void begin_step(bool may_be_free = true);
  void begin_stage(Stage stage);
  void finish_strain_stage();
  void begin_strains();
  void find_fronts();
  void follow_front(int sweeps);
  int front_after(int sweeps) const;
  void share(int front);
  StepData relaxed(StepData data, int iteration) const;
  SliceFunction iteration(int iteration) const;
  // Sweeps, stepper_sweeps.cc.
  void plan_sweeps(const SimulationInput& input);
  bool strains_fit_a_sweep() const;
  int passes_a_step() const { return in_one_sweep_ ? strain_stages_ + 2 : 2; }
  int sweeps_a_step() const { return passes_a_step() - 1; }  // that carry the motion a bond further
  int worthwhile_steps() const;
  bool drifts_with_kick() const;
  StepData noted_by(int thread, StepData data);
  StepData data_of(int level);
  StepData data_of_strains(int stage);
  void pass(int thread, int index, int begin, int end);
  void sweep(int thread);
  void close_seam(int thread, int slice);
  void drift(int level, int begin, int end);
  void pull(int level, int begin, int end);
  bool worth_pulling(const SimulationInput& input) const;
  void size_pulls();
  std::size_t driven_component(int place) const { return static_cast<std::size_t>(kQuad * place + (drive_->direction == Direction::x ? 0 : 1)); }
  // New contacts, stepper_contacts.cc.
  void look_for_contacts();
  void recall_contacts();
  bool contacts_agree();
  void add_contact_strains();
  void add_strain(const NewContact& contact, double force, double weight, AlignedVector<double>& to) const;
  void push_from_rest(double* vx, double* vy) const;
  void finish_contacts();
  void size_notes();
  double take_largest(AlignedVector<double>& noted) const;
  double furthest_driven(int steps) const;
  // Sweeps in which nothing closes, stepper_free.cc.
  void size_kept();
  bool finds_free_steps();
  bool was_free();
  void keep(int begin, int end);
  std::pair<std::ptrdiff_t, std::ptrdiff_t> extent(const Kept& kept, int begin, int end) const;
  void take_back();

  SlicedBonds bonds_;
  std::vector<int> position_;
  std::size_t discs_ = 0, padded_ = 0;
  bool rotation_ = false, deformable_ = false, pulls_ = false;
  std::optional<EdgeDrive> drive_;
  std::vector<int> driven_places_;
  AlignedVector<double> motion_, strain_, strain_next_, source_;  // kQuad a disc
  AlignedVector<double> vx_, vy_, omega_;
  AlignedVector<double> kick_x_, kick_y_, kick_theta_;  // the others empty where they would be kick_x_
  AlignedVector<double> rigid_fx_, rigid_fy_, rigid_moment_;
  AlignedVector<double> previous_dx_, previous_dy_, previous_rotation_, slip_;
  AlignedVector<double> pull_, press_, press_next_, dyad_xx_, dyad_yy_, dyad_xy_;
  AlignedVector<std::int32_t> other_end_;
  StepData data_{};
  StepKernels kernels_;
  SliceFunction move_ = nullptr, due_ = nullptr;
  bool implicit_ = false;
  Stage stage_ = Stage::motion;
  int strain_stages_ = 0, stages_done_ = 0;  // before the motion; of the step under way
  std::vector<double> relaxations_;
  std::optional<ConjugateGradients> gradients_;
  // New contacts: those that pushed in the last step, and those that implicit strains are sought with.
  const Assembly& assembly_;
  const ContactParameters contact_;
  const DeformationParameters deformation_;
  std::optional<NewContacts> watch_;
  std::vector<int> range_begin_;  // first slice of each thread, and the end
  std::vector<int> fronts_;       // by sweep (front.h)
  std::size_t sweep_ = 0;
  int reach_ = 0;  // slices
  bool automatic_steps_ = true, one_sweep_pays_ = false;
  bool in_one_sweep_ = false;  // implicit: strains and motion of the step at hand
  int steps_at_once_ = 1, steps_due_ = 1, steps_taken_ = 1;
  Taps taps_;
  AlignedVector<double> fastest_, most_strained_;  // kLanes a thread
  double largest_strain_ = 0.0;
  bool free_ = false;         // nothing can close in the steps at hand unless all goes much faster than before, and nothing is looked for
  int free_steps_ = 0;
  std::vector<Kept> kept_;    // of free steps: what they change, as it was before
  std::vector<NewContact> in_use_, assumed_;
  std::optional<NewContactCount> count_;
  bool contacts_in_polynomial_ = false, undecided_ = false;
  int decisions_ = 0;
  long step_number_ = 0;
};

}  // namespace ddem
