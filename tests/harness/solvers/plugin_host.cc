// plugin_host MODULE [words of lmp]: a LAMMPS that takes styles as its command `plugin load` does, which the library here may lack.
// Prints what the module registers, then runs the script.
#include <dlfcn.h>
#include <mpi.h>

#include <lammps/force.h>
#include <lammps/input.h>
#include <lammps/lammps.h>
#define LAMMPS_LIB_MPI
#include <lammps/library.h>
#include <lammps/modify.h>

#include <cstdio>
#include <cstring>
#include <string>

namespace {

/// LAMMPS' own declarations, written anew: the module must keep to these.
using Factory1 = void* (*)(void*);
using Factory2 = void* (*)(void*, int, char**);
struct Registered {
  const char *version, *style, *name, *info, *author;
  union {
    Factory1 v1;
    Factory2 v2;
  } creator;
  void* handle;
};
using Initialise = void (*)(void*, void*, void*);

void* g_handle = nullptr;

void take(Registered* plugin, void* pointer) {
  auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(pointer);
  const bool same = std::strcmp(plugin->version, lmp->version) == 0 && plugin->handle == g_handle;
  std::printf("registered: %s %s%s, %s, by %s\n", plugin->style, plugin->name, same ? "" : " of another version or module", plugin->info, plugin->author);
  const std::string style = plugin->style, name = plugin->name;
  if (style == "pair") (*lmp->force->pair_map)[name] = reinterpret_cast<LAMMPS_NS::Force::PairCreator>(plugin->creator.v1);
  else if (style == "bond") (*lmp->force->bond_map)[name] = reinterpret_cast<LAMMPS_NS::Force::BondCreator>(plugin->creator.v1);
  else if (style == "fix") (*lmp->modify->fix_map)[name] = reinterpret_cast<LAMMPS_NS::Modify::FixCreator>(plugin->creator.v2);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  g_handle = argc > 1 ? dlopen(argv[1], RTLD_NOW | RTLD_GLOBAL) : nullptr;
  void* initialise = g_handle == nullptr ? nullptr : dlsym(g_handle, "lammpsplugin_init");
  if (initialise == nullptr) {
    std::fprintf(stderr, "%s\n", dlerror());
    MPI_Abort(MPI_COMM_WORLD, 1);
    return 1;
  }
  auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(lammps_open(argc - 1, argv + 1, MPI_COMM_WORLD, nullptr));
  reinterpret_cast<Initialise>(initialise)(lmp, g_handle, reinterpret_cast<void*>(&take));
  std::fflush(stdout);
  lmp->input->file();
  lammps_close(lmp);
  MPI_Finalize();
  return 0;
}
