#include "harness/scene/check_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "harness/scene/check_rules.h"
#include "harness/scene/limits.h"

namespace ddem::harness {
namespace {

using Keys = std::vector<std::string_view>;

bool any_given(const Values& values, const Keys& keys) {
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return values.given(key); });
}

void require(Values& values, std::string_view key) {
  if (values.given(key) || values.has(key)) return;
  const KeySpec& spec = scene_keys()[find_key(key).value()];
  values.reject(key, "missing", "give " + describe_value(spec));
}

bool periodic_x(const Values& values) {
  return values.is("assembly.periodic", "xy");
}
bool periodic_y(const Values& values) {
  return periodic_x(values) || values.is("assembly.periodic", "y") ||
         values.is("boundary.top_bottom", "periodic");
}

void check_hexagonal(Values& values) {
  const Keys lattice{"assembly.columns", "assembly.rows", "assembly.radius"};
  const Keys rectangle{"assembly.length", "assembly.width", "assembly.discs"};
  const bool by_lattice = any_given(values, lattice);
  if (by_lattice) {
    for (const std::string_view key : rectangle) {
      if (values.given(key)) {
        values.reject(key, "contradicts columns, rows and radius",
                      "give either length, width and discs, or columns, rows and radius");
      }
    }
    for (const std::string_view key : lattice) require(values, key);
    const bool countable = values.has("assembly.columns") && values.has("assembly.rows");
    constexpr double max_discs = 1e8;
    if (countable && static_cast<double>(values.integer("assembly.columns")) *
                             static_cast<double>(values.integer("assembly.rows")) >
                         max_discs) {
      values.reject("assembly.columns", fmt::format("more than {} discs with these rows", max_discs),
                    "take fewer");
    }
  } else if (any_given(values, rectangle) || !periodic_x(values)) {
    for (const std::string_view key : rectangle) require(values, key);
  }
}

void check_assembly(Values& values, bool discs_needed) {
  if (values.is("assembly.packing", "file")) {
    require(values, "assembly.file");
    if (periodic_y(values)) require(values, "assembly.width");
    if (periodic_x(values)) require(values, "assembly.length");
  } else if (values.is("assembly.packing", "hexagonal")) {
    check_hexagonal(values);
  } else if (!values.given("assembly.packing") || values.is("assembly.packing", "random")) {
    if (discs_needed) require(values, "assembly.packing");
    require(values, "assembly.length");
    require(values, "assembly.width");
    if (discs_needed) require(values, "assembly.discs");
    if (values.given("assembly.cell") && values.has("assembly.discs") && values.integer("assembly.discs") <= kJammedUnasked) {
      values.reject("assembly.cell", fmt::format("means nothing of up to {} discs, which are always jammed as a whole", kJammedUnasked), "leave it out");
    }
    if (values.is("assembly.grading", "sieve")) require(values, "assembly.sieve");
  }
}

// The softer the discs are beside their contacts, the fewer digits are left of what the contacts add: at 1e8 half of them.
void check_softness(Values& values) {
  constexpr double softest = 1e8;
  for (const char* key : {"contact.normal_stiffness", "contact.stiffness_ratio", "deformation.young_modulus", "assembly.thickness"}) {
    if (!values.has(key)) return;
  }
  const double stiffest = values.number("contact.normal_stiffness") * std::max(1.0, values.number("contact.stiffness_ratio"));
  const double modulus = stiffest / (softest * values.number("assembly.thickness"));
  if (values.number("deformation.young_modulus") >= modulus) return;
  values.reject("deformation.young_modulus", fmt::format("the contacts are more than {:g} times as stiff as such discs", softest),
                fmt::format("give at least {:.3g} Pa, or scheme = \"none\"", modulus));
}

void check_materials(Values& values, bool discs_move) {
  if (discs_move || values.table_given("material")) require(values, "material.density");
  if (discs_move || values.table_given("contact")) {
    if (!values.given("contact.contact_modulus")) require(values, "contact.normal_stiffness");
    require(values, "contact.stiffness_ratio");
  }
  if (!values.table_given("deformation") || values.is("deformation.scheme", "none")) return;
  require(values, "deformation.young_modulus");
  require(values, "deformation.poisson_ratio");
  check_softness(values);
  const bool strain = values.is("deformation.plane", "strain") && values.has("deformation.poisson_ratio");
  if (strain && values.number("deformation.poisson_ratio") >= 0.5) {
    values.reject("deformation.poisson_ratio", "impossible in plane strain: 0.5 is incompressible",
                  "give a number greater than -1 and less than 0.5");
  }
}

void check_load(Values& values, Purpose purpose) {
  const bool initial = values.table_given("initial");
  const bool drive = values.table_given("drive");
  if (initial && drive) {
    values.reject_table("drive", "contradicts [initial]", "give one of the two");
  }
  const bool moves = purpose == Purpose::simulation || purpose == Purpose::continuum;
  if (!initial && !drive && moves) {
    values.reject_table("initial", "missing: nothing would move",
                        "give a table [initial] or a table [drive]");
  }
  if (initial && !any_given(values, {"initial.displacement", "initial.velocity"})) {
    require(values, "initial.wave");
    require(values, "initial.amplitude");
    if (values.is("initial.shape", "cosine") || values.is("initial.shape", "gaussian")) {
      require(values, "initial.width");
    }
  }
  if (drive) {
    require(values, "drive.wave");
    require(values, "drive.duration");
    require(values, "drive.amplitude");
  }
}

