// Discs that are not bonded, from the list of neighbours of pair_style ddem.
//
// Looking at every pair at every step would cost as much as the bonds. No disc has moved further since the list was made than
// the furthest, and no boundary further than the largest strain takes it: as long as the sum of that cannot have closed the
// narrowest gap that was left then, no pair is looked at.
#include <lammps/atom.h>
#include <lammps/domain.h>
#include <lammps/error.h>
#include <lammps/force.h>
#include <lammps/neigh_list.h>
#include <lammps/neighbor.h>

#include <algorithm>
#include <cmath>

#include "dem/lammps/fix_ddem.h"
#include "dem/lammps/pair_ddem.h"

namespace ddem::lammps {

using std::string_literals::operator""s;

/// Bonds are told by the lists of who is bonded to whom, which both ends have, whatever special_bonds says and who keeps the bond.
bool FixDdem::bonded(int i, int j) const {
  const LAMMPS_NS::tagint* partners = atom->special[i];
  const auto* end = partners + atom->nspecial[i][0];
  return std::find(partners, end, atom->tag[j]) != end;
}

void FixDdem::build_contacts() {
  if (pair_ == nullptr) return;
  send(Sent::motion);  // to ghosts that are new
  const LAMMPS_NS::NeighList& list = *pair_->list;
  const double known = pair_->reach() + neighbor->skin;
  std::vector<std::pair<int, int>> pairs;
  for (int n = 0; n < list.inum; ++n) {
    const int i = list.ilist[n];
    const std::size_t before = pairs.size();
    for (int k = 0; k < list.numneigh[i]; ++k) {
      const int j = list.firstneigh[i][k] & NEIGHMASK;
      const double apart = std::hypot(atom->x[j][0] - atom->x[i][0], atom->x[j][1] - atom->x[i][1]);
      if (apart - (atom->radius[i] + atom->radius[j]) <= known && !bonded(i, j)) pairs.emplace_back(i, j);
    }
    // In an order that does not depend on where the list was made: runs in pieces have the bits of one.
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(before), pairs.end(), [this](const auto& a, const auto& b) { return atom->tag[a.second] < atom->tag[b.second]; });
  }
  const std::size_t count = pairs.size();
  contacts_.stride = 1;
  contacts_.bond.resize(count), contacts_.k_n.resize(count), contacts_.k_t.assign(count, 0.0), contacts_.start_gap.resize(count);
  contacts_.first.assign(static_cast<std::size_t>(atom->nlocal) + 1, 0);
  for (const auto& [i, j] : pairs) ++contacts_.first[static_cast<std::size_t>(i) + 1];
  for (std::size_t i = 1; i < contacts_.first.size(); ++i) contacts_.first[i] += contacts_.first[i - 1];
  std::vector<int> next(contacts_.first.begin(), contacts_.first.end());
  for (const auto& [i, j] : pairs) set_contact(static_cast<std::size_t>(next[static_cast<std::size_t>(i)]++), i, j);
  begin_watch();
}

/// Which image of j it is says its place now; the reference has the same one, without the displacements since. Discs that overlap
/// in the reference are taken to touch there.
void FixDdem::set_contact(std::size_t at, int i, int j) {
  double d[2];
  for (int c = 0; c < 2; ++c) {
    d[c] = reference_[j][c] - reference_[i][c];
    const double without = (atom->x[j][c] - atom->x[i][c]) - (disc_[j][c] - disc_[i][c]), period = domain->prd[c];
    if (domain->periodicity[c] != 0) d[c] += period * std::round((without - d[c]) / period);
  }
  const double length = std::hypot(d[0], d[1]), r_i = atom->radius[i], r_j = atom->radius[j], stretch = length / (r_i + r_j);
  contacts_.bond[at] = {d[0] / length, d[1] / length, r_i * stretch, r_j * stretch, j};
  contacts_.k_n[at] = pair_->normal_stiffness(atom->type[i], atom->type[j], r_i, r_j);
  contacts_.start_gap[at] = length - std::min(r_i + r_j, length);
}

