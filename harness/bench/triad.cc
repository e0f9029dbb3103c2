#include "harness/bench/triad.h"

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

namespace ddem::harness::bench {
namespace {

constexpr std::size_t kEntries = std::size_t{1} << 23;  // 64 MB an array
constexpr int kPasses = 6;

void on_threads(int threads, const auto& job) {
  std::vector<std::jthread> team;
  for (int id = 1; id < threads; ++id) team.emplace_back(job, id);
  job(0);
}

}  // namespace

double triad_gb_per_s(int threads) {
  const auto part = [&](int id) { return kEntries * static_cast<std::size_t>(id) / static_cast<std::size_t>(threads); };
  // Not touched before the threads that will use them do.
  const auto a = std::make_unique_for_overwrite<double[]>(kEntries), b = std::make_unique_for_overwrite<double[]>(kEntries),
             c = std::make_unique_for_overwrite<double[]>(kEntries);
  on_threads(threads, [&](int id) {
    for (std::size_t k = part(id); k < part(id + 1); ++k) a[k] = 0.0, b[k] = static_cast<double>(k), c[k] = 1.0;
  });
  double best = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kPasses; ++pass) {
    const double scale = 1.0 + pass;
    const auto start = std::chrono::steady_clock::now();
    on_threads(threads, [&](int id) {
      const auto mine = [&](const auto& all) { return Eigen::Map<Eigen::ArrayXd>(all.get() + part(id), static_cast<Eigen::Index>(part(id + 1) - part(id))); };
      // By Eigen, which takes several a time however this is compiled: one by one the processor is measured, not its memory.
      mine(a) = mine(b) + scale * mine(c);
    });
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  // Every entry is a whole number below 2^53: what was computed is looked at, and was right.
  const bool right = a[kEntries - 1] == b[kEntries - 1] + kPasses;
  return right ? 24.0 * static_cast<double>(kEntries) / best * 1e-9 : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace ddem::harness::bench
