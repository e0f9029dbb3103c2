#include "meshes/msh_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "meshes/mesh_error.h"

namespace ddem::meshes {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

template <typename Number>
bool parse(std::string_view word, Number& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if constexpr (std::is_floating_point_v<Number>) {
    // What is too small for a double is 0, what is too large infinite.
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);
    return error != std::errc::invalid_argument && end == word.data() + word.size();
  }
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string shown(text.substr(0, most));
  std::replace_if(shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > most ? shown + "..." : shown;
}

void MshSource::fail(const std::string& what) const {
  if (in_data_) throw MeshError(fmt::format("byte {}: {}", at_, what));
  const auto lines = std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(word_at_), '\n');
  throw MeshError(fmt::format("line {}: {}", lines + 1, what));
}

bool MshSource::at_end() {
  in_data_ = false;
  while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
  word_at_ = at_;
  return at_ == bytes_.size();
}

std::string_view MshSource::word() {
  if (at_end()) fail("the file ends too early");
  while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
  return bytes_.substr(word_at_, at_ - word_at_);
}

void MshSource::expect(std::string_view wanted) {
  const std::string_view found = word();
  if (found != wanted) fail(fmt::format("\"{}\" stands where {} should", printable(found), wanted));
}

std::string_view MshSource::rest_of_line() {
  const std::size_t start = at_;
  at_ = std::min(bytes_.find('\n', at_), bytes_.size());
  return bytes_.substr(start, at_ - start);
}

void MshSource::skip_past(std::string_view section_end) {
  const std::size_t found = bytes_.find("\n" + std::string(section_end), at_);
  if (found == std::string_view::npos) fail(fmt::format("{} is missing", section_end));
  at_ = found;
  expect(section_end);
}

std::int64_t MshSource::whole() {
  std::int64_t value = 0;
  const std::string_view text = word();
  if (!parse(text, value)) fail(fmt::format("\"{}\" stands where a whole number should", printable(text)));
  return value;
}

double MshSource::real() {
  double value = 0.0;
  const std::string_view text = word();
  if (!parse(text, value)) fail(fmt::format("\"{}\" stands where a number should", printable(text)));
  if (!std::isfinite(value)) fail(fmt::format("\"{}\" is no finite number", printable(text)));
  return value;
}

void MshSource::begin_data() {
  if (!binary_) return;
  if (rest_of_line().find_first_not_of(" \r") != std::string_view::npos || at_ == bytes_.size()) fail("a line break is missing before data in bytes");
  ++at_;
}

template <typename Number>
Number MshSource::bytes() {
  in_data_ = true;
  if (bytes_.size() - at_ < sizeof(Number)) fail("the file ends too early");
  Number value;
  std::memcpy(&value, bytes_.data() + at_, sizeof(Number));
  at_ += sizeof(Number);
  return value;
}

std::int64_t MshSource::data_int() {
  return binary_ ? bytes<std::int32_t>() : whole();
}

std::uint64_t MshSource::data_size() {
  if (binary_) return bytes<std::uint64_t>();
  const std::int64_t value = whole();
  if (value < 0) fail(fmt::format("{} stands where a number that is not negative should", value));
  return static_cast<std::uint64_t>(value);
}

double MshSource::data_real() {
  if (!binary_) return real();
  const double value = bytes<double>();
  if (!std::isfinite(value)) fail("a coordinate is no finite number");
  return value;
}

}  // namespace ddem::meshes
