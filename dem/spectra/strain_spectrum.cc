#include "dem/spectra/strain_spectrum.h"

#include "dem/spectra/gauss_quadrature.h"
#include "dem/spectra/scheme_stiffness.h"

namespace ddem {
namespace {

constexpr int kNodes = 12;

/// The energy of a deformation is e.K e - <f, (1 + T)^-1 f> in the inner product of V C_p, f = (V C_p)^-1 G^T K e: where the
/// stress takes shear forces too (N) these have no part in it.
ModeShares shares_of(const Operators& op, const StrainIteration& t, const Eigen::VectorXd& overlaps) {
  const Eigen::VectorXd forces = op.stiffness.cwiseProduct(overlaps);
  const Eigen::VectorXd f = t.lower_solve(op.strain_overlap.transpose() * forces);
  const Quadrature q = gauss_quadrature([&t](const Eigen::VectorXd& x) { return t.apply(x); }, f, kNodes);
  const Eigen::VectorXd given = f.squaredNorm() * q.weights;
  const double energy = overlaps.dot(forces) - (given.array() / (1.0 + q.nodes.array())).sum();
  ModeShares m;
  for (Eigen::Index k = 0; k < q.nodes.size(); ++k) {
    m.eigenvalue.push_back(q.nodes[k]);
    m.share.push_back(given[k] / energy);
  }
  return m;
}

}  // namespace

StrainSpectrum strain_spectrum(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation) {
  const Operators op = make_operators(a, contact, deformation);
  const StrainIteration t(op);
  StrainSpectrum s;
  s.radius = spectral_radius(t);
  for (const MacroStrain& e : {MacroStrain{1, 1, 0}, MacroStrain{1, -1, 0}, MacroStrain{0, 0, 1}}) {
    s.uniform.push_back(shares_of(op, t, affine_overlaps(a, op, e)));
  }
  return s;
}

}  // namespace ddem
