#pragma once
// The command line of one command. The parser and the help are made from the same description.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

using Arguments = std::vector<std::string>;  ///< without the program's and the command's name

struct OptionSpec {
  std::string_view name;   ///< with its dashes
  std::string_view value;  ///< how help names its value; empty: a flag
  std::string_view help;   ///< one line, the default included
};

struct CommandSpec {
  std::string_view name;     ///< kds run
  std::string_view summary;  ///< one sentence; definitions may follow on lines of their own
  std::string_view operand;  ///< how help names the arguments that are no options; empty: there are none
  std::string_view operand_help;
  std::string_view examples;  ///< one a line
};

/// Thrown where --help was given: main prints the text and exits with 0.
struct HelpRequest {
  std::string text;
};

class ParsedArguments {
 public:
  [[nodiscard]] const std::vector<std::string>& operands() const { return operands_; }
  [[nodiscard]] bool has(std::string_view flag) const { return values_.contains(flag); }
  [[nodiscard]] std::optional<std::string> value(std::string_view option) const;

 private:
  friend ParsedArguments parse_arguments(const CommandSpec&, const std::vector<OptionSpec>&,
                                         const Arguments&);
  std::vector<std::string> operands_;
  std::map<std::string, std::string, std::less<>> values_;  ///< flags have an empty value
};

/// Throws InputError for an unknown option, one given twice, one without its value; HelpRequest for --help.
[[nodiscard]] ParsedArguments parse_arguments(const CommandSpec& command,
                                              const std::vector<OptionSpec>& options,
                                              const Arguments& arguments);

[[nodiscard]] std::string help_text(const CommandSpec& command, const std::vector<OptionSpec>& options);

}  // namespace kds
