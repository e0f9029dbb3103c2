#include "harness/campaign/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "harness/io/errors.h"
#include "harness/scene/nearest_name.h"

namespace ddem::harness {
namespace {

/// "paper-protocol" is as good as "paper_protocol".
std::string as_id(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string first_part(const std::string& case_id) {
  return case_id.substr(0, case_id.find('/'));
}

bool is_below(const std::string& case_id, const std::string& name) {
  return case_id == name || case_id.starts_with(name + "/");
}

std::vector<PlannedStudy> make_studies(const CampaignSpec& spec, const CampaignOptions& options, std::span<const std::string> only,
                                       const std::set<std::string_view>* present) {
  SharedObjects shared;
  const StudyContext context{spec.tables, only, options, shared};
  std::vector<PlannedStudy> made;
  for (const StudyEntry& entry : studies()) {
    if (!spec.has(entry.table) || (present != nullptr && !present->contains(entry.id))) continue;
    made.push_back({&entry, entry.make(context)});
  }
  return made;
}

bool is_chosen(const CampaignSpec& spec, std::string_view study) {
  return spec.studies.empty() || std::ranges::find(spec.studies, study) != spec.studies.end();
}

/// What is called `only` among the studies that are run; all of them without it.
class CasesAskedFor {
 public:
  CasesAskedFor(const CampaignSpec& spec, const std::vector<PlannedStudy>& all) {
    for (const PlannedStudy& s : all) {
      const bool chosen = is_chosen(spec, s.entry->id), whole = chosen && (spec.only.empty() || as_id(spec.only) == s.entry->id);
      if (whole) take_whole(s);
      for (const Judged& j : s.study->judge()) {
        if (chosen) names_.push_back(j.verdict.case_id);
        if (whole || (chosen && is_below(j.verdict.case_id, spec.only))) take(s, j);
      }
      for (const Piece& p : s.study->pieces()) owner_[p.unit.id] = s.entry->id;
      if (chosen) names_.emplace_back(s.entry->id);
    }
    if (asked_.empty()) refuse(spec);
  }

  std::set<std::string> units, cases;
  const std::set<std::string_view>& asked() const { return asked_; }
  /// The studies whose units are run, besides those asked for.
  std::set<std::string_view> present() const {
    std::set<std::string_view> all = asked_;
    for (const std::string& unit : units) all.insert(owner_.at(unit));
    return all;
  }

 private:
  void take_whole(const PlannedStudy& s) {
    asked_.insert(s.entry->id);
    for (const Piece& p : s.study->pieces()) units.insert(p.unit.id);
  }

  void take(const PlannedStudy& s, const Judged& j) {
    asked_.insert(s.entry->id);
    cases.insert(j.verdict.case_id);
    units.insert(j.units.begin(), j.units.end());
  }

  [[noreturn]] void refuse(const CampaignSpec& spec) const {
    const std::vector<std::string_view> names(names_.begin(), names_.end());
    const auto near = nearest_name(spec.only, names);
    throw InputError(fmt::format("--only {}: no such case or study; {}", spec.only,
                                 near ? fmt::format("did you mean {}?", *near) : "ddem validate --list names them"));
  }

  std::set<std::string_view> asked_;
  std::vector<std::string> names_;
  std::map<std::string, std::string_view> owner_;
};

}  // namespace

bool Selection::has(const std::string& case_id) const {
  if (cases.contains(case_id)) return true;
  const bool whole = only.empty() || std::ranges::any_of(studies, [&](const PlannedStudy& s) { return s.entry->id == as_id(only); });
  if (!whole) return is_below(case_id, only);
  return std::ranges::any_of(cases, [&](const std::string& id) { return first_part(id) == first_part(case_id); });
}

Selection select(const CampaignSpec& spec, const CampaignOptions& options) {
  const CasesAskedFor choice(spec, make_studies(spec, options, {}, nullptr));
  Selection s;
  s.only = spec.only;
  s.units = choice.units;
  s.cases = choice.cases;
  const std::vector<std::string> only(s.cases.begin(), s.cases.end());
  const std::set<std::string_view> present = choice.present();
  s.studies = make_studies(spec, options, spec.only.empty() ? std::span<const std::string>{} : only, &present);
  for (PlannedStudy& study : s.studies) study.is_asked_for = choice.asked().contains(study.entry->id);
  return s;
}

std::vector<StudyListing> list_studies(const CampaignSpec& spec, const CampaignOptions& options) {
  const std::vector<PlannedStudy> all = make_studies(spec, options, {}, nullptr);
  std::vector<StudyListing> list;
  for (const PlannedStudy& s : all) {
    if (!is_chosen(spec, s.entry->id)) continue;
    StudyListing listing{std::string(s.entry->id), std::string(s.entry->title), {}, {}};
    CampaignSpec alone = spec;
    alone.only = listing.id;
    const CasesAskedFor choice(alone, all);
    for (const std::string_view id : choice.present()) {
      if (id != s.entry->id) listing.needs.emplace_back(id);
    }
    for (const Judged& j : s.study->judge()) listing.cases.push_back(j.verdict.case_id);
    for (const PlannedStudy& other : all) {
      for (const Piece& p : other.study->pieces()) {
        if (choice.units.contains(p.unit.id)) listing.seconds += kSecondsOfWork * static_cast<double>(p.unit.work);
      }
    }
    list.push_back(std::move(listing));
  }
  return list;
}

}  // namespace ddem::harness
