#include "harness/cli/usage.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <vector>

#include "harness/scene/nearest_name.h"
#include "harness/scene/violation.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kShown = 80;

std::string guess(std::string_view written, const std::vector<std::string_view>& names) {
  const std::optional<std::string_view> nearest = nearest_name(written, names);
  return nearest ? fmt::format("did you mean {}?", *nearest) : fmt::format("there are {}", fmt::join(names, ", "));
}

std::string unknown(std::string_view what, std::string_view written, const std::vector<std::string>& names) {
  return fmt::format("{}: unknown {}; {}", printable(written, kShown), what, guess(written, std::vector<std::string_view>(names.begin(), names.end())));
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The command that the line came to, and the first word that is none of its commands; "" where there is none.
std::pair<const CLI::App*, std::string> follow(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = &app;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const std::vector<std::string> names = command_names(*command);
    if (names.empty()) break;
    if (word.starts_with('-')) continue;
    const auto next = command->get_subcommands([&word](const CLI::App* c) { return c->check_name(word); });
    if (next.empty()) return {command, word};
    command = next.front();
  }
  return {command, ""};
}

}  // namespace

void refuse_empty_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // flags
    option->check([](const std::string& value) {
      return value.find_first_not_of(" \t\n\v\f\r") == std::string::npos ? "an empty text; give a value, or leave it out" : std::string();
    });
  }
  for (CLI::App* command : app.get_subcommands({})) refuse_empty_values(*command);
}

std::string explain_slip(const CLI::App& app, int argc, const char* const* argv) {
  const auto [command, wrong] = follow(app, argc, argv);
  if (wrong == "help") return "help: give --help after a command, such as: ddem calibrate --help; ddem --help lists them";
  if (!wrong.empty()) return unknown("command", wrong, command_names(*command));
  for (const std::string& word : command->remaining()) {
    if (word.starts_with('-')) return unknown("option", word.substr(0, word.find('=')), option_names(*command));
  }
  const std::vector<std::string> commands = command_names(*command);
  if (commands.empty()) return "";
  return fmt::format("{}a command is missing; there are {}", command == &app ? "" : command->get_name() + ": ", fmt::join(commands, ", "));
}

}  // namespace ddem::harness
