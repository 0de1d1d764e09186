#include "experiments/sweep/sweep_axis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 2> kFileOptions{"topology", "obstacle"};
constexpr std::string_view kRadiusFile = "file:";

// Sets the words and the files of a value. Files become absolute, since tasks run in any folder.
void set_words(const std::string& option, const std::string& word, const fs::path& folder,
               const PatternFiles& known, AxisValue& value) {
  value.words = {word};
  if (option == "radius" && word.starts_with(kRadiusFile) && word != kRadiusFile) {
    value.files = {in_folder(folder, word.substr(kRadiusFile.size())).string()};
    value.words = {std::string(kRadiusFile) + value.files.front()};
  }
  if (std::ranges::find(kFileOptions, option) == kFileOptions.end() || word.empty()) return;
  const std::string whole = in_folder(folder, word).string();
  if (known.is_file(whole)) {  // its name may have commas
    value.words = value.files = {whole};
    return;
  }
  std::vector<std::string> items;
  for (const std::string& item : split(word, ',')) {
    items.push_back(item.empty() ? item : in_folder(folder, item).string());
    if (!item.empty()) value.files.push_back(items.back());
  }
  value.words = {fmt::format("{}", fmt::join(items, ","))};
}

// Returns the setting of a value as the command shows it. --radius shows a number as it is written.
std::string setting_of(const std::string& option, const std::string& shown) {
  const auto number = parse_double(shown);
  return option == "radius" && number ? fmt::format("{}", *number) : shown;
}

}  // namespace

std::string scalar_text(const Json& value, const std::string& where) {
  if (value.text() != nullptr && value.text()->find('\0') != std::string::npos)
    throw InputError(where + ": has a zero byte, which no argument of a command can have");
  if (value.text() != nullptr) return *value.text();
  if (value.number()) return line_of(value).value_or("");
  throw InputError(fmt::format("{}: expected a text or a number", where));
}

bool AxisValue::lists_files() const {
  return !files.empty() && words.front() != files.front() &&
         words.front() != std::string(kRadiusFile) + files.front();
}

AxisValue read_value(const SweptCommand& command, const std::string& name, const Json& json,
                     const fs::path& folder, const PatternFiles& files, const std::string& where) {
  AxisValue value;
  if (json.is_null()) {
    value.given = false;
    return value;
  }
  if (name == stride_axis) {
    value.text = scalar_text(json, where);
    const auto stride = parse_whole_number(where, value.text, 1, 1'000'000'000);
    value.words = {std::to_string(stride)};
    value.setting = value.words.front();
    return value;
  }
  const SweptCommand::Option& option = *command.find(name);
  if (option.value.empty()) {
    if (json.truth() == nullptr)
      throw InputError(fmt::format("{}: --{} takes no value; expected true or false", where, name));
    value.given = *json.truth();
    value.text = value.given ? "yes" : "no";
    return value;
  }
  if (option.count == 1) {
    value.text = scalar_text(json, where);
    set_words(name, value.text, folder, files, value);
  } else {
    if (json.items() == nullptr || json.items()->size() != option.count)
      throw InputError(fmt::format("{}: --{} takes {} values; expected an array of {} texts", where, name,
                                   option.count, option.count));
    for (const Json& word : *json.items()) value.words.push_back(scalar_text(word, where));
    value.text = fmt::format("{}", fmt::join(value.words, " "));
  }
  for (const std::string& word : value.words)
    if (word.empty() || word.starts_with("--"))
      throw InputError(
          fmt::format("{}: --{} cannot take '{}'; null leaves the option out", where, name, word));
  value.setting = setting_of(name, command.setting(name, value.words, where));
  return value;
}

// An array lists the values of an axis. For an option with several values, each item is an array itself.
Axis read_axis(const SweptCommand& command, const std::string& key, const Json& json, const fs::path& folder,
               const PatternFiles& files, const std::string& where) {
  Axis axis{known_option(command, key, where), {}};
  const SweptCommand::Option* const option = command.find(axis.name);
  const Json::Items* const items = json.items();
  const bool one_of_several = option != nullptr && option->count > 1 && items != nullptr &&
                              (items->empty() || items->front().items() == nullptr);
  if (items == nullptr || one_of_several) {
    axis.values = {read_value(command, axis.name, json, folder, files, where)};
    return axis;
  }
  if (items->empty()) throw InputError(where + ": has no value; expected at least one");
  std::map<std::pair<bool, std::string>, std::string> listed;
  for (const Json& item : *items) {
    axis.values.push_back(read_value(command, axis.name, item, folder, files, where));
    const AxisValue& value = axis.values.back();
    const auto [earlier, is_new] = listed.emplace(std::pair(value.given, value.setting), value.text);
    if (is_new) continue;
    if (value.text == earlier->second)
      throw InputError(fmt::format("{}: value '{}' is listed twice", where, value.text));
    throw InputError(fmt::format("{}: values '{}' and '{}' are the same setting; expected it once", where,
                                 earlier->second, value.text));
  }
  return axis;
}

}  // namespace kds
