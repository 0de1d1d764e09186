#pragma once
// The commands that a sweep can run, with their options, as the help of each command describes them.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/command_line.h"

namespace kds {

/// A command as its help describes it.
struct SweptCommand {
  struct Option {
    std::string name;   ///< without its dashes
    std::string value;  ///< placeholder of the value in the help; empty for a flag
    std::size_t count = 1;
  };
  std::string name;
  bool takes_inputs = false, needs_inputs = false;
  std::vector<Option> options;
  HelpRequest::Check check;

  [[nodiscard]] const Option* find(std::string_view option) const;
  /// Returns these values of an option as the command shows its settings. Throws the command's own
  /// InputError, after `where`, if the option cannot take the values. Values that depend on the content of an
  /// input or on other options are not checked.
  [[nodiscard]] std::string setting(const std::string& option, const std::vector<std::string>& values,
                                    const std::string& where) const;
};

/// Returns a command by its name, as its own help describes it. Throws InputError if there is no such command
/// or if its results cannot be swept.
[[nodiscard]] const SweptCommand& swept_command(const std::string& name, const std::string& subject);
/// Returns the names of all commands that can be swept.
[[nodiscard]] const std::vector<std::string>& swept_commands();

/// An axis of every command that has --frames.
inline constexpr std::string_view stride_axis = "stride";

/// Returns ", did you mean NAME?", or "" if no name is near.
[[nodiscard]] std::string nearest_of(const std::string& name, const std::vector<std::string>& names);
/// Returns the name of an option without its dashes.
[[nodiscard]] std::string without_dashes(std::string_view option);
/// Returns the name of an option of the command, or `stride`, without dashes. Throws InputError if the
/// command has no such option or if the sweep sets the option itself.
[[nodiscard]] std::string known_option(const SweptCommand& command, const std::string& key,
                                       const std::string& where);

}  // namespace kds
