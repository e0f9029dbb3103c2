// Reads every file of the folders named, and each of them with a byte changed or cut off: what fuzzing found
// once stays found, with any compiler.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/fuzz.h"

int main(int argc, char** argv) {
  int files = 0;
  for (int k = 1; k < argc; ++k) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[k])) {
      std::ifstream in(entry.path(), std::ios::binary);
      std::string text{std::istreambuf_iterator<char>(in), {}};
      fuzz(text);
      const std::size_t stride = text.size() / 40 + 1;
      for (std::size_t at = 0; at < text.size(); at += stride) {
        std::string bad = text;
        bad[at] = static_cast<char>(bad[at] ^ 0x15);
        fuzz(bad);
        fuzz(std::string_view(text).substr(0, at));
      }
      ++files;
    }
  }
  std::printf("%d files\n", files);
  return files > 0 ? 0 : 1;
}
