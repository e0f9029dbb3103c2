#include "harness/nightly/broken_since.h"

#include <fmt/format.h>

#include <algorithm>

namespace ddem::harness::nightly {

std::vector<std::string> broken_since(const std::vector<Night>& nights) {
  if (nights.empty()) return {};
  const auto fails = [](const Night& night, const std::string& id) {
    const auto& all = night.summary.verdicts;
    const auto found = std::find_if(all.begin(), all.end(), [&id](const reports::Verdict& v) { return v.case_id == id; });
    return found != all.end() && reports::is_failure(found->state);
  };
  std::vector<std::pair<std::size_t, std::string>> broken;  // for how many nights, and which
  for (const reports::Verdict& v : nights.back().summary.verdicts) {
    if (!reports::is_failure(v.state)) continue;
    std::size_t count = 1;
    while (count < nights.size() && fails(nights[nights.size() - 1 - count], v.case_id)) ++count;
    broken.emplace_back(count, v.case_id);
  }
  std::stable_sort(broken.begin(), broken.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> sentences;
  for (const auto& [count, id] : broken) {
    sentences.push_back(count == 1 ? fmt::format("{} broke this night.", id)
                                   : fmt::format("{} fails since {}, {} nights.", id, nights[nights.size() - count].time, count));
  }
  return sentences;
}

}  // namespace ddem::harness::nightly
