#include "harness/nightly/unit_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "harness/io/atomic_file.h"
#include "harness/io/digest.h"
#include "harness/io/errors.h"
#include "harness/io/json.h"
#include "harness/io/regular_file.h"
#include "harness/nightly/unit_name.h"

namespace ddem::harness::nightly {
namespace {

using nlohmann::json;

constexpr std::string_view kTitle = "ddem unit 1 ";
constexpr std::size_t kHeader = kTitle.size() + 64 + 1;
constexpr int kMostDepth = 64;

/// nlohmann's reader of CBOR calls itself for what is nested; this stops it.
class BoundedParser : public nlohmann::detail::json_sax_dom_parser<json> {
 public:
  using Base = nlohmann::detail::json_sax_dom_parser<json>;
  using Base::Base;

  bool start_object(std::size_t size) { return ++depth_ <= kMostDepth && Base::start_object(size); }
  bool start_array(std::size_t size) { return ++depth_ <= kMostDepth && Base::start_array(size); }
  bool end_object() { return --depth_, Base::end_object(); }
  bool end_array() { return --depth_, Base::end_array(); }

 private:
  int depth_ = 0;
};

json parse_cbor(std::string_view bytes, const std::string& place) {
  json value;
  BoundedParser parser(value);
  try {
    if (!json::sax_parse(bytes.begin(), bytes.end(), &parser, json::input_format_t::cbor))
      throw InputError(place + ": damaged: not CBOR, or nested too deep");
  } catch (const json::exception& e) {
    throw InputError(place + ": damaged: " + in_words(e));
  }
  return value;
}

/// The members that hold times.
void erase_times(json& value) {
  if (value.is_object()) {
    for (const char* name : {"seconds", "solve_seconds", "nanoseconds_per_bond_step"}) value.erase(name);
  }
  if (value.is_structured()) {
    for (json& member : value) erase_times(member);
  }
}

}  // namespace

std::string identity_of(const Unit& unit, std::string_view program) {
  return sha256(fmt::format("{}\n{}\n{}", program, unit.id, unit.inputs));
}

std::string to_bytes(const UnitRecord& r) {
  const json content{{"id", r.id},
                     {"identity", r.identity},
                     {"failure", r.outcome.failure},
                     {"seconds", r.outcome.seconds},
                     {"result", r.outcome.result}};
  std::string cbor;
  json::to_cbor(content, cbor);
  return fmt::format("{}{}\n", kTitle, sha256(cbor)) + cbor;
}

UnitRecord parse_unit(std::string_view bytes, const std::string& place) {
  if (bytes.size() < kHeader || !bytes.starts_with(kTitle) || bytes[kHeader - 1] != '\n')
    throw InputError(place + ": not a unit's file, or cut off");
  const std::string_view content = bytes.substr(kHeader);
  if (sha256(content) != bytes.substr(kTitle.size(), 64))
    throw InputError(place + ": damaged: its checksum does not hold");
  const json value = parse_cbor(content, place);
  try {
    UnitRecord r{
        value.at("id"), value.at("identity"), {value.at("result"), value.at("failure"), value.at("seconds")}};
    if (r.outcome.failure.empty() && r.outcome.result.is_null())
      throw InputError(place + ": neither a result nor a reason");
    if (const std::string at = place_of_no_number(value); !at.empty())
      throw InputError(fmt::format("{}: {} is not a finite number, which no unit writes", place, at));
    return r;
  } catch (const json::exception& e) {
    throw InputError(place + ": not a unit's file: " + in_words(e));
  }
}

std::filesystem::path unit_path(const std::filesystem::path& folder, const std::string& id) {
  return folder / "cases" / file_of_unit(id);
}

void write_unit(const std::filesystem::path& folder, const UnitRecord& record) {
  const std::filesystem::path path = unit_path(folder, record.id);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw machine_error(path.parent_path().string(), "cannot create the folder", error.value());
  write_file(path, to_bytes(record), Flush::none);
}

UnitRecord read_unit(const std::filesystem::path& folder, const std::string& id,
                     const std::string& identity) {
  const std::filesystem::path path = unit_path(folder, id);
  UnitRecord r = parse_unit(read_regular_file(path), path.string());
  if (r.id != id) throw InputError(fmt::format("{}: holds another unit, {}", path.string(), r.id));
  if (r.identity != identity) throw InputError(path.string() + ": of other inputs or another program");
  return r;
}

std::string content_digest(const UnitRecord& record) {
  json result = record.outcome.result;
  erase_times(result);
  std::string cbor;
  json::to_cbor(json{result, record.outcome.failure}, cbor);
  return sha256(cbor);
}

}  // namespace ddem::harness::nightly
