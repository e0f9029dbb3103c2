#include "harness/studies/statics/statics_verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/studies/strip/criteria.h"

namespace ddem::harness {
namespace {

using reports::Verdict;

constexpr double kStaticSpeed = 1e-10, kBlochLimit = 1e-7;  // relative, of the lattice's speeds

/// Without time steps.
void judge_lattice_speeds(const StaticOutcome& s, Verdict& v) {
  const auto add = [&](const char* metric, std::optional<double> speed, double closed, double tolerance,
                       const char* derivation) {
    v.criteria.push_back(judge(metric, speed, relative(closed, tolerance, tolerance), "m/s", derivation));
  };
  const auto unless_failed = [&](double speed) {
    return s.failure.empty() ? std::optional(speed) : std::nullopt;
  };
  const char* strip =
      "closed form; the strip is periodic in y, and its grips follow the affine motion, which is the "
      "lattice's own: a sparse "
      "solve in double precision reaches 1e-10";
  add("shear velocity, static", unless_failed(s.speeds.shear), s.kinematic_speeds.shear, kStaticSpeed, strip);
  add("P velocity, static", unless_failed(s.speeds.p), s.kinematic_speeds.p, kStaticSpeed, strip);
  const char* bloch =
      "closed form; omega/k at kr = 0.005 and 0.01, extrapolated: dispersion and round-off leave 1e-10 each, "
      "of the softest discs 2e-9 (see "
      "bloch_limit.cc)";
  add("shear velocity, Bloch limit", s.bloch ? std::optional(s.bloch->shear) : std::nullopt,
      s.kinematic_speeds.shear, kBlochLimit, bloch);
  add("P velocity, Bloch limit", s.bloch ? std::optional(s.bloch->p) : std::nullopt, s.kinematic_speeds.p,
      kBlochLimit, bloch);
}

/// Of the random packings' statics; empty where one has none.
template <class Value>
std::optional<std::vector<double>> of_all_seeds(const StripResults& r, StripMaterial key, Verdict& v,
                                                const Value& value) {
  std::vector<double> values;
  for (const std::int64_t seed : r.campaign.seeds) {
    key.seed = seed;
    const StaticOutcome* s = r.find(key);
    if (s == nullptr || !s->failure.empty()) {
      v.reason = fmt::format("seed {}: {}", seed, s == nullptr ? "not run" : s->failure);
      return std::nullopt;
    }
    values.push_back(value(*s));
  }
  return values;
}

/// Discs at a strip's ends lack bonds, and the box reaches to their rims: on the lattice of N columns 2/(3N)
/// and 1/(2N) of the sum over bonds per area, which the sections within do not lack.
double end_effect(const StripCampaign& s, const StaticOutcome& o) {
  const double diameter = 2.0 * std::sqrt(o.moduli.solid_fraction * s.length * s.width /
                                          (std::numbers::pi * static_cast<double>(o.moduli.discs)));
  return 7.0 / 6.0 * diameter / s.length;
}

/// At most 1 in every packing: the highest.
void judge_kinematic_bound(const StripResults& r, const StripMaterial& key, Verdict& v) {
  const auto end = of_all_seeds(r, key, v, [&](const StaticOutcome& s) { return end_effect(r.campaign, s); });
  const auto add = [&](const char* metric, double references::PlaneModuli::*bound,
                       double IsotropicModuli::*modulus) {
    const auto ratios = of_all_seeds(r, key, v, [&](const StaticOutcome& s) {
      return s.moduli.isotropic().value().*modulus / (s.kinematic.*bound);
    });
    v.criteria.push_back(judge(
        metric, ratios ? std::optional(*std::max_element(ratios->begin(), ratios->end())) : std::nullopt,
        {1.0, 0.0, 1.0 + (end ? end->front() : 0.0)}, "",
        "an equilibrium has the least energy, and all discs strained alike have more: for the bulk, and for "
        "the mean of the two shears, that of "
        "the closed form, in any fabric. The strip's ends lack bonds that its sections have: 7/6 of a disc "
        "over the length is allowed"));
  };
  add("highest bulk modulus over its kinematic bound", &references::PlaneModuli::bulk,
      &IsotropicModuli::bulk);
  add("highest shear modulus over its kinematic bound", &references::PlaneModuli::shear,
      &IsotropicModuli::shear);
}

}  // namespace

Verdict static_verdict(const StaticOutcome& s) {
  Verdict v{.case_id = case_id("static/hexagonal", s.key),
            .title = title_of(s.key, "Homogenised lattice against its closed form"),
            .reason = s.failure};
  const IsotropicModuli closed{s.kinematic.bulk, s.kinematic.shear};
  const char* derivation =
      "closed form of the infinite lattice; a sparse solve in double precision reaches 1e-10";
  const auto cell = s.cell;
  v.criteria = {judge("Young's modulus", cell ? std::optional(cell->young()) : std::nullopt,
                      relative(closed.young(), 1e-10, 1e-10), "Pa", derivation),
                judge("shear modulus", cell ? std::optional(cell->shear) : std::nullopt,
                      relative(closed.shear, 1e-10, 1e-10), "Pa", derivation),
                judge("Poisson's ratio", cell ? std::optional(cell->poisson()) : std::nullopt,
                      absolute(closed.poisson(), 1e-10), "", derivation)};
  judge_lattice_speeds(s, v);
  conclude(v);
  return v;
}

Verdict random_static_verdict(const StripResults& r, const StripMaterial& key) {
  Verdict v{
      .case_id = case_id("static/random", key),
      .title = title_of(key, fmt::format("Static moduli of {} random packings", r.campaign.seeds.size()))};
  // The published correction derives from no energy, so that nothing bounds it.
  if (key.model != Model::lagged_normal) judge_kinematic_bound(r, key, v);
  const double tolerance = widened(0.01, r.campaign.seeds.size());
  for (const StripWave wave : {StripWave::shear, StripWave::p}) {
    const auto errors = of_all_seeds(
        r, key, v, [&](const StaticOutcome& s) { return s.sections.of(wave) / s.speeds.of(wave) - 1.0; });
    v.criteria.push_back(
        judge(fmt::format("{} velocity between the sections over that of the whole packing", name(wave)),
              errors ? std::optional(sample_statistics(*errors).value) : std::nullopt,
              {0.0, -tolerance, tolerance}, "",
              "sections see two thirds of a packing, and speeds scatter by up to 1.5 % from one packing to "
              "the next: the part about the whole by "
              "sqrt(1/2) of that, the mean of six by 0.45 %; twice that is allowed"));
  }
  conclude(v);
  return v;
}

}  // namespace ddem::harness
