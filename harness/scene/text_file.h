#pragma once
// Whole text files, of bounded size.

#include <cstddef>
#include <filesystem>
#include <string>

#include "harness/scene/violation.h"

namespace ddem::harness {

enum class Pipes {
  refused,  ///< files alone, which can be read again
  taken     ///< also pipes, /dev/stdin among them; one into which nothing is written is refused after ten seconds
};

/// The bytes of a file. A file that is absent, a folder, a device, unreadable or larger than `max_bytes` is a violation.
Checked<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes, Pipes pipes = Pipes::refused);

}  // namespace ddem::harness
