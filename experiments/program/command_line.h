#pragma once
// Declares and parses the command line of one command. The parser and the help text are made from the same
// declarations.

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

using Arguments = std::vector<std::string>;  ///< without the names of the program and the command

struct OptionSpec {
  std::string_view name;   ///< with its dashes
  std::string_view value;  ///< placeholder of the value in the help text; empty for a flag
  std::string help;        ///< one line, with the default value
  std::size_t count = 1;   ///< number of values, unless the option is a flag
  bool of_inputs = false;  ///< whether `kds help inputs` explains it, in place of the command's own help
};

struct CommandSpec {
  std::string_view name;     ///< such as kds run
  std::string_view summary;  ///< one sentence; definitions may follow on separate lines
  std::string_view operand;  ///< placeholder of positional arguments in the help text; empty if none
  std::string_view operand_help;
  std::string_view examples;  ///< one example per line
};

/// Thrown if --help is given. main prints the text and exits with 0. `kds sweep` asks each command for its
/// help to learn the command's operand and options, and which values they take.
struct HelpRequest {
  using Check = std::function<std::string(std::string_view option, const std::vector<std::string>& values)>;

  std::string text;
  std::string operand = {};              ///< empty if the command takes none
  std::vector<OptionSpec> options = {};  ///< refer to texts that live as long as the command's option list
  /// Returns these values of an option, which has its dashes, as the command's settings show them; values of
  /// an option that is no setting are joined as they are. Throws the command's own InputError if the option
  /// cannot take the values. All other options have their defaults. Null if the command does not use
  /// parse_for.
  Check check = {};
};

class ParsedArguments {
 public:
  [[nodiscard]] const std::vector<std::string>& operands() const { return operands_; }
  [[nodiscard]] bool has(std::string_view flag) const { return values_.contains(flag); }
  /// Returns the first value, which is empty for a flag.
  [[nodiscard]] std::optional<std::string> value(std::string_view option) const;
  /// Returns all values of an option that is given.
  [[nodiscard]] const std::vector<std::string>& values(std::string_view option) const;

 private:
  friend ParsedArguments parse_arguments(const CommandSpec&, const std::vector<OptionSpec>&,
                                         const Arguments&);
  std::vector<std::string> operands_;
  std::map<std::string, std::vector<std::string>, std::less<>> values_;  ///< a flag has an empty value
};

/// Parses the arguments of a command. Throws InputError for an unknown option, a repeated option or an option
/// without its values. Throws HelpRequest for --help.
[[nodiscard]] ParsedArguments parse_arguments(const CommandSpec& command,
                                              const std::vector<OptionSpec>& options,
                                              const Arguments& arguments);

/// Returns the width of the terminal (COLUMNS, or as the system tells it), or 100 if standard output is no
/// terminal.
[[nodiscard]] std::size_t help_width();
/// Breaks a text between words. `indent` blanks begin each line but the first, which the caller indents.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t width, std::size_t indent);
/// Returns the help of a command, with lines of at most `width` characters where words allow it.
[[nodiscard]] std::string help_text(const CommandSpec& command, const std::vector<OptionSpec>& options,
                                    std::size_t width = help_width());

}  // namespace kds
