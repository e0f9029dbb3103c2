#include "harness/io/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "harness/io/atomic_file.h"
#include "harness/io/digest.h"
#include "harness/io/errors.h"
#include "harness/io/regular_file.h"

namespace ddem::harness {
namespace {

constexpr int max_depth = 200;
constexpr const char* kDigest = "digest";

void require_finite(const Json& value, const std::string& place) {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    throw std::invalid_argument(
        fmt::format("a number that is not finite at {} of a JSON document", place.empty() ? "/" : place));
  if (value.is_object()) {
    for (const auto& [key, element] : value.items()) require_finite(element, place + "/" + key);
  } else if (value.is_array()) {
    for (std::size_t n = 0; n < value.size(); ++n) require_finite(value[n], fmt::format("{}/{}", place, n));
  }
}

}  // namespace

Json number_or_status(double value, std::string_view reason) {
  if (std::isfinite(value)) return value;
  return Json::object({{"status", fmt::format("not a number: {}", reason)}});
}

Json numbers_or_status(const std::vector<double>& values, std::string_view reason) {
  Json array = Json::array();
  for (const double value : values) array.push_back(number_or_status(value, reason));
  return array;
}

std::string to_text(const Json& document) {
  require_finite(document, "");
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_json(const std::filesystem::path& target, const Json& document) {
  write_file(target, to_text(document));
}

Json parse_json(const std::string& text, const std::string& place) {
  // The parser itself does not recurse, but everything that walks its result does.
  const auto limit_depth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > max_depth)
      throw InputError(fmt::format("{}: JSON nested deeper than {} levels", place, max_depth));
    return true;
  };
  try {
    return Json::parse(text, limit_depth);
  } catch (const Json::parse_error& error) {
    const std::string_view before = std::string_view(text).substr(0, error.byte > 0 ? error.byte - 1 : 0);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
    throw InputError(fmt::format("{}: not JSON from line {}, column {} on: damaged, cut off, or another kind of file; let the command that wrote it write it again", place, line, column));
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: {}", place, in_words(error)));
  }
}

std::string in_words(const Json::exception& error) {
  std::string_view text = error.what();
  if (const std::size_t end = text.find("] "); text.starts_with('[') && end != std::string_view::npos) text.remove_prefix(end + 2);
  return std::string(text);
}

Json sealed(Json document) {
  document.erase(kDigest);
  std::string digest = sha256(to_text(document));
  document[kDigest] = std::move(digest);
  return document;
}

Json unsealed(Json document, const std::string& place) {
  if (!document.is_object() || !document.contains(kDigest)) return document;
  const Json digest = document[kDigest];
  document.erase(kDigest);
  if (digest != Json(sha256(to_text(document))))
    throw InputError(place + ": damaged, or changed after it was written: its digest does not hold (whoever meant to change it "
                              "removes its line, the last, and the comma before it)");
  return document;
}

void require_schema_version(const Json& document, const std::string& place) {
  const Json version = document.is_object() ? document.value("schema_version", Json()) : Json();
  if (version == 1) return;
  throw InputError(version.is_number_integer() ? fmt::format("{}: schema_version = {}, but this ddem reads 1: use the ddem that wrote it", place, version.dump())
                                               : place + ": not of ddem: it has no schema_version");
}

Json read_json(const std::filesystem::path& path) {
  return unsealed(parse_json(read_regular_file(path), path.string()), path.string());
}

}  // namespace ddem::harness
