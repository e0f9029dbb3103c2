#include "harness/campaign/report_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "harness/campaign/facets.h"
#include "harness/provenance/provenance.h"

namespace ddem::harness {
namespace {

template <class T>
void append(std::vector<T>& to, std::vector<T>&& from) {
  std::ranges::move(from, std::back_inserter(to));
}

void add_section(std::vector<reports::Section>& sections, reports::Section section) {
  const auto same = std::ranges::find(sections, section.heading, &reports::Section::heading);
  if (same == sections.end()) {
    sections.push_back(std::move(section));
    return;
  }
  append(same->paragraphs, std::move(section.paragraphs));
  append(same->figures, std::move(section.figures));
  append(same->tables, std::move(section.tables));
}

/// A result that no study foresaw, of a damaged file perhaps, must not cost the report.
std::vector<reports::Section> sections_of(const PlannedStudy& s) {
  try {
    return s.study->sections();
  } catch (const std::exception& e) {
    return {{.heading = std::string(s.entry->title), .paragraphs = {fmt::format("Not drawn: {}", e.what())}}};
  }
}

/// What lacks results cannot always be drawn: the report is there all the same, and says so.
void leave_out_undrawable(reports::Section& section) {
  std::erase_if(section.figures, [&](const reports::Figure& figure) {
    try {
      reports::require_valid(figure);
      return false;
    } catch (const std::invalid_argument& e) {
      section.paragraphs.push_back(fmt::format("Not drawn: {}", e.what()));
      return true;
    }
  });
}

void introduce(const nlohmann::json& tables, reports::Report& report) {
  for (const InputTable& t : input_tables()) {
    if (tables.contains(t.name)) t.introduce(tables.at(std::string(t.name)), report);
  }
}

}  // namespace

std::string campaign_title(const nlohmann::json& tables) {
  reports::Report report;
  introduce(tables, report);
  return report.title;
}

reports::Report report_of(const CampaignResults& r, const std::vector<reports::Verdict>& verdicts, const std::vector<reports::Section>& more) {
  reports::Report report;
  report.verdicts = verdicts;
  for (reports::Verdict& v : report.verdicts) v.facets = facets_of(v.case_id);
  report.provenance = provenance();
  if (!r.solver.empty()) report.provenance.emplace_back("solver", r.solver);
  introduce(r.tables, report);
  nightly::WorkCounts work;
  for (const PlannedStudy& s : r.studies) {
    s.study->introduce(report);
    s.study->count(work);
    if (!s.is_asked_for) continue;
    for (reports::Section& section : sections_of(s)) {
      for (reports::Figure& figure : section.figures) figure.made_by = fmt::format("ddem validate --only {}", s.entry->id);
      add_section(report.sections, std::move(section));
    }
  }
  report.sections.insert(report.sections.end(), more.begin(), more.end());
  for (reports::Section& section : report.sections) leave_out_undrawable(section);
  report.provenance.emplace_back("simulations", std::to_string(work.simulations));
  report.provenance.emplace_back("wall time", fmt::format("{:.1f} s", r.wall_seconds));
  return report;
}

}  // namespace ddem::harness
