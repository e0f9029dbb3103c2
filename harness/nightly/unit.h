#pragma once
// A piece of a campaign that can be run alone, by any process, and whose result is data.

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace ddem::harness::nightly {

struct Unit {
  std::string id;        ///< "material/random-1/lagged-full/kt0.30": unique in its campaign
  std::string inputs;    ///< a text of all that its result follows from, besides the program
  std::size_t work = 1;  ///< units of progress
  /// Deterministic but for times. Runs in any thread; throws what keeps it from a result.
  std::function<nlohmann::json()> run;
  bool reports_progress = false;  ///< of all its work, while it runs
  double memory = 0.0;            ///< bytes at most, where they are known beforehand
};

/// What became of a unit: a result, or why there is none.
struct Outcome {
  nlohmann::json result;
  std::string failure;   ///< empty: ok
  double seconds = 0.0;  ///< wall time
};

/// Of a failure: the unit needs what its solver cannot do (UnsupportedError).
bool was_skipped(const std::string& failure);
/// The failure without the mark of that.
std::string reason_of(const std::string& failure);

/// Where the first number that is not finite stands ("/waves/3/speed"); empty: there is none.
std::string place_of_no_number(const nlohmann::json& result);

/// Runs it. A result with a number that is not finite is none: failure says where it stands.
Outcome run_unit(const Unit& unit);

}  // namespace ddem::harness::nightly
