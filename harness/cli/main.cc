// ddem: the command line.

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "harness/cli/commands.h"
#include "harness/cli/print_json.h"
#include "harness/cli/usage.h"
#include "harness/io/errors.h"
#include "harness/io/leftovers.h"
#include "harness/io/memory.h"
#include "harness/io/message.h"
#include "harness/io/streams.h"
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
  ddem measure shots.csv --distance "10 mm"
                                         wave speeds from signals of a laboratory

Example scenes and campaigns, and the guide, are in harness/ of the checkout, or of share/ddem where ddem is installed.

Exit codes: 0 done, within tolerance; 1 a verdict failed, or a target is out of reach; 2 wrong use or input;
            3 a solver failed (unstable, no convergence); 4 the machine failed (disk, missing tool).)";

/// Also where the rest of the command line is wrong.
bool asks_for_json(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](const char* argument) { return std::string_view(argument) == "--json"; });
}

/// What ended the program, for people and where it was asked for as JSON.
int failed(const std::exception& e, bool as_json) {
  const ExitCode code = exit_code_of(e);
  const bool lost_output = dynamic_cast<const std::system_error*>(&e) != nullptr && std::ferror(stdout) != 0;
  message("ddem: {}{}", lost_output ? "standard output: " : "", e.what());
  try {
    if (as_json) print_json_failure(code, messages_of(e));
    finish_standard_output();
  } catch (const std::exception&) {  // standard output may be what failed
  }
  return static_cast<int>(code);
}

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
  add_export_command(app, action);
  add_measure_command(app, action);
  add_fem_command(app, action);
  add_moduli_command(app, action);
  add_stability_command(app, action);
  add_pack_command(app, action);
  add_calibrate_command(app, action);
  add_bench_command(app, action);
  add_report_command(app, action);
  add_scene_reference_command(app, action);
  add_completion_command(app, action);
  refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (const std::string slip = e.get_exit_code() == 0 ? "" : explain_slip(app, argc, argv); !slip.empty()) throw InputError(slip);
    if (app.exit(e) == 0) return 0;
    if (asks_for_json(argc, argv)) print_json_failure(ExitCode::wrong_input, {e.what()});
    return static_cast<int>(ExitCode::wrong_input);
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
  prepare_streams();
  clean_up_on_signals();
  keep_freed_memory();
  try {
    const int code = run(argc, argv);
    finish_standard_output();  // data that did not get there must not look like success
    return code;
  } catch (const std::bad_alloc&) {
    return failed(MachineError(fmt::format("out of memory: {} are left; take fewer discs, samples, snapshots or jobs", bytes_text(available_memory()))),
                  asks_for_json(argc, argv));
  } catch (const std::exception& e) {
    return failed(e, asks_for_json(argc, argv));
  }
}
