// The one loop over bonds. Compiled once per instruction set (DDEM_ISA names the namespace), always with the same bits:
// no contraction, no reassociation. Include only from step_kernel.cc.
//
// Per slice of eight discs: gather the neighbours' motion, form the overlaps of a bond, correct them by the particle
// strains, apply the law, sum the force, moment and stress of each disc; then kick and drift (leapfrog).
//
// Implicit strains solve (V C + S K G) eps = S K C u (theory section 3). With T = (V C)^-1 S K G, whose eigenvalues lie
// in [0, rho], that is (1 + T) eps = (V C)^-1 S K C u =: f, solved by a fixed number of Chebyshev iterations from zero:
// a polynomial of T, so that the effective stiffness is as symmetric as S K G, and conserves its energy exactly.
// What a run does not use is not compiled into its kernel (if constexpr on the template parameters).

#include <cmath>

#include "dem/kernel/step_data.h"

namespace ddem::DDEM_ISA {
namespace {

constexpr int kWidth = 8;  // kLanes

struct Pack {
  alignas(64) double v[kWidth];
  double operator[](int l) const { return v[l]; }
  double& operator[](int l) { return v[l]; }
};

/// Overlaps of one bond and the current normal and arms.
struct BondState {
  double nx, ny, arm_own, arm_other;
  double u_n, u_t;
};

/// theory section 1: small displacement, the geometry of the start.
struct LinearKinematics {
  template <bool kRotation>
  static BondState overlaps(const StepData& d, int k, double dx, double dy, double theta_own, double theta_other) {
    BondState b{d.nx[k], d.ny[k], d.arm_own[k], d.arm_other[k], 0.0, 0.0};
    b.u_n = b.nx * dx + b.ny * dy;
    // The sum of the two rotations first: symmetric in the two ends, so both ends of a bond get the same bits.
    if constexpr (kRotation) b.u_t = (b.nx * dy - b.ny * dx) - (b.arm_own * theta_own + b.arm_other * theta_other);
    return b;
  }
};

/// Current geometry; the slip is summed from step to step along the current tangent:
/// du_t = L (d alpha - d(w_i theta_i + w_j theta_j)), alpha the angle of the bond, w = a / L.
struct NonlinearKinematics {
  template <bool kRotation>
  static BondState overlaps(const StepData& d, int k, double dx, double dy, double theta_own, double theta_other) {
    const double l0 = d.length[k], x0 = l0 * d.nx[k], y0 = l0 * d.ny[k];
    const double x = x0 + dx, y = y0 + dy, l = std::sqrt(x * x + y * y);
    const double stretch = l / l0;
    BondState b{x / l, y / l, d.arm_own[k] * stretch, d.arm_other[k] * stretch, 0.0, 0.0};
    // L - L0 without the cancellation.
    b.u_n = (2.0 * (x0 * dx + y0 * dy) + (dx * dx + dy * dy)) / (l + l0);
    if constexpr (kRotation) {
      const double px = x0 + d.previous_dx[k], py = y0 + d.previous_dy[k], pl = std::sqrt(px * px + py * py);
      const double sine = (px * (dy - d.previous_dy[k]) - py * (dx - d.previous_dx[k])) / (pl * l);
      // asin to the fifth power: a step turns a bond by far less than 1e-2, where the rest is below 1e-15 of it.
      const double s2 = sine * sine;
      const double turn = sine * (1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0)));
      const double rotation = (d.arm_own[k] * theta_own + d.arm_other[k] * theta_other) / l0;
      d.slip[k] += 0.5 * (l + pl) * (turn - (rotation - d.previous_rotation[k]));
      d.previous_dx[k] = dx;
      d.previous_dy[k] = dy;
      d.previous_rotation[k] = rotation;
      b.u_t = d.slip[k];
    }
    return b;
  }
};

struct Strain {
  double xx, yy, xy;
};

/// a n.eps.n and a t.eps.n: what a disc's uniform strain adds to the overlaps.
inline double normal_part(const Strain& e, double nx, double ny) {
  return nx * nx * e.xx + ny * ny * e.yy + 2.0 * (nx * ny) * e.xy;
}
inline double tangential_part(const Strain& e, double nx, double ny) {
  return nx * ny * (e.yy - e.xx) + (nx * nx - ny * ny) * e.xy;
}

template <class Kinematics, bool kRotation, StrainCoupling kStrain>
struct StepKernel {
  static constexpr bool kDeformable = kStrain != StrainCoupling::none;

  struct Sums {
    Pack fx{}, fy{}, moment{}, sxx{}, syy{}, sxy{};
  };

