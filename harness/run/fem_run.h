#pragma once
// The continuum model of a scene's strip: cases for the program ddem-fem, which runs many in one process, and its
// signals. The harness and the finite-element program meet in files only.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/measure/signal.h"
#include "harness/model/probes.h"
#include "harness/run/measure_wave.h"
#include "harness/run/scene_moduli.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

struct ContinuumMaterial {
  double young_modulus = 0.0, poisson_ratio = 0.0;  ///< plane moduli
  double density = 0.0;                             ///< bulk, kg/m3
  double wave_speed(Wave wave, bool periodic) const;  ///< bar, shear or P
};

struct FemCase {
  std::string id;
  double length = 0.0, width = 0.0;
  std::array<int, 2> elements{66, 8};
  std::string mesh;  ///< file of a mesh instead of elements
  int degree = 4;
  ContinuumMaterial material;
  bool periodic = false;  ///< top and bottom
  Edge left = Edge::free, right = Edge::fixed_x;
  Load load;               ///< InitialPulse or Drive
  double column_spacing = 0.0;  ///< of the discs' columns, for the shape "column"
  /// exact: signals without error of time, whatever the step, which sets the samples alone.
  Integrator integrator = Integrator::exact;
  std::variant<StepFraction, StepSeconds> step = StepFraction{1.0};
  double end = 0.0;            ///< s
  std::int64_t sample_every = 1;
  int snapshots = 0;  ///< of all nodes, the last at the end; needs verlet
  std::vector<std::array<double, 2>> points;  ///< m, from the lower left corner
  std::vector<double> sections;               ///< m, from the left end
};

/// Fields of all nodes at a few times, on elements cut into quadrilaterals between their Gauss-Lobatto nodes.
struct FemFields {
  std::vector<double> x, y;         ///< of each point, m, from the lower left corner; nodes of periodic edges are two points
  std::vector<int> quadrilaterals;  ///< count x 4: points, anticlockwise
  std::vector<double> time;         ///< of the snapshots, s
  /// Snapshots x points: m, m/s, of strain the components of the tensor, Pa.
  std::vector<double> displacement_x, displacement_y, velocity_x, velocity_y;
  std::vector<double> strain_xx, strain_yy, strain_xy, stress_xx, stress_yy, stress_xy;
};

/// Each of these as files name it.
struct NamedFemField {
  const char *name, *unit;
  std::vector<double> FemFields::*values;
};
inline constexpr NamedFemField named_fem_fields[] = {
    {"displacement_x", "m", &FemFields::displacement_x}, {"displacement_y", "m", &FemFields::displacement_y},
    {"velocity_x", "m/s", &FemFields::velocity_x},       {"velocity_y", "m/s", &FemFields::velocity_y},
    {"strain_xx", "1", &FemFields::strain_xx},           {"strain_yy", "1", &FemFields::strain_yy},
    {"strain_xy", "1", &FemFields::strain_xy},           {"stress_xx", "Pa", &FemFields::stress_xx},
    {"stress_yy", "Pa", &FemFields::stress_yy},          {"stress_xy", "Pa", &FemFields::stress_xy}};

struct FemResult {
  std::string id;
  std::string status;  ///< "ok", or why the signals are not to be used
  int degree = 0;
  long dofs = 0, steps = 0;
  std::array<int, 2> elements{};
  double critical_time_step = 0.0, time_step = 0.0, sample_interval = 0.0, solve_seconds = 0.0;
  double energy_drift = 0.0;  ///< NaN where it was not measured
  std::vector<double> time;
  /// [receiver][sample]
  std::vector<std::vector<double>> point_ux, point_uy, section_ux, section_uy;
  FemFields fields;  ///< empty without snapshots
};

/// Runs all cases in one process of ddem-fem, which stands beside the running program; cases that are one problem in
/// other units are solved once (fem_reuse.h). `on_case` hears of each case that is finished. Throws MachineError if the program is missing or dies, SolverError if its output cannot be used.
std::vector<FemResult> run_fem(std::span<const FemCase> cases, const std::function<void()>& on_case = {}, std::int64_t threads = 1);

/// The plane moduli of a scene's continuum: [continuum] where given, else the static moduli of the assembly; for a bar the
/// Young's modulus and contraction of the very strip, for shear and P the directional stiffness.
ContinuumMaterial continuum_material(const Scene& scene, const std::optional<SceneModuli>& moduli, Wave wave);

}  // namespace ddem::harness
