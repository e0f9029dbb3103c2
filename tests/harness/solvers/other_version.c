/* Loaded before LAMMPS: a library of another version, as far as it says. */
int lammps_version(void* handle) {
  (void)handle;
  return 20300101;
}
