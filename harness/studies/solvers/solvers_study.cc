// Other solvers, side by side with the built-in one.
#include <fmt/format.h>

#include "harness/campaign/pieces.h"
#include "harness/io/errors.h"
#include "harness/solvers/find_solver.h"
#include "harness/studies/solvers/read_solvers.h"
#include "harness/studies/solvers/solvers_figures.h"
#include "harness/studies/solvers/solvers_verdicts.h"

namespace ddem::harness {
namespace {

/// A solver that may not be here: a report is drawn anywhere.
struct Found {
  std::shared_ptr<const Solver> solver;
  std::string reason;

  explicit Found(const std::string& name) {
    try {
      solver = find_solver(name);
    } catch (const std::exception& e) {
      reason = e.what();
    }
  }
  const Solver& get() const {
    if (!solver) throw MachineError(reason);
    return *solver;
  }
};

class SolversStudy : public Study {
 public:
  explicit SolversStudy(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const auto tasks = solver_tasks(name, label_of_solver(name));
      for (const SolverTask& t : tasks) compared_.push_back({t, {}});
    }
    std::size_t k = 0;
    for (const std::string& name : names) {
      const Found found(name);
      for (const std::size_t end = k + solver_tasks(name, "").size(); k < end; ++k) {
        ComparedSolver& c = compared_[k];
        pieces_.push_back(piece_at(c.found, c.task.id(), found.solver ? found.solver->identity() : found.reason, 40,
                                   [task = c.task, found] { return measure_solver(task, found.get()); },
                                   [](const SolverResult&, const SolverResult&) { return true; }));
      }
    }
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    for (const ComparedSolver& c : compared_) judged.push_back({solver_verdict(c), {c.task.id()}});
    return judged;
  }

  std::vector<reports::Section> sections() const override {
    reports::Section section{.heading = "Solvers side by side",
                             .paragraphs = {"Each solver is given the same strips as the built-in one, to the last bit: a random strip with a shear pulse, and a lattice with a "
                                            "bar pulse between free edges. What differs is its own."}};
    for (std::size_t begin = 0, end; begin < compared_.size(); begin = end) {
      for (end = begin; end < compared_.size() && compared_[end].task.label == compared_[begin].task.label; ++end) {}
      const std::span<const ComparedSolver> one(&compared_[begin], end - begin);
      section.figures.push_back(solver_figure(one));
      section.tables.push_back(solver_table(one));
    }
    return {section};
  }

  nlohmann::json data() const override {
    nlohmann::json j = nlohmann::json::object();
    for (const ComparedSolver& c : compared_) j[c.task.id()] = c.found;
    return j;
  }

 private:
  std::vector<ComparedSolver> compared_;
};

}  // namespace

std::unique_ptr<Study> make_solvers(const StudyContext& context) {
  return std::make_unique<SolversStudy>(context.tables.at("solvers").at("names").get<std::vector<std::string>>());
}

}  // namespace ddem::harness
