#include "harness/nightly/unit_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "harness/io/digest.h"

namespace ddem::harness::nightly {
namespace {

constexpr std::string_view kEnding = ".unit";
constexpr std::size_t kLongestPart = 200, kLongestPath = 1000;  // of the usual 255 and 4096, with room for temporary names

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || std::string_view("-_=+.").find(c) != std::string_view::npos;
}

/// One part of the name. Nothing is lost: "%XX" is always one byte, a lone "%" the empty part.
std::string escaped(std::string_view part) {
  if (part.empty()) return "%";
  std::string out;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const bool dot_that_means_something = part[k] == '.' && (k == 0 || part.substr(k) == kEnding);
    if (is_plain(part[k]) && !dot_that_means_something)
      out += part[k];
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(part[k]));
  }
  return out;
}

}  // namespace

std::filesystem::path file_of_unit(std::string_view id) {
  std::string path;
  std::size_t longest = 0;
  for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
    end = id.find('/', begin);
    const std::string part = escaped(id.substr(begin, end == std::string_view::npos ? end : end - begin));
    longest = std::max(longest, part.size());
    path += (begin == 0 ? "" : "/") + part;
  }
  // No escaped name begins so.
  if (longest > kLongestPart || path.size() > kLongestPath) path = "%~" + sha256(id);
  return path + std::string(kEnding);
}

}  // namespace ddem::harness::nightly
