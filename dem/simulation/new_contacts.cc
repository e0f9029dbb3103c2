#include "dem/simulation/new_contacts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "dem/assembly/bond_stiffness.h"
#include "dem/assembly/contacts.h"

namespace ddem {
namespace {

/// Between two surveys there shall be about so many steps.
constexpr double kStepsAhead = 32.0;
/// With fewer free steps ahead there is a survey.
constexpr double kFewSteps = 16.0;
/// In mean radii: the gap up to which pairs are known at first, and at most in linear kinematics.
constexpr double kFirstReach = 1.0, kLinearReach = 4.0;
/// In mean radii: a run that has come so far is lost, and its watch over.
constexpr double kLost = 1e6;

double longest_reach(const Packing& p, bool nonlinear) {
  const double widest = 2.0 * *std::max_element(p.radius.begin(), p.radius.end());
  double reach = (nonlinear ? kFirstReach : kLinearReach) * mean_radius(p);
  for (const double period : {p.period.x, p.period.y}) {
    if (period > 0.0) reach = std::min(reach, 0.5 * period * (1.0 - 1e-12) - widest);
  }
  return reach;
}

double start_distance(const Packing& p, const ClosePair& pair) {
  return std::hypot(nearest_image(p.x[pair.j] - p.x[pair.i], p.period.x), nearest_image(p.y[pair.j] - p.y[pair.i], p.period.y));
}

std::vector<std::pair<int, int>> bonded_pairs(const Bonds& b) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t c = 0; c < b.size(); ++c) pairs.push_back(std::minmax(b.i[c], b.j[c]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

NewContacts::NewContacts(const Assembly& a, const SimulationInput& input, const std::vector<int>& position)
    : assembly_(a),
      contact_(input.contact),
      position_(position),
      always_(input.new_contacts == ContactWatch::every_step),
      nonlinear_(input.contact.kinematics == Kinematics::nonlinear),
      longest_reach_(longest_reach(a.packing, nonlinear_)),
      lost_(kLost * mean_radius(a.packing)) {
  if (!(longest_reach_ > 0.0)) {
    throw std::invalid_argument("new contacts cannot be watched where a period is shorter than two discs: new_contacts = \"off\", or more discs");
  }
  first_reach_ = reach_ = std::min(kFirstReach * mean_radius(a.packing), longest_reach_);
  found_at_.assign(2 * a.size(), 0.0);
  find_pairs(nullptr);
}

void NewContacts::find_pairs(const double* motion) {
  Packing p = assembly_.packing;
  if (motion != nullptr) {
    for (std::size_t d = 0; d < p.size(); ++d) {
      const double *u = motion + kQuad * position_[d];
      p.x[d] += found_at_[2 * d] = u[0];
      p.y[d] += found_at_[2 * d + 1] = u[1];
    }
  }
  longest_arm_ = 1.0 + 0.5 * reach_ / *std::min_element(p.radius.begin(), p.radius.end());
  const std::vector<std::pair<int, int>> bonded = bonded_pairs(assembly_.bonds);
  pairs_.clear();
  for (const ClosePair& c : close_pairs(p, reach_)) {
    if (std::binary_search(bonded.begin(), bonded.end(), std::pair(c.i, c.j))) continue;
    const double r_i = p.radius[c.i], r_j = p.radius[c.j];
    // From the positions at the start and the image: the same bits wherever the pair was found.
    const Packing& start = assembly_.packing;
    const auto from_start = [&](const std::vector<double>& x, double period, double now, int component) {
      const double apart = x[c.j] - x[c.i], moved = found_at_[2 * c.j + component] - found_at_[2 * c.i + component];
      return period > 0.0 ? apart + period * std::round((now - moved - apart) / period) : apart;
    };
    pairs_.push_back({position_[c.i], position_[c.j], c.i, c.j, from_start(start.x, start.period.x, c.dx, 0),
                      from_start(start.y, start.period.y, c.dy, 1), std::min(r_i + r_j, start_distance(start, c)),
                      normal_stiffness(contact_, r_i, r_j)});
  }
}

NewContact NewContacts::state(const Pair& pair, const double* motion) const {
  const double *a = motion + kQuad * pair.i, *b = motion + kQuad * pair.j;
  const double ux = b[0] - a[0], uy = b[1] - a[1];
  const double start = std::hypot(pair.dx, pair.dy);
  NewContact c{pair.i, pair.j, pair.dx / start, pair.dy / start, 1.0, pair.stiffness, start - pair.touching, 0.0, 0.0};
  double length = start;
  if (nonlinear_) {
    length = std::hypot(pair.dx + ux, pair.dy + uy);
    c.nx = (pair.dx + ux) / length, c.ny = (pair.dy + uy) / length;
    c.rigid_gap = length - pair.touching;
  } else {
    c.rigid_gap = c.rigid_gap_at(motion);
  }
  c.stretch = length / (assembly_.packing.radius[pair.disc_i] + assembly_.packing.radius[pair.disc_j]);
  return c;
}

void NewContacts::moved(double distance, int steps) {
  last_distance_ = distance;
  path_ += steps * distance;
  has_moved_ = true;
}

int NewContacts::free_steps(const double* motion, double largest_strain) {
  if (always_ || !has_moved_ || !closed_.empty()) return 0;
  const double ahead = 2.0 * reach_of(largest_strain);
  const auto count = [&] { return near_.empty() ? (margin_ - ahead - 2.0 * path_) / (4.0 * last_distance_) : 0.0; };
  // Another survey pays where half of the last one's margin is used up.
  if (!(count() >= kFewSteps) && !(2.0 * path_ < 0.5 * margin_)) survey(motion, 0.5 * ahead);
  const double steps = count();
  return steps >= kStepsAhead ? static_cast<int>(kStepsAhead) : steps >= 1.0 ? static_cast<int>(steps) : 0;
}

/// How far a disc has moved at most since the pairs were found, m; not a number if a displacement is none.
double NewContacts::furthest(const double* motion) const {
  double most = 0.0;
  for (std::size_t d = 0; d < assembly_.size(); ++d) {
    const double *u = motion + kQuad * position_[d], *from = found_at_.data() + 2 * d;
    const double moved = std::hypot(u[0] - from[0], u[1] - from[1]);
    if (!(moved <= most)) most = moved;
    if (std::isnan(most)) break;
  }
  return most;
}

/// Pairs that are not known have to cross the reach before they close: as long as none is half-way, the known ones will do.
void NewContacts::survey(const double* motion, double reach_of_strains) {
  path_ = 0.0;
  near_.clear();
  margin_ = HUGE_VAL;
  double moved = furthest(motion);
  if (!(moved < lost_)) return;
  const bool may_reach_further = nonlinear_ || reach_ < longest_reach_;
  if (may_reach_further && moved > 0.375 * reach_) {
    if (!nonlinear_) reach_ = std::min(2.0 * reach_, longest_reach_);  // distances are those of the start
    find_pairs(nonlinear_ ? motion : nullptr);
    moved = furthest(motion);
  }
  if (nonlinear_ || reach_ < longest_reach_) margin_ = reach_ - 2.0 * moved;
  const double horizon = 2.0 * kStepsAhead * last_distance_ + 2.0 * reach_of_strains;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const double gap = state(pairs_[k], motion).rigid_gap;
    if (gap > horizon) {
      margin_ = std::min(margin_, gap);
    } else {
      near_.push_back(static_cast<int>(k));
    }
  }
}

const std::vector<NewContact>& NewContacts::look(const double* motion, const double* strain, double largest_strain) {
  if (always_ || !is_free(largest_strain)) survey(motion, reach_of(largest_strain));
  closed_.clear();
  const auto add_if_closed = [&](const Pair& pair) {
    NewContact c = state(pair, motion);
    c.gap = c.rigid_gap - (strain == nullptr ? 0.0 : c.approach(strain));
    if (c.gap < 0.0) closed_.push_back(c);
  };
  if (always_) {
    for (const Pair& pair : pairs_) add_if_closed(pair);
  } else {
    for (const int k : near_) add_if_closed(pairs_[k]);
  }
  return closed_;
}

Assembly NewContacts::all_closed() const {
  Assembly a = assembly_;
  std::vector<ClosePair> pairs;
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    pairs.push_back({a.bonds.i[c], a.bonds.j[c], a.bonds.length[c] * a.bonds.nx[c], a.bonds.length[c] * a.bonds.ny[c], 0.0});
  }
  for (const Pair& p : pairs_) {
    const double touching = a.packing.radius[p.disc_i] + a.packing.radius[p.disc_j];
    if (nonlinear_ || std::hypot(p.dx, p.dy) - touching <= first_reach_) pairs.push_back({p.disc_i, p.disc_j, p.dx, p.dy, 0.0});
  }
  a.bonds = bonds_of(a.packing, pairs);
  return a;
}

}  // namespace ddem
