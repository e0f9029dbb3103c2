#include "meshes/packings/soft_discs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "dem/assembly/contacts.h"

namespace ddem::packings {
namespace {

// Parameters of the FIRE paper; the time steps are in units of sqrt(mass/stiffness), in which
// the fastest mode of a hexagonal packing has the frequency sqrt(6): steps below 0.8 are stable.
constexpr double kFirstStep = 0.1, kLongestStep = 0.5;
constexpr double kGrow = 1.1, kShrink = 0.5;
constexpr double kSteer = 0.1, kSteerDecay = 0.99;
constexpr int kPatience = 5;

// Room around the discs in the neighbour list, in mean radii: wider lists are rebuilt less often.
constexpr double kSkin = 0.6;

}  // namespace

SoftDiscs::SoftDiscs(Packing start) : packing_(std::move(start)) {
  for (auto* values : {&vx_, &vy_, &fx_, &fy_}) values->assign(packing_.size(), 0.0);
  build_list();
}

void SoftDiscs::scale_radii(double factor) {
  for (double& radius : packing_.radius) radius *= factor;
  build_list();
}

void SoftDiscs::build_list() {
  skin_ = kSkin * mean_radius(packing_);
  neighbours_.clear();
  first_.assign(packing_.size() + 1, 0);
  for (const ClosePair& close : close_pairs(packing_, skin_)) {
    const double dx = packing_.x[close.j] - packing_.x[close.i],
                 dy = packing_.y[close.j] - packing_.y[close.i];
    neighbours_.push_back(
        {close.j, close.dx - dx, close.dy - dy, packing_.radius[close.i] + packing_.radius[close.j]});
    ++first_[close.i + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  listed_x_ = packing_.x;
  listed_y_ = packing_.y;
}

SoftDiscs::State SoftDiscs::evaluate_forces(Products& products) {
  std::fill(fx_.begin(), fx_.end(), 0.0);
  std::fill(fy_.begin(), fy_.end(), 0.0);
  products = {};
  State state;
  double sum = 0.0;
  for (std::size_t i = 0; i < packing_.size(); ++i) {
    const double x = packing_.x[i], y = packing_.y[i];
    double fx = fx_[i], fy = fy_[i];
    for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
      const Neighbour& other = neighbours_[k];
      const double dx = packing_.x[other.disc] - x + other.shift_x;
      const double dy = packing_.y[other.disc] - y + other.shift_y;
      const double distance2 = dx * dx + dy * dy;
      if (distance2 >= other.radii * other.radii) continue;
      const double distance = std::sqrt(distance2);
      const double overlap = other.radii - distance;
      // Discs in the same place are pushed apart along x.
      const double per_length = distance > 0.0 ? overlap / distance : 0.0;
      const double force_x = distance > 0.0 ? per_length * dx : overlap, force_y = per_length * dy;
      fx -= force_x;
      fy -= force_y;
      fx_[other.disc] += force_x;
      fy_[other.disc] += force_y;
      sum += overlap;
      state.largest_overlap = std::max(state.largest_overlap, overlap);
      ++state.contacts;
    }
    fx_[i] = fx;
    fy_[i] = fy;
    // Neighbours listed at i have higher numbers: the force on i is complete.
    const double force2 = fx * fx + fy * fy;
    products.power += fx * vx_[i] + fy * vy_[i];
    products.force2 += force2;
    products.velocity2 += vx_[i] * vx_[i] + vy_[i] * vy_[i];
    products.largest_force2 = std::max(products.largest_force2, force2);
  }
  if (state.contacts > 0) {
    state.mean_overlap = sum / state.contacts;
    state.unbalanced_force = std::sqrt(products.largest_force2) / state.mean_overlap;
  }
  return state;
}

/// v <- keep v + push F, then a semi-implicit Euler step; the list is built again where discs have left its
/// skin.
void SoftDiscs::advance(double dt, double keep, double push) {
  double farthest2 = 0.0;
  for (std::size_t i = 0; i < packing_.size(); ++i) {
    vx_[i] = keep * vx_[i] + push * fx_[i];
    vy_[i] = keep * vy_[i] + push * fy_[i];
    packing_.x[i] += dt * vx_[i];
    packing_.y[i] += dt * vy_[i];
    const double dx = packing_.x[i] - listed_x_[i], dy = packing_.y[i] - listed_y_[i];
    farthest2 = std::max(farthest2, dx * dx + dy * dy);
  }
  // Two discs that approach each other cover the skin together.
  if (4.0 * farthest2 > skin_ * skin_) build_list();
}

SoftDiscs::State SoftDiscs::minimise(const Goal& goal) {
  for (auto* values : {&vx_, &vy_}) std::fill(values->begin(), values->end(), 0.0);
  double dt = kFirstStep, mixing = kSteer;
  int downhill = 0;
  State state;
  for (int iteration = 0; iteration < goal.most_iterations; ++iteration) {
    Products now;
    state = evaluate_forces(now);
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
    advance(dt, keep, steer + dt);
  }
  return state;
}

}  // namespace ddem::packings
