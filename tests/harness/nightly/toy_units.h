#pragma once
// Units that take no time, with results of every kind of value.

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "harness/nightly/run_units.h"
#include "harness/nightly/unit_file.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness::nightly {

inline nlohmann::json toy_result(std::size_t k) {
  const double x = static_cast<double>(k);
  std::vector<double> series;
  for (int n = 0; n < 50; ++n) series.push_back(std::sin(x + 0.1 * n));
  return {{"speed", 1000.0 / (1.0 + x)},
          {"none", nullptr},
          {"series", series},
          {"name", "unit " + std::to_string(k)},
          {"seconds", 0.5}};
}

/// `runs` counts how often each was run.
inline std::vector<Unit> toy_units(std::size_t count, std::vector<std::atomic<int>>* runs = nullptr) {
  std::vector<Unit> units;
  for (std::size_t k = 0; k < count; ++k) {
    units.push_back({"toy/kind-" + std::to_string(k % 3) + "/unit-" + std::to_string(k),
                     "inputs " + std::to_string(k), 1, [k, runs] {
                       if (runs != nullptr) ++(*runs)[k];
                       return toy_result(k);
                     }});
  }
  return units;
}

inline Plan toy_plan(const std::vector<Unit>& units) {
  return make_plan(units, Json{{"title", "toys"}}, "toy program 1");
}

/// By unit; outcomes as bytes, without wall times.
using Outcomes = std::map<std::size_t, std::string>;

inline std::string bytes_of(const Outcome& o) {
  std::string cbor;
  nlohmann::json::to_cbor(nlohmann::json{o.result, o.failure}, cbor);
  return cbor;
}

inline OnOutcome into(Outcomes& outcomes) {
  return [&outcomes](std::size_t k, const Outcome& o) {
    EXPECT_FALSE(outcomes.contains(k)) << k;
    outcomes[k] = bytes_of(o);
  };
}

inline Outcomes outcomes_of(const std::vector<Unit>& units, const RunOptions& options) {
  Outcomes outcomes;
  run_units(units, toy_plan(units), options, into(outcomes));
  return outcomes;
}

inline Outcomes outcomes_in(const std::filesystem::path& folder, const std::vector<Unit>& units) {
  Outcomes outcomes;
  read_outcomes(folder, toy_plan(units), into(outcomes));
  return outcomes;
}

}  // namespace ddem::harness::nightly
