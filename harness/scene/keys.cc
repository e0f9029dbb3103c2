#include "harness/scene/keys.h"

#include <fmt/format.h>

#include <iterator>

#include "harness/scene/fill.h"
#include "harness/scene/limits.h"
#include "harness/scene/scene.h"

namespace ddem::harness {
namespace {

using enum Dimension;

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr std::string_view no_default{};
constexpr Range any{};
constexpr Range positive{.low = 0.0, .low_excluded = true};
constexpr Range non_negative{.low = 0.0};
constexpr Range non_zero{.zero_excluded = true};
constexpr Range between_minus_one_and_one{
    .low = -1.0, .high = 1.0, .low_excluded = true, .high_excluded = true};
constexpr Range below_one{.low = 0.0, .high = 1.0, .low_excluded = true, .high_excluded = true};
constexpr Range fraction{.low = 0.0, .high = 1.0, .low_excluded = true};
constexpr Range small_fraction{.low = 1e-12, .high = 0.1};
constexpr Range from(double low, double high = unlimited) {
  return {.low = low, .high = high};
}

// Disc numbers are ints in the solver; a strip of 1e8 discs needs more memory than it is worth.
constexpr double max_discs = 1e8;

constexpr TableSpec tables[] = {
    {"assembly", "the discs, and who is bonded to whom"},
    {"material", "of the discs"},
    {"contact", "the law of the bonds"},
    {"deformation", "deformable discs (DDEM); without this table plain DEM"},
    {"boundary", "the edges of the strip"},
    {"initial", "a displacement at the start: a pulse, or any state from files"},
    {"drive", "a prescribed motion of the left edge, instead of [initial]"},
    {"continuum", "for ddem fem"},
    {"time", "steps and end"},
    {"probes", "where signals are taken"},
    {"run", "the machine"},
};

// Rows of the table, by type of value. `initial` is the default.
using Name = std::string_view;

constexpr KeySpec text(Name table, Name key, Name initial, Name doc) {
  return {table, key, ValueType::text, none, any, "", initial, doc};
}
constexpr KeySpec file(Name table, Name key, Name doc) {
  return {table, key, ValueType::file, none, any, "", no_default, doc};
}
constexpr KeySpec choice(Name table, Name key, Name choices, Name initial, Name doc) {
  return {table, key, ValueType::choice, none, any, choices, initial, doc};
}
constexpr KeySpec quantity(Name table, Name key, Dimension dimension, Range range, Name initial, Name doc) {
  return {table, key, ValueType::number, dimension, range, "", initial, doc};
}
constexpr KeySpec number(Name table, Name key, Range range, Name initial, Name doc) {
  return quantity(table, key, none, range, initial, doc);
}
constexpr KeySpec integer(Name table, Name key, Range range, Name initial, Name doc) {
  return {table, key, ValueType::integer, none, range, "", initial, doc};
}
constexpr KeySpec boolean(Name table, Name key, Name initial, Name doc) {
  return {table, key, ValueType::boolean, none, any, "", initial, doc};
}

constexpr KeySpec keys[] = {
    into<&Scene::title>(text("", "title", "\"\"", "name of the scene in reports")),

    choice("assembly", "packing", "random | hexagonal | file", no_default,
           "random: jammed discs of different sizes; hexagonal: equal touching discs; file: your own"),
    into<&RandomPacking::length, &HexagonalRectangle::length, &FilePacking::length>(quantity("assembly", "length", length, positive, no_default,
             "of the strip, along x; for a file: the period where periodic, else of what the discs fill (left out: found from them)")),
    into<&RandomPacking::width, &HexagonalRectangle::width, &FilePacking::width>(quantity("assembly", "width", length, positive, no_default,
             "of the strip, along y; for a file: the period where periodic, else of what the discs fill (left out: found from them)")),
    into<&RandomPacking::discs, &HexagonalRectangle::discs>(integer("assembly", "discs", from(1, max_discs), no_default,
            "how many")),
    into<&RandomPacking::seed>(integer("assembly", "seed", non_negative, "1",
            "random: another seed is another packing; the same seed is the same packing, to the bit")),
    into<&RandomPacking::radius_ratio>(number("assembly", "radius_ratio", from(1, 10), "1.67", "random: largest over smallest radius")),
    into<&RandomPacking::grading>(choice("assembly", "grading", "uniform | log-normal | sieve", "\"uniform\"",
           "random: radii by number, uniform between the smallest and the largest, or log-normal (these are two standard deviations off); or "
           "by mass, as the curve of assembly.sieve has them")),
    into<&RandomPacking::sieve>(file("assembly", "sieve",
           "random: CSV with header radius,passing: the share by mass of the discs that are smaller, from 0 to 1; radii are scaled")),
    into<&RandomPacking::porosity>(number("assembly", "porosity", below_one, no_default,
           "random: in the end radii are scaled to it, which leaves gaps between the discs, or overlaps; without it that at which they jam, "
           "some 0.16")),
    into<&RandomPacking::walls>(choice("assembly", "walls", "periodic | flat", "\"periodic\"",
           "random: packed in a periodic cell, whose bonds across free edges are cut, or between flat walls at all "
           "edges that are not periodic")),
    into<&RandomPacking::cell>(choice("assembly", "cell", "copies | whole", "\"copies\"",
           "random, of more than 20000 discs: copies of one periodic cell of 1000 to 4000 discs, or all jammed as a whole, which takes minutes")),
    into<&HexagonalPacking::close_packed_along>(choice("assembly", "close_packed_along", "x | y", "\"x\"",
           "hexagonal: direction of the rows of touching discs")),
    into<&HexagonalLattice::columns>(integer("assembly", "columns", from(1, max_discs), no_default,
            "hexagonal: discs in a row; with rows and radius instead of length, width and discs")),
    into<&HexagonalLattice::rows>(integer("assembly", "rows", from(1, max_discs), no_default, "hexagonal: rows")),
    into<&HexagonalLattice::radius>(quantity("assembly", "radius", length, positive, no_default, "hexagonal: of every disc")),
    into<&FilePacking::discs>(file("assembly", "file", "file: CSV with header x,y,radius (metres)")),
    into<&BondFile::path>(file("assembly", "bonds",
         "file: CSV with header i,j (discs counted from 0, gaps up to two mean radii); without it bond_gap decides")),
    into<&BondGap::mean_radii>(number("assembly", "bond_gap", from(0, 2), "0.3",
           "bonded when the gap is at most this times the mean radius (random: see coordination)")),
    into<&BondCoordination::bonds_per_disc>(number("assembly", "coordination", positive, "5.8",
           "bonds of a disc on average, which chooses the gap; rattlers count, discs at flat walls do not, and edges are "
           "cut later; the default is for random packings")),
    choice("assembly", "periodic", " | y | xy", "\"\"",
           "overrides boundary.top_bottom, for moduli of a cell; \"\" does not"),
    into<&Assembly::edge_band>(number("assembly", "edge_band", positive, "1.2",
           "an edge's discs have their centres within so many mean radii of the outermost centre")),
    into<&Assembly::thickness>(quantity("assembly", "thickness", length, positive, "1.0", "out of the plane")),

    into<&Material::density>(quantity("material", "density", density, positive, no_default, "of a disc, not of the assembly")),

    into<&NormalStiffness::k_n>(quantity("contact", "normal_stiffness", stiffness, positive, no_default, "k_n, the same for every bond")),
    into<&ContactModulus::pascal>(quantity("contact", "contact_modulus", stress, positive, no_default,
             "instead of normal_stiffness: k_n = contact_modulus * 2 r_i r_j/(r_i + r_j), bond by bond")),
    into<&Contact::stiffness_ratio>(number("contact", "stiffness_ratio", non_negative, no_default, "k_t / k_n")),
    into<&Contact::kinematics>(choice("contact", "kinematics", "linear | nonlinear", "\"linear\"",
           "small displacements, or current geometry with incremental shear")),
    into<&Contact::new_contacts>(choice("contact", "new_contacts", "auto | off", "\"auto\"",
           "whether discs that are not bonded repel when they meet, with the k_n of a bond and without friction")),

    into<&DeformationParameters::scheme>(choice("deformation", "scheme", "none | lagged | implicit", "\"lagged\"",
           "none: plain DEM, whatever else stands in this table; lagged: the published scheme; implicit: strains and forces of the same step")),
    into<&DeformationParameters::evaluations>(integer("deformation", "evaluations", from(1, 1000), "1", "lagged: force evaluations a step")),
    into<&DeformationParameters::relaxation>(number("deformation", "relaxation", fraction, "1.0", "lagged: under-relaxation of the particle strains")),
    into<&DeformationParameters::solver>(choice("deformation", "solver", "polynomial | conjugate_gradients", "\"polynomial\"",
           "implicit: a fixed polynomial, the faster and the one that conserves energy to round-off, or iteration from the "
           "strains before to a residual, as a check")),
    into<&DeformationParameters::tolerance>(number("deformation", "tolerance", small_fraction, "1e-4",
           "implicit: largest relative error of the moduli, and a hundredth of that of any motion's stiffness (polynomial), or of "
           "the strains (conjugate_gradients)")),
    into<&DeformationParameters::correction>(choice("deformation", "correction", "normal | full | normal_only_stress", "\"normal\"",
           "N (published): normal overlaps; F: also slips; NN: stress from normal forces")),
    into<&DeformationParameters::young_modulus>(quantity("deformation", "young_modulus", stress, positive, no_default, "of the disc")),
    into<&DeformationParameters::poisson_ratio>(number("deformation", "poisson_ratio", between_minus_one_and_one, no_default,
           "of the disc; below 0.5 in plane strain")),
    into<&DeformationParameters::plane>(choice("deformation", "plane", "stress | strain", "\"stress\"",
           "plane stress or plane strain of the disc")),
    into<&DeformationParameters::volume>(choice("deformation", "particle_volume", "disc | cell", "\"disc\"",
           "the volume of the mean stress: of the disc (published), or with its share of the voids")),

    choice("boundary", "top_bottom", "free | periodic", "\"free\"",
           "free edges: a bar; periodic: an infinitely wide strip"),
    into<&Boundary::right>(choice("boundary", "right", "free | fixed_x | fixed", "\"fixed_x\"", "the discs of the right edge")),
    into<&Boundary::left>(choice("boundary", "left", "free | fixed_x | fixed", "\"free\"", "the discs of the left edge")),

    into<&InitialPulse::wave>(choice("initial", "wave", "longitudinal | shear", no_default, "displacement along x or along y")),
    into<&InitialPulse::shape>(choice("initial", "shape", "column | cosine | gaussian", "\"column\"",
           "the left-edge discs only; amplitude/2 (1 + cos(pi s/width)); amplitude exp(-(s-center)^2/(2 "
           "width^2))")),
    into<&InitialPulse::width>(quantity("initial", "width", length, positive, no_default,
             "cosine: of its support; gaussian: standard deviation")),
    into<&InitialPulse::center>(quantity("initial", "center", length, any, "0.0", "gaussian: from the left end")),
    into<&InitialPulse::amplitude>(quantity("initial", "amplitude", length, non_zero, no_default, "largest displacement")),
    into<&InitialState::displacement>(file("initial", "displacement", "instead of a pulse: CSV with header ux,uy,theta, one row a disc")),
    into<&InitialState::velocity>(file("initial", "velocity", "instead of a pulse: CSV with header ux,uy,theta, one row a disc")),

    into<&Drive::wave>(choice("drive", "wave", "longitudinal | shear", no_default, "displacement along x or along y")),
    into<&Drive::shape>(choice("drive", "shape", "sin2", "\"sin2\"",
           "u = amplitude sin^2(pi t/duration) until the duration, then held at 0")),
    into<&Drive::duration>(quantity("drive", "duration", time, positive, no_default, "of the motion")),
    into<&Drive::amplitude>(quantity("drive", "amplitude", length, non_zero, no_default, "largest displacement")),

    into<&Continuum::young_modulus>(quantity("continuum", "young_modulus", stress, positive, no_default,
             "without it: from the assembly's static moduli")),
    into<&Continuum::poisson_ratio>(number("continuum", "poisson_ratio", between_minus_one_and_one, no_default,
           "in the plane; without it: from the assembly's static moduli")),
    into<&Continuum::density>(quantity("continuum", "density", density, positive, no_default,
             "without it: the assembly's bulk density")),
    into<&Continuum::degree>(integer("continuum", "degree", from(1, 8), "4", "of the elements")),
    {"continuum", "elements", ValueType::counts, none, from(1, 1e5), "", "[66, 8]", "along x and along y"},
    into<&Continuum::plane>(choice("continuum", "plane", "stress | strain", "\"stress\"",
           "stress: E and nu are those of the plane; strain: those of a solid between rigid walls")),
    into<&Continuum::mesh>(file("continuum", "mesh",
         "instead of elements: a gmsh mesh (.msh 4.1, 4 or 2.2; metres) of quadrilaterals that cover the rectangle of "
         "assembly.length and width; each edge of its outline in the physical curve left, right, bottom or top")),

    into<&Time::integrator>(choice("time", "integrator", "verlet | exact", "\"verlet\"",
           "velocity Verlet; exact: exact in time at the probes, for rigid discs or implicit strains; the step then spaces the samples (ddem fem: unless verlet is written)")),
    into<&StepFraction::of_critical>(number("time", "step_fraction", positive, "0.2", "time step as a fraction of the critical one")),
    into<&StepSeconds::seconds>(quantity("time", "step", time, positive, no_default, "instead of step_fraction: the time step")),
    into<&EndTime::seconds>(quantity("time", "end", time, positive, no_default,
             "when to stop; without it and steps: when the last probe has seen its peak")),
    into<&EndSteps::steps>(integer("time", "steps", from(1, static_cast<double>(kMostSteps)), no_default, "instead of end")),
    into<&Time::sample_every>(integer("time", "sample_every", from(1, 1e12), "1", "steps from one row of the signals to the next")),
    into<&Time::allow_above_critical>(boolean("time", "allow_above_critical", "false",
            "for stability studies: let a step exceed the critical one")),

    into<&ProbePairs::pairs>(integer("probes", "pairs", from(1, 1000), "5", "pairs of discs at known distances")),
    into<&ProbePairs::section>(boolean("probes", "section", "false", "average the discs of a cross-section")),
    {"probes", "discs", ValueType::indices, none, from(0, max_discs), "", no_default,
     "instead of pairs: discs, counted from 0"},
    {"probes", "points", ValueType::points, length, any, "", no_default,
     "instead of pairs: [[x, y], ...] from the lower left corner; discs: the nearest"},

    into<&Run::threads>(integer("run", "threads", from(1, 1024), "1", "the results have the same bits for any number")),
};

}  // namespace

std::span<const TableSpec> scene_tables() {
  return tables;
}
std::span<const KeySpec> scene_keys() {
  return keys;
}

std::string dotted_name(std::string_view table, std::string_view key) {
  return table.empty() ? std::string(key) : std::string(table).append(1, '.').append(key);
}

std::optional<std::size_t> find_key(std::string_view dotted) {
  const std::size_t dot = dotted.find('.');
  return dot == std::string_view::npos ? find_key("", dotted)
                                       : find_key(dotted.substr(0, dot), dotted.substr(dot + 1));
}

std::optional<std::size_t> find_key(std::string_view table, std::string_view key) {
  for (std::size_t k = 0; k < std::size(keys); ++k) {
    if (keys[k].table == table && keys[k].key == key) return k;
  }
  return std::nullopt;
}

std::vector<std::string_view> split_names(std::string_view joined) {
  std::vector<std::string_view> names;
  while (true) {
    const std::size_t bar = joined.find('|');
    std::string_view name = joined.substr(0, bar);
    while (name.starts_with(' ')) name.remove_prefix(1);
    while (name.ends_with(' ')) name.remove_suffix(1);
    names.push_back(name);
    if (bar == std::string_view::npos) return names;
    joined.remove_prefix(bar + 1);
  }
}

std::string describe(const Range& range) {
  if (range.zero_excluded) return "different from 0";
  const bool low = range.low > -unlimited;
  const bool high = range.high < unlimited;
  if (low && high && range.low_excluded) {
    return fmt::format("greater than {} and {} {}", range.low, range.high_excluded ? "less than" : "at most",
                       range.high);
  }
  if (low && high) return fmt::format("from {} to {}", range.low, range.high);
  if (low) return fmt::format("{} {}", range.low_excluded ? "greater than" : "at least", range.low);
  return "";
}

std::string describe_value(const KeySpec& spec) {
  const std::string range = describe(spec.range);
  const std::string in_range = range.empty() ? "" : " " + range;
  switch (spec.type) {
    case ValueType::text:
      return "text in quotes";
    case ValueType::file:
      return "the path of a file, in quotes";
    case ValueType::choice: {
      std::string choices;
      for (const std::string_view name : split_names(spec.choices))
        choices += fmt::format(" or \"{}\"", name);
      return choices.substr(4);
    }
    case ValueType::number:
      return fmt::format("a {}{}, such as {}", dimension_name(spec.dimension), in_range,
                         quantity_examples(spec.dimension));
    case ValueType::integer:
      return fmt::format("a whole number{}", in_range);
    case ValueType::boolean:
      return "true or false";
    case ValueType::counts:
      return "two whole numbers, such as [66, 8]";
    case ValueType::indices:
      return "a list of different whole numbers, such as [12, 40, 71]";
    case ValueType::points:
      return "a list of points, such as [[0.005, 0.001]] or [[\"5 mm\", \"1 mm\"]]";
  }
  return "";
}

bool Range::contains(double value) const {
  const bool above = low_excluded ? value > low : value >= low;
  const bool below = high_excluded ? value < high : value <= high;
  return above && below && !(zero_excluded && value == 0.0);
}

}  // namespace ddem::harness
