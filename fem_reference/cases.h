#pragma once
// The case file of ddem-fem: {"schema": 1, "cases": [...]}, SI units, all that the program does.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem_reference/kernel/material.h"

namespace ddem::fem {

/// Everything wrong with a case file, one problem a line, each naming case and key.
class CaseError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

enum class Wave { longitudinal, shear };
enum class Shape { column, cosine, gaussian, standing };
enum class Field { displacement, velocity };
enum class End { free, fixed_x, fixed };
/// How the receivers' signals follow from the states of the leapfrog: they are the states, with the error of its
/// step, or a filter of them that is exact in time (dem/core/time_filter.h).
enum class Integrator { verlet, exact };

/// Displacement at rest, or velocity without displacement, at t = 0: its x (longitudinal) or y component (shear) as
/// a function of s, the distance from the left end.
///   column    amplitude max(0, 1 - s/spacing): the linear interpolant of a displaced first column of discs
///   cosine    amplitude/2 (1 + cos(pi s/width)) for s < width
///   gaussian  amplitude exp(-(s - center)^2/(2 width^2))
///   standing  the symmetric standing wave of a strip with free edges (Rayleigh and Lamb) that has `half_waves` half
///             waves along the length and moves with frequency pi half_waves phase_speed/length: both components.
///             The caller knows the phase speed; both ends must be fixed_x, which is the wave's own symmetry.
struct InitialPulse {
  Wave wave = Wave::longitudinal;
  Shape shape = Shape::gaussian;
  Field field = Field::displacement;
  double amplitude = 0.0;    ///< m, or m/s
  double width = 0.0;        ///< m; cosine, gaussian
  double center = 0.0;       ///< m; gaussian
  double spacing = 0.0;      ///< m; column
  unsigned half_waves = 0;   ///< standing
  double phase_speed = 0.0;  ///< m/s; standing
};

/// Prescribed motion of one component of the left edge: amplitude sin^2(pi t/duration) up to `duration`, held
/// at 0 after it. The other component is free: a bar contracts laterally at its end as it does everywhere
/// else (a fixed uy would clamp it), and a plane shear wave has no ux to hold.
struct EdgeDrive {
  Wave wave = Wave::longitudinal;
  double duration = 0.0;   ///< s
  double amplitude = 0.0;  ///< m
};

struct TimeSpan {
  Integrator integrator = Integrator::verlet;
  /// The step in s, or as a fraction of the critical one. verlet: above that the run blows up. exact: what sample_every
  /// and steps count in, while the states are marched with the largest stable step.
  std::optional<double> step;
  double step_fraction = 0.0;  ///< instead of step
  std::optional<double> end;           ///< s; the last step is the first that reaches it
  std::optional<std::uint64_t> steps;  ///< instead of end
};

struct Receivers {
  std::vector<std::array<double, 2>> points;  ///< m, from the lower left corner
  std::vector<double> sections;               ///< x in m: average over the height
};

struct StripCase {
  std::string id;
  double length = 0.0, width = 0.0;  ///< m
  /// Along length and width, of equal rectangles; or the .msh file of a mesh of that length and width.
  std::array<unsigned, 2> elements{};
  std::filesystem::path mesh;
  int degree = 0;
  double young_modulus = 0.0, poisson_ratio = 0.0, density = 0.0;
  Plane plane = Plane::stress;
  bool periodic = false;  ///< top and bottom
  End left = End::free;  ///< free under a drive
  End right = End::free;
  std::optional<InitialPulse> initial;
  std::optional<EdgeDrive> drive;
  TimeSpan time;
  Receivers receivers;
  std::uint64_t sample_every = 1;  ///< steps between samples
  std::uint64_t snapshots = 0;     ///< of all nodes at equal intervals, the last at the end; with verlet alone
};

/// Empty, or that so many elements are more than one process can hold.
std::string excess_of(double elements, int degree);

/// Throws CaseError listing every problem: unknown and missing keys, wrong types, impossible values.
std::vector<StripCase> parse_cases(const std::string& text);

/// The same from a file. Throws CaseError, also if the file cannot be read.
std::vector<StripCase> read_cases(const std::filesystem::path& file);

}  // namespace ddem::fem
