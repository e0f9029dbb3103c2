// Other solvers beside the built-in one: a right one passes, and each parameter that is wrong by a per cent fails a case that is named.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "harness/io/errors.h"
#include "harness/studies/solvers/solvers_figures.h"
#include "harness/studies/solvers/solvers_verdicts.h"

namespace ddem::harness {
namespace {

using reports::State;

/// What a solver is given, as it takes it.
struct Given {
  ddem::Assembly assembly;
  SimulationInput input;
};

/// The built-in solver, given something else.
class Wrong : public Solver {
 public:
  explicit Wrong(std::function<void(Given&)> change) : change_(std::move(change)) {}
  std::string name() const override { return "wrong"; }
  std::string version() const override { return "1"; }
  Abilities abilities() const override { return builtin_solver().abilities(); }
  SimulationResult solve(const ddem::Assembly& a, const SimulationInput& in) const override {
    Given given{a, in};
    change_(given);
    SimulationResult result = builtin_solver().solve(given.assembly, given.input);
    if (given.input.time_step != in.time_step) {  // who gets the step wrong does not know
      for (std::size_t n = 0; n < result.signals.time.size(); ++n) result.signals.time[n] *= in.time_step / given.input.time_step;
    }
    return result;
  }

 private:
  std::function<void(Given&)> change_;
};

std::vector<reports::Verdict> judge_all(const Solver& solver) {
  std::vector<reports::Verdict> verdicts;
  for (const SolverTask& task : solver_tasks("wrong", "wrong")) verdicts.push_back(solver_verdict({task, measure_solver(task, solver)}));
  return verdicts;
}

std::string failed_of(const std::vector<reports::Verdict>& verdicts) {
  std::string failed;
  for (const reports::Verdict& v : verdicts) {
    if (v.state == State::pass) continue;
    failed += v.case_id + " ";
    for (const reports::Criterion& c : v.criteria) failed += c.state == State::pass ? "" : reports::outcome_text(c) + "; ";
  }
  return failed;
}

TEST(SolverStudy, TheBuiltInOneAgreesWithItself) {
  const auto verdicts = judge_all(Wrong([](Given&) {}));
  EXPECT_EQ(failed_of(verdicts), "");
  EXPECT_EQ(verdicts.size(), 12u);
}

TEST(SolverStudy, APerCentOfAnythingIsFoundAndNamed) {
  const std::pair<const char*, std::function<void(Given&)>> kErrors[] = {
      {"k_n", [](Given& g) { g.input.contact.normal_stiffness *= 1.01; }},
      {"k_t", [](Given& g) { g.input.contact.stiffness_ratio *= 1.01; }},
      {"density", [](Given& g) {
         for (auto* of : {&g.assembly.mass, &g.assembly.inertia}) {
           for (double& value : *of) value *= 1.01;
         }
       }},
      {"time step", [](Given& g) { g.input.time_step *= 1.01; }},
      {"a missing bond", [](Given& g) {
         Bonds& b = g.assembly.bonds;
         const auto k = static_cast<std::ptrdiff_t>(b.size() / 2);
         b.i.erase(b.i.begin() + k), b.j.erase(b.j.begin() + k);
         for (auto* of : {&b.nx, &b.ny, &b.length, &b.stretch, &b.arm_i, &b.arm_j}) of->erase(of->begin() + k);
       }},
      {"no rotation", [](Given& g) { g.input.held.theta.assign(g.assembly.size(), 1); }},
      {"plane strain", [](Given& g) { g.input.deformation.plane = Plane::strain; }},
      {"E_p", [](Given& g) { g.input.deformation.young_modulus *= 1.01; }},
      {"nu_p", [](Given& g) { g.input.deformation.poisson_ratio *= 1.01; }},
      {"drive", [](Given& g) { g.input.drive->duration *= 1.01; }},
  };
  for (const auto& [what, change] : kErrors) {
    const std::string failed = failed_of(judge_all(Wrong(change)));
    EXPECT_THAT(failed, testing::HasSubstr("solvers/wrong/")) << what;
    EXPECT_THAT(failed, testing::HasSubstr("displacements")) << what;
  }
}

TEST(SolverStudy, WhatASolverCannotDoIsNotMeasured) {
  class Rigid : public Wrong {
   public:
    Rigid() : Wrong([](Given&) {}) {}
    Abilities abilities() const override {
      Abilities can = builtin_solver().abilities();
      can.laws = {"dem"};
      return can;
    }
  };
  for (const SolverTask& task : solver_tasks("rigid", "rigid")) {
    if (task.law == "dem") {
      EXPECT_EQ(solver_verdict({task, measure_solver(task, Rigid())}).state, State::pass);
    } else {
      EXPECT_THROW(measure_solver(task, Rigid()), UnsupportedError) << task.id();
    }
  }
}

TEST(SolverStudy, IsDrawnWithAndWithoutResults) {
  std::vector<ComparedSolver> compared;
  for (const SolverTask& task : solver_tasks("x", "x")) compared.push_back({task, {}});
  EXPECT_NO_THROW(reports::require_valid(solver_figure(compared)));
  EXPECT_EQ(solver_table(compared).rows.size(), 12u);
  compared[1].found = measure_solver(compared[1].task, builtin_solver());
  EXPECT_NO_THROW(reports::require_valid(solver_figure(compared)));
  EXPECT_EQ(solver_figure(compared).panels.size(), 2u);
  for (const auto& row : solver_table(compared).rows) EXPECT_EQ(row.size(), solver_table(compared).columns.size());
}

}  // namespace
}  // namespace ddem::harness
