#include "harness/scene/key_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace ddem::harness {
namespace {

constexpr std::string_view any_packing = "random | hexagonal | file";

// scheme = "none" switches the table [deformation] off as a whole, whatever else stands in it.
constexpr OnlyWith only_with[] = {
    {"assembly.discs", "assembly.packing", "random | hexagonal"},
    {"assembly.seed | assembly.radius_ratio | assembly.walls | assembly.grading | assembly.porosity | assembly.cell", "assembly.packing", "random"},
    {"assembly.sieve", "assembly.grading", "sieve"},
    {"assembly.close_packed_along | assembly.columns | assembly.rows | assembly.radius", "assembly.packing", "hexagonal"},
    {"assembly.file | assembly.bonds", "assembly.packing", "file"},
    {"assembly.bond_gap | assembly.coordination | assembly.edge_band | assembly.thickness | material.density", "assembly.packing",
     any_packing},
    {"contact.normal_stiffness | contact.contact_modulus | contact.stiffness_ratio | contact.kinematics | contact.new_contacts",
     "assembly.packing", any_packing},
    {"deformation.scheme | deformation.correction | deformation.young_modulus | deformation.poisson_ratio | deformation.plane | "
     "deformation.particle_volume",
     "assembly.packing", any_packing},
    {"deformation.evaluations | deformation.relaxation", "deformation.scheme", "lagged | none"},
    {"deformation.solver | deformation.tolerance", "deformation.scheme", "implicit | none"},
    {"initial.width", "initial.shape", "cosine | gaussian"},
    {"initial.center", "initial.shape", "gaussian"},
    {"probes.discs", "assembly.packing", any_packing},
};

constexpr std::string_view no_ends = "a cell that is periodic in x and y has no ends";
constexpr std::string_view use_y = "leave it out, or use periodic = \"y\"";

constexpr Exclusion excluded[] = {
    {{"assembly.grading", "sieve"}, {"assembly.radius_ratio"}, "the curve has radii of its own", "leave radius_ratio out"},
    {{"assembly.bonds"}, {"assembly.bond_gap | assembly.coordination"}},
    {{"assembly.bond_gap"}, {"assembly.coordination"}},
    {{"assembly.periodic", "xy"}, {"boundary.right | boundary.left", "fixed_x | fixed"}, no_ends, use_y},
    {{"assembly.periodic", "xy"}, {"assembly.edge_band"}, no_ends, use_y},
    {{"assembly.periodic", "xy"},
     {"assembly.walls", "flat"},
     "a cell that is periodic in x and y has no place for walls",
     "leave walls out, or use periodic = \"y\" for walls at the two ends"},
    {{"contact.normal_stiffness"}, {"contact.contact_modulus"}},
    {{"deformation.scheme", "implicit"},
     {"contact.kinematics", "nonlinear"},
     "implicit strains need linear kinematics",
     "use kinematics = \"linear\", or scheme = \"lagged\""},
    {{"initial.displacement | initial.velocity"},
     {"initial.wave | initial.shape | initial.width | initial.center | initial.amplitude"}},
    {{"continuum.mesh"}, {"continuum.elements"}},
    {{"time.step"}, {"time.step_fraction"}},
    {{"time.end"}, {"time.steps"}},
    {{"probes.pairs"}, {"probes.discs | probes.points"}},
    {{"probes.discs"}, {"probes.points"}},
    {{"probes.discs | probes.points"},
     {"probes.section"},
     "sections are averaged for pairs only",
     "use pairs, or leave section out"},
};

bool lists(std::string_view joined, std::string_view name) {
  const std::vector<std::string_view> names = split_names(joined);
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string with_values(const KeysWith& side) {
  std::string text;
  for (const std::string_view key : split_names(side.keys)) text += fmt::format("{}{}", text.empty() ? "" : ", ", key);
  return side.values.empty() ? text : fmt::format("{} = {}", text, quoted_choices(side.values));
}

}  // namespace

std::span<const OnlyWith> only_with_rules() {
  return only_with;
}
std::span<const Exclusion> exclusions() {
  return excluded;
}

std::string quoted_choices(std::string_view choices) {
  return fmt::format("\"{}\"", fmt::join(split_names(choices), "\" or \""));
}

std::string describe_rules(const KeySpec& spec) {
  const std::string dotted = dotted_name(spec.table, spec.key);
  std::string text;
  const auto add = [&text](const std::string& rule) { text += (text.empty() ? "" : "; ") + rule; };
  for (const OnlyWith& rule : only_with) {
    if (!lists(rule.keys, dotted)) continue;
    add(rule.choices == any_packing ? fmt::format("only with {}", rule.selector)
                                    : fmt::format("only with {} = {}", rule.selector, quoted_choices(rule.choices)));
  }
  for (const Exclusion& rule : excluded) {
    for (const auto& [own, other] : {std::pair(rule.first, rule.second), std::pair(rule.second, rule.first)}) {
      if (!lists(own.keys, dotted)) continue;
      add(fmt::format("{}not beside {}", own.values.empty() ? "" : quoted_choices(own.values) + " ", with_values(other)));
    }
  }
  return text;
}

}  // namespace ddem::harness
