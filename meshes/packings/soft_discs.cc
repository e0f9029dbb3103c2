#include "meshes/packings/soft_discs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>
#include <utility>


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

// Up to so many discs are one chunk. Of more, two chunks for as many again, so that two threads share them evenly.
constexpr std::size_t kChunk = 20000;

// Keeps the distance of two centres in one place from being 0; far below the rounding of any other.
constexpr double kSmallestDistance2 = 1e-200;

}  // namespace

SoftDiscs::SoftDiscs(Packing start, FlatWalls walls) : packing_(std::move(start)), walls_(walls) {
  for (auto* values : {&vx_, &vy_, &fx_, &fy_}) values->assign(packing_.size(), 0.0);
  make_chunks();
  build_list();
}

void SoftDiscs::make_chunks() {
  const std::size_t count = packing_.size() > kChunk ? 2 * (packing_.size() / kChunk) : 1;
  chunks_.resize(count);
  for (std::size_t c = 0; c < count; ++c) chunks_[c].begin = packing_.size() * c / count, chunks_[c].end = packing_.size() * (c + 1) / count;
  team_ = std::make_unique<Team>(static_cast<int>(std::min<std::size_t>(count, std::max(1U, std::thread::hardware_concurrency()))));
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
  std::vector<std::vector<ClosePair>> inner(chunks_.size()), outer(chunks_.size());
  const auto chunk_of = [&](int disc) {
    const auto after = std::ranges::upper_bound(chunks_, static_cast<std::size_t>(disc), {}, &Chunk::begin);
    return static_cast<std::size_t>(after - chunks_.begin()) - 1;
  };
  for (const ClosePair& c : close) {
    const std::size_t of_i = chunk_of(c.i), of_j = chunk_of(c.j);
    if (of_i == of_j) {
      inner[of_i].push_back(c);
    } else {
      outer[of_i].push_back(c);
      outer[of_j].push_back({c.j, c.i, -c.dx, -c.dy, c.gap});
    }
  }
  team_->run([&](int thread) {
    const auto [begin, end] = team_->part(chunks_.size(), thread);
    for (std::size_t c = begin; c < end; ++c) {
      std::ranges::stable_sort(outer[c], {}, &ClosePair::i);
      chunks_[c].inner = arranged(inner[c], packing_, static_cast<int>(chunks_[c].begin));
      chunks_[c].outer = arranged(outer[c], packing_, static_cast<int>(chunks_[c].begin));
    }
  });
}

/// A counting sort of pairs that are ordered by i: by block of discs and place among the pairs of disc i; those through a period last.
SoftDiscs::Pairs SoftDiscs::arranged(const std::vector<ClosePair>& close, const Packing& packing, int first_disc) {
  const auto is_shifted = [&](const ClosePair& c) {
    return c.dx != packing.x[c.j] - packing.x[c.i] || c.dy != packing.y[c.j] - packing.y[c.i];
  };
  std::vector<std::size_t> key(close.size());
  std::size_t most = 1, blocks = 1;
  const auto block = [&](const ClosePair& c) { return static_cast<std::size_t>(c.i - first_disc) / kBlock; };
  for (std::size_t k = 0; k < close.size(); ++k) {
    key[k] = k > 0 && close[k - 1].i == close[k].i ? key[k - 1] + 1 : 0;
    most = std::max(most, key[k] + 1);
    blocks = std::max(blocks, block(close[k]) + 1);
  }
  const std::size_t last = most * blocks;
  for (std::size_t k = 0; k < close.size(); ++k) key[k] = is_shifted(close[k]) ? last : key[k] + most * block(close[k]);
  std::vector<std::size_t> start(last + 2, 0);
  for (const std::size_t k : key) ++start[k + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());

  Pairs pairs;
  pairs.first_shifted = start[last];
  for (auto* indices : {&pairs.i, &pairs.j}) indices->resize(close.size());
  for (auto* shifts : {&pairs.shift_x, &pairs.shift_y}) shifts->resize(close.size() - pairs.first_shifted);
  for (std::size_t k = 0; k < close.size(); ++k) {
    const ClosePair& c = close[k];
    const std::size_t place = start[key[k]]++;
    pairs.i[place] = c.i;
    pairs.j[place] = c.j;
    if (place < pairs.first_shifted) continue;
    pairs.shift_x[place - pairs.first_shifted] = c.dx - (packing.x[c.j] - packing.x[c.i]);
    pairs.shift_y[place - pairs.first_shifted] = c.dy - (packing.y[c.j] - packing.y[c.i]);
  }
  return pairs;
}

