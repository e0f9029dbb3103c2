#include "harness/model/memory_need.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "dem/statics/elimination_tree.h"
#include "harness/io/errors.h"
#include "harness/io/memory.h"
#include "harness/scene/place.h"

namespace ddem::harness {
namespace {

// Bytes a disc, as measured from 2e4 to 1e7 discs; a test compares them with what the program takes. Most of a simulation's are
// the vectors of the iterations that find its critical step, and of implicit strains their spectrum.
constexpr double kPacking = 500.0, kRigid = 1500.0, kLagged = 2000.0, kImplicit = 7000.0, kLaggedLimits = 10500.0, kFactors = 430.0, kSoftFactors = 2000.0, kVariantFactors = 3000.0;
// Of many discs, whose factors are single.
constexpr double kManyFactors = 270.0, kManySoftFactors = 1400.0;

double bytes_a_disc(const Scene& scene, double discs, DiscWork work) {
  switch (work) {
    case DiscWork::packing: return kPacking;
    case DiscWork::simulation: return !scene.deformation ? kRigid : scene.deformation->scheme == Scheme::lagged ? kLagged : kImplicit;
    case DiscWork::limits: return !scene.deformation ? kRigid : scene.deformation->scheme == Scheme::lagged ? kLaggedLimits : kImplicit;
    case DiscWork::statics:
      if (discs > kManyDiscs) return (scene.deformation ? kManySoftFactors : kManyFactors) * std::log2(discs);
      return (scene.deformation ? kSoftFactors : kFactors) * std::log2(discs + 2.0);
  }
  return 0.0;
}

/// In two digits, rounded down. Where bytes grow faster than the count, a little more would fit.
std::string what_fits(const MemoryPart& part, double available) {
  const double count = part.count * available / part.bytes;
  if (!(count >= 1.0)) return "";
  const double unit = std::pow(10.0, std::floor(std::log10(count)) - 1.0);
  return fmt::format(", enough for {:.2g}", unit * std::floor(count / unit));
}

}  // namespace

void require_memory(const Scene& scene, std::span<const MemoryPart> parts) {
  const double needed = std::accumulate(parts.begin(), parts.end(), 0.0, [](double sum, const MemoryPart& p) { return sum + p.bytes; });
  // Asking takes a dozen files of the kernel: not again for the thousands of simulations of a campaign that need next to nothing
  // of what was there before.
  static std::atomic<double> last{0.0};
  if (needed < last / 64.0) return;
  const double available = last = available_memory();
  if (needed <= available) return;
  const MemoryPart& largest = *std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.bytes < b.bytes; });
  throw InputError(scene_problem(scene, largest.key,
                                 fmt::format("{} would take {} of memory, with the rest {}, and {} are left{}", largest.what, bytes_text(largest.bytes),
                                             bytes_text(needed), bytes_text(available), what_fits(largest, available - (needed - largest.bytes))),
                                 std::string(largest.remedy)));
}

std::optional<double> planned_discs(const Scene& scene) {
  if (const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing)) return static_cast<double>(random->discs);
  const auto* hexagonal = std::get_if<HexagonalPacking>(&scene.assembly.packing);
  if (hexagonal == nullptr) return std::nullopt;
  if (const auto* r = std::get_if<HexagonalRectangle>(&hexagonal->size)) return static_cast<double>(r->discs);
  const auto& lattice = std::get<HexagonalLattice>(hexagonal->size);
  return static_cast<double>(lattice.columns) * static_cast<double>(lattice.rows);
}

MemoryPart memory_of_discs(const Scene& scene, double discs, DiscWork work) {
  std::string_view key = "assembly.discs";
  for (const std::string_view other : {"assembly.columns", "assembly.file"}) {
    if (scene.places.contains(std::string(other))) key = other;
  }
  return {fmt::format("{:.3g} discs", discs), discs * bytes_a_disc(scene, discs, work), key, "take fewer discs, or a machine with more memory", discs};
}

void require_memory_of_discs(const Scene& scene, DiscWork work) {
  const std::optional<double> discs = planned_discs(scene);
  if (!discs) return;
  const MemoryPart part = memory_of_discs(scene, *discs, work);
  require_memory(scene, {&part, 1});
}

double memory_of_samples(double samples, double probes, bool as_text) { return (as_text ? 200.0 : 72.0) * samples * probes; }

double memory_of_snapshots(double discs, int snapshots) { return 120.0 * static_cast<double>(snapshots) * discs; }

double memory_of_packings(double discs, int packings, int at_once) {
  return discs * (packings * kPacking + at_once * kVariantFactors * std::log2(discs + 2.0));
}

void require_memory_of_packings(const Scene& scene, int packings, int at_once) {
  const std::optional<double> discs = planned_discs(scene);
  if (!discs) return;
  MemoryPart part = memory_of_discs(scene, *discs, DiscWork::statics);
  part.bytes = memory_of_packings(*discs, packings, at_once);
  if (packings > 1 || at_once > 1) {
    part.what = fmt::format("{} packings of {:.3g} discs, and the statics of {} at a time,", packings, *discs, at_once);
    part.remedy = "take fewer discs or seeds, or a machine with more memory";
  }
  require_memory(scene, {&part, 1});
}

}  // namespace ddem::harness
