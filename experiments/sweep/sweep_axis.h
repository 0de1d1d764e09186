#pragma once
// Values of options in sweep.json: each option is an axis, with one value or several.

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/sweep/swept_command.h"

namespace kds {

/// The setting of one option: the words that follow the option on the command line. A flag has no words.
struct AxisValue {
  std::vector<std::string> words;
  bool given = true;                    ///< false if the option is left out
  std::string text;                     ///< for tables
  std::vector<std::string> files = {};  ///< absolute paths that the value names: those of --topology,
                                        ///< --obstacle and `--radius file:PATH`
  std::string shape = {};    ///< which items of a list of files are empty: -+ for ",FILE"; empty for no files
  std::string setting = {};  ///< equal for values that are the same setting, as 2 and "2.0"
};

/// An option and the values that it takes in turn.
struct Axis {
  std::string name;
  std::vector<AxisValue> values;
};

/// Returns a text or a number as text. Throws InputError if the value is neither or has a zero byte.
[[nodiscard]] std::string scalar_text(const Json& value, const std::string& where);
/// Returns the items of an array, or the value itself as the only item.
[[nodiscard]] Json::Items items_of(const Json& value);

/// Reads a value or an array of values of an option of the command, or of `stride`. Relative paths are
/// relative to `folder`. Throws InputError, which begins with `where`, if there is no such option, if it
/// cannot take a value, or if two values are the same setting.
[[nodiscard]] Axis read_axis(const SweptCommand& command, const std::string& key, const Json& json,
                             const std::filesystem::path& folder, const std::string& where);

}  // namespace kds
