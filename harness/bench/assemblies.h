#pragma once
// What is timed: a lattice of equal discs or a random packing, and the contact laws and schemes by name.

#include <array>
#include <string>
#include <vector>

#include "dem/simulation/simulation.h"

namespace ddem::harness::bench {

inline constexpr double kRadius = 0.132e-3, kDensity = 2000.0, kNormalStiffness = 1e10, kShearRatio = 0.25;
inline constexpr double kSoftness = 0.25, kDiscPoisson = 0.3;  ///< k_n/E_p, nu_p

enum class Arrangement { lattice, random };

/// "lattice", "random".
std::string name_of(Arrangement arrangement);

struct Law {
  std::string name;
  ContactParameters contact;
  DeformationParameters deformation;
};

/// Plain DEM, lagged and implicit strains (F), without and with shear stiffness. `per_bond`: k_n read from an array of
/// one value a bond, all of them the same here, so that the motion is that of the uniform one.
Law rigid(bool shear, bool per_bond = false);
Law deformable(Scheme scheme, bool shear = true, bool per_bond = false);

/// Touching discs, close-packed rows along x, so many a row; `periodic` in both directions.
ddem::Assembly lattice(int columns, int rows, bool periodic = false, double radius = kRadius);

/// About so many discs: the strip of the paper, or one five times as long as wide. Random ones are as large on average as those of the
/// lattice and have 5.8 bonds each away from the edges; they are jammed first where the user's cache has not their cell.
ddem::Assembly strip_of(Arrangement arrangement, std::size_t discs);

/// Columns and rows of about so many discs, five times as long as wide.
std::array<int, 2> lattice_size(std::size_t discs);

/// Length and width (m) of a random strip of so many discs: the paper's, or five times as long as wide.
std::array<double, 2> random_size(std::size_t discs);

/// A step of this fraction of the critical one without shear stiffness, 2/sqrt(6) sqrt(m/k_n) (theory section 3).
double lattice_step(double fraction);
/// The same of the lightest disc.
double step_of(const ddem::Assembly& assembly, double fraction);

/// A smooth displacement everywhere: arithmetic on zeros or subnormal numbers takes other times.
ddem::InitialState smooth_state(const ddem::Assembly& assembly);

}  // namespace ddem::harness::bench
