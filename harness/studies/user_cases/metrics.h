#pragma once
// Which numbers a case can ask for: known before anything is run.

#include <span>
#include <string>
#include <string_view>

#include "harness/scene/scene.h"
#include "harness/scene/units.h"

namespace ddem::harness {

/// All of a group (see group_of()), by the names of `ddem run --json`, `moduli`, `fem`, `stability`. Wall times are none.
std::span<const std::string_view> metrics_of(std::string_view group);

struct MetricProblem {
  std::string message, remedy;  ///< message empty: none
};

/// Of a name alone: no prefix of ours, no such number.
MetricProblem problem_of_metric(const std::string& metric);

/// Of a known metric.
Dimension dimension_of_metric(const std::string& metric);

/// Of a known metric with a scene that can never have it. (What fails to be measured is found when it is run.)
MetricProblem problem_of_metric(const std::string& metric, const Scene& scene);

}  // namespace ddem::harness
