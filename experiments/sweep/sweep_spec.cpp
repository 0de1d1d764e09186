#include "experiments/sweep/sweep_spec.h"

#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>

#include "experiments/program/option_values.h"
#include "experiments/sweep/refuse.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

void check_keys(const Json& object, const std::string& where, std::initializer_list<std::string_view> known) {
  if (object.members() == nullptr)
    refuse("{}: expected an object with the keys {}", where, fmt::join(known, ", "));
  const std::vector<std::string_view> names(known);
  for (const auto& [key, value] : *object.members())
    if (std::ranges::find(names, key) == names.end())
      refuse("{}: unknown key '{}', expected one of {}{}", where, key, fmt::join(names, ", "),
             suggestion(key, names));
}

// Reads the members of an object as options, apart from `other`.
std::vector<Axis> read_options(const SweptCommand& command, const Json& json, std::string_view other,
                               const fs::path& folder, const std::string& where) {
  std::vector<Axis> axes;
  for (const auto& [key, value] : *json.members()) {
    if (key == other) continue;
    Axis axis = read_axis(command, key, value, folder, fmt::format("{}: {}", where, key));
    if (std::ranges::find(axes, axis.name, &Axis::name) != axes.end())
      refuse("{}: option {} is listed twice", where, axis.name);
    axes.push_back(std::move(axis));
  }
  return axes;
}

// Adds the inputs of an item of the array `inputs`.
void add_inputs(const SweptCommand& command, const Json& item, const fs::path& folder, InputFiles& known,
                const std::string& where, std::vector<SweepInput>& inputs) {
  const Json* files = &item;
  SweepInput input;
  if (item.members() != nullptr) {
    files = item.find("file");
    if (files == nullptr)
      refuse("{}: an input that is an object needs the key 'file', beside options of the input", where);
    for (Axis& axis : read_options(command, item, "file", folder, where)) {
      if (axis.values.size() > 1) refuse("{}: {}: expected one value for an input", where, axis.name);
      input.options.emplace_back(axis.name, std::move(axis.values.front()));
    }
  }
  const Json::Items items = items_of(*files);
  std::vector<std::string> names;
  for (const Json& file : items) {
    if (file.text() == nullptr || file.text()->empty())
      refuse("{}: expected a path, or an object with the key 'file'", where);
    names.push_back(scalar_text(file, where));
    input.files.push_back(in_folder(folder, names.back()).string());
  }
  if (names.empty()) refuse("{}: 'file' lists no file", where);
  input.name = fmt::format("{}", fmt::join(names, " "));
  if (files->items() != nullptr) return inputs.push_back(input);  // several files of one task
  const std::string whole = input.files.front();
  for (const std::string& file : known.matching(names.front(), folder, where)) {
    // The name is that of a path in sweep.json.
    const std::string relative = fs::path(file).lexically_relative(folder).string();
    if (file != whole) input.name = relative.empty() ? file : relative;
    input.files = {file};
    inputs.push_back(input);
  }
}

// Inputs that are the same files with different options get these options in their names, so that tables and
// pools distinguish them.
void tell_apart(std::vector<SweepInput>& inputs) {
  std::map<std::string, std::size_t> named;
  for (const SweepInput& input : inputs) ++named[input.name];
  for (SweepInput& input : inputs)
    for (const auto& [option, value] : named[input.name] > 1 ? input.options : decltype(input.options)())
      if (value.given)
        input.name += fmt::format(" --{}{}{}", option, value.words.empty() ? "" : " ", value.text);
}

// Refuses options that both an input and an axis set. A stride is appended to FIRST:LAST.
void check_options(const SweepBlock& block, const std::string& where) {
  const auto has = [&](std::string_view name) {
    return std::ranges::find(block.axes, name, &Axis::name) != block.axes.end();
  };
  const auto check_frames = [&](const std::string& option, const AxisValue& value) {
    if (option == "frames" && value.given && has(stride_axis) && std::ranges::count(value.text, ':') != 1)
      refuse("{}: --frames {}: expected FIRST:LAST beside the option stride", where, value.text);
  };
  for (const Axis& axis : block.axes)
    for (const AxisValue& value : axis.values) check_frames(axis.name, value);
  for (const SweepInput& input : block.inputs)
    for (const auto& [option, value] : input.options) {
      if (has(option))
        refuse("{}: input '{}' sets --{} too; expected it in one place", where, input.name, option);
      check_frames(option, value);
    }
}

