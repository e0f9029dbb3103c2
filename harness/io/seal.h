#pragma once
// The last line of a file that readers must find as it was written: a digest of all that stands before it.

#include <string>
#include <string_view>

namespace ddem::harness {

inline constexpr std::string_view kSealTitle = "ddem sha256 ";
inline constexpr std::size_t kSealBytes = kSealTitle.size() + 64 + 1;

/// "ddem sha256 DIGEST", a line to be put behind `content`.
std::string seal_of(std::string_view content);

/// The content of a file with a seal behind it. Throws InputError with `place`: there is none, or it does not hold.
std::string_view sealed_content(std::string_view bytes, const std::string& place);

}  // namespace ddem::harness
