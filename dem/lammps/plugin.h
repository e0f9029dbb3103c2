#pragma once
// What LAMMPS' command `plugin load` and a module say to each other: the layout of its C interface, which packages of LAMMPS leave
// out of their headers (manual of LAMMPS, "Writing plugins").

namespace ddem::lammps {

struct Plugin {
  const char* version;  ///< of LAMMPS, as it names itself
  const char* style;    ///< "pair", "bond", "fix" ...
  const char* name;
  const char* info;
  const char* author;
  union {
    void* (*plain)(void* lammps);                                   ///< pair, bond
    void* (*with_words)(void* lammps, int count, char** words);  ///< fix
  } maker;
  void* handle;  ///< of the module
};

/// The third argument of lammpsplugin_init(lammps, handle, registers); it copies the plugin.
using RegisterPlugin = void (*)(Plugin* plugin, void* lammps);

}  // namespace ddem::lammps
