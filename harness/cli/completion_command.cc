// ddem completion: scripts for shells, made from the commands and options that the program has.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/cli/commands.h"
#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// The first sentence, with a backslash before each of `special`.
std::string described(const std::string& text, std::string_view special) {
  std::string escaped;
  for (const char c : text.substr(0, text.find_first_of(";\n"))) {
    if (special.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string bash_completion(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : app.get_subcommands({})) {
    std::string options;
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : names_of(*option)) options += " " + name;
    }
    commands += " " + command->get_name();
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), options.substr(options.empty() ? 0 : 1));
  }
  return fmt::format(R"(# Completion of ddem for bash.
_ddem() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} words
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "{} --help --version" -- "$current")
    return
  fi
  [[ $current == -* ]] || return
  case ${{COMP_WORDS[1]}} in
{}    *) return ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _ddem ddem
)",
                     commands.substr(1), cases);
}

std::string zsh_completion(const CLI::App& app) {
  // Within '...' a quote ends the word; colons and brackets mean something to _describe and _arguments.
  const auto quoted = [](const std::string& text, std::string_view special) {
    std::string word;
    for (const char c : described(text, special)) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word;
  };
  std::string commands, cases;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands += fmt::format("    '{}:{}'\n", command->get_name(), quoted(command->get_description(), ":\\"));
    cases += fmt::format("    {})\n      _arguments", command->get_name());
    for (const CLI::Option* option : command->get_options()) {
      const char* value = option->get_items_expected_max() == 0 ? "" : ":value:_files";
      for (const std::string& name : names_of(*option)) {
        cases += fmt::format(" \\\n        '{}[{}]{}'", name, quoted(option->get_description(), ":[]\\"), value);
      }
    }
    cases += " \\\n        '*:file:_files'\n      ;;\n";
  }
  return fmt::format(R"(#compdef ddem
# Completion of ddem for zsh.
_ddem() {{
  local -a commands=(
{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  ((CURRENT--))
  case $command in
{}  esac
}}
_ddem "$@"
)",
                     commands, cases);
}

}  // namespace

void add_completion_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("completion", "A script that completes commands and options on the command line of bash or zsh");
  auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash or zsh")->required();
  command->footer("Examples:\n  source <(ddem completion bash)\n  ddem completion zsh > ~/.zfunc/_ddem");
  command->callback([&app, &action, shell] {
    action = [&app, shell] {
      if (*shell != "bash" && *shell != "zsh") throw InputError(fmt::format("completion: \"{}\" is no shell that it knows; give bash or zsh", *shell));
      fmt::print("{}", *shell == "bash" ? bash_completion(app) : zsh_completion(app));
      return static_cast<int>(ExitCode::done);
    };
  });
}

}  // namespace ddem::harness
