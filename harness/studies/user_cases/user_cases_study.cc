// The user's own scenes.
#include <algorithm>

#include "harness/campaign/pieces.h"
#include "harness/studies/user_cases/user_case.h"

namespace ddem::harness {
namespace {

class UserCasesStudy : public Study {
 public:
  UserCasesStudy(const nlohmann::json& cases, const Solver& solver) {
    for (const nlohmann::json& c : cases) results_.push_back({c.get<UserCase>(), {.failure = "not run", .diverged_step = {}, .metrics = {}, .missing = {}, .warnings = {}}});
    for (CaseResult& r : results_) {
      pieces_.push_back(piece_at(r.found, "case/" + r.c.id, inputs_of_case(r.c), 20, [c = r.c, &solver] { return run_user_case(c, solver); },
                                 [](const UserCaseOutcome&, const UserCaseOutcome&) { return true; }));
      pieces_.back().unit.memory = memory_of_case(r.c);
    }
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    for (const CaseResult& r : results_) judged.push_back({case_verdict(r), {"case/" + r.c.id}});
    return judged;
  }

  void count(nightly::WorkCounts& work) const override {
    for (const CaseResult& r : results_) {
      const auto asks_for = [&](std::string_view group) {
        return r.found.failure.empty() && std::ranges::any_of(r.c.criteria, [&](const CaseCriterion& c) { return group_of(c.metric) == group || (!c.reference.empty() && group_of(c.reference) == group); });
      };
      work.simulations += asks_for("") ? 1 : 0;
      work.finite_element_runs += asks_for("fem") ? 1 : 0;
    }
  }

  nlohmann::json data() const override {
    nlohmann::json j = nlohmann::json::object();
    for (const CaseResult& r : results_) j[r.c.id] = r.found;
    return j;
  }

 private:
  std::vector<CaseResult> results_;
};

}  // namespace

std::unique_ptr<Study> make_user_cases(const StudyContext& context) {
  return std::make_unique<UserCasesStudy>(context.tables.at("case"), *context.options.solver);
}

}  // namespace ddem::harness
