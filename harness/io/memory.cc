#include "harness/io/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  double value = 0.0;
  if (stream >> value) return value;
  return std::nullopt;  // absent, or "max"
}

double free_of_machine(const fs::path& root) {
  std::ifstream stream(root / "proc/meminfo");
  for (std::string line; std::getline(stream, line);) {
    double kilobytes = 0.0;
    if (std::sscanf(line.c_str(), "MemAvailable: %lf kB", &kilobytes) == 1) return kilobytes * 1024.0;
  }
  return HUGE_VAL;
}

/// The files of one version of control groups. What is used counts the cache of files, which the kernel gives back when asked.
struct GroupFiles {
  const char *limit, *usage, *cache;
};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles version_2{"memory.max", "memory.current", "inactive_file"};

double cache_of(const fs::path& group, const char* name) {
  std::ifstream stream(group / "memory.stat");
  std::string key;
  double value = 0.0;
  while (stream >> key >> value) {
    if (key == name) return value;
  }
  return 0.0;
}

/// Of a group and all above it: each may have a limit.
double left_by_groups(const fs::path& top, fs::path group, const GroupFiles& files) {
  double left = HUGE_VAL;
  while (true) {
    const auto most = number_in(top / group / files.limit), used = number_in(top / group / files.usage);
    if (most && used) left = std::min(left, std::max(0.0, *most - *used + cache_of(top / group, files.cache)));
    if (group.empty()) return left;
    group = group.parent_path();
  }
}

/// A line is "0::/user.slice" (version 2), or "4:memory:/user.slice" (version 1). In a container the named group may lie outside
/// of what is mounted; the top of the mount is then the container's own.
double left_by_control_groups(const fs::path& root) {
  double left = HUGE_VAL;
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path group = fs::path(line.substr(second + 1)).relative_path();
    const fs::path top = root / "sys/fs/cgroup";
    if (controllers.empty()) left = std::min(left, left_by_groups(top, group, version_2));
    if (controllers == "memory") left = std::min(left, left_by_groups(top / "memory", group, version_1));
  }
  return left;
}

double left_of_address_space(const fs::path& root, double limit) {
  const auto pages = number_in(root / "proc/self/statm");
  if (!pages || !std::isfinite(limit)) return HUGE_VAL;
  return std::max(0.0, limit - *pages * static_cast<double>(::sysconf(_SC_PAGESIZE)));
}

}  // namespace

double available_memory(const fs::path& root, double address_space) {
  return std::min({free_of_machine(root), left_by_control_groups(root), left_of_address_space(root, address_space)});
}

double available_memory() {
  rlimit limit{};
  const bool limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return available_memory("/", limited ? static_cast<double>(limit.rlim_cur) : HUGE_VAL);
}

std::string bytes_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.3g} MB", bytes * 1e-6) : fmt::format("{:.3g} GB", bytes * 1e-9);
}

}  // namespace ddem::harness
