// Commands of the interface that are still to be built.
#include <memory>

#include "harness/cli/commands.h"
#include "harness/io/errors.h"

namespace ddem::harness {

void add_commands_to_come(CLI::App& app, Action& action) {
  for (const auto& [name, what] : {std::pair{"calibrate", "Contact parameters for target moduli"}}) {
    CLI::App* command = app.add_subcommand(name, std::string(what) + " (not built yet)");
    command->allow_extras();
    command->callback([name = std::string(name), &action] {
      action = [name]() -> int { throw InputError("ddem " + name + ": not built yet"); };
    });
  }
}

}  // namespace ddem::harness
