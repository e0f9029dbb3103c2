#include "dem/assembly/particle_volume.h"

#include <numbers>

namespace ddem {

std::vector<double> particle_volumes(const Assembly& a, const DeformationParameters& deformation) {
  std::vector<double> volume = a.volume;
  if (deformation.volume == ParticleVolume::cell) {
    const double solid = solid_fraction(a);
    for (double& v : volume) v /= solid;
  }
  return volume;
}

double volume_over_square_radius(const Assembly& a, const DeformationParameters& deformation) {
  const double volume = std::numbers::pi * a.thickness;
  return deformation.volume == ParticleVolume::cell ? volume / solid_fraction(a) : volume;
}

}  // namespace ddem
