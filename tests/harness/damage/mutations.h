#pragma once
// Changes at random, the same on every run.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace ddem::harness::test {

/// The standard's distributions differ from library to library.
class Chance {
 public:
  explicit Chance(std::uint32_t seed) : random_(seed) {}
  /// 0 .. count - 1.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

 private:
  std::mt19937 random_;
};

/// A bit, a byte, some bytes, a block of zeros, two blocks exchanged, one repeated or left out, the end cut off, more behind it.
std::string damaged(const std::string& content, Chance& chance);

/// A member or element somewhere inside is left out, repeated, exchanged with another, or becomes another number, text, list or
/// nothing.
nlohmann::json forged(nlohmann::json value, Chance& chance);

}  // namespace ddem::harness::test
