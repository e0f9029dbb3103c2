// ddem-lammps: LAMMPS with bond_style ddem, pair_style ddem and fix ddem, and the command line of lmp.
#define LAMMPS_LIB_MPI  // lammps_open() with a communicator
#include <lammps/input.h>
#include <lammps/lammps.h>
#include <lammps/library.h>
#include <mpi.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "dem/lammps/styles.h"

namespace {

constexpr int kRefused = 4;  // as ddem: the machine lacks something

LAMMPS_NS::LAMMPS* open(int argc, char** argv) { return static_cast<LAMMPS_NS::LAMMPS*>(lammps_open(argc, argv, MPI_COMM_WORLD, nullptr)); }

int print_version(char** argv) {
  std::string words[] = {argv[0], "-screen", "none", "-log", "none"};
  std::vector<char*> quiet;
  for (std::string& word : words) quiet.push_back(word.data());
  auto* lmp = open(static_cast<int>(quiet.size()), quiet.data());
  std::printf("ddem-lammps %s, LAMMPS %d\n", DDEM_VERSION, ddem::lammps::running_version(lmp));
  lammps_close(lmp);
  return 0;
}

int run(int argc, char** argv) {
  auto* lmp = open(argc, argv);
  const int running = ddem::lammps::running_version(lmp), compiled = ddem::lammps::compiled_version();
  if (running != compiled) {
    std::fprintf(stderr, "ddem-lammps: built for LAMMPS %d, and this library is %d, whose classes are others: build ddem-lammps anew, with its headers\n",
                 compiled, running);
    lammps_close(lmp);
    return kRefused;
  }
  ddem::lammps::add_styles(lmp);
  lmp->input->file();
  lammps_close(lmp);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int code = 1;
  try {
    code = argc == 2 && std::strcmp(argv[1], "--version") == 0 ? print_version(argv) : run(argc, argv);
  } catch (const std::exception& e) {  // where LAMMPS was built with exceptions
    std::fprintf(stderr, "%s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return code;
}
