#pragma once
// SHA-256, as 64 hexadecimal digits.

#include <filesystem>
#include <string>
#include <string_view>

namespace ddem::harness {

std::string sha256(std::string_view content);

/// Of a file's content; InputError where it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace ddem::harness
