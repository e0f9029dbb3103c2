#include "harness/campaign/study.h"
#include "harness/studies/strip/formulas.h"

namespace ddem::harness {
namespace {

reports::Table waves() {
  return {
      .caption = "Waves in the continuum. E, G, K, ν: plane constants, K + G the P modulus; ρ: bulk density.",
      .columns = {{"reference"}, {"formula"}, {"source"}, {"used for"}},
      .rows = {
          {"shear velocity", "c_s = √(G/ρ)", "plane elasticity", "velocities of shear runs; finite elements, shear (±1e-4)"},
          {"P velocity", "c_p = √((K + G)/ρ) = √(E/(ρ(1 − ν²)))", "plane elasticity", "velocities of P runs; finite elements, P (±1e-4)"},
          {"bar velocity", "c_b = √(E/ρ)", "plane elasticity; long waves in a strip with free edges",
           "velocities of bar runs; finite elements, bar: exact for ν = 0 (±1e-4)"},
          {"d'Alembert, released", "u(x, t) = [f(x − ct) + f(x + ct)]/2; f continued evenly about a free end, oddly about a fixed one",
           "d'Alembert's solution by images", "accuracy of the finite elements; work-precision"},
          {"d'Alembert, driven", "u(x, t) = Σₘ (−r)ᵐ [g(t − (2mL + x)/c) + r g(t − (2(m+1)L − x)/c)], r = 1 free, −1 fixed right end",
           "the same for u(0, t) = g(t)", "driven pulses of the finite elements (tests)"},
          {"Rayleigh-Lamb, S0",
           "(q² − k²)² cos(ph) sin(qh)/q + 4k² p sin(ph) cos(qh) = 0; p² = (ω/c_p)² − k², q² = (ω/c_s)² − k², h half the width",
           "Graff, Wave motion in elastic solids, section 8.1",
           "why bar pulses are up to 2 % slower than √(E/ρ); standing waves of the finite elements (tests)"},
          {"Poisson's ratio from speeds", "ν = 1 − 2 (c_s/c_p)² or ν = c_b²/(2c_s²) − 1", "from the three velocities",
           "ν measured: P and shear; the paper's protocol: bar and shear"}}};
}

reports::Table moduli() {
  return {
      .caption =
          "Moduli and motion of the discs. A: sum over bonds of k_n L² over the area, 2√3 k_n in the lattice; λ = k_t/k_n; φ: solid "
          "fraction; K_p, G_p, E_p, ν_p of the disc.",
      .columns = {{"reference"}, {"formula"}, {"source"}, {"used for"}},
      .rows = {{"closed form, DEM", "2K = A/2, 2G = A(1 + λ)/4; lattice: ν = (1 − λ)/(3 + λ)", "Bathurst and Rothenburg 1988; Luding 2004",
                "lattice: static moduli (±1e-10) and velocities (±0.2 %); random packings: the kinematic estimate"},
               {"closed form, DDEM", "2K = (A/2)/(1 + A/(2φ 2K_p)) for all variants",
                "mean particle stress φσ_p = σ in the scheme of Rojek et al. 2018", "the same"},
               {"", "N: 2G = [A(1 + λ)/4]/(1 + A/(4φ 2G_p))", "published correction", "the same"},
               {"", "F: 2G = [A(1 + λ)/4]/(1 + A(1 + λ)/(4φ 2G_p))", "full correction", "the same; reach of implicit strains"},
               {"static moduli", "C E = mean σ of the periodic cell in equilibrium under unit strains; P from C₁₁, shear from C₆₆",
                "homogenisation of the very assembly, sparse direct solve", "static velocities; material of the finite elements"},
               {"static speed of the free strip", "c = √(EA/(m/L)), EA: force over mean strain of the pulled strip",
                "static solve of the very strip", "velocities of bar runs"},
               {"limit of the lagged strains, lattice", "k_n/E_p < min(π/(6(1 − ν_p)), π/(3(1 + ν_p)c)); c = 1 (N), 1 + λ (F); N: λ ≤ 1/3",
                "spectral radius of K B below 1", "release from noise: expected to diverge or not"},
               {"plane waves of the lattice", "det(K(k) − ω² M) = 0 for one disc with three bonds", "Bloch's theorem",
                "order of the error in the time step; work-precision of discs"},
               {"critical step", "Δt = 2/ω_max, ω_max² the largest eigenvalue of M⁻¹K", "leapfrog; Lanczos", "time steps of all runs"},
               {"conserved energy", "E = vₙ₊½ᵀ M vₙ₊½/2 + uₙᵀ K uₙ₊₁/2", "invariant of the leapfrog", "energy drift"},
               {"states exact in time", "u(t) = J₀(2t/Δt) u₀ + 2 Σ J₂ₖ(2t/Δt) uₖ", "leapfrog states are Chebyshev polynomials of M⁻¹K",
                "signals of the finite elements"}}};
}

}  // namespace

reports::Section formulas_section() {
  return {
      .heading = "References and formulas",
      .paragraphs =
          {"What is measured is compared with formulas and static solves, not with finer runs of the same program. Tolerances and their "
           "derivation stand with each verdict."},
      .tables = {waves(), moduli()}};
}

namespace {

class FormulasStudy : public Study {
  std::vector<reports::Section> sections() const override { return {formulas_section()}; }
};

}  // namespace

std::unique_ptr<Study> make_formulas(const StudyContext&) {
  return std::make_unique<FormulasStudy>();
}

}  // namespace ddem::harness
