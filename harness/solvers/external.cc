#include "harness/solvers/external.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "harness/io/digest.h"
#include "harness/io/errors.h"
#include "harness/io/json.h"
#include "harness/io/subprocess.h"
#include "harness/io/temporary_folder.h"
#include "harness/scene/violation.h"
#include "harness/solvers/exchange.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kVersionSeconds = 20.0;
constexpr std::size_t kSaid = 300;              // bytes of what it said, in messages
constexpr std::uintmax_t kBytesOfNumber = 64;   // far more than any number takes in a file
constexpr std::uintmax_t kBytesOfReport = 1 << 20;

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += by.size()) text.replace(at, mark.size(), by);
  return text;
}

/// The program's file; empty where it is none that can be found.
fs::path file_of(const std::string& program) {
  std::error_code ignored;
  if (program.find('/') != std::string::npos) return fs::is_regular_file(program, ignored) ? fs::path(program) : fs::path();
  const char* path = std::getenv("PATH");
  std::string folders = path == nullptr ? "" : path;
  for (std::size_t end; !folders.empty(); folders.erase(0, end == std::string::npos ? end : end + 1)) {
    end = folders.find(':');
    const fs::path file = fs::path(folders.substr(0, end)) / program;
    if (fs::is_regular_file(file, ignored)) return file;
  }
  return {};
}

/// What the program said last, in one line.
std::string last_words(const SubprocessResult& run) {
  std::string said = run.standard_error.empty() ? run.standard_output : run.standard_error;
  while (!said.empty() && std::isspace(static_cast<unsigned char>(said.back()))) said.pop_back();
  if (said.size() > kSaid) said = "..." + said.substr(said.size() - kSaid);
  return said.empty() ? "it said nothing" : "it said: " + printable(said, 4 * kSaid);
}

class External : public Solver {
 public:
  External(SolverDescription description, Translation translation) : description_(std::move(description)), translation_(std::move(translation)) { find_version(); }

  std::string name() const override { return description_.name; }
  std::string version() const override { return version_; }
  std::string identity() const override { return identity_; }
  Abilities abilities() const override { return description_.abilities; }

  SimulationResult solve(const ddem::Assembly& assembly, const SimulationInput& input) const override {
    check_input(assembly, input);
    if (const std::string reason = refusal(*this, assembly, input); !reason.empty()) throw UnsupportedError(reason);
    Exchange exchange{assembly, input, {}, {}};
    for (std::size_t r = 0; r < input.receivers.size(); ++r) exchange.receivers.push_back(fmt::format("r{}", r));
    const TemporaryFolder folder("ddem-solver");
    translation_.write ? translation_.write(folder.path(), exchange) : write_exchange(folder.path(), exchange);
    const auto start = std::chrono::steady_clock::now();
    const SubprocessResult run = call(description_.command, folder.path(), description_.time_limit);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (run.timed_out) fail(fmt::format("killed at its time limit of {:.4g} s (time_limit)", description_.time_limit), run);
    if (!run.succeeded()) fail(run.status(), run);
    SimulationResult result = translation_.read ? translated(folder.path(), exchange, run) : found(folder.path(), exchange, seconds, run);
    result.steps_done = input.steps;
    if (input.on_progress) input.on_progress(1.0);
    return result;
  }

  std::string further_refusal(const ddem::Assembly& assembly, const SimulationInput& input) const override {
    const std::string reason = translation_.refusal ? translation_.refusal(assembly, input) : "";
    return reason.empty() ? "" : fmt::format("{} cannot do {}", description_.name, reason);
  }

 private:
  SimulationResult translated(const fs::path& folder, const Exchange& exchange, const SubprocessResult& run) const {
    try {
      return translation_.read(folder, exchange, run.standard_output);
    } catch (const NonFiniteSignal& e) {
      throw SolverError(fmt::format("{}: {}", description_.name, e.what()));
    } catch (const InputError& e) {
      fail(e.what(), run);
    }
  }

  SimulationResult found(const fs::path& folder, const Exchange& exchange, double seconds, const SubprocessResult& run) const {
    SimulationResult report;
    report.wall_seconds = seconds;
    read_report(folder / "solver.json", report, run);
    SimulationResult result = read(folder, exchange, run);
    result.wall_seconds = report.wall_seconds;
    result.energy_drift = report.energy_drift;
    return result;
  }

  [[noreturn]] void fail(const std::string& what, const SubprocessResult& run) const {
    throw MachineError(fmt::format("{}: {}; {}", description_.name, what, last_words(run)));
  }

