#include "harness/model/packing_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <vector>

#include "harness/io/atomic_file.h"
#include "harness/io/digest.h"
#include "harness/io/message.h"
#include "harness/io/progress.h"
#include "harness/io/regular_file.h"
#include "harness/io/seal.h"
#include "meshes/packings/tiling.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

// First word of a file. It reads differently where bytes have another order.
constexpr std::uint64_t kFormat = 0x32676e696b636170ULL;  // "packing2"

constexpr std::string_view kFilePrefix = "packing-";

void append(std::string& bytes, std::uint64_t word) {
  char raw[sizeof word];
  std::memcpy(raw, &word, sizeof word);
  bytes.append(raw, sizeof word);
}

void append(std::string& bytes, const std::vector<double>& values) {
  for (const double value : values) append(bytes, std::bit_cast<std::uint64_t>(value));
}

/// Everything that decides on the packing's bits.
std::string header(const packings::RandomSpec& spec) {
  std::string bytes;
  append(bytes, kFormat);
  append(bytes, packings::kJammingBits);
  append(bytes, std::vector<double>{spec.length, spec.width, spec.radius_ratio});
  append(bytes, static_cast<std::uint64_t>(spec.discs));
  append(bytes, spec.seed);
  append(bytes, (spec.walls.x ? 1u : 0u) + (spec.walls.y ? 2u : 0u));
  if (spec.grading.law != packings::Grading::Law::uniform) {
    append(bytes, static_cast<std::uint64_t>(spec.grading.law));
    append(bytes, static_cast<std::uint64_t>(spec.grading.sieve.radius.size()));
    for (const auto* values : {&spec.grading.sieve.radius, &spec.grading.sieve.passing}) append(bytes, *values);
  }
  return bytes;
}

std::vector<double> doubles(std::string_view bytes) {
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// What takes longer than a moment says how far it is.
Packing jammed(const packings::RandomSpec& spec) {
  if (spec.discs <= packings::kLargestJammed) return packings::random_jammed(spec);
  Progress progress(1, "jamming");
  return packings::random_jammed(spec, [&](double overlap) {
    progress.set_label(fmt::format("jamming: largest overlap {:.2g} mean radii, {:.2g} in the end", overlap, packings::kJammedOverlap));
  });
}

Packing made_or_cached(const packings::RandomSpec& spec) {
  const auto folder = packing_cache_folder();
  if (!folder) return jammed(spec);
  const fs::path file = packing_cache_file(*folder, spec);
  if (auto packing = read_cached_packing(file, spec)) {
    std::error_code ignored;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);  // used now: trim_packing_cache()
    return *packing;
  }
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(file, ignored)))
    message("{}: not the packing that was stored there: it is made anew", file.string());
  Packing packing = jammed(spec);
  write_cached_packing(file, spec, packing);
  return packing;
}

}  // namespace

std::optional<fs::path> packing_cache_folder() {
  // Both must be absolute: a relative one would leave files wherever the program is started (XDG base directories).
  const auto absolute = [](const char* variable) -> std::optional<fs::path> {
    const char* value = std::getenv(variable);
    if (value == nullptr || *value != '/') return std::nullopt;
    return fs::path(value);
  };
  if (const auto cache = absolute("XDG_CACHE_HOME")) return *cache / "ddem";
  if (const auto home = absolute("HOME")) return *home / ".cache" / "ddem";
  return std::nullopt;
}

fs::path packing_cache_file(const fs::path& folder, const packings::RandomSpec& spec) {
  return folder / fmt::format("{}{:.32}", kFilePrefix, sha256(header(spec)));
}

std::optional<Packing> read_cached_packing(const fs::path& file, const packings::RandomSpec& spec) noexcept {
  try {
    const std::string head = header(spec);
    const std::size_t column = static_cast<std::size_t>(spec.discs) * sizeof(double);
    const std::size_t expected = head.size() + 3 * column + kSealBytes;
    std::error_code error;
    if (fs::file_size(file, error) != expected || error) return std::nullopt;
    const std::string bytes = read_regular_file(file, Trust::own);
    const std::string_view content = sealed_content(bytes, file.string());
    if (bytes.size() != expected || !content.starts_with(head)) return std::nullopt;
    const auto at = [&](std::size_t k) { return doubles(content.substr(head.size() + k * column, column)); };
    Packing packing{at(0), at(1), at(2), {spec.walls.x ? 0.0 : spec.length, spec.walls.y ? 0.0 : spec.width},
                    spec.length, spec.width};
    // Who can write a file can write its digest.
    if (!packings::can_be_jammed_from(packing, spec)) return std::nullopt;
    return packing;
  } catch (...) {
    return std::nullopt;  // a cache is a convenience: whatever is wrong with it, the packing is made anew
  }
}

void trim_packing_cache(const fs::path& folder, std::uintmax_t most_bytes) noexcept {
  struct Entry {
    fs::file_time_type used;
    fs::path path;
    std::uintmax_t bytes;
  };
  try {
    std::vector<Entry> entries;
    std::uintmax_t total = 0;
    for (const fs::directory_entry& e : fs::directory_iterator(folder)) {
      if (!e.path().filename().string().starts_with(kFilePrefix) || !e.is_regular_file()) continue;
      entries.push_back({e.last_write_time(), e.path(), e.file_size()});
      total += entries.back().bytes;
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return std::tie(a.used, a.path) < std::tie(b.used, b.path); });
    for (const Entry& e : entries) {
      if (total <= most_bytes) break;
      std::error_code ignored;
      fs::remove(e.path, ignored);
      total -= e.bytes;
    }
  } catch (...) {
    // Another process trims as well, or the folder is not ours: there is a next time.
  }
}

void write_cached_packing(const fs::path& file, const packings::RandomSpec& spec, const Packing& packing) noexcept {
  try {
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    std::string bytes = header(spec);
    for (const auto* values : {&packing.x, &packing.y, &packing.radius}) append(bytes, *values);
    bytes += seal_of(bytes);
    if (!fs::is_regular_file(fs::symlink_status(file))) fs::remove(file);  // never through a link, nor into a pipe
    write_file(file, bytes);
    trim_packing_cache(file.parent_path(), kLargestPackingCache);
  } catch (...) {
    // A full disk or a folder of somebody else: the next process jams again.
  }
}

Packing stored_random_packing(const packings::RandomSpec& spec) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_future<Packing>> made;
  std::promise<Packing> promise;
  std::shared_future<Packing> packing;
  bool make = false;
  {
    const std::lock_guard lock(mutex);
    auto [entry, absent] = made.try_emplace(header(spec));
    make = absent;
    if (absent) entry->second = promise.get_future().share();
    packing = entry->second;
  }
  if (make) {
    try {
      promise.set_value(made_or_cached(spec));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return packing.get();
}

}  // namespace ddem::harness