void SoftDiscs::gather(Batch& batch, const Pairs& pairs, std::size_t first, std::size_t count) const {
  for (std::size_t k = 0; k < count; ++k) {
    const int i = pairs.i[first + k], j = pairs.j[first + k];
    batch.dx[k] = packing_.x[j] - packing_.x[i];
    batch.dy[k] = packing_.y[j] - packing_.y[i];
    batch.radii[k] = packing_.radius[i] + packing_.radius[j];
  }
  for (std::size_t k = std::max(first, pairs.first_shifted); k < first + count; ++k) {
    batch.dx[k - first] += pairs.shift_x[k - pairs.first_shifted];
    batch.dy[k - first] += pairs.shift_y[k - pairs.first_shifted];
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

void SoftDiscs::add_inner_forces(Chunk& chunk) {
  Batch& batch = chunk.batch;
  const Pairs& pairs = chunk.inner;
  Overlaps all;  // in registers: as far as the compiler knows, a force may be stored into the chunk's
  for (std::size_t first = 0; first < pairs.i.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, pairs.i.size() - first);
    gather(batch, pairs, first, count);
    batch.press(count);
    for (std::size_t k = 0; k < count; ++k) {
      const int i = pairs.i[first + k], j = pairs.j[first + k];
      fx_[i] -= batch.dx[k];
      fy_[i] -= batch.dy[k];
      fx_[j] += batch.dx[k];
      fy_[j] += batch.dy[k];
      all.add(batch.overlap[k]);
    }
  }
  chunk.overlaps = all;
}

/// On i alone, and its overlap counted once: where i < j.
void SoftDiscs::add_outer_forces(Chunk& chunk) {
  Batch& batch = chunk.batch;
  const Pairs& pairs = chunk.outer;
  Overlaps all;
  for (std::size_t first = 0; first < pairs.i.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, pairs.i.size() - first);
    gather(batch, pairs, first, count);
    batch.press(count);
    for (std::size_t k = 0; k < count; ++k) {
      const int i = pairs.i[first + k];
      fx_[i] -= batch.dx[k];
      fy_[i] -= batch.dy[k];
      if (i < pairs.j[first + k]) all.add(batch.overlap[k]);
    }
  }
  chunk.overlaps.add(all);
}

void SoftDiscs::add_wall_forces(Chunk& chunk) {
  const auto press = [&](const std::vector<double>& centre, double end, std::vector<double>& force) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const double low = packing_.radius[i] - centre[i], high = packing_.radius[i] - (end - centre[i]);
      chunk.overlaps.add(std::max(0.0, low));
      chunk.overlaps.add(std::max(0.0, high));
      force[i] += std::max(0.0, low) - std::max(0.0, high);
    }
  };
  if (walls_.x) press(packing_.x, packing_.length, fx_);
  if (walls_.y) press(packing_.y, packing_.width, fy_);
}

void SoftDiscs::add_products(Chunk& chunk) const {
  Products p;
  for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
    const double force2 = fx_[i] * fx_[i] + fy_[i] * fy_[i];
    const double velocity2 = vx_[i] * vx_[i] + vy_[i] * vy_[i];
    p.power += fx_[i] * vx_[i] + fy_[i] * vy_[i];
    p.force2 += force2;
    p.velocity2 += velocity2;
    p.largest_force2 = std::max(p.largest_force2, force2);
    p.largest_velocity2 = std::max(p.largest_velocity2, velocity2);
  }
  chunk.products = p;
}

void SoftDiscs::Products::add(const Products& more) {
  power += more.power;
  force2 += more.force2;
  velocity2 += more.velocity2;
  largest_force2 = std::max(largest_force2, more.largest_force2);
  largest_velocity2 = std::max(largest_velocity2, more.largest_velocity2);
}

void SoftDiscs::evaluate(Chunk& chunk) {
  for (auto* forces : {&fx_, &fy_}) {
    std::fill(forces->begin() + static_cast<std::ptrdiff_t>(chunk.begin), forces->begin() + static_cast<std::ptrdiff_t>(chunk.end), 0.0);
  }
  add_inner_forces(chunk);
  add_outer_forces(chunk);
  add_wall_forces(chunk);
  add_products(chunk);
}

SoftDiscs::State SoftDiscs::evaluate() {
  team_->run([&](int thread) {
    const auto [begin, end] = team_->part(chunks_.size(), thread);
    for (std::size_t c = begin; c < end; ++c) evaluate(chunks_[c]);
  });
  Overlaps overlaps;
  products_ = {};
  for (const Chunk& chunk : chunks_) {
    overlaps.add(chunk.overlaps);
    products_.add(chunk.products);
  }
  State state;
  state.contacts = overlaps.contacts;
  state.largest_overlap = overlaps.largest;
  if (overlaps.contacts > 0) state.mean_overlap = overlaps.sum / overlaps.contacts;
  return state;
}

/// v <- keep v + push F, then a semi-implicit Euler step; the list is built again where discs have left its
/// skin.
void SoftDiscs::advance(double dt, double keep, double push) {
  const auto move = [&](std::vector<double>& centres, std::vector<double>& velocities, const std::vector<double>& forces, std::size_t begin, std::size_t end) {
    double* __restrict x = centres.data();
    double* __restrict v = velocities.data();
    const double* __restrict f = forces.data();
    for (std::size_t i = begin; i < end; ++i) {
      v[i] = keep * v[i] + push * f[i];
      x[i] += dt * v[i];
    }
  };
  team_->run([&](int thread) {
    const auto [begin, end] = team_->part(packing_.size(), thread);
    move(packing_.x, vx_, fx_, begin, end);
    move(packing_.y, vy_, fy_, begin, end);
  });
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
    state = evaluate();
    const Products& now = products_;
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
