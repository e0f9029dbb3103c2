#include "dem/assembly/bond_stiffness.h"

namespace ddem {

std::vector<double> normal_stiffnesses(const Assembly& a, const ContactParameters& contact) {
  std::vector<double> k_n(a.bonds.size(), contact.normal_stiffness);
  if (contact.uniform()) return k_n;
  for (std::size_t c = 0; c < k_n.size(); ++c) {
    const double r_i = a.packing.radius[a.bonds.i[c]], r_j = a.packing.radius[a.bonds.j[c]];
    k_n[c] = contact.contact_modulus * 2.0 * r_i * r_j / (r_i + r_j);
  }
  return k_n;
}

}  // namespace ddem
