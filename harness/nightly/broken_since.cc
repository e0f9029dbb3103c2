#include "harness/nightly/broken_since.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace ddem::harness::nightly {

namespace {

constexpr std::size_t kTold = 5;

/// Nothing where the night has not got the case, or did not run it.
std::optional<bool> fails(const Night& night, const std::string& id) {
  const auto& all = night.summary.verdicts;
  const auto found = std::find_if(all.begin(), all.end(), [&id](const reports::Verdict& v) { return v.case_id == id; });
  if (found == all.end() || found->state == reports::State::skipped) return std::nullopt;
  return reports::is_failure(found->state);
}

struct Broken {
  std::string id, since = {};
  int nights = 0;
  bool was_right = false;
};

}  // namespace

std::vector<std::string> broken_since(const std::vector<Night>& nights) {
  std::vector<Broken> all;
  if (nights.empty()) return {};
  for (const reports::Verdict& v : nights.back().summary.verdicts) {
    if (!reports::is_failure(v.state)) continue;
    Broken broken{.id = v.case_id};
    for (auto night = nights.rbegin(); night != nights.rend() && !broken.was_right; ++night) {
      const std::optional<bool> failed = fails(*night, v.case_id);
      if (!failed) continue;
      broken.was_right = !*failed;
      if (*failed) broken.since = night->time, ++broken.nights;
    }
    all.push_back(std::move(broken));
  }
  std::stable_sort(all.begin(), all.end(), [](const Broken& a, const Broken& b) { return a.nights > b.nights; });
  std::vector<std::string> sentences;
  for (const Broken& b : all) {
    if (sentences.size() == kTold) {
      sentences.push_back(fmt::format("{} more fail.", all.size() - kTold));
      break;
    }
    sentences.push_back(b.nights > 1   ? fmt::format("{} fails since {}, {} nights.", b.id, b.since, b.nights)
                        : b.was_right ? fmt::format("{} broke this night.", b.id)
                                      : fmt::format("{} fails in its first night.", b.id));
  }
  return sentences;
}

}  // namespace ddem::harness::nightly
