#pragma once
// Frictionless soft discs in a cell with periodic edges or flat walls, relaxed to a minimum of their energy
// sum_c overlap_c^2 / 2.

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "dem/assembly/contacts.h"
#include "dem/core/packing.h"
#include "dem/core/team.h"
#include "meshes/packings/flat_walls.h"

namespace ddem::packings {

class SoftDiscs {
 public:
  /// What the contacts look like where the minimiser stopped.
  struct State {
    double mean_overlap = 0.0, largest_overlap = 0.0;  ///< m; forces as well, with unit stiffness
    double unbalanced_force = 0.0;  ///< largest net force on a disc over the mean contact force
    int contacts = 0;               ///< those with walls included
    int iterations = 0;
    bool converged = false;
  };

  struct Goal {
    double unbalanced_force;  ///< converged when no larger than this,
    double overlap;           ///< or when the largest overlap (m) is no larger than this: nothing touches
    int most_iterations;
  };

  /// `start` holds the centres, the radii, the size, and the periods in the directions without walls. Many discs take as many threads
  /// as the machine has.
  SoftDiscs(Packing start, FlatWalls walls);

  const Packing& packing() const { return packing_; }

  void scale_radii(double factor);

  /// FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006): damped dynamics that turn off their inertia
  /// whenever it points uphill. Unit masses.
  State minimise(const Goal& goal);

 private:
  /// Neighbours (i, j): of a block of discs the first one of every disc, then the second ones and so on, since
  /// sums into the same disc one after the other would wait for each other. Those through a period come last; only they have a shift to
  /// j's nearest image, which is fixed while the list is valid.
  struct Pairs {
    std::vector<int> i, j;
    std::size_t first_shifted = 0;
    std::vector<double> shift_x, shift_y;  ///< of pair first_shifted + k
  };

  /// Pairs on their way through the force loop: few enough to stay in the innermost cache.
  static constexpr std::size_t kBatch = 256;
  struct Batch {
    std::array<double, kBatch> dx, dy, radii, overlap;

    void press(std::size_t count);
  };

  struct Overlaps {
    double sum = 0.0, largest = 0.0;
    int contacts = 0;

    void add(double overlap) {
      sum += overlap;
      largest = std::max(largest, overlap);
      contacts += overlap > 0.0 ? 1 : 0;
    }
    void add(const Overlaps& more) {
      sum += more.sum;
      largest = std::max(largest, more.largest);
      contacts += more.contacts;
    }
  };

  /// Sums over the discs: F.v, F.F, v.v; and the largest F.F and v.v of a disc.
  struct Products {
    double power = 0.0, force2 = 0.0, velocity2 = 0.0, largest_force2 = 0.0, largest_velocity2 = 0.0;

    void add(const Products& more);
  };

  /// Discs that one thread looks after. Pairs that reach into another chunk are in the lists of both, so that no force is written to from
  /// two sides; and how many chunks there are depends on the discs alone: the same bits for any number of threads.
  struct Chunk {
    std::size_t begin = 0, end = 0;
    Pairs inner, outer;  ///< both discs in the chunk, i < j; i in it and j in another
    Batch batch;
    Overlaps overlaps;
    Products products;
  };

  void make_chunks();
  void build_list();
  static Pairs arranged(const std::vector<ClosePair>& close, const Packing& packing, int first_disc);
  void gather(Batch& batch, const Pairs& pairs, std::size_t first, std::size_t count) const;
  void evaluate(Chunk& chunk);
  void add_inner_forces(Chunk& chunk);
  void add_outer_forces(Chunk& chunk);
  void add_wall_forces(Chunk& chunk);
  void add_products(Chunk& chunk) const;
  State evaluate();  ///< all but what the minimiser knows
  void advance(double dt, double keep, double push);
  void keep_list_valid(double largest_move);

  Packing packing_;
  FlatWalls walls_;
  std::vector<double> vx_, vy_, fx_, fy_;
  std::vector<Chunk> chunks_;
  Products products_;
  std::unique_ptr<Team> team_;
  std::vector<double> listed_x_, listed_y_;  ///< centres when the list was built
  double skin_ = 0.0, moved_ = 0.0;           ///< since then, at most
};

}  // namespace ddem::packings
