#pragma once
// The linear mechanics of an assembly as sparse matrices (theory section 1), shared by the static solves and
// by the spectra. Not used in the time loop.
//
//   rigid overlaps   e = C q          q = (u_x, u_y, r theta) per disc, r the mean radius; without rotations
//                                     (lambda = 0) q = (u_x, u_y)
//   overlaps         w = e - G eps    eps = (xx, yy, xy) per disc, tensor components times r
//   bond forces      F = K w
//   strains          V_p C_p eps = S F
//
// S = G^T for the corrections F and NN (they derive from an energy); for N, S also takes the tangential forces.
// Rotations and strains are scaled by the mean radius so that every entry of C, G and S is of order one.

#include <Eigen/SparseCore>
#include <array>
#include <optional>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"

namespace ddem {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// All but the large matrices, for who takes them bond by bond (bond_rows).
struct OperatorFrame {
  int dofs_per_disc = 2;  ///< 2, or 3 with rotation
  int rows_per_bond = 1;  ///< 1 (normal), or 2 (normal, tangential)
  double length_scale = 0.0;
  Eigen::VectorXd stiffness;  ///< diagonal of K, N/m
  bool deformable = false;    ///< there are strains
  bool symmetric = true;      ///< S = G^T
};

struct Operators : OperatorFrame {
  SparseMatrix overlap;           ///< C: (rows_per_bond * bonds) x (dofs_per_disc * discs)
  Eigen::VectorXd inverse_mass;   ///< diagonal of M^-1 for q
  SparseMatrix strain_overlap;    ///< G: (rows) x (3 * discs); empty without deformation
  SparseMatrix stress;            ///< S: (3 * discs) x (rows)
  SparseMatrix strain_stiffness;  ///< V_p C_p, block diagonal, 3 x 3 a disc

  SparseMatrix stiffness_matrix() const;  ///< C^T K C
};

/// The rows of one bond, normal and tangential, in C, G and S^T: what each of its discs i and j has in them.
struct BondRows {
  using Row = std::array<std::array<double, 3>, 2>;
  std::array<Row, 2> overlap, strain, stress;
};
BondRows bond_rows(const Bonds& bonds, std::size_t c, double length_scale, const DeformationParameters& deformation);

OperatorFrame operator_frame(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation);

Operators make_operators(const Assembly& assembly, const ContactParameters& contact,
                         const DeformationParameters& deformation);

/// Plane strain components of a macroscopic deformation; the shear is the engineering one.
struct MacroStrain {
  double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Overlaps of the bonds when every centre moves by E . x: rows as in Operators::overlap.
Eigen::VectorXd affine_overlaps(const Assembly& assembly, const OperatorFrame& operators, const MacroStrain& strain);

/// C q.
Eigen::VectorXd rigid_overlaps(const Assembly& assembly, const OperatorFrame& operators, const Eigen::VectorXd& q);

}  // namespace ddem