  /// The one loop over bonds: bond(k, p, l, sums) for each bond k of disc p in lane l, then disc(p, l, sums).
  template <class Bond, class Disc>
  static void for_slices(const StepData& d, int begin, int end, Bond bond, Disc disc) {
    for (int slice = begin; slice < end; ++slice) {
      const int first = slice * kWidth;
      Sums sum;
      for (int row = d.row_begin[slice]; row < d.row_begin[slice + 1]; ++row) {
#pragma GCC ivdep
        for (int l = 0; l < kWidth; ++l) bond(row * kWidth + l, first + l, l, sum);
      }
#pragma GCC ivdep
      for (int l = 0; l < kWidth; ++l) disc(first + l, l, sum);
    }
  }

  static BondState rigid(const StepData& d, int k, int p) {
    const int q = d.neighbour[k];
    const double theta_own = kRotation ? d.theta[p] : 0.0, theta_other = kRotation ? d.theta[q] : 0.0;
    return Kinematics::template overlaps<kRotation>(d, k, d.ux[q] - d.ux[p], d.uy[q] - d.uy[p], theta_own, theta_other);
  }

  static Strain strain_of(const StepData& d, int p) { return {d.exx[p], d.eyy[p], d.exy[p]}; }

  static void correct(const StepData& d, int k, int p, BondState& b) {
    if constexpr (kDeformable) {
      const Strain own = strain_of(d, p), other = strain_of(d, d.neighbour[k]);
      b.u_n -= b.arm_own * normal_part(own, b.nx, b.ny) + b.arm_other * normal_part(other, b.nx, b.ny);
      if constexpr (kRotation && kStrain == StrainCoupling::full) {
        b.u_t -= b.arm_own * tangential_part(own, b.nx, b.ny) + b.arm_other * tangential_part(other, b.nx, b.ny);
      }
    }
  }

  /// Force and moment on the disc, or the stress in it, or both.
  template <bool kForce, bool kStress>
  static void add(const StepData& d, const BondState& b, int l, Sums& sum) {
    const double f_n = d.normal_stiffness * b.u_n;
    double fx = f_n * b.nx, fy = f_n * b.ny;
    if constexpr (kStress && (!kRotation || kStrain == StrainCoupling::normal_only_stress)) add_stress(b, fx, fy, l, sum);
    if constexpr (kRotation) {
      const double f_t = d.shear_stiffness * b.u_t;
      fx -= f_t * b.ny;
      fy += f_t * b.nx;
      if constexpr (kForce) sum.moment[l] += b.arm_own * f_t;
      if constexpr (kStress && kStrain != StrainCoupling::normal_only_stress) add_stress(b, fx, fy, l, sum);
    }
    if constexpr (kForce) {
      sum.fx[l] += fx;
      sum.fy[l] += fy;
    }
  }

  /// V_p sigma_p = sum_c s_c (x) F_c, symmetrised, s_c = a n.
  static void add_stress(const BondState& b, double fx, double fy, int l, Sums& sum) {
    const double sx = b.arm_own * b.nx, sy = b.arm_own * b.ny;
    sum.sxx[l] += sx * fx;
    sum.syy[l] += sy * fy;
    sum.sxy[l] += 0.5 * (sx * fy + sy * fx);
  }

  /// eps_p = D : sigma_p.
  static Strain strain_from(const StepData& d, int p, int l, const Sums& sum) {
    const double w = d.inverse_volume[p];
    const double sxx = w * sum.sxx[l], syy = w * sum.syy[l], sxy = w * sum.sxy[l];
    return {d.compliance_direct * sxx + d.compliance_coupling * syy, d.compliance_coupling * sxx + d.compliance_direct * syy,
            d.compliance_shear * sxy};
  }

  static void relax_strain(const StepData& d, int p, const Strain& e) {
    d.exx_next[p] = d.keep_strain * d.exx[p] + d.new_strain * e.xx;
    d.eyy_next[p] = d.keep_strain * d.eyy[p] + d.new_strain * e.yy;
    d.exy_next[p] = d.keep_strain * d.exy[p] + d.new_strain * e.xy;
  }

  static void kick_and_drift(const StepData& d, int p, int l, const Sums& sum) {
    d.vx[p] += d.kick_x[p] * sum.fx[l];
    d.vy[p] += d.kick_y[p] * sum.fy[l];
    d.ux_next[p] = d.ux[p] + d.dt * d.vx[p];
    d.uy_next[p] = d.uy[p] + d.dt * d.vy[p];
    if constexpr (kRotation) {
      d.omega[p] += d.kick_theta[p] * sum.moment[l];
      d.theta_next[p] = d.theta[p] + d.dt * d.omega[p];
    }
  }

