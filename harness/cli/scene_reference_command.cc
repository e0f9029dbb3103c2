// ddem scene-reference
#include <fmt/format.h>

#include "harness/cli/commands.h"
#include "harness/io/errors.h"
#include "harness/scene/reference.h"

namespace ddem::harness {

void add_scene_reference_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "scene-reference", "Every table and key of a scene file, with values and defaults, as Markdown");
  command->callback([&action] {
    action = [] {
      fmt::print("{}", scene_reference());
      return static_cast<int>(ExitCode::done);
    };
  });
}

}  // namespace ddem::harness
