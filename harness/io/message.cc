#include "harness/io/message.h"

#include <unistd.h>

#include <cerrno>
#include <iterator>

namespace ddem::harness {

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const auto next = k + 1 < text.size() ? static_cast<unsigned char>(text[k + 1]) : 0;
    if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f) {
      fmt::format_to(std::back_inserter(shown), "\\x{:02x}", byte);
    } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {  // the other control characters, as UTF-8
      fmt::format_to(std::back_inserter(shown), "\\x{:02x}", next);
      ++k;
    } else {
      shown += text[k];
    }
  }
  return shown;
}

void say(std::string_view text) {
  const std::string shown = printable(text);
  for (std::string_view rest = shown; !rest.empty();) {
    const ssize_t written = ::write(STDERR_FILENO, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace ddem::harness