// A left edge that is held cannot be displaced.
void check_left_edge(Values& values, Purpose purpose) {
  if (purpose == Purpose::packing || purpose == Purpose::statics) return;
  const bool column = any_given(values, {"initial.wave"}) && values.is("initial.shape", "column");
  const bool drive = values.table_given("drive");
  if (purpose == Purpose::continuum && periodic_x(values)) {
    values.reject("assembly.periodic", "the continuum has two ends, a cell that is periodic in x has none", "use \"y\"");
    return;
  }
  if (!column && !drive) return;
  if (periodic_x(values)) {
    values.reject("assembly.periodic", "there is no left edge to displace in a cell that is periodic in x",
                  "use \"y\", or another load");
  }
  const std::string_view wave = drive ? "drive.wave" : "initial.wave";
  const bool held = values.is("boundary.left", "fixed") ||
                    (values.is("boundary.left", "fixed_x") && values.is(wave, "longitudinal"));
  if (held) {
    values.reject("boundary.left",
                  fmt::format("the left edge is held, but {} displaces it", drive ? "[drive]" : "[initial]"),
                  "use left = \"free\"");
  }
}

void check_time(Values& values) {
  if (!values.given("time.step_fraction") || !values.has("time.step_fraction")) return;
  if (!values.has("time.allow_above_critical") || values.flag("time.allow_above_critical")) return;
  if (values.number("time.step_fraction") <= 1.0) return;
  values.reject("time.step_fraction", "a step above the critical one is unstable",
                "give at most 1, or allow_above_critical = true for a stability study");
}

// Exact in time are motions whose stiffness is linear, symmetric and the same at all times.
void check_exact(Values& values) {
  if (!values.is("time.integrator", "exact")) return;
  const auto reject = [&values](const char* what, const char* remedy) { values.reject("time.integrator", what, remedy); };
  if (values.is("contact.kinematics", "nonlinear")) reject("needs linear kinematics", "use integrator = \"verlet\", or kinematics = \"linear\"");
  if (!values.table_given("deformation")) return;
  if (values.is("deformation.scheme", "lagged")) {
    reject("of lagged strains the time step is a part", "use integrator = \"verlet\", or scheme = \"implicit\"");
  }
  if (!values.is("deformation.scheme", "implicit")) return;
  if (values.is("deformation.solver", "conjugate_gradients")) {
    reject("needs strains that are linear in the motion", "use integrator = \"verlet\", or solver = \"polynomial\"");
  }
  const bool rolls = !values.has("contact.stiffness_ratio") || values.number("contact.stiffness_ratio") > 0.0;
  if (values.is("deformation.correction", "normal") && rolls) {
    reject("the normal correction with shear stiffness has no energy",
           "use integrator = \"verlet\", or correction = \"full\" or \"normal_only_stress\"");
  }
}

void check_probes(Values& values) {
  const bool random = values.is("assembly.packing", "random");
  if (random && values.has("assembly.discs") && values.has("probes.discs")) {
    const auto& discs = values.integers("probes.discs");
    const std::int64_t last = *std::max_element(discs.begin(), discs.end());
    const std::int64_t count = values.integer("assembly.discs");
    if (last >= count) {
      values.reject("probes.discs", fmt::format("there is no disc {}", last),
                    fmt::format("discs are 0 to {}", count - 1));
    }
  }
  if (!values.has("probes.points") || !values.has("assembly.length") || !values.has("assembly.width")) return;
  const double length = values.number("assembly.length");
  const double width = values.number("assembly.width");
  for (const Point& point : values.points("probes.points")) {
    if (point[0] >= 0.0 && point[0] <= length && point[1] >= 0.0 && point[1] <= width) continue;
    values.reject("probes.points",
                  fmt::format("the point [{}, {}] lies outside the strip", point[0], point[1]),
                  fmt::format("x is from 0 to {} and y from 0 to {}, in metres", length, width));
  }
}

// Where no length and width say it, or probes are discs.
bool discs_give_the_rectangle(const Values& values) {
  const bool lattice = values.is("assembly.packing", "hexagonal") && any_given(values, {"assembly.columns", "assembly.rows", "assembly.radius"});
  return lattice || values.is("assembly.packing", "file") || values.given("probes.discs");
}

void check_continuum(Values& values) {
  if (values.given("continuum.mesh") && !continuum_is_complete(values)) {
    values.reject("continuum.mesh", "a mesh has its own ends, not those of the discs",
                  "give young_modulus, poisson_ratio and density, too");
  }
  if (!values.is("continuum.plane", "strain")) return;
  require(values, "continuum.young_modulus");
  require(values, "continuum.poisson_ratio");
  if (values.has("continuum.poisson_ratio") && values.number("continuum.poisson_ratio") >= 0.5) {
    values.reject("continuum.poisson_ratio", "impossible in plane strain", "must be less than 0.5");
  }
}

}  // namespace

bool continuum_is_complete(const Values& values) {
  return values.given("continuum.young_modulus") && values.given("continuum.poisson_ratio") &&
         values.given("continuum.density");
}

void check_scene(Values& values, Purpose purpose) {
  const bool discs_needed = purpose != Purpose::continuum || !continuum_is_complete(values) || discs_give_the_rectangle(values);
  check_rules(values, discs_needed);
  check_assembly(values, discs_needed);
  check_materials(values, discs_needed && purpose != Purpose::packing);
  check_load(values, purpose);
  check_left_edge(values, purpose);
  check_time(values);
  if (purpose == Purpose::simulation) check_exact(values);
  check_probes(values);
  check_continuum(values);
}

}  // namespace ddem::harness