/// The displacements now, the narrowest gap of rigid discs, the smallest radius, and the longest arm over its radius.
void FixDdem::begin_watch() {
  const std::size_t discs = static_cast<std::size_t>(atom->nlocal) + static_cast<std::size_t>(atom->nghost);
  watched_from_.resize(2 * discs);
  for (std::size_t i = 0; i < discs; ++i) std::copy_n(disc_[i], 2, watched_from_.data() + 2 * i);
  narrowest_ = HUGE_VAL, longest_arm_ = 1.0;
  smallest_radius_ = discs == 0 ? 0.0 : *std::min_element(atom->radius, atom->radius + discs);
  LoopLaw rigid = contact_law_;
  rigid.strained = false;
  const double grows = nonlinear() ? pair_->reach() + neighbor->skin : 0.0;  // at most, while the list is good
  for (int i = 0; i < contacts_.discs(); ++i) {
    for (int b = contacts_.first[static_cast<std::size_t>(i)]; b < contacts_.first[static_cast<std::size_t>(i) + 1]; ++b) {
      const Overlap o = overlap_of(rigid, contacts_, discs_of_contacts(), i, b);
      narrowest_ = std::min(narrowest_, o.u_n);
      longest_arm_ = std::max(longest_arm_, (o.arm_i + grows) / atom->radius[i]);
    }
  }
}

/// Whether a pair may have closed. n.(a eps).n is at most the arm times the norm of eps. A pair in no list was further apart than
/// r_i + r_j and what is known, and is nearer by what both have moved since. In linear kinematics its gap is that along n of the
/// reference, which sees nothing of what one has moved past the other, at most the displacements of both: the hypotenuse.
bool FixDdem::may_touch() const {
  const int discs = atom->nlocal + atom->nghost, columns = size_peratom_cols;
  const double *row = discs == 0 ? nullptr : disc_[0], *from = watched_from_.data();
  double moved = 0.0, displaced = 0.0, strained_by = 0.0;  // squares
  const auto raise = [](double& most, double value) {
    if (!(value <= most)) most = value;  // what is no number stays
  };
  for (int i = 0; i < discs; ++i, row += columns, from += 2) {
    const double dx = row[kUx] - from[0], dy = row[kUy] - from[1];
    raise(moved, dx * dx + dy * dy);
    raise(displaced, row[kUx] * row[kUx] + row[kUy] * row[kUy]);
    if (!strained()) continue;
    const double *e = row + kStrain, r = atom->radius[i];
    raise(strained_by, r * r * (e[0] * e[0] + e[1] * e[1] + 2.0 * e[2] * e[2]));
  }
  const double nearer = 2.0 * std::sqrt(moved), grown = 2.0 * longest_arm_ * std::sqrt(strained_by);
  const double aside = nonlinear() ? 0.0 : 2.0 * std::sqrt(displaced), touching = 2.0 * smallest_radius_;
  if (std::hypot(touching + grown, aside) > touching + pair_->reach() + neighbor->skin - nearer)
    error->one(FLERR, "pair_style ddem: discs that are in no list of neighbours may touch: renew the lists more often (neigh_modify delay 0 every 1 "
                      "check yes), or let the skin be wider or, where strains or displacements are large, the reach"s);
  return !(nearer + grown < narrowest_);
}

Discs FixDdem::discs_of_contacts() { return discs_shared(force->newton_pair != 0); }

void FixDdem::add_contact_forces(double* force_of_all, double* torque_of_all) {
  if (may_touch()) add_forces(contact_law_, contacts_, discs_of_contacts(), {force_of_all, torque_of_all});
}

void FixDdem::add_contact_stresses() {
  if (pair_ != nullptr && may_touch()) add_stresses(contact_law_, false, contacts_, discs_of_contacts());
}

}  // namespace ddem::lammps
