// libddem-lammps-styles.so: the styles for a LAMMPS that runs already, by `plugin load` where it has the package PLUGIN, or by its
// package PYTHON (ddem-styles.lammps).
#include <lammps/lammps.h>

#include <cstdio>

#include "dem/lammps/plugin.h"
#include "dem/lammps/styles.h"

namespace {

/// LAMMPS calls makers by these types, and casts what they return to the base class.
void* make_pair(void* lammps) { return ddem::lammps::make_pair(static_cast<LAMMPS_NS::LAMMPS*>(lammps)); }
void* make_bond(void* lammps) { return ddem::lammps::make_bond(static_cast<LAMMPS_NS::LAMMPS*>(lammps)); }
void* make_fix(void* lammps, int count, char** words) { return ddem::lammps::make_fix(static_cast<LAMMPS_NS::LAMMPS*>(lammps), count, words); }

}  // namespace

/// 0, or the version of LAMMPS that the styles were compiled for, where this one is another.
extern "C" int ddem_add_styles(void* lammps) {
  auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(lammps);
  if (ddem::lammps::running_version(lmp) != ddem::lammps::compiled_version()) return ddem::lammps::compiled_version();
  ddem::lammps::add_styles(lmp);
  return 0;
}

/// What `plugin load` calls. Another version of LAMMPS is given nothing, since its classes are others.
extern "C" void lammpsplugin_init(void* lammps, void* handle, void* registers) {
  auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(lammps);
  const int running = ddem::lammps::running_version(lmp), compiled = ddem::lammps::compiled_version();
  if (running != compiled) {
    std::fprintf(stderr, "the styles of ddem were built for LAMMPS %d, and this is %d: build them anew with its headers\n", compiled, running);
    return;
  }
  const auto add = [&](const char* style, const char* info, const auto& set_maker) {
    ddem::lammps::Plugin p{lmp->version, style, "ddem", info, "the ddem project", {}, handle};
    set_maker(p.maker);
    reinterpret_cast<ddem::lammps::RegisterPlugin>(registers)(&p, lammps);
  };
  add("bond", "bonds of deformable discs", [](auto& maker) { maker.plain = make_bond; });
  add("pair", "contacts of deformable discs that are not bonded", [](auto& maker) { maker.plain = make_pair; });
  add("fix", "motion and strains of deformable discs", [](auto& maker) { maker.with_words = make_fix; });
}