SweepBlock read_block(const Json& json, const Json* shared_inputs, const fs::path& folder, InputFiles& files,
                      const std::string& where, const std::string& subject) {
  Json whole = json;
  if (json.text() != nullptr) whole = {{"command", *json.text()}};
  if (whole.find("segment_steps") != nullptr)
    refuse(
        "{}: segment_steps is no longer supported; expected one task for each trajectory, with the option "
        "threads to run it on several cores",
        where);
  check_keys(whole, where, {"command", "inputs", "options"});
  const Json *const name = whole.find("command"), *const own_inputs = whole.find("inputs"),
                    *const options = whole.find("options");
  if (name == nullptr || name->text() == nullptr)
    refuse("{}: needs the key 'command', one of {}", where, fmt::join(swept_commands(), ", "));
  SweepBlock block;
  block.command = &swept_command(*name->text(), where);
  const Json* const inputs = own_inputs != nullptr ? own_inputs : shared_inputs;
  const std::string owner = (own_inputs != nullptr ? where : subject) + ": inputs";
  const Json::Items items = inputs != nullptr ? items_of(*inputs) : Json::Items();
  if (own_inputs != nullptr && !block.command->takes_inputs && !items.empty())
    refuse("{}: kds {} reads no inputs", where, block.command->name);
  for (std::size_t k = 0; block.command->takes_inputs && k < items.size(); ++k)
    add_inputs(*block.command, items[k], folder, files,
               inputs->items() != nullptr ? fmt::format("{}[{}]", owner, k) : owner, block.inputs);
  tell_apart(block.inputs);
  if (block.inputs.empty() && block.command->needs_inputs)
    refuse("{}: kds {} needs inputs", where, block.command->name);
  if (block.inputs.empty()) block.inputs.emplace_back();  // one task for each setting
  if (options != nullptr && options->members() == nullptr)
    refuse("{}: options: expected an object with options of kds {} as keys", where, block.command->name);
  if (options != nullptr) block.axes = read_options(*block.command, *options, "", folder, where);
  check_options(block, where);
  return block;
}

// Seeds are an option of each command that has --seed.
void add_seeds(const Json& json, std::vector<SweepBlock>& blocks, const std::string& where) {
  Json list = json;
  if (json.items() == nullptr) {
    list = Json::array();
    const std::size_t count = parse_whole_number(where, line_of(json).value_or("?"), 1, 1'000'000);
    for (std::size_t seed = 1; seed <= count; ++seed) list.push_back(seed);
  }
  bool used = false;
  for (SweepBlock& block : blocks) {
    if (block.command->find("seed") == nullptr) continue;
    if (std::ranges::find(block.axes, "seed", &Axis::name) != block.axes.end())
      refuse("{}: an option seed of a command says the seeds too; expected one of the two", where);
    block.axes.push_back(read_axis(*block.command, "seed", list, {}, where));
    used = true;
  }
  if (!used) refuse("{}: no command of this sweep has the option --seed", where);
}

void check_axis_name(const std::string& name, const std::vector<SweepBlock>& blocks,
                     const std::string& where) {
  std::vector<std::string> names{"command", "input"};
  for (const SweepBlock& block : blocks)
    for (const Axis& axis : block.axes)
      if (std::ranges::find(names, axis.name) == names.end()) names.push_back(axis.name);
  if (std::ranges::find(names, name) == names.end())
    refuse("{}: '{}' is no axis of this sweep, expected one of {}{}", where, name, fmt::join(names, ", "),
           nearest_of(name, names));
}

Exclusion read_exclusion(const Json& json, const std::vector<SweepBlock>& blocks, const std::string& where) {
  if (json.members() == nullptr || json.members()->empty())
    refuse("{}: expected an object of axes and patterns, such as {{\"motion\": \"lifted\"}}", where);
  Exclusion exclusion;
  for (const auto& [key, pattern] : *json.members()) {
    exclusion.emplace_back(without_dashes(key), pattern.truth() == nullptr
                                                    ? scalar_text(pattern, where + ": " + key)
                                                    : (*pattern.truth() ? "yes" : "no"));
    check_axis_name(exclusion.back().first, blocks, where);
  }
  return exclusion;
}

}  // namespace

bool matches(std::string_view text, std::string_view pattern) {
  return ::fnmatch(std::string(pattern).c_str(), std::string(text).c_str(), 0) == 0;
}

SweepSpec read_sweep(const Json& json, const fs::path& folder, InputFiles& files,
                     const std::string& subject) {
  check_keys(json, subject, {"inputs", "commands", "seeds", "exclude", "pool"});
  const Json *const commands = json.find("commands"), *const seeds = json.find("seeds"),
                    *const exclude = json.find("exclude"), *const pool = json.find("pool");
  if (commands == nullptr || commands->items() == nullptr || commands->items()->empty())
    refuse(
        "{}: needs the key 'commands', an array of objects such as {{\"command\": \"run\", \"options\": "
        "{{...}}}}",
        subject);
  SweepSpec spec;
  for (const Json& command : *commands->items())
    spec.blocks.push_back(read_block(command, json.find("inputs"), folder, files,
                                     fmt::format("{}: commands[{}]", subject, spec.blocks.size()), subject));
  if (seeds != nullptr) add_seeds(*seeds, spec.blocks, subject + ": seeds");
  if (exclude != nullptr)
    for (const Json& item : items_of(*exclude))
      spec.exclusions.push_back(
          read_exclusion(item, spec.blocks, fmt::format("{}: exclude[{}]", subject, spec.exclusions.size())));
  if (pool == nullptr) spec.pooled = {seeds != nullptr ? "seed" : "input"};
  for (const Json& name : pool != nullptr ? items_of(*pool) : Json::Items()) {
    spec.pooled.push_back(scalar_text(name, subject + ": pool"));
    check_axis_name(spec.pooled.back(), spec.blocks, subject + ": pool");
    if (spec.pooled.back() == "command")
      refuse("{}: pool: results of different commands have no mean; expected other axes", subject);
  }
  return spec;
}

}  // namespace kds
