#include "harness/nightly/unit.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <string_view>

#include "harness/io/errors.h"

namespace ddem::harness::nightly {
namespace {

constexpr std::string_view kSkipped = "skipped: ";

/// Fills `path` from its end: the common case, no such number, costs no text.
bool has_no_number(const nlohmann::json& value, std::string& path) {
  if (value.is_number_float()) return !std::isfinite(value.get<double>());
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      if (has_no_number(member, path)) {
        path = "/" + key + path;
        return true;
      }
    }
  } else if (value.is_array()) {
    for (std::size_t n = 0; n < value.size(); ++n) {
      if (has_no_number(value[n], path)) {
        path = "/" + std::to_string(n) + path;
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::string place_of_no_number(const nlohmann::json& result) {
  std::string path;
  return has_no_number(result, path) && path.empty() ? "/" : path;
}

bool was_skipped(const std::string& failure) { return failure.starts_with(kSkipped); }

std::string reason_of(const std::string& failure) { return was_skipped(failure) ? failure.substr(kSkipped.size()) : failure; }

Outcome run_unit(const Unit& unit) {
  const auto start = std::chrono::steady_clock::now();
  Outcome out;
  try {
    out.result = unit.run();
    if (const std::string place = place_of_no_number(out.result); !place.empty()) {
      out.failure = fmt::format("{} of the result is not a finite number", place);
      out.result = nullptr;
    }
  } catch (const UnsupportedError& e) {
    out.failure = std::string(kSkipped) + e.what();
  } catch (const std::exception& e) {
    out.failure = e.what();
  } catch (...) {
    out.failure = "an exception of unknown kind";
  }
  if (out.failure.empty() && out.result.is_null()) out.failure = "no result";
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace ddem::harness::nightly
