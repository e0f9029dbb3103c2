// ddem: the command line.

#include <malloc.h>

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "harness/cli/commands.h"
#include "harness/io/errors.h"
#include "harness/provenance/provenance.h"

namespace {

using namespace ddem::harness;

constexpr const char* kFooter = R"(Examples:
  ddem validate                          the strip of the paper: DEM, DDEM, finite elements; writes ddem-report/
  ddem run scene.toml --json             one simulation, its wave speed as JSON
  ddem moduli scene.toml                 static moduli and wave speeds of its assembly
  ddem stability scene.toml              its critical step, limits and numerical damping
  ddem calibrate --young "30 GPa" --poisson 0.25 --density 2400
                                         contact parameters that give these moduli
  ddem fem scene.toml --signals s.csv    the continuum model of the same strip

Exit codes: 0 done, within tolerance; 1 a verdict failed, or a target is out of reach; 2 wrong use or input;
            3 a solver failed (unstable, no convergence); 4 the machine failed (disk, missing tool).)";

int run(int argc, char** argv) {
  CLI::App app{"Deformable discrete elements (DDEM) against continuum references: simulation, moduli, validation."};
  app.name("ddem");
  app.require_subcommand(1);
  app.footer(kFooter);
  app.set_version_flag("--version", version_text());
  Action action;
  add_validate_command(app, action);
  add_merge_command(app, action);
  add_baseline_command(app, action);
  add_compare_command(app, action);
  add_history_command(app, action);
  add_run_command(app, action);
  add_fem_command(app, action);
  add_moduli_command(app, action);
  add_stability_command(app, action);
  add_pack_command(app, action);
  add_calibrate_command(app, action);
  add_bench_command(app, action);
  add_report_command(app, action);
  add_scene_reference_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? 0 : static_cast<int>(ExitCode::wrong_input);
  }
  return action();
}

/// A campaign makes and drops matrices of some megabytes thousands of times. The C library would give their pages back to
/// the system every time and have them zeroed again: a tenth of the time of a static solve.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  try {
    const int code = run(argc, argv);
    // Data that did not reach standard output must not look like success.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw MachineError("standard output could not be written");
    }
    return code;
  } catch (const std::exception& e) {
    fmt::print(stderr, "ddem: {}\n", e.what());
    return static_cast<int>(exit_code_of(e));
  }
}
