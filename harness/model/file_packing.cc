#include "harness/model/file_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "dem/assembly/contacts.h"
#include "dem/assembly/outline.h"
#include "dem/assembly/packing_check.h"
#include "harness/io/errors.h"
#include "harness/model/memory_need.h"
#include "harness/model/valid_table.h"
#include "harness/scene/csv.h"
#include "harness/scene/place.h"
#include "harness/scene/units.h"

namespace ddem::harness {
namespace {

constexpr double kRounding = 1e-9;
constexpr std::size_t kListed = 10;

/// One direction of a scene's size and what the discs need of it, m.
struct Extent {
  std::string_view key;
  double size;
  bool periodic;
  double centres, discs;  ///< from the first centre to the last, and with their radii
};

Extent extent(std::string_view key, double size, bool periodic, const std::vector<double>& centre, const std::vector<double>& radius) {
  Extent d{key, size, periodic, 0.0, 0.0};
  double lo = HUGE_VAL, hi = -HUGE_VAL, left = HUGE_VAL, right = -HUGE_VAL;
  for (std::size_t k = 0; k < centre.size(); ++k) {
    lo = std::min(lo, centre[k]), hi = std::max(hi, centre[k]);
    left = std::min(left, centre[k] - radius[k]), right = std::max(right, centre[k] + radius[k]);
  }
  d.centres = hi - lo, d.discs = right - left;
  return d;
}

/// Nearly a thousand times too much or too little: millimetres read as metres.
std::string size_remedy(double needed, double size) {
  constexpr double kTwice = 2.0;
  const double ratio = needed / size;
  if (ratio > 1e3 / kTwice && ratio < 1e3 * kTwice) return "x, y and radius of the file are metres: these look like millimetres";
  if (1.0 / ratio > 1e3 / kTwice && 1.0 / ratio < 1e3 * kTwice) return "did you mean millimetres? Plain numbers are metres";
  return "correct it, or leave it out: then it follows from the discs (x, y and radius of the file are metres)";
}

std::vector<std::string> contradictions(const Scene& scene, const FilePacking& p, const Packing& packing) {
  std::vector<Extent> given;
  if (p.length) given.push_back(extent("assembly.length", *p.length, scene.assembly.periodic.x, packing.x, packing.radius));
  if (p.width) given.push_back(extent("assembly.width", *p.width, scene.assembly.periodic.y, packing.y, packing.radius));
  const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
  const std::string file = p.discs.string();
  std::vector<std::string> problems;
  for (const Extent& d : given) {
    if (!d.periodic && d.centres > d.size * (1.0 + kRounding)) {
      problems.push_back(scene_problem(scene, d.key, fmt::format("the discs of {} lie outside of it: their centres span {}", file, format_quantity(d.centres, "m")),
                                       size_remedy(d.centres, d.size)));
    } else if (d.size > d.discs + 4.0 * largest) {
      problems.push_back(scene_problem(scene, d.key, fmt::format("the discs of {} fill only {} of it", file, format_quantity(d.discs, "m")), size_remedy(d.discs, d.size)));
    }
  }
  return problems;
}

/// Of discs that hardly overlap (packing_check.h).
std::vector<std::string> overfull(const Scene& scene, const FilePacking& p, const Packing& packing) {
  double area = 0.0;
  for (const double r : packing.radius) area += std::numbers::pi * r * r;
  const double share = area / (packing.length * packing.width);
  if ((!p.length && !p.width) || share <= 1.0) return {};
  return {scene_problem(scene, p.width ? "assembly.width" : "assembly.length",
                        fmt::format("the discs of {} would fill {:.3g} times the {} x {} of the packing", p.discs.string(), share,
                                    format_quantity(packing.length, "m"), format_quantity(packing.width, "m")),
                        "correct length and width, or leave them out: then they follow from the discs")};
}

/// Those that a listed bond holds: what lies loose beside the strip does not stretch it. All where most are loose, or a bond
/// is of none of them, which file_bonds() tells.
Packing bonded_discs(const Scene& scene, const Packing& packing) {
  const auto* file = std::get_if<BondFile>(&scene.assembly.bonding);
  if (file == nullptr) return packing;
  const Checked<BondTable> checked = read_bond_table(file->path);
  std::vector<char> bonded(packing.size(), 0);
  for (const auto& [i, j] : valid_table(checked)) {
    for (const std::size_t d : {static_cast<std::size_t>(i), static_cast<std::size_t>(j)}) {
      if (d >= bonded.size()) return packing;
      bonded[d] = 1;
    }
  }
  Packing held{{}, {}, {}, packing.period, 0.0, 0.0};
  for (std::size_t d = 0; d < packing.size(); ++d) {
    if (!bonded[d]) continue;
    held.x.push_back(packing.x[d]), held.y.push_back(packing.y[d]), held.radius.push_back(packing.radius[d]);
  }
  return 2 * held.size() > packing.size() ? held : packing;
}

}  // namespace

Packing file_packing(const Scene& scene, const FilePacking& p) {
  std::error_code unknown;
  const double bytes = static_cast<double>(std::filesystem::file_size(p.discs, unknown));
  const MemoryPart text{"the file's text and discs", unknown ? 0.0 : 3.0 * bytes, "assembly.file", "is it the right file?"};
  require_memory(scene, {&text, 1});
  const Checked<DiscTable> checked = read_disc_table(p.discs);
  const DiscTable& table = valid_table(checked);
  Packing packing{table.x, table.y, table.radius, {}, 0.0, 0.0};
  if (packing.size() < 2) throw InputError(scene_problem(scene, "assembly.file", "fewer than two discs", "give at least two rows"));
  packing.period = {scene.assembly.periodic.x ? p.length.value() : 0.0, scene.assembly.periodic.y ? p.width.value() : 0.0};
  const Outline outline = outline_of(bonded_discs(scene, packing), p.length, p.width);
  packing.length = outline.length;
  packing.width = outline.width;
  std::vector<std::string> lines = contradictions(scene, p, packing);
  if (lines.empty()) {
    for (const std::string& problem : packing_problems(packing)) lines.push_back(p.discs.string() + ": " + problem);
    if (!lines.empty()) lines.push_back("  (discs count from 0 in the order of the rows; move them apart, shrink them, or correct the periods)");
  }
  if (lines.empty()) lines = overfull(scene, p, packing);
  if (!lines.empty()) throw InputError(lines);
  return packing;
}

Bonds file_bonds(const Packing& packing, const BondFile& file) {
  const Checked<BondTable> checked = read_bond_table(file.path);
  const BondTable& table = valid_table(checked);
  const int discs = static_cast<int>(packing.size());
  const double mean = mean_radius(packing);
  std::map<std::pair<int, int>, std::size_t> seen;
  std::vector<std::string> lines;
  const auto refuse = [&](std::size_t row, const std::string& problem) {
    lines.push_back(fmt::format("{}:{}: bond {},{}: {}", file.path.string(), line_of_row(file.path, row), table[row].first, table[row].second, problem));
  };
  for (std::size_t row = 0; row < table.size() && lines.size() < kListed; ++row) {
    const auto [i, j] = std::minmax(table[row].first, table[row].second);
    if (j >= discs) {
      refuse(row, fmt::format("disc {} does not exist; discs are numbered from 0 to {}", j, discs - 1));
      continue;
    }
    if (const auto [first, is_new] = seen.try_emplace({i, j}, row); !is_new) {
      refuse(row, fmt::format("is given twice, first on line {}; leave the row out", line_of_row(file.path, first->second)));
      continue;
    }
    const double gap = std::hypot(nearest_image(packing.x[j] - packing.x[i], packing.period.x), nearest_image(packing.y[j] - packing.y[i], packing.period.y)) -
                       packing.radius[i] - packing.radius[j];
    if (gap > kLongestListedGap * mean) {
      refuse(row, fmt::format("the discs are {:.3g} mean radii apart; bonds reach over gaps up to {:g}: correct the numbers (discs count from 0)", gap / mean, kLongestListedGap));
    }
  }
  if (!lines.empty()) throw InputError(lines);
  return bonds_between(packing, table);
}

}  // namespace ddem::harness
