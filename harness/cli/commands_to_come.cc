// Commands of the interface that are still to be built.

#include "harness/cli/commands.h"
#include "harness/io/errors.h"

namespace ddem::harness {

void add_commands_to_come(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("compare", "Compare a campaign with a baseline (not built yet)");
  command->allow_extras();
  command->callback([&action] {
    action = []() -> int { throw InputError("ddem compare: not built yet"); };
  });
}

}  // namespace ddem::harness
