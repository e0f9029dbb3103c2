#pragma once
// New contacts (theory section 1): two discs that are not bonded and whose gap closes, because they move or deform, repel
// with k_n; they never pull. Without friction.
//
//   gap = n.(x_j + u_j - x_i - u_i) - (r_i + r_j) - s n.(r_i eps_i + r_j eps_j).n,   force on i: k_n gap n where gap < 0
//
// n stands still in linear kinematics, which means little beyond displacements of a radius: there pairs further apart than
// four radii at the start are never watched. Discs that overlap at the start without a bond are taken to touch.
//
// Looking at every pair at every step would cost more than the bonds. No disc moves further in a step than the fastest, and
// no boundary further than the largest strain takes it: as long as the sum of that cannot have closed the narrowest gap
// of the last survey, nothing is looked at; and then at first only at the pairs that are near.

#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/simulation/new_contact.h"
#include "dem/simulation/simulation.h"

namespace ddem {

class NewContacts {
 public:
  /// Throws std::invalid_argument where a period is too short to tell two images of a disc apart.
  NewContacts(const Assembly& assembly, const SimulationInput& input, const std::vector<int>& position);

  /// In each of so many steps since the call before no disc has moved further than this, m.
  void moved(double distance, int steps = 1);

  /// In how many steps from here nothing can close, and so need not be looked for, as long as no disc moves twice as far in one as in the
  /// last, and no boundary twice as far; 0 where a pair is near.
  int free_steps(const double* motion, double largest_strain);
  /// Whether nothing can have closed up to here, where no strain was larger.
  bool is_free(double largest_strain) const { return 2.0 * path_ + reach_of(largest_strain) < margin_; }

  /// Finds what is closed under displacements and strains (kQuad a disc; null for rigid discs), no component sum
  /// r |eps| of which exceeds `largest_strain` (m).
  const std::vector<NewContact>& look(const double* motion, const double* strain, double largest_strain);
  const std::vector<NewContact>& closed() const { return closed_; }

  /// The assembly with every pair bonded that is watched from the start on (nonlinear kinematics: now): its particle strains are coupled
  /// at least as closely as with any of them closed. In linear kinematics the same whenever it is asked for.
  Assembly all_closed() const;

 private:
  struct Pair {
    int i, j;            // places
    int disc_i, disc_j;  // in the order of the assembly
    double dx, dy;       // from i to j at the start, m
    double touching;     // distance at which they touch: r_i + r_j, or that of the start if nearer
    double stiffness;
  };

  /// n.(r eps).n is at most the norm of r eps.
  double reach_of(double largest_strain) const { return 2.0 * largest_strain * longest_arm_; }
  void survey(const double* motion, double reach_of_strains);
  void find_pairs(const double* motion);
  double furthest(const double* motion) const;
  NewContact state(const Pair& pair, const double* motion) const;

  const Assembly& assembly_;
  ContactParameters contact_;
  const std::vector<int>& position_;
  bool always_ = false, nonlinear_ = false;
  double first_reach_ = 0.0, reach_ = 0.0, longest_reach_ = 0.0;  // gap up to which pairs are known
  double longest_arm_ = 1.0;                  // over its radius: a gapped pair's arms are longer, by half the gap at most
  std::vector<double> found_at_;              // displacements where they were searched (x, y a disc), nonlinear kinematics
  std::vector<Pair> pairs_;
  std::vector<int> near_;                     // of pairs_: to be looked at in every step
  double margin_ = 0.0;                       // narrowest gap of the others, at the survey; 0 before the first
  double lost_ = 0.0;
  double path_ = 0.0, last_distance_ = 0.0;   // moved since the survey; in the last step
  bool has_moved_ = false;
  std::vector<NewContact> closed_;
};

}  // namespace ddem
