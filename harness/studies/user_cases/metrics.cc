#include "harness/studies/user_cases/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "harness/studies/user_cases/user_case.h"
#include "harness/scene/nearest_name.h"

namespace ddem::harness {
namespace {

using std::string_view;

constexpr std::array kRun = {
    string_view("bonds"),         string_view("bulk_density"),           string_view("critical_time_step"),
    string_view("discs"),         string_view("energy_drift"),           string_view("good_pairs"),
    string_view("moving_density"), string_view("rattlers"),              string_view("steps"),
    string_view("time_step"),     string_view("wave_speed"),             string_view("wave_speed_by_centroid"),
    string_view("wave_speed_by_correlation"), string_view("wave_speed_stddev")};
constexpr std::array kStatic = {
    string_view("bar_velocity"),   string_view("bonds"),         string_view("bulk_density"),   string_view("bulk_modulus"),
    string_view("coordination"),   string_view("discs"),         string_view("moving_density"), string_view("p_velocity"),
    string_view("poisson_ratio"),  string_view("rattlers"),       string_view("shear_modulus"), string_view("shear_velocity"), string_view("solid_fraction"),
    string_view("young_modulus")};
constexpr std::array kFem = {
    string_view("analytical_speed"),  string_view("critical_time_step"),     string_view("degree"),
    string_view("density"),           string_view("dofs"),                   string_view("energy_drift"),
    string_view("good_pairs"),        string_view("poisson_ratio"),          string_view("steps"),
    string_view("time_step"),         string_view("wave_speed"),             string_view("wave_speed_by_centroid"),
    string_view("wave_speed_by_correlation"), string_view("wave_speed_stddev"), string_view("young_modulus")};
constexpr std::array kStability = {
    string_view("bonds"),
    string_view("critical_time_step"),
    string_view("dem_critical_time_step"),
    string_view("discs"),
    string_view("fixed_point_radius"),
    string_view("fixed_point_radius_limit"),
    string_view("largest_stable_softness"),
    string_view("largest_stable_softness_at_step"), string_view("largest_stable_softness_at_step_at_most"), string_view("slowest_growth_per_step"), string_view("steps_needed"),
    string_view("largest_stable_step_fraction"),
    string_view("softness"),
    string_view("step_fraction"),
    string_view("time_step")};

string_view name_of(string_view metric, string_view group) {
  return group.empty() ? metric : metric.substr(group.size() + 1);
}

bool is_one_of(string_view name, std::initializer_list<string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of what is measured between pairs of probes.
MetricProblem problem_of_speed(string_view name, const Scene& scene) {
  const auto* pulse = std::get_if<InitialPulse>(&scene.load);
  const auto* pairs = std::get_if<ProbePairs>(&scene.probes);
  if (pulse == nullptr && !std::holds_alternative<Drive>(scene.load))
    return {"a start from files has no pulse whose speed is known", "use a pulse in [initial], or [drive]"};
  if (pairs == nullptr) return {"is measured between pairs of probes, and the scene names discs or points", "use pairs in [probes]"};
  if (name == "wave_speed_by_centroid" && pulse != nullptr && pulse->shape == PulseShape::column)
    return {"a released column sends no pulse of known width", "judge wave_speed, or use another shape, or [drive]"};
  if (name == "wave_speed_stddev" && pairs->pairs < 2) return {"a single pair has no standard deviation", "use more pairs in [probes]"};
  return {};
}

/// Without an end, or with one that means something for discs alone.
MetricProblem problem_of_end(string_view group, const Scene& scene) {
  const bool waits = std::holds_alternative<UntilLastPeak>(scene.time.end);
  const bool has_peak = std::holds_alternative<ProbePairs>(scene.probes) && !std::holds_alternative<InitialState>(scene.load);
  if (waits && !has_peak) return {"without pairs of probes and a pulse there is no last peak to wait for", "give end in [time]"};
  const bool counts = std::holds_alternative<EndSteps>(scene.time.end) && !std::holds_alternative<StepSeconds>(scene.time.step);
  if (group == "fem" && counts) return {"steps are the discs', and the continuum has others", "give end, or step in seconds, in [time]"};
  return {};
}

MetricProblem problem_in_motion(string_view group, string_view name, const Scene& scene) {
  if (MetricProblem p = problem_of_end(group, scene); !p.message.empty()) return p;
  if (group == "fem" && std::holds_alternative<InitialState>(scene.load))
    return {"a start from files has no continuum counterpart", "use a pulse in [initial], or [drive]"};
  if (name.starts_with("wave_speed") || name == "good_pairs") return problem_of_speed(name, scene);
  if (group.empty() && name == "energy_drift" && scene.contact && scene.contact->kinematics == Kinematics::nonlinear)
    return {"nonlinear kinematics has no energy that leapfrog conserves", "use kinematics = \"linear\""};
  return {};
}

MetricProblem problem_in_statics(string_view name, const Scene& scene) {
  const bool closes = scene.assembly.periodic.y || !std::holds_alternative<FilePacking>(scene.assembly.packing);
  if (!closes && is_one_of(name, {"bulk_modulus", "p_velocity", "poisson_ratio", "shear_modulus", "shear_velocity", "young_modulus"}))
    return {"a free packing from a file can only be pulled", "judge static.bar_velocity, or use top_bottom = \"periodic\""};
  return {};
}

MetricProblem problem_in_stability(string_view name, const Scene& scene) {
  const bool lagged = scene.deformation && scene.deformation->scheme == Scheme::lagged;
  if (!scene.deformation && is_one_of(name, {"fixed_point_radius", "softness"})) return {"plain DEM has no strains of discs", "use [deformation]"};
  if (!lagged && is_one_of(name, {"fixed_point_radius_limit", "largest_stable_softness", "largest_stable_softness_at_step"}))
    return {"only lagged strains set a limit", "use scheme = \"lagged\""};
  return {};
}

}  // namespace

std::span<const string_view> metrics_of(string_view group) {
  if (group == "static") return kStatic;
  if (group == "fem") return kFem;
  if (group == "stability") return kStability;
  return kRun;
}

MetricProblem problem_of_metric(const std::string& metric) {
  const std::optional<std::string> group = group_of(metric);
  if (!group) {
    return {"no prefix of a command", "give a number of ddem run --json, such as \"wave_speed\", or of ddem moduli, fem, stability as "
                                      "\"static.\", \"fem.\", \"stability.\" and its name"};
  }
  const string_view name = name_of(metric, *group);
  const auto names = metrics_of(*group);
  if (std::find(names.begin(), names.end(), name) != names.end()) return {};
  if (is_one_of(name, {"wall_seconds", "solve_seconds", "nanoseconds_per_bond_step"}))
    return {"no two runs take the same time", "judge what is computed; ddem history compares wall times"};
  const std::string prefix = group->empty() ? "" : *group + ".";
  if (const auto near = nearest_name(name, names)) return {"no such number", fmt::format("did you mean {}{}?", prefix, *near)};
  return {"no such number", fmt::format("there are {}{}", prefix, fmt::join(names, ", " + prefix))};
}

Dimension dimension_of_metric(const std::string& metric) {
  const auto ends = [&](string_view end) { return metric.ends_with(end); };
  if (metric.find("wave_speed") != std::string::npos || ends("_velocity") || ends("_speed")) return Dimension::velocity;
  if (ends("_modulus")) return Dimension::stress;
  if (ends("density")) return Dimension::density;
  if (ends("time_step")) return Dimension::time;
  return Dimension::none;
}

MetricProblem problem_of_metric(const std::string& metric, const Scene& scene) {
  const std::string group = group_of(metric).value();
  const string_view name = name_of(metric, group);
  if (group == "static") return problem_in_statics(name, scene);
  if (group == "stability") return problem_in_stability(name, scene);
  return problem_in_motion(group, name, scene);
}

}  // namespace ddem::harness
