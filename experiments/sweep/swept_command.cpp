#include "experiments/sweep/swept_command.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option_values.h"
#include "experiments/sweep/refuse.h"

namespace kds {

namespace {

// The sweep sets these options itself, or their files would be those of every task.
constexpr std::array<std::string_view, 11> kOwnOptions{"help", "o",      "out",  "json", "quiet",  "dump",
                                                       "log",  "events", "view", "data", "replace"};

bool is_own(std::string_view option) { return std::ranges::find(kOwnOptions, option) != kOwnOptions.end(); }

// Returns the command, or nothing if a sweep cannot run it: it needs --json, and files that the sweep knows.
std::optional<SweptCommand> described(const Command& command) {
  if (command.name == "sweep" || command.name == "replay" || command.name == "generate") return std::nullopt;
  try {
    command.run({"--help"});
  } catch (const HelpRequest& help) {
    SweptCommand swept{std::string(command.name),
                       help.operand.find("INPUT") != std::string::npos,
                       help.operand.starts_with("INPUT"),
                       {},
                       help.check};
    const bool other_operand = !help.operand.empty() && !swept.takes_inputs;
    bool has_json = false;
    for (const OptionSpec& option : help.options) {
      const std::string name = without_dashes(option.name);
      has_json = has_json || name == "json";
      if (name == "data") return std::nullopt;
      if (!is_own(name)) swept.options.push_back({name, std::string(option.value), option.count});
    }
    if (has_json && !(other_operand && help.operand.front() != '[')) return swept;
  }
  return std::nullopt;
}

const std::vector<SweptCommand>& all_swept() {
  static const std::vector<SweptCommand> all = [] {
    std::vector<SweptCommand> found;
    for (const Command& command : all_commands())
      if (auto swept = described(command)) found.push_back(std::move(*swept));
    return found;
  }();
  return all;
}

}  // namespace

std::string nearest_of(const std::string& name, const std::vector<std::string>& names) {
  return suggestion(name, std::vector<std::string_view>(names.begin(), names.end()));
}

const SweptCommand::Option* SweptCommand::find(std::string_view option) const {
  const auto found = std::ranges::find(options, option, &Option::name);
  return found == options.end() ? nullptr : &*found;
}

std::string SweptCommand::setting(const std::string& option, const std::vector<std::string>& values,
                                  const std::string& where) const {
  if (!check || find(option) == nullptr) return shell_words(values);
  try {
    return check("--" + option, values);
  } catch (const InputError& error) {
    refuse("{}: {}", where, error.what());
  }
}

const std::vector<std::string>& swept_commands() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const SweptCommand& command : all_swept()) all.push_back(command.name);
    return all;
  }();
  return names;
}

const SweptCommand& swept_command(const std::string& name, const std::string& subject) {
  for (const SweptCommand& command : all_swept())
    if (command.name == name) return command;
  refuse("{}: '{}' is no command that can be swept, expected one of {}{}", subject, name,
         fmt::join(swept_commands(), ", "), nearest_of(name, swept_commands()));
}

std::string without_dashes(std::string_view option) {
  return std::string(option.substr(std::min(option.find_first_not_of('-'), option.size())));
}

std::string known_option(const SweptCommand& command, const std::string& key, const std::string& where) {
  const std::string name = without_dashes(key);
  if (is_own(name))
    refuse("{}: the sweep sets --{} of its tasks itself; expected an option that is a setting", where, name);
  const bool has_frames = command.find("frames") != nullptr;
  if (command.find(name) != nullptr || (has_frames && name == stride_axis)) return name;
  std::vector<std::string> names;
  for (const SweptCommand::Option& option : command.options) names.push_back(option.name);
  if (has_frames) names.emplace_back(stride_axis);
  refuse("{}: kds {} has no option --{}{} (see kds {} --help)", where, command.name, name,
         nearest_of(name, names), command.name);
}

}  // namespace kds
