#include "harness/io/seal.h"

#include <algorithm>

#include "harness/io/digest.h"
#include "harness/io/errors.h"

namespace ddem::harness {

std::string seal_of(std::string_view content) {
  return std::string(kSealTitle) + sha256(content) + "\n";
}

std::string_view sealed_content(std::string_view bytes, const std::string& place) {
  const std::string_view content = bytes.substr(0, bytes.size() - std::min(bytes.size(), kSealBytes));
  const std::string_view seal = bytes.substr(content.size());
  if (!seal.starts_with(kSealTitle))
    throw InputError(place + ": ends without its checksum: cut off, or written by an older ddem or another program");
  if (seal != seal_of(content)) throw InputError(place + ": damaged: its checksum does not hold");
  return content;
}

}  // namespace ddem::harness
