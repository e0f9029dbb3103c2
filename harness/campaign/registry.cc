#include "harness/campaign/registry.h"

#include <array>

#include "harness/studies/solvers/read_solvers.h"
#include "harness/studies/strip/read_strip.h"
#include "harness/studies/user_cases/read_cases.h"

// A study is a line, in the order of the report: its folder, the input without which there is no such study, and what it answers.
#define DDEM_STUDIES(study)                                                                  \
  study(waves, "strip", "Driven long pulses against statics, closed forms and S0")           \
  study(paper_protocol, "strip", "The paper's protocol, and its bias")                       \
  study(finite_elements, "strip", "The continuum of the same strip")                         \
  study(statics, "strip", "Wave speeds without time steps")                                  \
  study(sizes, "strip", "Smaller discs: what the strip's width does")                        \
  study(calibration, "strip", "Contacts for a material that is wanted")                      \
  study(schemes, "strip", "Energy, order and reach of each scheme")                          \
  study(dispersion, "strip", "Which waves travel: spectra against exact branches")           \
  study(stability, "strip", "Growth predicted and measured; noise")                          \
  study(work_precision, "strip", "Error against run time")                                   \
  study(discrimination, "strip", "Would a wrong parameter be noticed?")                      \
  study(solvers, "solvers", "Other solvers, side by side with the built-in one")             \
  study(user_cases, "case", "Scenes of your own")                                            \
  study(formulas, "strip", "What the report compares with")

namespace ddem::harness {

#define DDEM_DECLARE(folder, table, title) std::unique_ptr<Study> make_##folder(const StudyContext& context);
DDEM_STUDIES(DDEM_DECLARE)

std::span<const StudyEntry> studies() {
#define DDEM_ENTRY(folder, table, title) StudyEntry{#folder, title, table, make_##folder},
  static constexpr std::array kStudies = {DDEM_STUDIES(DDEM_ENTRY)};
  return kStudies;
}

std::span<const InputTable> input_tables() {
  static constexpr std::array kTables = {
      InputTable{"strip", false, "[strip] for the strip of the paper", read_strip, check_strip, lost_of_strip, introduce_strip, default_strip},
      InputTable{"solvers", false, "[solvers] for other programs beside the built-in one", read_solvers, check_solvers, lost_of_solvers, introduce_solvers},
      InputTable{"case", true, "[[case]] for scenes of your own", read_case_table, check_cases, lost_of_cases, introduce_cases},
  };
  return kTables;
}

}  // namespace ddem::harness
