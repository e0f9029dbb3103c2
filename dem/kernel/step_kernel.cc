// Compiled once per instruction set: see dem/CMakeLists.txt.
#include "dem/kernel/step_kernel.h"

namespace ddem::DDEM_ISA {
namespace {

/// Without rotation there are forces along the normals alone, to which every correction is the same.
template <class Kinematics, class Bond>
StepKernels choose_central_strain(const StepFeatures& f) {
  if (f.strain == StrainCoupling::none) return StepKernel<Kinematics, Bond, false, StrainCoupling::none>::kernels(f);
  return StepKernel<Kinematics, Bond, false, StrainCoupling::normal>::kernels(f);
}

template <class Kinematics, class Bond>
StepKernels choose_strain(const StepFeatures& f) {
  switch (f.strain) {
    case StrainCoupling::none: return StepKernel<Kinematics, Bond, true, StrainCoupling::none>::kernels(f);
    case StrainCoupling::normal: return StepKernel<Kinematics, Bond, true, StrainCoupling::normal>::kernels(f);
    case StrainCoupling::full: return StepKernel<Kinematics, Bond, true, StrainCoupling::full>::kernels(f);
    case StrainCoupling::normal_only_stress:
      return StepKernel<Kinematics, Bond, true, StrainCoupling::normal_only_stress>::kernels(f);
  }
  return {};
}

template <class Kinematics, class Bond>
StepKernels choose_rotation(const StepFeatures& f) {
  if constexpr (Kinematics::kLinear) {
    if (f.pulls) return StepKernel<Kinematics, Bond, false, StrainCoupling::normal, true>::kernels(f);
  }
  return f.rotation ? choose_strain<Kinematics, Bond>(f) : choose_central_strain<Kinematics, Bond>(f);
}

template <class Kinematics>
StepKernels choose_bonds(const StepFeatures& f) {
  if (f.per_bond_stiffness) return choose_rotation<Kinematics, BondStiffness>(f);
  if constexpr (Kinematics::kLinear) {
    if (f.touching) return choose_rotation<Kinematics, UniformStiffness<TouchingBonds>>(f);
  }
  return choose_rotation<Kinematics, UniformStiffness<StretchedBonds>>(f);
}

}  // namespace

StepKernels choose(const StepFeatures& f) {
  return f.nonlinear ? choose_bonds<NonlinearKinematics>(f) : choose_bonds<LinearKinematics>(f);
}

}  // namespace ddem::DDEM_ISA
