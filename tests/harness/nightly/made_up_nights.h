#pragma once
// Nights of a history whose outcome is known.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "harness/nightly/history.h"

namespace ddem::harness::nightly {

inline reports::Criterion band(const std::string& metric, double value) {
  return {.metric = metric, .actual = value, .target = 100.0, .lower = 90.0, .upper = 110.0, .unit = "m/s", .state = reports::State::pass};
}

/// Twelve metrics: "near its limit" at 9.5 of 10 every night; "jumps" by 4 from 101 on the last night; "drift" has an upper
/// limit only, 1e-3, and is at a quarter of it; nine are right.
inline Night made_up_night(int day, int last) {
  std::vector<reports::Verdict> verdicts;
  const auto add = [&](const std::string& case_id, const reports::Criterion& c) {
    verdicts.push_back({.case_id = case_id, .state = c.state, .criteria = {c}});
  };
  add("wave/near", band("near its limit", 109.5));
  add("wave/jump", band("jumps", day == last ? 105.0 : 101.0));
  add("energy", {.metric = "drift", .actual = 2.5e-4, .upper = 1e-3, .state = reports::State::pass});
  for (int k = 0; k < 9; ++k) add(fmt::format("static/{}", k), band("right", 100.0));
  Night n{fmt::format("2026-{:02}-{:02}T02:00:00Z", 1 + day / 28, 1 + day % 28), {"t", 60.0 + 0.01 * day, {}, verdicts}, {}};
  n.work = {10, 20, 1000, 3, {1, 2}};
  return n;
}

inline std::vector<Night> made_up_nights(int count) {
  std::vector<Night> all;
  for (int k = 0; k < count; ++k) all.push_back(made_up_night(k, count - 1));
  return all;
}

}  // namespace ddem::harness::nightly
