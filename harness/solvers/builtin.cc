// The project's own solver.
#include "harness/provenance/provenance.h"
#include "harness/solvers/solver.h"

namespace ddem::harness {
namespace {

class Builtin : public Solver {
 public:
  std::string name() const override { return "builtin"; }
  std::string version() const override { return program_identity(); }
  Abilities abilities() const override {
    return {{"dem", "lagged-normal", "lagged-full", "lagged-normal-only-stress", "implicit-normal", "implicit-full", "implicit-normal-only-stress"},
            true, true, true, true, true, true, true, true};
  }
  SimulationResult solve(const ddem::Assembly& a, const SimulationInput& in) const override { return simulate(a, in); }
  SimulationResult solve_exact(const ddem::Assembly& a, const SimulationInput& in, const Sampling& sampling) const override {
    return simulate_exact(a, in, sampling);
  }
};

}  // namespace

const Solver& builtin_solver() {
  static const Builtin solver;
  return solver;
}

}  // namespace ddem::harness
