#pragma once
// The lowest symmetric wave (S0, Rayleigh and Lamb) of a strip with free edges in plane elasticity: what the
// bar wave becomes at a wavelength that is not long against the width.

namespace ddem::references {

/// Speeds in units of the bar speed sqrt(E/rho).
struct LambSpeeds {
  double phase = 0.0, group = 0.0;
};

/// S0 at the wave number k of a strip of width W (kW from 1e-9 to 1e4), nu the plane Poisson's ratio, 0 <= nu
/// < 1 (plane stress: that of the material). With h = W/2, p^2 = (w/c_p)^2 - k^2, q^2 = (w/c_s)^2 - k^2 the
/// lowest root of
///   (q^2 - k^2)^2 cos(ph) sin(qh)/q + 4 k^2 p sin(ph) cos(qh) = 0
/// (Graff, Wave motion in elastic solids, section 8.1; multiplied out, so that it has no poles), by bisection
/// to the last bit. nu = 0: the uniaxial wave, both speeds 1 at every k. Throws std::invalid_argument outside
/// the range.
LambSpeeds lamb_s0(double wave_number_times_width, double poisson_ratio);

/// The part of the S0 wave in the mean u_x across the strip behind an end that is moved by u_x = 1 at every height and is
/// free to slide along y, at the phase speed c = lamb_s0(...).phase: mean(u_x) int s_xx dy / int (s_xx u_x - s_xy u_y) dy
/// of the mode's own shape, by the biorthogonality of the strip's modes (Fraser, J. Acoust. Soc. Am. 59 (1976)
/// 1025-1026). 1 for long waves; the rest goes into other modes, which do not travel below their cut-off frequencies.
/// kW up to 100, otherwise the range of lamb_s0; checked with a Fourier transform of finite-element runs to 5e-4.
double lamb_s0_share(double wave_number_times_width, double poisson_ratio, double phase_speed);

}  // namespace ddem::references
