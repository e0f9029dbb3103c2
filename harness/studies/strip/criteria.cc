#include "harness/studies/strip/criteria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ddem::harness {

using reports::Criterion;
using reports::State;

std::string title_of(const StripMaterial& key, const std::string& what) {
  return fmt::format("{}, {}, k_t/k_n = {:g}", what, name(key.model), key.stiffness_ratio);
}

std::string case_id(const std::string& kind, const StripMaterial& key) {
  return fmt::format("{}/{}", kind, material_slug(key.model, key.stiffness_ratio));
}

double widened(double tolerance, std::size_t seeds) { return tolerance * std::sqrt(std::max(1.0, 6.0 / static_cast<double>(seeds))); }

Criterion judge(const std::string& metric, std::optional<double> actual, const Bounds& b,
                const std::string& unit, const std::string& derivation) {
  Criterion c{.metric = metric,
              .target = b.target,
              .lower = b.lower,
              .upper = b.upper,
              .unit = unit,
              .derivation = derivation};
  if (actual && std::isfinite(*actual)) {
    c.actual = *actual;
    c.state = *actual >= b.lower && *actual <= b.upper ? State::pass : State::fail;
  }
  return c;
}

void conclude(reports::Verdict& v) {
  v.state = State::pass;
  for (const State worse : {State::fail, State::error}) {
    for (const Criterion& c : v.criteria) {
      if (c.state == worse) v.state = worse;
    }
  }
}

void conclude_study(reports::Verdict& v) {
  conclude(v);
  if (!v.reason.empty()) v.state = State::error;
}

}  // namespace ddem::harness
