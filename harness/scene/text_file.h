#pragma once
// Whole text files, of bounded size.

#include <cstddef>
#include <filesystem>
#include <string>

#include "harness/scene/violation.h"

namespace ddem::harness {

/// The bytes of a file. A file that is absent, a folder, unreadable or larger than `max_bytes` is a
/// violation.
Checked<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace ddem::harness
