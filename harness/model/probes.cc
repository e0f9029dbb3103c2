#include "harness/model/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "dem/core/narrow.h"
#include "harness/io/errors.h"
#include "harness/scene/place.h"

namespace ddem::harness {
namespace {

constexpr double kFrom = 0.25;                                                   // of the length
constexpr std::array<double, 5> kDistances = {0.40, 0.35, 0.45, 0.375, 0.425};  // of the length, one a pair, repeated

struct Box {
  double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;  // outermost edges of the network's discs

  explicit Box(const ddem::Assembly& a) {
    const Packing& p = a.packing;
    for (const int d : network_discs(a)) {
      x0 = std::min(x0, p.x[d] - p.radius[d]);
      x1 = std::max(x1, p.x[d] + p.radius[d]);
      y0 = std::min(y0, p.y[d] - p.radius[d]);
      y1 = std::max(y1, p.y[d] + p.radius[d]);
    }
  }
};

int nearest_disc(const ddem::Assembly& a, double x, double y) {
  int best = 0;
  double smallest = HUGE_VAL;
  for (const int d : network_discs(a)) {
    const double distance = std::hypot(a.packing.x[d] - x, a.packing.y[d] - y);
    if (distance < smallest) {
      smallest = distance;
      best = d;
    }
  }
  return best;
}

Probe disc_probe(const ddem::Assembly& a, int disc) {
  return {"disc" + std::to_string(disc), a.packing.x[disc], a.packing.y[disc], {{disc}}};
}

/// A layout in the making, in which a disc has one signal, however often it is asked for.
struct LayoutInMaking {
  ProbeLayout layout;
  std::map<std::string, int> places;

  /// The index of the probe of that name, which is added if it is not there yet.
  int add(Probe probe) {
    const auto [place, is_new] = places.try_emplace(probe.name, static_cast<int>(layout.probes.size()));
    if (is_new) layout.probes.push_back(std::move(probe));
    return place->second;
  }
};

Probe section_probe(const ddem::Assembly& a, double x, int number) {
  const double half_width = 2.0 * mean_radius(a.packing);
  Probe probe{"section" + std::to_string(number), 0.0, 0.0, {}};
  for (const int d : network_discs(a)) {
    if (std::abs(a.packing.x[d] - x) > half_width) continue;
    probe.receiver.discs.push_back(d);
    probe.x += a.packing.x[d];
    probe.y += a.packing.y[d];
  }
  const double n = static_cast<double>(probe.receiver.discs.size());
  if (n == 0) throw InputError("probes: no disc near the cross-section at x = " + std::to_string(x) + " m");
  probe.x /= n;
  probe.y /= n;
  return probe;
}

/// Wanted places of a pair, from the lower left corner of a strip.
struct PairPlace {
  double x_from, x_to, y;
};

PairPlace place_of_pair(int k, const ProbePairs& spec, double length, double width) {
  const double pairs = static_cast<double>(spec.pairs);
  // Sections start at different places too, so that they do not share all their discs.
  const double shift = spec.section ? 0.02 * length * (k - 0.5 * (pairs - 1.0)) * std::min(1.0, 5.0 / pairs) : 0.0;
  const double x_from = kFrom * length + shift;
  return {x_from, x_from + kDistances[k % kDistances.size()] * length, width * (k + 0.5) / pairs};
}

ProbeLayout pairs_layout(const ProbePairs& spec, const ddem::Assembly& a) {
  const Box box(a);
  LayoutInMaking making;
  const ProbeLayout& layout = making.layout;
  for (int k = 0; k < narrow<int>(spec.pairs, "probes.pairs"); ++k) {
    const PairPlace place = place_of_pair(k, spec, box.x1 - box.x0, box.y1 - box.y0);
    int from = 0, to = 0;
    if (spec.section) {
      from = making.add(section_probe(a, box.x0 + place.x_from, 2 * k));
      to = making.add(section_probe(a, box.x0 + place.x_to, 2 * k + 1));
    } else {
      from = making.add(disc_probe(a, nearest_disc(a, box.x0 + place.x_from, box.y0 + place.y)));
      to = making.add(disc_probe(a, nearest_disc(a, box.x0 + place.x_to, layout.probes[from].y)));
    }
    const double distance = layout.probes[to].x - layout.probes[from].x;
    if (!(distance > 0.0)) {
      throw InputError("probes.pairs: the assembly is too short for pairs of probes; name discs or points instead");
    }
    making.layout.pairs.push_back({from, to, distance});
  }
  return making.layout;
}

}  // namespace

ProbeLayout lay_probes(const Scene& scene, const ddem::Assembly& a) {
  if (const auto* pairs = std::get_if<ProbePairs>(&scene.probes)) return pairs_layout(*pairs, a);
  LayoutInMaking making;
  std::vector<std::string> problems;
  if (const auto* named = std::get_if<ProbeDiscs>(&scene.probes)) {
    for (const std::int64_t disc : named->discs) {
      if (disc < 0 || disc >= static_cast<std::int64_t>(a.size())) {
        problems.push_back(scene_problem(scene, "probes.discs", fmt::format("disc {} does not exist", disc),
                                         fmt::format("discs are 0 to {}", a.size() - 1)));
      } else {
        making.add(disc_probe(a, narrow<int>(disc, "probes.discs")));
      }
    }
  } else {
    const Box box(a);
    for (const auto& [x, y] : std::get<ProbePoints>(scene.probes).points) {
      if (x < 0.0 || x > box.x1 - box.x0 || y < 0.0 || y > box.y1 - box.y0) {
        problems.push_back(scene_problem(scene, "probes.points", fmt::format("({:g}, {:g}) m lies outside the assembly", x, y),
                                         fmt::format("x and y count from the lower left corner of {:g} m x {:g} m", box.x1 - box.x0, box.y1 - box.y0)));
      } else {
        making.add(disc_probe(a, nearest_disc(a, box.x0 + x, box.y0 + y)));
      }
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return making.layout;
}

ProbeLayout nominal_pairs(const ProbePairs& spec, double length, double width) {
  ProbeLayout layout;
  for (int k = 0; k < narrow<int>(spec.pairs, "probes.pairs"); ++k) {
    const PairPlace place = place_of_pair(k, spec, length, width);
    layout.probes.push_back({"p" + std::to_string(2 * k), place.x_from, place.y, {}});
    layout.probes.push_back({"p" + std::to_string(2 * k + 1), place.x_to, place.y, {}});
    layout.pairs.push_back({2 * k, 2 * k + 1, place.x_to - place.x_from});
  }
  return layout;
}

}  // namespace ddem::harness
