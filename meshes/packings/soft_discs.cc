#include "meshes/packings/soft_discs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "dem/assembly/contacts.h"

namespace ddem::packings {
namespace {

// Those of the FIRE paper but for a faster decay of the steering (0.99 there: a third more iterations). Time steps are
// in units of sqrt(mass/stiffness), in which the fastest mode of a hexagonal packing has the frequency sqrt(6): steps
// below 0.8 are stable there, and a large disc among small ones has more contacts (0.7 fails at radius ratio 10).
constexpr double kFirstStep = 0.1, kLongestStep = 0.6;
constexpr double kGrow = 1.1, kShrink = 0.5;
constexpr double kSteer = 0.1, kSteerDecay = 0.98;
constexpr int kPatience = 5;

// Room around the discs in the neighbour list, in mean radii: wider lists are rebuilt less often.
// Measured moves are trusted up to this part of the skin: the rest is rounding and the next step.
constexpr double kSkin = 0.5, kSafe = 0.9;

// Discs whose positions and forces stay in the innermost cache while their pairs are looked at.
constexpr std::size_t kBlock = 256;

// Keeps the distance of two centres in one place from being 0; far below the rounding of any other.
constexpr double kSmallestDistance2 = 1e-200;

}  // namespace

SoftDiscs::SoftDiscs(Packing start, FlatWalls walls) : packing_(std::move(start)), walls_(walls) {
  for (auto* values : {&vx_, &vy_, &fx_, &fy_}) values->assign(packing_.size(), 0.0);
  build_list();
}

void SoftDiscs::scale_radii(double factor) {
  for (double& radius : packing_.radius) radius *= factor;
  build_list();
}

void SoftDiscs::build_list() {
  skin_ = kSkin * mean_radius(packing_);
  listed_x_ = packing_.x;
  listed_y_ = packing_.y;
  moved_ = 0.0;
  const std::vector<ClosePair> close = close_pairs(packing_, skin_);

  // A counting sort: by block of discs and place among the pairs of disc i; those through a period come last.
  const auto is_shifted = [&](const ClosePair& c) {
    return c.dx != packing_.x[c.j] - packing_.x[c.i] || c.dy != packing_.y[c.j] - packing_.y[c.i];
  };
  std::vector<std::size_t> key(close.size());
  std::size_t most = 1;
  for (std::size_t k = 0; k < close.size(); ++k) {
    key[k] = k > 0 && close[k - 1].i == close[k].i ? key[k - 1] + 1 : 0;
    most = std::max(most, key[k] + 1);
  }
  const std::size_t last = most * (packing_.size() / kBlock + 1);
  for (std::size_t k = 0; k < close.size(); ++k)
    key[k] = is_shifted(close[k]) ? last : key[k] + most * (static_cast<std::size_t>(close[k].i) / kBlock);
  std::vector<std::size_t> start(last + 2, 0);
  for (const std::size_t k : key) ++start[k + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());

  pairs_.first_shifted = start[last];
  for (auto* indices : {&pairs_.i, &pairs_.j}) indices->resize(close.size());
  for (auto* shifts : {&pairs_.shift_x, &pairs_.shift_y}) shifts->resize(close.size() - pairs_.first_shifted);
  for (std::size_t k = 0; k < close.size(); ++k) {
    const ClosePair& c = close[k];
    const std::size_t place = start[key[k]]++;
    pairs_.i[place] = c.i;
    pairs_.j[place] = c.j;
    if (place < pairs_.first_shifted) continue;
    pairs_.shift_x[place - pairs_.first_shifted] = c.dx - (packing_.x[c.j] - packing_.x[c.i]);
    pairs_.shift_y[place - pairs_.first_shifted] = c.dy - (packing_.y[c.j] - packing_.y[c.i]);
  }
}

void SoftDiscs::gather(std::size_t first, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const int i = pairs_.i[first + k], j = pairs_.j[first + k];
    batch_.dx[k] = packing_.x[j] - packing_.x[i];
    batch_.dy[k] = packing_.y[j] - packing_.y[i];
    batch_.radii[k] = packing_.radius[i] + packing_.radius[j];
  }
  for (std::size_t k = std::max(first, pairs_.first_shifted); k < first + count; ++k) {
    batch_.dx[k - first] += pairs_.shift_x[k - pairs_.first_shifted];
    batch_.dy[k - first] += pairs_.shift_y[k - pairs_.first_shifted];
  }
}

/// Forces on j into dx, dy; no branch, so that the compiler takes several pairs at once.
void SoftDiscs::Batch::press(std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const double distance = std::sqrt(dx[k] * dx[k] + dy[k] * dy[k] + kSmallestDistance2);
    const double between = radii[k] - distance;
    overlap[k] = between > 0.0 ? between : 0.0;
    const double per_length = overlap[k] / distance;
    dx[k] *= per_length;
    dy[k] *= per_length;
  }
}

