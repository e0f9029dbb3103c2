#include "harness/scene/check_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "harness/scene/key_rules.h"

namespace ddem::harness {
namespace {

/// A value that is not a choice, or wrong, is none of `choices`.
bool is_one_of(const Values& values, std::string_view key, std::string_view choices) {
  const std::vector<std::string_view> names = split_names(choices);
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return values.is(key, name); });
}

bool stands(const Values& values, std::string_view key, std::string_view choices) {
  return values.given(key) && (choices.empty() || is_one_of(values, key, choices));
}

class RuleCheck {
 public:
  RuleCheck(Values& values, bool discs_needed) : values_(values), discs_needed_(discs_needed) {}

  void apply(const Exclusion& rule) {
    const std::vector<std::string_view> firsts = split_names(rule.first.keys);
    const auto first = std::find_if(firsts.begin(), firsts.end(),
                                    [&](std::string_view key) { return stands(values_, key, rule.first.values); });
    if (first == firsts.end()) return;
    for (const std::string_view key : split_names(rule.second.keys)) {
      if (!stands(values_, key, rule.second.values)) continue;
      refuse(key, rule.message.empty() ? fmt::format("contradicts {}", *first) : std::string(rule.message),
             std::string(rule.remedy));
    }
  }

  void apply(const OnlyWith& rule) {
    // A selector that is missing is said once, for itself, and one that is wrong too.
    const bool chosen = values_.has(rule.selector);
    if (!chosen && (discs_needed_ || values_.given(rule.selector))) return;
    if (chosen && is_one_of(values_, rule.selector, rule.choices)) return;
    for (const std::string_view key : split_names(rule.keys)) {
      if (!values_.given(key)) continue;
      refuse(key, fmt::format("means nothing unless {} = {}", rule.selector, quoted_choices(rule.choices)), "leave it out");
    }
  }

 private:
  void refuse(std::string_view key, std::string message, std::string remedy) {
    if (refused_.insert(key).second) values_.reject(key, std::move(message), std::move(remedy));
  }

  Values& values_;
  bool discs_needed_;
  std::set<std::string_view> refused_;
};

}  // namespace

void check_rules(Values& values, bool discs_needed) {
  RuleCheck check(values, discs_needed);
  for (const Exclusion& rule : exclusions()) check.apply(rule);
  for (const OnlyWith& rule : only_with_rules()) check.apply(rule);
}

}  // namespace ddem::harness
