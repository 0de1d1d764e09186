#include "experiments/program/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"

namespace kds {
namespace {

const OptionSpec kHelp{"--help", "", "print this and exit"};

std::string usage_hint(const CommandSpec& command) {
  std::string function(command.name == "kds info" ? "kds.conditions" : command.name);
  std::replace(function.begin(), function.end(), ' ', '.');
  return std::string(
      words(fmt::format(" (see {} --help)", command.name), fmt::format(" (see help({}))", function)));
}

std::string left_column(const OptionSpec& option) {
  return option.value.empty() ? std::string(option.name) : fmt::format("{} {}", option.name, option.value);
}

std::string needs_values(const OptionSpec& option) {
  if (option.count == 1) return fmt::format("{} needs a value", argument(option.name));
  return fmt::format("{} needs {} values, {}", argument(option.name), option.count, option.value);
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
        return fmt::format("{} takes no value", kds::argument(option.name));
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
    if (times > 1)
      throw InputError(fmt::format("{} is given {} times; give it once", argument(option.name), times));
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

std::size_t help_width() {
  constexpr std::size_t least = 60, without_terminal = 100;
  if (::isatty(STDOUT_FILENO) == 0) return without_terminal;
  winsize size{};
  if (const char* const columns = std::getenv("COLUMNS"))
    size.ws_col = static_cast<unsigned short>(std::strtoul(columns, nullptr, 10));
  if (size.ws_col == 0 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return without_terminal;
  return size.ws_col == 0 ? without_terminal : std::max<std::size_t>(size.ws_col, least);
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string result;
  std::size_t column = indent;
  for (const std::string& word : split(text, ' ')) {
    const bool is_first = column == indent;
    const bool breaks = !is_first && column + 1 + word.size() > width;
    if (breaks) result += '\n' + std::string(indent, ' ');
    if (!is_first && !breaks) result += ' ';
    column = (breaks ? indent : column + (is_first ? 0 : 1)) + word.size();
    result += word;
  }
  return result;
}

std::string help_text(const CommandSpec& command, const std::vector<OptionSpec>& options, std::size_t width) {
  std::vector<OptionSpec> lines;
  std::vector<std::string_view> of_inputs;
  for (const OptionSpec& option : options)
    option.of_inputs ? of_inputs.push_back(option.name) : lines.push_back(option);
  lines.push_back(kHelp);
  std::size_t left = command.operand.size();
  for (const OptionSpec& line : lines) left = std::max(left, left_column(line).size());
  const auto row = [&](std::string_view name, std::string_view help) {
    return fmt::format("  {:<{}}  {}\n", name, left, wrapped(help, width, left + 4));
  };

  std::string text, paragraph;
  const auto end_paragraph = [&] {
    if (!paragraph.empty()) text += wrapped(paragraph, width, 0) + '\n';
    paragraph.clear();
  };
  for (const std::string& line : split(command.summary, '\n')) {
    if (line.empty() || line.starts_with(' ')) {  // rows of a table are indented
      end_paragraph();
      text += line + '\n';
    } else {
      paragraph += (paragraph.empty() ? "" : " ") + line;
    }
  }
  end_paragraph();
  text += fmt::format("\nusage: {}{}{} [OPTION]...\n\n", command.name, command.operand.empty() ? "" : " ",
                      command.operand);
  if (!command.operand.empty()) text += row(command.operand, command.operand_help) + "\n";
  if (!of_inputs.empty())
    text +=
        wrapped(fmt::format("kds help inputs explains the options of inputs: {}", fmt::join(of_inputs, ", ")),
                width, 0) +
        "\n\n";
  for (const OptionSpec& line : lines) text += row(left_column(line), line.help);
  if (!command.examples.empty()) {
    text += "\nexamples:\n";
    for (const std::string& example : split(command.examples, '\n')) text += fmt::format("  {}\n", example);
  }
  return text;
}

}  // namespace kds
