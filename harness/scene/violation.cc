#include "harness/scene/violation.h"

#include <fmt/format.h>

namespace ddem::harness {
namespace {

constexpr std::size_t max_value_bytes = 80;
constexpr std::size_t max_message_bytes = 500;

// Length of the well-formed UTF-8 sequence that starts `text`, 0 if there is none.
std::size_t sequence_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((static_cast<unsigned char>(text[k]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

}  // namespace

std::string printable(std::string_view text, std::size_t max_bytes) {
  std::string line;
  while (!text.empty()) {
    if (line.size() >= max_bytes) return line + "...";
    const std::size_t length = sequence_length(text);
    const auto lead = static_cast<unsigned char>(text.front());
    if (length == 0 || lead < 0x20 || lead == 0x7F) {
      line += fmt::format("\\x{:02x}", lead);
      text.remove_prefix(1);
    } else {
      line += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return line;
}

std::string to_string(const Violation& violation) {
  std::string line = printable(violation.file, max_message_bytes);
  if (violation.line > 0) line += fmt::format(":{}", violation.line);
  if (violation.line > 0 && violation.key.empty()) line += fmt::format(":{}", violation.column);
  line += ": ";
  if (!violation.key.empty()) {
    line += printable(violation.key, max_value_bytes);
    if (!violation.value.empty()) line += " = " + printable(violation.value, max_value_bytes);
    line += ": ";
  }
  line += printable(violation.message, max_message_bytes);
  if (!violation.remedy.empty()) line += "; " + printable(violation.remedy, max_message_bytes);
  return line;
}

std::string to_string(std::span<const Violation> violations) {
  std::string lines;
  for (const Violation& violation : violations) lines += to_string(violation) + "\n";
  return lines;
}

}  // namespace ddem::harness
