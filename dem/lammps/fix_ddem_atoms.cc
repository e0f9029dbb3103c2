// What fix ddem keeps of discs: storage, migration, restart files, ghosts.
#include <lammps/atom.h>
#include <lammps/comm.h>
#include <lammps/memory.h>

#include <algorithm>

#include "dem/lammps/fix_ddem.h"
#include "dem/lammps/lammps_api.h"

namespace ddem::lammps {

void FixDdem::grow_arrays(int discs) {
  memory->grow(disc_, discs, size_peratom_cols, "ddem:disc");
  memory->grow(reference_, discs, 2, "ddem:reference");
  array_atom = disc_;
  if (!nonlinear()) return;
  memory->grow(previous_, discs, 3, "ddem:previous");
  memory->grow(slip_, discs, std::max(atom->bond_per_atom, 1), "ddem:slip");
}

/// Motion, strain, and reference; slip and the motion before.
int FixDdem::values_of_disc() const { return size_peratom_cols + 2 + (nonlinear() ? 3 + atom->bond_per_atom : 0); }

int FixDdem::pack(int i, double* to) const {
  double* next = std::copy_n(disc_[i], size_peratom_cols, to);
  next = std::copy_n(reference_[i], 2, next);
  if (nonlinear()) {
    next = std::copy_n(previous_[i], 3, next);
    next = std::copy_n(slip_[i], atom->bond_per_atom, next);
  }
  return static_cast<int>(next - to);
}

int FixDdem::unpack(int i, const double* from) {
  const double* next = from;
  const auto take = [&next](double* values, int count) {
    std::copy_n(next, count, values);
    next += count;
  };
  take(disc_[i], size_peratom_cols);
  take(reference_[i], 2);
  if (nonlinear()) {
    take(previous_[i], 3);
    take(slip_[i], atom->bond_per_atom);
  }
  return static_cast<int>(next - from);
}

void FixDdem::copy_arrays(int from, int to, int) {
  std::vector<double> values(static_cast<std::size_t>(values_of_disc()));
  pack(from, values.data());
  unpack(to, values.data());
}

/// A disc that is new is where it belongs.
void FixDdem::set_arrays(int i) {
  std::fill_n(disc_[i], size_peratom_cols, 0.0);
  std::copy_n(atom->x[i], 2, reference_[i]);
  if (!nonlinear()) return;
  std::fill_n(previous_[i], 3, 0.0);
  std::fill_n(slip_[i], atom->bond_per_atom, 0.0);
}

int FixDdem::pack_exchange(int i, double* to) { return pack(i, to); }
int FixDdem::unpack_exchange(int i, double* from) { return unpack(i, from); }

void FixDdem::write_restart(std::FILE* file) {
  keep_slip();  // within a run; all ranks come here before they pack their discs
  if (comm->me != 0) return;
  const int size = sizeof(double);
  const double begun = begun_ ? 1.0 : 0.0;
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(&begun, sizeof begun, 1, file);
}

void FixDdem::restart(char* from) { begun_ = displaced_ = *reinterpret_cast<double*>(from) != 0.0; }

int FixDdem::maxsize_restart() { return values_of_disc() + 1; }
int FixDdem::size_restart(int) { return values_of_disc() + 1; }

int FixDdem::pack_restart(int i, double* to) {
  to[0] = values_of_disc() + 1;
  return pack(i, to + 1) + 1;
}

/// What several fixes left stands one after the other, each with its length.
void FixDdem::unpack_restart(int i, int nth) {
  const double* next = atom->extra[i];
  for (int k = 0; k < nth; ++k) next += static_cast<int>(*next);
  unpack(i, next + 1);
}

void FixDdem::send(Sent what) {
  sent_ = what;
  to_ghosts(comm, this, values_sent());
}

int FixDdem::values_sent() const {
  switch (sent_) {
    case Sent::reference: return 2;
    case Sent::strain: return 3;
    case Sent::motion: return nonlinear() ? 6 : 3;
    case Sent::all: return (strained() ? 6 : 3) + (nonlinear() ? 3 : 0);
  }
  return 0;
}

/// Columns of disc_ that are sent.
std::pair<int, int> FixDdem::columns_sent() const {
  if (sent_ == Sent::reference) return {0, 0};
  if (sent_ == Sent::strain) return {kStrain, 3};
  return {0, sent_ == Sent::all && strained() ? 6 : 3};
}

int FixDdem::pack_forward_comm(int count, int* list, double* to, int, int*) {
  const auto [first_column, columns] = columns_sent();
  double* next = to;
  for (int k = 0; k < count; ++k) {
    if (sent_ == Sent::reference) next = std::copy_n(reference_[list[k]], 2, next);
    next = std::copy_n(disc_[list[k]] + first_column, columns, next);
    if (nonlinear() && (sent_ == Sent::motion || sent_ == Sent::all)) next = std::copy_n(previous_[list[k]], 3, next);
  }
  return static_cast<int>(next - to);
}

void FixDdem::unpack_forward_comm(int count, int first, double* from) {
  const auto [first_column, columns] = columns_sent();
  const double* next = from;
  const auto take = [&next](double* values, int many) {
    std::copy_n(next, many, values);
    next += many;
  };
  for (int i = first; i < first + count; ++i) {
    if (sent_ == Sent::reference) take(reference_[i], 2);
    take(disc_[i] + first_column, columns);
    if (nonlinear() && (sent_ == Sent::motion || sent_ == Sent::all)) take(previous_[i], 3);
  }
}

int FixDdem::pack_reverse_comm(int count, int first, double* to) {
  double* next = to;
  for (int i = first; i < first + count; ++i) next = std::copy_n(disc_[i] + kStress, 3, next);
  return static_cast<int>(next - to);
}

void FixDdem::unpack_reverse_comm(int count, int* list, double* from) {
  const double* next = from;
  for (int k = 0; k < count; ++k) {
    for (int c = 0; c < 3; ++c) disc_[list[k]][kStress + c] += *next++;
  }
}

}  // namespace ddem::lammps
