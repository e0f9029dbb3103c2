#pragma once
// fix ddem: displacement and rotation of discs since the reference, their strains, and their motion.
//
// A step, with x, v, omega, f and torque where LAMMPS keeps them:
//   initial_integrate   v(n+1/2) = v(n) + dt/2 F(n)/m,  u(n+1) = u(n) + dt v(n+1/2); lagged strains take what F(n) left
//   pre_force           u, theta, eps to ghosts; the passes of implicit strains
//   pair_style ddem, bond_style ddem   F(n+1), and the sums s (x) F of every disc
//   final_integrate     v(n+1) = v(n+1/2) + dt/2 F(n+1)/m
// That is leapfrog, with velocities at whole steps between them. Forces at the setup of a run leave strains and slip as they
// are, so that a run in pieces is one run.

#include <lammps/fix.h>

#include <cstdio>
#include <utility>
#include <vector>

#include "dem/lammps/bond_loop.h"
#include "dem/lammps/fix_options.h"

namespace ddem::lammps {

class BondDdem;
class PairDdem;

class FixDdem : public LAMMPS_NS::Fix {
 public:
  FixDdem(LAMMPS_NS::LAMMPS* l, int count, char** words);
  ~FixDdem() override;
  /// The one that there is, or none.
  static FixDdem* of(LAMMPS_NS::LAMMPS* l);

  // For bond_style ddem and pair_style ddem.
  const BondRows& rows() const { return rows_; }
  const LoopLaw& law() const { return law_; }
  Discs discs();
  void add_bond_forces(double* force_of_all, double* torque_of_all);
  const BondRows& contacts() const { return contacts_; }
  const LoopLaw& contact_law() const { return contact_law_; }
  Discs discs_of_contacts();
  void add_contact_forces(double* force_of_all, double* torque_of_all);

  // What LAMMPS calls.
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_post_neighbor() override;
  void setup_pre_force(int vflag) override;
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void pre_exchange() override;
  void post_neighbor() override;
  void pre_force(int vflag) override;
  void post_force(int vflag) override;
  void final_integrate() override;
  void reset_dt() override;
  void post_run() override;

  double compute_scalar() override;
  double compute_vector(int n) override;
  double memory_usage() override;

  void grow_arrays(int discs) override;
  void copy_arrays(int from, int to, int deleted) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* to) override;
  int unpack_exchange(int i, double* from) override;
  void write_restart(std::FILE* file) override;
  void restart(char* from) override;
  int pack_restart(int i, double* to) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  int pack_forward_comm(int count, int* list, double* to, int, int*) override;
  void unpack_forward_comm(int count, int first, double* from) override;
  int pack_reverse_comm(int count, int first, double* to) override;
  void unpack_reverse_comm(int count, int* list, double* from) override;

 private:
  enum class Sent { reference, motion, strain, all };

  bool strained() const { return law_.strained; }
  bool nonlinear() const { return law_.kinematics == Kinematics::nonlinear; }
  bool holds(int i, int which) const;
  int values_of_disc() const;  ///< that migrate and are restarted
  int pack(int i, double* to) const;
  int unpack(int i, const double* from);

  void take_reference();
  void build_rows();
  void set_row(int b, int i, int j, int type);
  void keep_slip();
  int slot_of(int i, LAMMPS_NS::tagint other) const;
  // Discs that are not bonded, fix_ddem_contacts.cc.
  bool bonded(int i, int j) const;
  void build_contacts();
  void set_contact(std::size_t at, int i, int j);
  void begin_watch();
  bool may_touch() const;
  void add_contact_stresses();
  Discs discs_shared(bool newton);

  void send(Sent what);
  int values_sent() const;
  std::pair<int, int> columns_sent() const;
  void remember_motion();
  void impose_drive(LAMMPS_NS::bigint step);
  void prepare_discs();
  template <bool kDrift>
  void kick();
  void follow();

  void clear_stress(int from, int to);
  void clear_ghosts();
  void collect_stress();
  void advance_strains(double weight);
  void strain_passes();
  double kinetic_energy(bool turning) const;
  double strain_energy() const;

  FixOptions options_;
  BondDdem* bonds_ = nullptr;
  LoopLaw law_;
  Compliance compliance_;
  BondRows rows_;
  bool rows_hold_ = false;  ///< their indices are those of LAMMPS' arrays now
  // Where there is a pair_style ddem.
  PairDdem* pair_ = nullptr;
  LoopLaw contact_law_;
  BondRows contacts_;
  std::vector<double> watched_from_;                  // displacements when the list was made, x and y a disc, of ghosts as well
  double narrowest_ = 0.0, longest_arm_ = 1.0;        // gap of rigid discs then; arm over radius
  double smallest_radius_ = 0.0;
  struct OfDisc {
    double kick_x, kick_y, kick_theta;  ///< half a step over mass, inertia
    double over_volume;                 ///< 1/V
  };
  std::vector<OfDisc> of_disc_;  ///< made with the rows
  double half_step_ = 0.0, step_ = 0.0;
  Sent sent_ = Sent::motion;
  bool displaced_ = false;  ///< discs stand where their displacements say
  bool begun_ = false;      ///< forces have been found

  double** disc_ = nullptr;       ///< rows of Column: the per-atom output
  double** reference_ = nullptr;  ///< x, y
  double** previous_ = nullptr;   ///< ux, uy, theta at the step before (nonlinear)
  double** slip_ = nullptr;       ///< of a disc's bonds, in the order of bond_atom (nonlinear)
};

}  // namespace ddem::lammps
