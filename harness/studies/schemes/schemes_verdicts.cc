#include "harness/studies/schemes/schemes_verdicts.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "harness/studies/strip/criteria.h"

namespace ddem::harness {

using reports::Verdict;

/// What the schemes are chosen by: energy, order in the step, reach.
Verdict energy_verdict(const SchemeStudy& study) {
  Verdict v{.case_id = "schemes/energy", .title = "Energy over 10000 steps", .reason = study.failure};
  for (const EnergyCurve& c : study.energy) {
    const bool gradients = c.scheme.ends_with("gradients");
    if (c.scheme.starts_with("lagged")) continue;
    v.criteria.push_back(judge(fmt::format("energy drift, {}", c.scheme), c.drift, {0.0, 0.0, gradients ? 1e-3 : 1e-12}, "",
                               gradients ? "strains right to a residual of 1e-4" : "leapfrog with a symmetric stiffness conserves its invariant; round-off of 10000 steps"));
  }
  conclude_study(v);
  return v;
}

Verdict order_verdict(const SchemeStudy& study) {
  Verdict v{.case_id = "schemes/order", .title = "Order of the error in the time step", .reason = study.failure};
  for (const OrderCurve& c : study.order) {
    v.criteria.push_back(judge(fmt::format("order, {}", c.scheme), c.order, absolute(c.scheme == "lagged" ? 1.0 : 2.0, 0.1), "",
                               "leapfrog is of second order, a strain that is a step late of first; the next term at these steps is below a tenth"));
  }
  conclude_study(v);
  return v;
}

Verdict reach_verdict(const SchemeStudy& study) {
  Verdict v{.case_id = "schemes/reach", .title = "Poisson's ratio of the softest discs, implicit strains", .reason = study.failure};
  for (const ReachCurve& c : study.reach) {
    if (c.scheme != "implicit") continue;
    v.criteria.push_back(judge(fmt::format("Poisson's ratio at k_n/E_p = {:g}", c.points.back().softness), c.points.back().poisson,
                               absolute(c.points.back().closed_form, 0.003), "", "closed form of the lattice; dispersion of an 8 mm pulse as in the other runs"));
  }
  conclude_study(v);
  return v;
}

/// Hard discs are rigid ones. (Where soft ones lead is for the figure: no closed form holds for a random packing.)
Verdict range_verdict(const RangeStudy& study) {
  Verdict v{.case_id = "schemes/range", .title = "Range of Poisson's ratio, hardest discs against rigid ones", .reason = study.failure};
  const char* derivation = "at k_n/E_p = 0.01 the strains give at most (6/pi) 0.01 of the bonds' compliance, in bulk and shear by different parts";
  for (const RangeCurve& c : study.curves) {
    const auto add = [&](const char* end, double actual, double rigid) {
      v.criteria.push_back(judge(fmt::format("{}, nu_p = {:g}", end, c.particle_poisson_ratio), actual, absolute(rigid, 0.02), "", derivation));
    };
    add("highest", c.ranges.front().highest, study.rigid.highest);
    add("lowest", c.ranges.front().lowest, study.rigid.lowest);
  }
  conclude_study(v);
  return v;
}

std::string reach_finding(const SchemeStudy& study) {
  std::vector<std::string> reached;
  for (const ReachCurve& curve : study.reach) {
    const ReachPoint* best = nullptr;
    for (const ReachPoint& p : curve.points) {
      if (p.poisson && (best == nullptr || *p.poisson > *best->poisson)) best = &p;
    }
    if (best != nullptr) reached.push_back(fmt::format("{} {:.3f} (kₙ/Eₚ = {:g})", curve.scheme, *best->poisson, best->softness));
  }
  if (reached.empty()) return "";
  return fmt::format("The lattice of νₚ = {:g} without tangential stiffness reaches Poisson's ratios of 1/3 with rigid discs, with softer ones by scheme: {}.",
                     study.reach_poisson_ratio, fmt::join(reached, "; "));
}

}  // namespace ddem::harness
