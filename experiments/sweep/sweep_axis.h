#pragma once
// Values of options in sweep.json: each option is an axis, with one value or several.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/sweep/pattern_files.h"
#include "experiments/sweep/swept_command.h"

namespace kds {

/// The setting of one option: the words that follow the option on the command line. A flag has no words.
struct AxisValue {
  std::vector<std::string> words;
  bool given = true;                    ///< false if the option is left out
  std::string text;                     ///< for tables
  std::vector<std::string> files = {};  ///< absolute paths that the value names: those of --topology,
                                        ///< --obstacle and `--radius file:PATH`
  std::string setting = {};             ///< equal for values that are the same setting, as 2 and "2.0"

  /// Returns whether the value is a list of files, of which some items may be empty.
  [[nodiscard]] bool lists_files() const;
};

/// An option and the values that it takes in turn.
struct Axis {
  std::string name;
  std::vector<AxisValue> values;
};

/// Returns a text or a number as text. Throws InputError if the value is neither or has a zero byte.
[[nodiscard]] std::string scalar_text(const Json& value, const std::string& where);

/// Reads the value of an option that the command has. Relative paths are relative to `folder`. Throws
/// InputError, which begins with `where`, if the option cannot take the value.
[[nodiscard]] AxisValue read_value(const SweptCommand& command, const std::string& option, const Json& json,
                                   const std::filesystem::path& folder, const PatternFiles& files,
                                   const std::string& where);
/// Reads a value or an array of values. Throws like read_value and known_option, and if two values are the
/// same setting.
[[nodiscard]] Axis read_axis(const SweptCommand& command, const std::string& key, const Json& json,
                             const std::filesystem::path& folder, const PatternFiles& files,
                             const std::string& where);

}  // namespace kds
