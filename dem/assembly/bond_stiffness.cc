#include "dem/assembly/bond_stiffness.h"

namespace ddem {

double normal_stiffness(const ContactParameters& contact, double r_i, double r_j) {
  return contact.uniform() ? contact.normal_stiffness : contact.contact_modulus * 2.0 * r_i * r_j / (r_i + r_j);
}

std::vector<double> normal_stiffnesses(const Assembly& a, const ContactParameters& contact) {
  std::vector<double> k_n(a.bonds.size(), contact.normal_stiffness);
  if (contact.uniform()) return k_n;
  for (std::size_t c = 0; c < k_n.size(); ++c) {
    k_n[c] = normal_stiffness(contact, a.packing.radius[a.bonds.i[c]], a.packing.radius[a.bonds.j[c]]);
  }
  return k_n;
}

}  // namespace ddem
