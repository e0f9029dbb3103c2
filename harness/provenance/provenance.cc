#include "harness/provenance/provenance.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hdf5.h>

#include <Eigen/Core>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

#include "dem/kernel/step_data.h"
#include "harness/io/atomic_file.h"
#include "harness/io/digest.h"
#include "harness/io/own_files.h"

namespace ddem::harness {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) {
      const auto colon = line.find(": ");
      if (colon != std::string::npos) return line.substr(colon + 2);
    }
  }
  return "unknown";
}

std::string instruction_set() {
  switch (best_instruction_set()) {
    case InstructionSet::baseline: return "baseline";
    case InstructionSet::avx2: return "AVX2";
    case InstructionSet::avx512: return "AVX-512";
  }
  return "unknown";
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{} (serial)", major, minor, release);
}

std::string libraries() {
  return fmt::format("Eigen {}.{}.{}, HDF5 {}, fmt {}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                     hdf5_version(), FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
}

/// Of which the program was built; of a build without git "unknown".
std::string commit() {
  const std::filesystem::path file = shared_file("commit");
  const std::string commit = std::filesystem::exists(file) ? read_file(file) : std::string();
  return commit.empty() ? "unknown" : commit;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> provenance() {
  return {{"version", DDEM_VERSION},
          {"commit", commit()},
          {"compiler", DDEM_COMPILER},
          {"build", DDEM_BUILD},
          {"libraries", libraries()},
          {"processor", processor()},
          {"cores", std::to_string(std::thread::hardware_concurrency())},
          {"instruction set", instruction_set()},
          {"time", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
}

const std::string& program_identity() {
  static const std::string identity = [] {
    std::string digests = sha256_of_file("/proc/self/exe");  // even where the file was replaced meanwhile
    if (const auto fem = program_folder() / "ddem-fem"; std::filesystem::exists(fem)) digests += sha256_of_file(fem);
    return fmt::format("ddem {} ({:.16})", DDEM_VERSION, sha256(digests));
  }();
  return identity;
}

std::string version_text() {
  return fmt::format("ddem {}\n{}, {}\n{}\n", DDEM_VERSION, DDEM_COMPILER, DDEM_BUILD, libraries());
}

}  // namespace ddem::harness
