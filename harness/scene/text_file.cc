#include "harness/scene/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

namespace ddem::harness {

Checked<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes) {
  const auto refuse = [&](std::string message, std::string remedy) {
    return Violations{{path.string(), 0, 0, "", "", std::move(message), std::move(remedy)}};
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return refuse("this is a folder", "name a file in it");
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) return refuse(fmt::format("cannot be read: {}", std::strerror(errno)), "check the name");

  const std::uintmax_t expected = std::filesystem::file_size(path, error);
  std::string text;
  // Pipes and devices have no size; they are read until they end or exceed the limit.
  std::size_t room = error ? 0 : static_cast<std::size_t>(std::min<std::uintmax_t>(expected, max_bytes));
  while (true) {
    constexpr std::size_t smallest_read = std::size_t{1} << 16;
    const std::size_t filled = text.size();
    text.resize(filled + std::max(room + 1, smallest_read));
    room = 0;
    const std::size_t got = std::fread(text.data() + filled, 1, text.size() - filled, file.get());
    text.resize(filled + got);
    if (std::ferror(file.get())) return refuse(fmt::format("cannot be read: {}", std::strerror(errno)), "");
    if (text.size() > max_bytes) {
      return refuse(fmt::format("larger than {} MiB", max_bytes >> 20), "is it the right file?");
    }
    if (got == 0) return text;
  }
}

}  // namespace ddem::harness