  SubprocessResult call(const std::vector<std::string>& command, const fs::path& folder, double seconds) const {
    std::vector<std::string> words;
    for (const std::string& word : command) words.push_back(replaced(replaced(word, "{folder}", folder.string()), "{ranks}", std::to_string(description_.ranks)));
    const std::string program = words.front();
    words.erase(words.begin());
    return run_confined(program, words, {folder, description_.may_write, seconds});
  }

  /// A file that the program left, itself and no link to another, of a size that it can have.
  void require_file(const fs::path& file, std::uintmax_t most, const SubprocessResult& run) const {
    struct stat status {};
    const std::string called = file.filename().string();
    if (::lstat(file.c_str(), &status) != 0) fail(fmt::format("ended, and left no {}", called), run);
    if (!S_ISREG(status.st_mode)) fail(fmt::format("left a {} that is no regular file", called), run);
    if (static_cast<std::uintmax_t>(status.st_size) > most)
      fail(fmt::format("left a {} of {} bytes, more than {} can take", called, static_cast<std::uintmax_t>(status.st_size), most), run);
  }

  SimulationResult read(const fs::path& folder, const Exchange& exchange, const SubprocessResult& run) const {
    const fs::path file = folder / "signals.csv";
    const auto rows = static_cast<std::uintmax_t>(sample_count(exchange.input)) + 1, columns = 3 * static_cast<std::uintmax_t>(exchange.receivers.size()) + 1;
    require_file(file, kBytesOfNumber * rows * columns + kBytesOfReport, run);
    SimulationResult result;
    try {
      result.signals = read_exchange_signals(file, exchange);
    } catch (const NonFiniteSignal& e) {
      throw SolverError(fmt::format("{}: {}", description_.name, replaced(e.what(), file.string(), "signals.csv")));
    } catch (const InputError& e) {
      fail(replaced(e.what(), file.string(), "signals.csv"), run);
    }
    return result;
  }

  /// {"status", "wall_seconds", "energy_drift"}, each of them or none. SolverError where the status is not "ok".
  void read_report(const fs::path& file, SimulationResult& result, const SubprocessResult& run) const {
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) return;
    require_file(file, kBytesOfReport, run);
    const auto number = [](const Json& j, const char* key, double least) {
      const Json& value = j.at(key);
      if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < least)
        throw InputError(fmt::format("solver.json: {} is not a number from {} on", key, least));
      return value.get<double>();
    };
    try {
      const Json j = read_json(file);
      if (!j.is_object()) throw InputError("solver.json: not an object");
      if (const Json status = j.value("status", Json("ok")); status != "ok")
        throw SolverError(fmt::format("{}: says that it is not ok: {}", description_.name, printable(status.dump(), kSaid)));
      if (j.contains("wall_seconds")) result.wall_seconds = number(j, "wall_seconds", 0.0);
      if (j.contains("energy_drift")) result.energy_drift = number(j, "energy_drift", 0.0);
    } catch (const InputError& e) {
      fail(replaced(e.what(), file.string(), "solver.json"), run);
    }
  }

  void find_version() {
    std::string files;
    for (std::size_t k = 0; k < description_.command.size(); ++k) {
      const fs::path file = k == 0 ? file_of(description_.command[k]) : fs::path(description_.command[k]);
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored)) files += sha256_of_file(file) + "\n";
    }
    if (!description_.version_command.empty()) {
      const TemporaryFolder folder("ddem-solver");
      const SubprocessResult run = call(description_.version_command, folder.path(), kVersionSeconds);
      if (!run.succeeded()) fail("asked for its version: " + run.status(), run);
      const std::string said = translation_.version ? translation_.version(run.standard_output) : run.standard_output;
      version_ = printable(said.substr(0, said.find('\n')), 200);
    }
    if (version_.empty()) version_ = "version unknown";
    identity_ = fmt::format("{} {} {}", description_.name, version_, sha256(fmt::format("{}\n{}{}\n{}", description_.text, files, version_, description_.ranks)).substr(0, 16));
  }

  SolverDescription description_;
  Translation translation_;
  std::string version_, identity_;
};

}  // namespace

std::shared_ptr<const Solver> external_solver(SolverDescription description, Translation translation) {
  return std::make_shared<External>(std::move(description), std::move(translation));
}

std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t mark = text.find(before);
  if (mark == std::string_view::npos) return {};
  text.remove_prefix(mark + before.size());
  return text.substr(0, std::min(text.find(after), text.size()));
}

double number_between(const std::string& printed, std::string_view before, std::string_view after) {
  double value = 0.0;
  const std::string_view text = between(printed, before, after);
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || rest != text.data() + text.size() || !std::isfinite(value))
    throw InputError(fmt::format("its time cannot be read: there is no number between \"{}\" and \"{}\"", before, after));
  return value;
}

}  // namespace ddem::harness
