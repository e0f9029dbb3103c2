#include "harness/io/digest.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

#include "harness/io/atomic_file.h"

namespace ddem::harness {

std::string sha256(std::string_view content) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(content.data(), content.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("OpenSSL computes no SHA-256");
  constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (unsigned k = 0; k < length; ++k) {
    hex += kDigits[digest[k] >> 4];
    hex += kDigits[digest[k] & 15];
  }
  return hex;
}

std::string sha256_of_file(const std::filesystem::path& path) {
  return sha256(read_file(path));
}

}  // namespace ddem::harness
