// Tables of discs, bonds and states.
#include "harness/scene/csv.h"
#include "tests/fuzz/fuzz.h"

void fuzz(std::string_view text) {
  using namespace ddem::harness;
  const auto discs = parse_disc_table(text, "fuzz.csv");
  require(discs.value.has_value() == discs.violations.empty());
  const auto bonds = parse_bond_table(text, "fuzz.csv");
  require(bonds.value.has_value() == bonds.violations.empty());
  const auto states = parse_state_table(text, "fuzz.csv");
  require(states.value.has_value() == states.violations.empty());
}
