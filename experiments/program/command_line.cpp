#include "experiments/program/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"

namespace kds {
namespace {

constexpr OptionSpec kHelp{"--help", "", "print this and exit"};

std::string usage_hint(const CommandSpec& command) { return fmt::format(" (see {} --help)", command.name); }

std::string left_column(const OptionSpec& option) {
  return option.value.empty() ? std::string(option.name) : fmt::format("{} {}", option.name, option.value);
}

std::string needs_values(const OptionSpec& option) {
  if (option.count == 1) return fmt::format("{} needs a value", option.name);
  return fmt::format("{} needs {} values, {}", option.name, option.count, option.value);
}

// Rewrites a CLI11 error, which names C++ types and counts, into a message that says what to do.
std::string explain(const CLI::ParseError& error, const CLI::App& parser,
                    const std::vector<OptionSpec>& options, const Arguments& arguments) {
  if (const std::vector<std::string> extras = parser.remaining(); !extras.empty()) {
    const std::string_view extra = extras.front();
    if (!extra.starts_with('-')) return fmt::format("unexpected argument '{}'", extra);
    const std::string_view unknown = extra.substr(0, extra.find('='));
    std::vector<std::string_view> names{kHelp.name};
    for (const OptionSpec& option : options) names.push_back(option.name);
    return fmt::format("unknown option '{}'{}", unknown, suggestion(unknown, names));
  }
  for (const OptionSpec& option : options)
    for (const std::string& argument : arguments)
      if (option.value.empty() && argument.starts_with(std::string(option.name) + "="))
        return fmt::format("{} takes no value", option.name);
  for (const OptionSpec& option : options) {
    if (option.value.empty()) continue;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
      const bool with_value = arguments[k].starts_with(std::string(option.name) + "=");
      if (!with_value && arguments[k] != option.name) continue;
      const std::size_t given = arguments.size() - 1 - k + (with_value ? 1 : 0);
      if (given < option.count) return needs_values(option);
    }
  }
  return one_line(error.what());
}

}  // namespace

std::optional<std::string> ParsedArguments::value(std::string_view option) const {
  const auto found = values_.find(option);
  if (found == values_.end()) return std::nullopt;
  return found->second.front();
}

const std::vector<std::string>& ParsedArguments::values(std::string_view option) const {
  return values_.find(option)->second;
}

ParsedArguments parse_arguments(const CommandSpec& command, const std::vector<OptionSpec>& options,
                                const Arguments& arguments) {
  CLI::App parser;
  parser.set_help_flag(std::string(kHelp.name) + ",-h");

  std::map<std::string_view, std::vector<std::string>> unused;  // CLI11 reads some values as empty lists: {}
  for (const OptionSpec& option : options) {
    const std::string name(option.name);
    if (option.value.empty()) {
      parser.add_flag(name)->disable_flag_override();
    } else {
      CLI::Option* const added = parser.add_option(name, unused[option.name]);
      added->allow_extra_args(false);  // each occurrence takes `count` values
      if (option.count > 1) added->type_size(static_cast<int>(option.count));
    }
  }
  if (!command.operand.empty()) parser.add_option(std::string(command.operand), unused[command.operand]);

  try {
    parser.parse(Arguments(arguments.rbegin(), arguments.rend()));  // CLI11 takes the last argument first
  } catch (const CLI::CallForHelp&) {
    throw HelpRequest{help_text(command, options), std::string(command.operand), options};
  } catch (const CLI::ParseError& error) {
    throw InputError(explain(error, parser, options, arguments) + usage_hint(command));
  }

  ParsedArguments parsed;
  if (!command.operand.empty()) parsed.operands_ = parser.get_option(std::string(command.operand))->results();
  for (const OptionSpec& option : options) {
    std::vector<std::string> values = parser.get_option(std::string(option.name))->results();
    const std::size_t times = values.size() / option.count;
    if (values.empty()) continue;
    if (times > 1) throw InputError(fmt::format("{} is given {} times; give it once", option.name, times));
    if (option.value.empty()) values = {""};
    for (const std::string& value : values) {
      if (value.starts_with("--"))  // a forgotten value: the next option was read as the value
        throw InputError(fmt::format("{}, but '{}' follows", needs_values(option), value));
      if (value.empty() && !option.value.empty()) throw InputError(needs_values(option));
    }
    parsed.values_.emplace(option.name, std::move(values));
  }
  return parsed;
}

std::string help_text(const CommandSpec& command, const std::vector<OptionSpec>& options) {
  std::vector<OptionSpec> lines = options;
  lines.push_back(kHelp);
  std::size_t width = command.operand.size();
  for (const OptionSpec& line : lines) width = std::max(width, left_column(line).size());

  std::string text = fmt::format("{}\n\nusage: {}{}{} [OPTION]...\n\n", command.summary, command.name,
                                 command.operand.empty() ? "" : " ", command.operand);
  if (!command.operand.empty())
    text += fmt::format("  {:<{}}  {}\n\n", command.operand, width, command.operand_help);
  for (const OptionSpec& line : lines)
    text += fmt::format("  {:<{}}  {}\n", left_column(line), width, line.help);
  if (!command.examples.empty()) {
    text += "\nexamples:\n";
    for (const std::string& example : split(command.examples, '\n')) text += fmt::format("  {}\n", example);
  }
  return text;
}

}  // namespace kds
