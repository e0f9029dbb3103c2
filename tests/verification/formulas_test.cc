// The report names its references: every formula has a source and a use.

#include "harness/studies/strip/formulas.h"

#include <gtest/gtest.h>

namespace ddem::harness {
namespace {

TEST(Formulas, EachReferenceHasFormulaSourceAndUse) {
  const reports::Section section = formulas_section();
  std::string all;
  for (const reports::Table& table : section.tables) {
    for (const auto& row : table.rows) {
      ASSERT_EQ(row.size(), table.columns.size());
      for (std::size_t c = 0; c < row.size(); ++c) {
        const std::string& text = std::get<std::string>(row[c].value);
        EXPECT_TRUE(c == 0 || !text.empty()) << std::get<std::string>(row[0].value);
        all += text + "\n";
      }
    }
  }
  for (const char* name : {"d'Alembert", "bar velocity", "shear velocity", "P velocity", "Rayleigh-Lamb", "closed form", "static moduli"}) {
    EXPECT_NE(all.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace ddem::harness
