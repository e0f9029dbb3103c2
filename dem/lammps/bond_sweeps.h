#pragma once
// The one loop over the bonds of a rank, and over its contacts without bonds, compiled once for each instruction set (bond_sweeps.cc, CMakeLists.txt) and chosen at
// run time (bond_loop.cc). No vectors here: an inline function of theirs, compiled for one set, could be called on a machine
// that lacks it.

#include "dem/core/material.h"

namespace ddem::lammps {

struct BondGeometry;

/// Bonds of disc i: bond[first[i]] to bond[first[i + 1]].
struct RowsView {
  int discs = 0;
  const int* first = nullptr;
  const BondGeometry* bond = nullptr;
  const double *k_n = nullptr, *k_t = nullptr;  ///< stride numbers apart; 0: the same for all
  int stride = 0;
  double* slip = nullptr;             ///< bonds in nonlinear kinematics alone
  const double* start_gap = nullptr;  ///< contacts alone: gap of the reference, m
};

/// Rows of all discs of the rank and of its ghosts.
struct Discs {
  double* row = nullptr;             ///< of `columns` numbers (Column)
  int columns = 0;
  const double* previous = nullptr;  ///< motion at the step before, rows of 3: nonlinear kinematics alone
  int writable = 0;                  ///< discs below it are given their part of a bond; others are another rank's to sum
};

/// Where forces and moments are added: rows of 3, as LAMMPS has them.
struct Loads {
  double* force = nullptr;
  double* torque = nullptr;
};

/// What the rows are.
enum class Pairs {
  bonds,
  contacts  ///< discs that are not bonded: gap = start_gap + u_n; they press where it is negative, and never pull or rub
};

struct LoopLaw {
  Pairs pairs = Pairs::bonds;
  Kinematics kinematics = Kinematics::linear;
  bool strained = false;
  Correction correction = Correction::normal;
};

using AddForces = void (*)(const LoopLaw&, const RowsView&, const Discs&, const Loads&);
using AddStresses = void (*)(const LoopLaw&, bool from_rest, const RowsView&, const Discs&);

namespace baseline {
void add_forces(const LoopLaw& law, const RowsView& rows, const Discs& discs, const Loads& loads);
void add_stresses(const LoopLaw& law, bool from_rest, const RowsView& rows, const Discs& discs);
}  // namespace baseline
namespace avx2 {
void add_forces(const LoopLaw& law, const RowsView& rows, const Discs& discs, const Loads& loads);
void add_stresses(const LoopLaw& law, bool from_rest, const RowsView& rows, const Discs& discs);
}  // namespace avx2

}  // namespace ddem::lammps