  /// Forces from the strains at hand; lagged: and from these forces the strains to come.
  template <bool kLagged>
  static void step(const StepData& data, int begin, int end) {
    const StepData d = data;  // pointers in registers: no store can change them
    for_slices(
        d, begin, end,
        [&d](int k, int p, int l, Sums& sum) {
          BondState b = rigid(d, k, p);
          correct(d, k, p, b);
          add<true, kLagged>(d, b, l, sum);
        },
        [&d](int p, int l, const Sums& sum) {
          kick_and_drift(d, p, l, sum);
          if constexpr (kLagged) relax_strain(d, p, strain_from(d, p, l, sum));
        });
  }

  static void evaluate(const StepData& data, int begin, int end) {
    const StepData d = data;
    for_slices(
        d, begin, end,
        [&d](int k, int p, int l, Sums& sum) {
          BondState b = rigid(d, k, p);
          correct(d, k, p, b);
          add<false, true>(d, b, l, sum);
        },
        [&d](int p, int l, const Sums& sum) { relax_strain(d, p, strain_from(d, p, l, sum)); });
  }

  /// f = (V C)^-1 S K C u, and the first approximation f / theta, theta the middle of the spectrum of 1 + T.
  static void source(const StepData& data, int begin, int end) {
    const StepData d = data;
    for_slices(
        d, begin, end, [&d](int k, int p, int l, Sums& sum) { add<false, true>(d, rigid(d, k, p), l, sum); },
        [&d](int p, int l, const Sums& sum) {
          const Strain f = strain_from(d, p, l, sum);
          d.source_xx[p] = f.xx;
          d.source_yy[p] = f.yy;
          d.source_xy[p] = f.xy;
          d.exx_next[p] = d.change_xx[p] = d.first_weight * f.xx;
          d.eyy_next[p] = d.change_yy[p] = d.first_weight * f.yy;
          d.exy_next[p] = d.change_xy[p] = d.first_weight * f.xy;
        });
  }

  /// The residual f - eps - T eps, and the next approximation. Overlaps of strains alone are -G eps, so their stress
  /// gives -T eps.
  static void iterate(const StepData& data, int begin, int end) {
    const StepData d = data;
    for_slices(
        d, begin, end,
        [&d](int k, int p, int l, Sums& sum) {
          BondState b{d.nx[k], d.ny[k], d.arm_own[k], d.arm_other[k], 0.0, 0.0};
          correct(d, k, p, b);
          add<false, true>(d, b, l, sum);
        },
        [&d](int p, int l, const Sums& sum) {
          const Strain minus_t = strain_from(d, p, l, sum);
          const auto next = [&](double source, double minus_te, double e, double* change) {
            *change = d.change_weight * *change + d.residual_weight * ((source - e) + minus_te);
            return e + *change;
          };
          d.exx_next[p] = next(d.source_xx[p], minus_t.xx, d.exx[p], &d.change_xx[p]);
          d.eyy_next[p] = next(d.source_yy[p], minus_t.yy, d.eyy[p], &d.change_yy[p]);
          d.exy_next[p] = next(d.source_xy[p], minus_t.xy, d.exy[p], &d.change_xy[p]);
        });
  }

  static StepKernels kernels(bool implicit) {
    if constexpr (kDeformable) {
      if (implicit) return {&step<false>, nullptr, &source, &iterate};
      return {&step<true>, &evaluate, nullptr, nullptr};
    }
    return {&step<false>, nullptr, nullptr, nullptr};
  }
};

template <class Kinematics, bool kRotation>
StepKernels choose_strain(const StepFeatures& f) {
  switch (f.strain) {
    case StrainCoupling::none: return StepKernel<Kinematics, kRotation, StrainCoupling::none>::kernels(false);
    case StrainCoupling::normal: return StepKernel<Kinematics, kRotation, StrainCoupling::normal>::kernels(f.implicit);
    case StrainCoupling::full: return StepKernel<Kinematics, kRotation, StrainCoupling::full>::kernels(f.implicit);
    case StrainCoupling::normal_only_stress:
      return StepKernel<Kinematics, kRotation, StrainCoupling::normal_only_stress>::kernels(f.implicit);
  }
  return {};
}

template <class Kinematics>
StepKernels choose_rotation(const StepFeatures& f) {
  return f.rotation ? choose_strain<Kinematics, true>(f) : choose_strain<Kinematics, false>(f);
}

}  // namespace

StepKernels choose(const StepFeatures& f) {
  return f.nonlinear ? choose_rotation<NonlinearKinematics>(f) : choose_rotation<LinearKinematics>(f);
}

}  // namespace ddem::DDEM_ISA
