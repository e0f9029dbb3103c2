#include "harness/bench/peers/peer.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "harness/bench/lattice.h"
#include "harness/io/errors.h"
#include "harness/io/subprocess.h"

namespace ddem::harness::bench {
namespace {

std::string end_of(const std::string& text) { return text.substr(text.size() - std::min<std::size_t>(text.size(), 300)); }

}  // namespace

double PeerScene::diameter() const { return 2.0 * kRadius; }
double PeerScene::unit_of_time() const { return std::sqrt(assembly.mass.front() / kNormalStiffness); }

std::optional<std::string_view> between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t mark = text.find(before);
  if (mark == std::string_view::npos) return std::nullopt;
  text.remove_prefix(mark + before.size());
  const std::size_t end = text.find(after);
  if (end == std::string_view::npos || end == 0) return std::nullopt;
  return text.substr(0, end);
}

std::string run_in_folder(const PeerScene& scene, const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"-c", "cd \"$1\" && shift && exec \"$@\"", "sh", scene.folder.string(), program};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const SubprocessResult run = run_program("/bin/sh", all);
  if (!run.succeeded()) {
    throw MachineError(program + ": " + run.status() + ": " + end_of(run.standard_error.empty() ? run.standard_output : run.standard_error));
  }
  return run.standard_output;
}

double seconds_said(const std::string& program, const std::string& printed, std::string_view before, std::string_view after) {
  double value = 0.0;
  const std::string_view text = between(printed, before, after).value_or("");
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || rest != text.data() + text.size() || !std::isfinite(value)) {
    throw MachineError(program + ": its time cannot be read: " + end_of(printed));
  }
  return value;
}

}  // namespace ddem::harness::bench