void SoftDiscs::scatter(std::size_t first, std::size_t count, Overlaps& overlaps) {
  Overlaps all = overlaps;  // in registers: as far as the compiler knows, a force may be stored into `overlaps`
  for (std::size_t k = 0; k < count; ++k) {
    const int i = pairs_.i[first + k], j = pairs_.j[first + k];
    fx_[i] -= batch_.dx[k];
    fy_[i] -= batch_.dy[k];
    fx_[j] += batch_.dx[k];
    fy_[j] += batch_.dy[k];
    all.add(batch_.overlap[k]);
  }
  overlaps = all;
}

void SoftDiscs::add_wall_forces(Overlaps& overlaps) {
  const auto press = [&](const std::vector<double>& centre, double end, std::vector<double>& force) {
    for (std::size_t i = 0; i < packing_.size(); ++i) {
      const double low = packing_.radius[i] - centre[i], high = packing_.radius[i] - (end - centre[i]);
      overlaps.add(std::max(0.0, low));
      overlaps.add(std::max(0.0, high));
      force[i] += std::max(0.0, low) - std::max(0.0, high);
    }
  };
  if (walls_.x) press(packing_.x, packing_.length, fx_);
  if (walls_.y) press(packing_.y, packing_.width, fy_);
}

SoftDiscs::State SoftDiscs::evaluate_forces() {
  std::fill(fx_.begin(), fx_.end(), 0.0);
  std::fill(fy_.begin(), fy_.end(), 0.0);
  Overlaps overlaps;
  for (std::size_t first = 0; first < pairs_.i.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, pairs_.i.size() - first);
    gather(first, count);
    batch_.press(count);
    scatter(first, count, overlaps);
  }
  add_wall_forces(overlaps);
  State state;
  state.contacts = overlaps.contacts;
  state.largest_overlap = overlaps.largest;
  if (overlaps.contacts > 0) state.mean_overlap = overlaps.sum / overlaps.contacts;
  return state;
}

SoftDiscs::Products SoftDiscs::products() const {
  Products p;
  for (std::size_t i = 0; i < packing_.size(); ++i) {
    const double force2 = fx_[i] * fx_[i] + fy_[i] * fy_[i];
    const double velocity2 = vx_[i] * vx_[i] + vy_[i] * vy_[i];
    p.power += fx_[i] * vx_[i] + fy_[i] * vy_[i];
    p.force2 += force2;
    p.velocity2 += velocity2;
    p.largest_force2 = std::max(p.largest_force2, force2);
    p.largest_velocity2 = std::max(p.largest_velocity2, velocity2);
  }
  return p;
}

/// v <- keep v + push F, then a semi-implicit Euler step; the list is built again where discs have left its
/// skin.
void SoftDiscs::advance(double dt, double keep, double push) {
  const auto move = [&](std::vector<double>& centres, std::vector<double>& velocities, const std::vector<double>& forces) {
    double* __restrict x = centres.data();
    double* __restrict v = velocities.data();
    const double* __restrict f = forces.data();
    for (std::size_t i = 0; i < centres.size(); ++i) {
      v[i] = keep * v[i] + push * f[i];
      x[i] += dt * v[i];
    }
  };
  move(packing_.x, vx_, fx_);
  move(packing_.y, vy_, fy_);
}

/// Two discs that approach each other cover the skin together. How far discs have moved is bounded by their
/// largest speeds, and looked at where the bound says that the skin may be used up.
void SoftDiscs::keep_list_valid(double largest_move) {
  moved_ += largest_move;
  if (2.0 * moved_ <= skin_) return;
  double farthest2 = 0.0;
  for (std::size_t i = 0; i < packing_.size(); ++i) {
    const double dx = packing_.x[i] - listed_x_[i], dy = packing_.y[i] - listed_y_[i];
    farthest2 = std::max(farthest2, dx * dx + dy * dy);
  }
  moved_ = std::sqrt(farthest2);
  if (2.0 * moved_ > kSafe * skin_) build_list();
}

SoftDiscs::State SoftDiscs::minimise(const Goal& goal) {
  for (auto* values : {&vx_, &vy_}) std::fill(values->begin(), values->end(), 0.0);
  double dt = kFirstStep, mixing = kSteer;
  int downhill = 0;
  State state;
  for (int iteration = 0; iteration < goal.most_iterations; ++iteration) {
    state = evaluate_forces();
    const Products now = products();
    if (state.contacts > 0) state.unbalanced_force = std::sqrt(now.largest_force2) / state.mean_overlap;
    state.iterations = iteration + 1;
    state.converged =
        state.largest_overlap <= goal.overlap || state.unbalanced_force <= goal.unbalanced_force;
    if (state.converged) return state;

    double keep = 0.0, steer = 0.0;  // uphill: start again from rest
    if (now.power > 0.0) {
      keep = 1.0 - mixing;
      steer = mixing * std::sqrt(now.velocity2 / now.force2);
      if (++downhill > kPatience) {
        dt = std::min(dt * kGrow, kLongestStep);
        mixing *= kSteerDecay;
      }
    } else {
      downhill = 0;
      if (iteration > 0) dt *= kShrink;
      mixing = kSteer;
    }
    const double push = steer + dt;
    advance(dt, keep, push);
    // |v| <= keep |v before| + push |F|
    keep_list_valid(dt * (keep * std::sqrt(now.largest_velocity2) + push * std::sqrt(now.largest_force2)));
  }
  return state;
}

}  // namespace ddem::packings
