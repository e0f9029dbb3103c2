#pragma once
// Case files for tests: a valid case to change by a key or two.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ddem::fem::test {

using Json = nlohmann::json;

inline constexpr double strip_length = 0.0165, strip_width = 0.002;

/// Heights differ from receiver to receiver: a plane wave must not care.
inline std::vector<double> receiver_places() {
  std::vector<double> x;
  for (int k = 0; k < 10; ++k) x.push_back(0.001 + 0.0013 * k);
  return x;
}

/// The Gaussian shear pulse between periodic edges.
inline Json shear_case(const std::string& id) {
  Json points = Json::array();
  for (const double x : receiver_places()) points.push_back({x, 0.1 * x});
  return {
      {"id", id},
      {"length", strip_length},
      {"width", strip_width},
      {"elements", {66, 8}},
      {"degree", 4},
      {"young_modulus", 1e10},
      {"poisson_ratio", 0.3},
      {"density", 1700.0},
      {"plane", "stress"},
      {"top_bottom", "periodic"},
      {"right", "fixed_x"},
      {"left", "free"},
      {"initial",
       {{"wave", "shear"}, {"shape", "gaussian"}, {"amplitude", 1e-6}, {"width", 3e-4}, {"center", 3e-3}}},
      {"drive", nullptr},
      {"time", {{"step_fraction", 0.1}, {"end", 7.5e-6}}},
      {"receivers", {{"points", points}, {"sections", receiver_places()}}},
      {"sample_every", 4}};
}

/// The same pulse along x in the free bar without lateral contraction, where it is plane, too.
inline Json bar_case(const std::string& id) {
  Json bar = shear_case(id);
  bar["poisson_ratio"] = 0.0;
  bar["top_bottom"] = "free";
  bar["initial"]["wave"] = "longitudinal";
  return bar;
}

inline std::string case_file(const std::vector<Json>& cases) {
  return Json{{"schema", 1}, {"cases", cases}}.dump();
}

}  // namespace ddem::fem::test
