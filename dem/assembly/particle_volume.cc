#include "dem/assembly/particle_volume.h"

#include <numbers>

namespace ddem {
namespace {

/// Rattlers leave voids behind: the cells of the others fill the assembly.
double network_fraction(const Assembly& a) { return moving_density(a) / a.density; }

}  // namespace

std::vector<double> particle_volumes(const Assembly& a, const DeformationParameters& deformation) {
  std::vector<double> volume = a.volume;
  if (deformation.volume == ParticleVolume::cell) {
    const double solid = network_fraction(a);
    for (double& v : volume) v /= solid;
  }
  return volume;
}

double volume_over_square_radius(const Assembly& a, const DeformationParameters& deformation) {
  const double volume = std::numbers::pi * a.thickness;
  return deformation.volume == ParticleVolume::cell ? volume / network_fraction(a) : volume;
}

}  // namespace ddem
