#pragma once
// pair_style ddem: discs that are not bonded press against each other where their gap closes, because they move or deform
// (theory section 1); they never pull, and do not rub. Displacements and strains are those of fix ddem.

#include <lammps/pair.h>

#include <cstdio>
#include <vector>

namespace ddem::lammps {

class FixDdem;

class PairDdem : public LAMMPS_NS::Pair {
 public:
  explicit PairDdem(LAMMPS_NS::LAMMPS* l);
  ~PairDdem() override;
  /// The one that there is, also as a part of pair_style hybrid; or none.
  static PairDdem* of(LAMMPS_NS::LAMMPS* l);

  void settings(int count, char** words) override;
  void coeff(int count, char** words) override;
  void init_style() override;
  double init_one(int i, int j) override;
  void compute(int eflag, int vflag) override;
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj, double& force) override;
  void write_restart(std::FILE* file) override;
  void read_restart(std::FILE* file) override;
  void write_restart_settings(std::FILE* file) override;
  void read_restart_settings(std::FILE* file) override;

  /// k_n of two discs.
  double normal_stiffness(int type_i, int type_j, double r_i, double r_j) const;
  /// By how much strains may move two boundaries towards each other, m: pairs further apart are not known.
  double reach() const { return reach_; }

 private:
  struct Coefficient {
    double normal_stiffness = 0.0;  ///< k_n
    double modulus = 0.0;           ///< where positive: k_n = modulus 2 r_i r_j / (r_i + r_j)
  };

  void allocate();
  Coefficient& between(int i, int j) { return of_types_[static_cast<std::size_t>(i) * types_ + static_cast<std::size_t>(j)]; }

  double reach_ = 0.0;
  std::size_t types_ = 0;                // and one more: they count from 1
  std::vector<Coefficient> of_types_;
  std::vector<double> largest_radius_;   // of each type, on all ranks
  FixDdem* fix_ = nullptr;
};

}  // namespace ddem::lammps
