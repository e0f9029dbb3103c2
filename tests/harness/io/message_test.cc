// Messages never cost a result, and never drive a terminal.

#include "harness/io/message.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/harness/io/scratch.h"

namespace ddem::harness {
namespace {

/// Standard error goes elsewhere while this lives; -1: it is closed.
class ErrorTo {
 public:
  explicit ErrorTo(int descriptor) : before_(::dup(STDERR_FILENO)) {
    if (descriptor < 0) {
      ::close(STDERR_FILENO);
    } else {
      ::dup2(descriptor, STDERR_FILENO);
      ::close(descriptor);
    }
  }
  ~ErrorTo() {
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
  }

 private:
  int before_;
};

TEST(Message, IsALineOnStandardError) {
  const Scratch scratch;
  {
    const ErrorTo file(::open((scratch / "e").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666));
    message("disc {} of {}", 3, "a\nb");
    say("two words");
  }
  EXPECT_EQ(content_of(scratch / "e"), "disc 3 of a\nb\ntwo words");
}

TEST(Message, IsLostWhereNobodyTakesIt) {
  {
    const ErrorTo full(::open("/dev/full", O_WRONLY));
    EXPECT_NO_THROW(message("lost"));
  }
  {
    const ErrorTo closed(-1);
    EXPECT_NO_THROW(message("lost"));
  }
  {
    const ErrorTo only_for_reading(::open("/dev/null", O_RDONLY));
    EXPECT_NO_THROW(message("lost"));
  }
}

// Every byte and every character of two bytes: none that a terminal obeys comes through, all others do.
TEST(Message, ShowsControlCharacters) {
  for (int byte = 0; byte < 0x80; ++byte) {
    const std::string text = std::string("a") + static_cast<char>(byte) + "b";
    const bool shown = (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f;
    EXPECT_EQ(printable(text), shown ? fmt::format("a\\x{:02x}b", byte) : text) << byte;
  }
  for (int code = 0x80; code < 0x800; ++code) {
    const std::string text{static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
    EXPECT_EQ(printable(text), code < 0xa0 ? fmt::format("\\x{:02x}", code) : text) << code;
  }
  EXPECT_EQ(printable("\xc2"), "\xc2");  // cut off
  EXPECT_EQ(printable("E = 3 GPa \xe2\x89\xa4 4\t\n"), "E = 3 GPa \xe2\x89\xa4 4\t\n");
}

}  // namespace
}  // namespace ddem::harness
