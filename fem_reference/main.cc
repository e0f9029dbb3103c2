// ddem-fem: many cases of the continuum strip in one process, case file in, signals file out.

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <thread>

#include "fem_reference/cases.h"
#include "fem_reference/run_case.h"
#include "fem_reference/signals_file.h"
#include "fem_reference/strip_model.h"

namespace {

using namespace ddem::fem;

enum Exit { done = 0, wrong_input = 2, solver_failed = 3, machine_failed = 4 };

const std::string version =
    fmt::format("ddem-fem {} (GCC {}, deal.II {})", DDEM_VERSION, __VERSION__, DEAL_II_PACKAGE_VERSION);

struct Arguments {
  std::string cases, output;
  bool progress = false;
  int threads = 1;
};

// Of several processes, which all come to the same conclusions, the first one speaks and writes.
bool is_first = true;

// Whether anyone hears it or not.
void say(const std::string& line) {
  std::fputs((line + '\n').c_str(), stderr);
}

int complain(Exit code, const std::string& message) {
  if (is_first) say("ddem-fem: " + message);
  return code;
}

// What is closed would be the number of the next file that is opened, which messages would then go into. Writing more than
// a limit allows, or to nobody, is an error to be seen, not the end of the process.
void prepare_streams() {
  int descriptor = 0;
  while (descriptor >= 0 && descriptor <= 2) descriptor = ::open("/dev/null", O_RDWR);
  if (descriptor > 2) ::close(descriptor);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

// A failed solution is a status of its case; the other cases still run.
CaseResult solve(const StripCase& strip, const StripModel& model, ddem::Team& team) {
  try {
    return run_case(strip, model, team);
  } catch (const std::runtime_error& error) {
    CaseResult failed;
    failed.status = fmt::format("failed: {}", error.what());
    return failed;
  }
}

int run(const std::vector<StripCase>& cases, const Arguments& arguments) {
  std::optional<SignalsFile> signals;
  if (is_first) signals.emplace(arguments.output, version);
  StripModeller modeller;
  modeller.read_meshes(cases);
  ddem::Team team(arguments.threads);
  bool all_ok = true;
  for (const StripCase& strip : cases) {
    const StripModel model = modeller.model(strip);
    const CaseResult result = solve(strip, model, team);
    if (!result.ok()) complain(solver_failed, fmt::format("case \"{}\": {}", strip.id, result.status));
    all_ok = all_ok && result.ok();
    if (!is_first) continue;
    signals->write(strip, result);
    if (arguments.progress) say("done " + strip.id);
  }
  if (is_first) signals->commit();
  return all_ok ? done : solver_failed;
}

int run_with_libraries(const std::vector<StripCase>& cases, const Arguments& arguments, char* program) {
  // A process of its own needs no daemon of Open MPI, which costs 0.1 s at the start; mpirun sets the rank.
  // Nor does it need a fabric: looking for one (the choice of a "pml" other than ob1) waits for 0.2 s, and shared memory
  // leaves a file in /dev/shm.
  if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr) {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_btl", "self", 0);
  }
  // Its name alone: deal.II hands all words on to libraries that have options of their own (Kokkos: --threads).
  char* words[] = {program, nullptr};
  int count = 1;
  char** argv = words;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(count, argv, 1);
  is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  int code = done;
  try {
    return run(cases, arguments);
  } catch (const std::invalid_argument& error) {  // CaseError
    code = complain(wrong_input, error.what());
  } catch (const dealii::ExceptionBase& error) {
    code = complain(machine_failed, std::string("deal.II failed: ") + error.get_exc_name());
  } catch (const std::bad_alloc&) {
    code = complain(machine_failed, "not enough memory: take fewer elements, or a lower degree");
  } catch (const std::exception& error) {  // disk, gmsh
    code = complain(machine_failed, error.what());
  }
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1) {
    // The others may be waiting for this one. Mostly all of them come here: the first one speaks before it is ended.
    if (!is_first) std::this_thread::sleep_for(std::chrono::seconds(2));
    MPI_Abort(MPI_COMM_WORLD, code);
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  prepare_streams();
  Arguments arguments;
  CLI::App app("Continuum reference of the strip: explicit plane elastodynamics on spectral elements.",
               "ddem-fem");
  app.add_option("CASES.json", arguments.cases, "what to solve: {\"schema\": 1, \"cases\": [...]}, SI units")
      ->required();
  app.add_option("-o", arguments.output, "signals file (HDF5), one group a case")->required();
  app.add_flag("--progress", arguments.progress,
               "print \"done ID\" for each finished case to standard error");
  app.add_option("--threads", arguments.threads, "the same bits for any number")->check(CLI::Range(1, 1024));
  app.set_version_flag("--version", version);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = app.exit(error) == 0;
    return !std::cout.flush() ? machine_failed : asked ? done : wrong_input;
  }
  std::vector<StripCase> cases;
  try {
    cases = read_cases(arguments.cases);
  } catch (const CaseError& error) {
    return complain(wrong_input, fmt::format("{}:\n{}", arguments.cases, error.what()));
  }
  try {
    check_replaceable(arguments.output);
  } catch (const CaseError& error) {
    return complain(wrong_input, error.what());
  }
  return run_with_libraries(cases, arguments, argv[0]);
}
