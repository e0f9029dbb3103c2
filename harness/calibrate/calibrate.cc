#include "harness/calibrate/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "harness/io/errors.h"
#include "harness/model/memory_need.h"
#include "harness/nightly/worker_pool.h"

namespace ddem::harness {
namespace {

constexpr double kLeastRatio = 0.01;  // of k_t/k_n, for assemblies with mechanisms at 0
constexpr int kOtherVariants = 6;     // of ranges_of(), at work at a time, each on one packing

const char* letter(Correction c) {
  return c == Correction::normal ? "N" : c == Correction::full ? "F" : "NN";
}

std::string variant_name(const DeformationParameters& d) {
  if (!d.active()) return "DEM";
  return fmt::format("{} {}", d.scheme == Scheme::lagged ? "lagged" : "implicit", letter(d.correction));
}

bool same_variant(const DeformationParameters& a, const DeformationParameters& b) {
  return a.scheme == b.scheme && (!a.active() || a.correction == b.correction);
}

/// At k_t = 0 sparse assemblies have mechanisms, whether discs deform or not: there the search begins a
/// little above.
double least_ratio(const StaticModel& model) {
  try {
    model.variant({}).at({});
    return 0.0;
  } catch (const std::runtime_error&) {
    return kLeastRatio;
  }
}

std::vector<VariantRange> ranges_of(const StaticModel& model, const CalibrationOptions& options,
                                    const SearchSpace& space, double least_ratio) {
  std::vector<DeformationParameters> variants(1);
  for (const Scheme scheme : {Scheme::lagged, Scheme::implicit}) {
    for (const Correction correction :
         {Correction::normal, Correction::full, Correction::normal_only_stress}) {
      DeformationParameters d = model.deformation();
      d.scheme = scheme;
      d.correction = correction;
      if (options.other_variants || same_variant(d, model.deformation())) variants.push_back(d);
    }
  }
  SearchSpace defaults;
  defaults.stiffness_ratio.low = least_ratio;
  const bool rigid_own = !model.deformable();
  std::vector<VariantRange> ranges(variants.size());
  ranges[0] = {variant_name(variants[0]),
               reachable_range(model.variant(variants[0]), rigid_own ? space : defaults), rigid_own};
  // Of deformable discs one packing tells where they lead, and DEM where they begin.
  run_jobs(variants.size() - 1, model.threads(), [&](std::size_t k) {
    const DeformationParameters& d = variants[k + 1];
    const bool own = same_variant(d, model.deformation());
    const StaticModel first = model.first_seed().variant(d);
    ranges[k + 1] = {
        variant_name(d),
        own ? reachable_range(first, space) : reachable_range(first, defaults, ranges[0].poisson), own};
  });
  return ranges;
}

/// The free parameter that nu determines, the others chosen: the one inside its interval.
std::optional<Parameter> solved_parameter(const StaticModel& model, const SearchSpace& space,
                                          const ModelPoint& point) {
  const auto inside = [](double x, const Interval& i) { return x > i.low && x < i.high; };
  if (inside(point.stiffness_ratio, space.stiffness_ratio)) return Parameter::stiffness_ratio;
  if (!model.deformable()) return std::nullopt;
  if (inside(point.softness, space.softness)) return Parameter::log_softness;
  if (inside(point.particle_poisson_ratio, space.particle_poisson_ratio))
    return Parameter::particle_poisson_ratio;
  return std::nullopt;
}

/// To first order: x answers to nu alone, and ln k = ln E - ln e(x), e the modulus at unit stiffness.
void propagate(const StaticModel& model, const Target& target, FoundParameters& found) {
  if (!found.solved_for) return;
  const Parameter rates[] = {*found.solved_for};
  const MeanModuli m = model.at(found.point, rates);
  const double by_nu = 1.0 / m.poisson_rates[0];
  const double scale = *found.solved_for == Parameter::log_softness ? found.point.softness : 1.0;
  found.solved_stddev = std::abs(scale * by_nu) * std::sqrt(target.covariance(1, 1));
  const Eigen::Vector2d log_stiffness(1.0, -m.young_rates[0] / m.young * by_nu);
  found.stiffness_stddev =
      found.stiffness * std::sqrt(std::max(0.0, log_stiffness.dot(target.covariance * log_stiffness)));
}

Stability stability_of(const StaticModel& model, const ModelPoint& point) {
  Stability s;
  s.radius = point.softness * model.radius_per_softness(point);
  s.limit = model.radius_limit();
  if (s.limit && s.radius > 0.9 * *s.limit) {
    s.remark =
        "close to what the lagged scheme can stand at vanishing steps; ask ddem stability for the step, or "
        "use scheme = \"implicit\"";
  }
  if (model.deformation().correction == Correction::normal && point.stiffness_ratio > 0.0) {
    s.remark += std::string(s.remark.empty() ? "" : "; ") +
                "the published normal-only correction with k_t > 0 has no energy: vibrations may grow by "
                "themselves; correction = \"full\" has none that do";
  }
  return s;
}

bool holds(const ReachableRange& r, double nu) {
  return nu >= r.lowest && nu <= r.highest;
}

/// Sparser networks of the scene's first packing whose rigid discs reach nu.
std::optional<std::string> other_coordination(const Scene& scene, double nu) {
  const auto* own = std::get_if<BondCoordination>(&scene.assembly.bonding);
  if (own == nullptr || !seed_of(scene)) return std::nullopt;
  for (double z = std::floor(5.0 * own->bonds_per_disc - 0.5) / 5.0; z > 4.3; z -= 0.2) {
    Scene sparser = scene;
    sparser.deformation.reset();
    sparser.assembly.bonding = BondCoordination{z};
    try {
      const StaticModel model(sparser, seed_assemblies(sparser, *seed_of(scene), 1, 1), 1);
      const double highest = model.at({}).poisson;
      if (highest > nu)
        return fmt::format(
            "a sparser network: coordination = {:.1f} reaches {:.3f} with rigid discs at k_t/k_n = 0 (first "
            "seed)",
            z, highest);
    } catch (const std::exception&) {
      return std::nullopt;  // the discs touch too often, or too rarely to be rigid
    }
  }
  return std::nullopt;
}

std::vector<std::string> remedies(const Scene& scene, const Calibration& c, const SearchSpace& space,
                                  bool deformable) {
  const double nu = c.target.poisson_ratio;
  std::vector<std::string> helps;
  if (space.stiffness_ratio.fixed() ||
      (deformable && (space.softness.fixed() || space.particle_poisson_ratio.fixed()))) {
    helps.push_back("leave more parameters free than the options do");
  }
  std::string others;
  for (const VariantRange& v : c.ranges) {
    if (!v.own && holds(v.poisson, nu)) others += (others.empty() ? "" : ", ") + v.name;
  }
  if (!others.empty())
    helps.push_back(fmt::format("another [deformation]: {} reach{} it on this assembly", others,
                                others.find(',') == std::string::npos ? "es" : ""));
  if (nu > c.poisson_ratio) {
    if (auto z = other_coordination(scene, nu)) helps.push_back(*z);
    if (others.empty())
      helps.push_back(
          fmt::format("implicit DDEM (correction = \"full\") with nu_p above {:.3g}: --particle-poisson, and "
                      "discs softer than k_n/E_p = {:g}",
                      nu, space.softness.high));
  } else {
    helps.push_back("a denser network");
  }
  return helps;
}

std::vector<std::string> notes_on(const Calibration& c, bool deformable) {
  std::vector<std::string> notes;
  const double ratio = c.found.point.stiffness_ratio;
  if (ratio == 0.0)
    notes.push_back(
        "k_t = 0 leaves bonds without shear stiffness, and moduli that scatter most from packing to packing: "
        "hold k_t/k_n at 0.1 or more by --stiffness-ratio");
  if (ratio > 1.0) notes.push_back("k_t/k_n above 1 is unusual");
  if (deformable && holds(c.ranges.front().poisson, c.target.poisson_ratio)) {
    notes.push_back(
        "rigid discs (no [deformation]) reach this Poisson's ratio, too, at a fraction of the time a step");
  }
  return notes;
}

}  // namespace

Calibration calibrate(const Scene& scene, const Target& target, const CalibrationOptions& options) {
  const auto seed = seed_of(scene);
  const int packings = seed ? options.seeds : 1;
  require_memory_of_packings(scene, packings, std::min(options.threads, std::max(packings, kOtherVariants)));
  const StaticModel model(scene, seed_assemblies(scene, seed.value_or(0), options.seeds, options.threads),
                          options.threads);
  const auto start = std::chrono::steady_clock::now();
  Calibration c;
  c.target = target;
  if (seed) {
    for (const SeedAssembly& a : model.assemblies()) c.seeds.push_back(a.seed);
  }
  try {
    SearchSpace space = options.space;
    const double least = least_ratio(model);
    if (!space.stiffness_ratio.fixed())
      space.stiffness_ratio.low = std::max(space.stiffness_ratio.low, least);
    c.ranges = ranges_of(model, options, space, least);
    const SearchResult result = find_poisson(model, space, target.poisson_ratio);
    c.feasible = result.feasible();
    c.choice = result.choice;
    c.found.point = result.point;
    c.found.stiffness = target.young_modulus / result.moduli.young;
    c.found.particle_young_modulus = model.discs(result.point, c.found.stiffness).young_modulus;
    c.found.solved_for = solved_parameter(model, space, result.point);
    c.solid_fraction = model.mean_solid_fraction();
    if (target.density) c.found.particle_density = *target.density / c.solid_fraction;
    std::vector<double> young, poisson;
    for (const SeedModuli& m : result.moduli.seeds)
      young.push_back(m.young * c.found.stiffness), poisson.push_back(m.poisson);
    c.young_over_seeds = mean_with_confidence(young);
    c.poisson_over_seeds = mean_with_confidence(poisson);
    c.young_modulus = c.young_over_seeds.mean;
    c.poisson_ratio = c.poisson_over_seeds.mean;
    if (c.feasible) {
      propagate(model, target, c.found);
      c.notes = notes_on(c, model.deformable());
    }
    if (model.deformable()) c.stability = stability_of(model, result.point);
    c.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!c.feasible) c.what_helps = remedies(scene, c, space, model.deformable());
  } catch (const std::invalid_argument& e) {
    throw InputError(scene.path.string() + ": [assembly]: " + e.what());
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw SolverError(std::string("static moduli: ") + e.what());
  }
  return c;
}

Scene calibrated_scene(const Scene& scene, const FoundParameters& found) {
  Scene out = scene;
  out.load = {};
  if (!out.contact) out.contact = Contact{};
  if (std::holds_alternative<ContactModulus>(out.contact->stiffness)) {
    out.contact->stiffness = ContactModulus{found.stiffness};
  } else {
    out.contact->stiffness = NormalStiffness{found.stiffness};
  }
  out.contact->stiffness_ratio = found.point.stiffness_ratio;
  if (out.deformation) {
    out.deformation->young_modulus = found.particle_young_modulus;
    out.deformation->poisson_ratio = found.point.particle_poisson_ratio;
  }
  if (found.particle_density) out.material = Material{*found.particle_density};
  return out;
}

}  // namespace ddem::harness
