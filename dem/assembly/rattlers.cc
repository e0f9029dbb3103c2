#include "dem/assembly/rattlers.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace ddem {
namespace {

void check_disc(int disc, std::size_t discs) {
  if (disc < 0 || static_cast<std::size_t>(disc) >= discs)
    throw std::invalid_argument(fmt::format("disc {} does not exist: there are {} discs", disc, discs));
}

void check_bonds(const Bonds& bonds, std::size_t discs) {
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    check_disc(bonds.i[b], discs);
    check_disc(bonds.j[b], discs);
  }
}

std::vector<char> marked(std::span<const int> list, std::size_t discs) {
  std::vector<char> mark(discs, 0);
  for (const int disc : list) {
    check_disc(disc, discs);
    mark[disc] = 1;
  }
  return mark;
}

/// Neighbours of every disc in one array: those of disc i are others[first[i]] .. others[first[i + 1] - 1].
struct Adjacency {
  std::vector<std::size_t> first;
  std::vector<int> others;

  Adjacency(std::size_t discs, const Bonds& bonds) : first(discs + 1, 0), others(2 * bonds.size()) {
    check_bonds(bonds, discs);
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      ++first[bonds.i[b] + 1];
      ++first[bonds.j[b] + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      others[next[bonds.i[b]]++] = bonds.j[b];
      others[next[bonds.j[b]]++] = bonds.i[b];
    }
  }

  std::span<const int> of(int disc) const {
    return std::span(others).subspan(first[disc], first[disc + 1] - first[disc]);
  }
};

}  // namespace

std::vector<int> find_rattlers(std::size_t discs, const Bonds& bonds) {
  const Adjacency neighbours(discs, bonds);
  std::vector<std::size_t> count(discs);
  std::vector<int> rattlers;
  for (int disc = 0; disc < static_cast<int>(discs); ++disc) {
    count[disc] = neighbours.of(disc).size();
    if (count[disc] < 2) rattlers.push_back(disc);
  }
  for (std::size_t k = 0; k < rattlers.size(); ++k)
    for (const int other : neighbours.of(rattlers[k]))
      if (--count[other] == 1) rattlers.push_back(other);
  std::sort(rattlers.begin(), rattlers.end());
  return rattlers;
}

std::vector<std::vector<int>> connected_components(std::size_t discs, const Bonds& bonds,
                                                   std::span<const int> left_out) {
  const Adjacency neighbours(discs, bonds);
  std::vector<char> seen = marked(left_out, discs);
  std::vector<std::vector<int>> components;
  for (int start = 0; start < static_cast<int>(discs); ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    std::vector<int> piece = {start};
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (const int other : neighbours.of(piece[k])) {
        if (seen[other]) continue;
        seen[other] = 1;
        piece.push_back(other);
      }
    std::sort(piece.begin(), piece.end());
    components.push_back(std::move(piece));
  }
  return components;
}

}  // namespace ddem
