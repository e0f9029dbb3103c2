#include "tests/harness/damage/mutations.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ddem::harness::test {
namespace {

using nlohmann::json;

std::string exchanged(std::string content, std::size_t a, std::size_t b, std::size_t length) {
  std::swap_ranges(content.begin() + static_cast<std::ptrdiff_t>(a), content.begin() + static_cast<std::ptrdiff_t>(a + length),
                   content.begin() + static_cast<std::ptrdiff_t>(b));
  return content;
}

/// Another value in the place of one: of every kind that a file can hold.
json another(const json& value, Chance& chance) {
  const json values[] = {nullptr, true, false, -1, 0, 1, 2, 7, 255, 1'000'000'007, -5'000'000'000, INT64_MAX, INT64_MIN, UINT64_MAX,
                         -0.5, 0.0, 1e-300, 1e-9, 1e18, 1e300, -1e300, "", "x", "a/b", ".", std::string("a\0b", 3), "\xff\xfe", "<b>&\x1b[2J",
                         std::string(100'000, 'x'), json::array(), json::object(), json::array({1, 2}), json::array({json::array()}),
                         json{{"x", 1}}, std::nan(""), HUGE_VAL};
  if (value.is_number() && chance.below(2) == 0) {
    const double factors[] = {-1.0, 0.0, 1e-12, 0.5, 1e3, 1e12, 1e150};
    const double changed = value.get<double>() * factors[chance.below(std::size(factors))];
    return value.is_number_integer() && std::abs(changed) < 1e15 ? json(static_cast<std::int64_t>(changed)) : json(changed);
  }
  return values[chance.below(std::size(values))];
}

void change_inside(json& parent, Chance& chance) {
  if (parent.empty()) return void(parent = another(parent, chance));
  auto at = parent.begin();
  std::advance(at, static_cast<std::ptrdiff_t>(chance.below(parent.size())));
  switch (chance.below(parent.is_array() ? 5 : 3)) {
    case 0: parent.erase(at); return;
    case 1: *at = another(*at, chance); return;
    case 2: {
      auto other = parent.begin();
      std::advance(other, static_cast<std::ptrdiff_t>(chance.below(parent.size())));
      std::swap(*at, *other);
      return;
    }
    case 3: parent.push_back(*at); return;
    default: parent.erase(at, parent.end()); return;
  }
}

}  // namespace

std::string damaged(const std::string& content, Chance& chance) {
  const std::size_t at = chance.below(content.size()), length = 1 + chance.below(std::min<std::size_t>(64, content.size() - at));
  const std::size_t block = std::max<std::size_t>(1, std::min<std::size_t>(content.size() / 4, std::size_t{1} << chance.below(13)));
  const std::size_t from = chance.below(content.size() - block + 1), to = chance.below(content.size() - block + 1);
  std::string bad = content;
  switch (chance.below(10)) {
    case 0: bad[at] = static_cast<char>(bad[at] ^ (1 << chance.below(8))); break;
    case 1: bad[at] = static_cast<char>(chance.below(256)); break;
    case 2: for (std::size_t k = 0; k < length; ++k) bad[at + k] = static_cast<char>(chance.below(256)); break;
    case 3: bad.replace(from, block, std::string(block, '\0')); break;
    case 4: if (from + block <= to || to + block <= from) bad = exchanged(bad, from, to, block); break;
    case 5: bad.insert(at, content.substr(from, block)); break;
    case 6: bad.erase(from, block); break;
    case 7: bad.resize(at); break;
    case 8: bad += content.substr(from, block); break;
    default:  // a digit for a digit: what a reader would not notice
      const std::size_t digit = content.find_first_of("0123456789", at);
      if (digit != std::string::npos) bad[digit] = static_cast<char>('0' + chance.below(10));
  }
  return bad;
}

json forged(json value, Chance& chance) {
  json* at = &value;
  for (;;) {
    // Of long arrays the first few elements: all are read alike.
    const bool inside = at->is_structured() && !at->empty();
    if (!inside || chance.below(4) == 0) break;
    auto child = at->begin();
    std::advance(child, static_cast<std::ptrdiff_t>(chance.below(std::min<std::size_t>(at->size(), 40))));
    if (!child->is_structured()) break;
    at = &*child;
  }
  if (at->is_structured())
    change_inside(*at, chance);
  else
    *at = another(*at, chance);
  return value;
}

}  // namespace ddem::harness::test
