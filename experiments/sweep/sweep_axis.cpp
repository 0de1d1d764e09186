#include "experiments/sweep/sweep_axis.h"

#include <fmt/ranges.h>

#include <map>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "experiments/sweep/input_files.h"
#include "experiments/sweep/refuse.h"
#include "motions/base/text_input.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kRadiusFile = "file:";

// Makes the files of a value absolute, since tasks run in any folder.
void find_files(const std::string& option, const fs::path& folder, AxisValue& value) {
  std::string& word = value.words.front();
  if (option == "radius" && word.starts_with(kRadiusFile) && word != kRadiusFile) {
    value.files = {in_folder(folder, word.substr(kRadiusFile.size())).string()};
    value.shape = "+";
    word = std::string(kRadiusFile) + value.files.front();
  } else if ((option == "topology" || option == "obstacle") && !word.empty()) {
    std::error_code none;
    const bool is_file = fs::exists(in_folder(folder, word), none);  // its name may have commas
    std::vector<std::string> items = is_file ? std::vector{word} : split(word, ',');
    for (std::string& item : items) {
      value.shape += item.empty() ? '-' : '+';
      if (!item.empty()) value.files.push_back(item = in_folder(folder, item).string());
    }
    word = fmt::format("{}", fmt::join(items, ","));
  }
}

AxisValue read_value(const SweptCommand& command, const std::string& name, const Json& json,
                     const fs::path& folder, const std::string& where) {
  AxisValue value;
  value.given = !json.is_null();
  if (!value.given) return value;
  if (name == stride_axis) {
    value.text = value.setting =
        std::to_string(parse_whole_number(where, scalar_text(json, where), 1, 1'000'000'000));
    value.words = {value.text};
    return value;
  }
  const SweptCommand::Option& option = *command.find(name);
  if (option.value.empty()) {
    if (json.truth() == nullptr) refuse("{}: --{} takes no value; expected true or false", where, name);
    value.given = *json.truth();
    value.text = value.given ? "yes" : "no";
    return value;
  }
  if (option.count > 1 && (json.items() == nullptr || json.items()->size() != option.count))
    refuse("{}: --{} takes {} values; expected an array of {} texts", where, name, option.count,
           option.count);
  for (const Json& word : option.count > 1 ? *json.items() : Json::Items{json})
    value.words.push_back(scalar_text(word, where));
  value.text = fmt::format("{}", fmt::join(value.words, " "));
  find_files(name, folder, value);
  for (const std::string& word : value.words)
    if (word.empty() || word.starts_with("--"))
      refuse("{}: --{} cannot take '{}'; null leaves the option out", where, name, word);
  value.setting = command.setting(name, value.words, where);
  // --radius shows a number as it is written.
  if (const auto number = parse_double(value.setting); number && name == "radius")
    value.setting = fmt::format("{}", *number);
  return value;
}

}  // namespace

std::string scalar_text(const Json& value, const std::string& where) {
  if (value.text() == nullptr && !value.number()) refuse("{}: expected a text or a number", where);
  if (value.text() == nullptr) return line_of(value).value_or("");
  if (value.text()->find('\0') != std::string::npos)
    refuse("{}: has a zero byte, which no argument of a command can have", where);
  return *value.text();
}

Json::Items items_of(const Json& value) {
  return value.items() != nullptr ? *value.items() : Json::Items{value};
}

// For an option with several values, each item of an array of values is an array itself.
Axis read_axis(const SweptCommand& command, const std::string& key, const Json& json, const fs::path& folder,
               const std::string& where) {
  Axis axis{known_option(command, key, where), {}};
  const SweptCommand::Option* const option = command.find(axis.name);
  Json::Items items = items_of(json);
  if (items.empty()) refuse("{}: has no value; expected at least one", where);
  if (option != nullptr && option->count > 1 && items.front().items() == nullptr) items = {json};
  std::map<std::pair<bool, std::string>, std::string> listed;
  for (const Json& item : items) {
    axis.values.push_back(read_value(command, axis.name, item, folder, where));
    const AxisValue& value = axis.values.back();
    const auto [earlier, is_new] = listed.emplace(std::pair(value.given, value.setting), value.text);
    if (is_new) continue;
    if (value.text == earlier->second) refuse("{}: value '{}' is listed twice", where, value.text);
    refuse("{}: values '{}' and '{}' are the same setting; expected it once", where, earlier->second,
           value.text);
  }
  return axis;
}

}  // namespace kds
