#pragma once
// What discs and time steps do to a short pulse, before anything is run: its waves are slower, or faster, than long ones.

#include <optional>
#include <string>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "harness/run/wave_context.h"

namespace ddem::harness {

/// Shares of the static speed by which waves are faster (above 0) or slower than long ones.
struct PulseDispersion {
  double of_discs = 0.0, of_steps = 0.0;

  double total() const { return of_discs + of_steps; }
};

/// In a plane wave along x of wave number k bond b is stretched by 2 sin(k dx_b/2), dx_b its length along x, so that
///   omega^2 ~ sum_b w_b (2 sin(k dx_b/2))^2 = k^2 sum_b w_b dx_b^2 (1 - k^2 dx_b^2/12 + ...),
/// w_b = k_n n_x^2 + k_t t_x^2 (longitudinal) or k_n n_y^2 (shear). The phase speed is lower by the share
///   k^2 sum_b w_b dx_b^4 / (24 sum_b w_b dx_b^2);
/// this is the factor of k^2, m^2. With shear stiffness the discs of a shear wave turn by theta = beta du_y/dx besides, and a bond of
/// length L slips by 2 n_x sin(k dx/2) - beta k L cos(k dx/2) = k L (n_x^2 - beta - k^2 dx^2 (n_x^2/24 - beta/8)), beta such that
/// they meet no moment; their inertia adds beta^2 I/(2 m). Exact to second order for rigid discs of a lattice, whose columns
/// move as a whole; what uneven motion adds elsewhere is left out.
double dispersion_area(const ddem::Assembly& assembly, const ContactParameters& contact, Wave wave);

/// Of the wave whose phase speed the top of the pulse has, rad/s. A dispersion of third order moves a top by f''''/f'':
/// a squared sine's by (pi/half width)^2, a gaussian's by 3/width^2. None of a released column, which has no width.
std::optional<double> pulse_frequency(const Scene& scene, const WaveContext& context);

/// At the pulse's frequency and the context's speed. Leapfrog adds (omega dt)^2/24: sin(omega dt/2) = omega_0 dt/2.
std::optional<PulseDispersion> pulse_dispersion(const Scene& scene, const ddem::Assembly& assembly, const WaveContext& context);

/// Where that is more than 0.35 %: by how much, and how long a pulse must be for less than 0.1 %.
std::optional<std::string> dispersion_warning(const Scene& scene, const ddem::Assembly& assembly, const WaveContext& context);

}  // namespace ddem::harness
