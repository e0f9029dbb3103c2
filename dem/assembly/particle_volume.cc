#include "dem/assembly/particle_volume.h"

namespace ddem {

std::vector<double> particle_volumes(const Assembly& a, const DeformationParameters& deformation) {
  std::vector<double> volume = a.volume;
  if (deformation.volume == ParticleVolume::cell) {
    const double solid = solid_fraction(a);
    for (double& v : volume) v /= solid;
  }
  return volume;
}

}  // namespace ddem
