#include "experiments/sweep/sweep_spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

void check_keys(const Json& object, const std::string& where, std::initializer_list<std::string_view> known) {
  if (object.members() == nullptr)
    throw InputError(fmt::format("{}: expected an object with the keys {}", where, fmt::join(known, ", ")));
  const std::vector<std::string_view> names(known);
  for (const auto& [key, value] : *object.members())
    if (std::ranges::find(names, key) == names.end())
      throw InputError(fmt::format("{}: unknown key '{}', expected one of {}{}", where, key,
                                   fmt::join(names, ", "), suggestion(key, names)));
}

std::size_t read_whole(const Json& json, const std::string& where, std::size_t most) {
  return parse_whole_number(where, line_of(json).value_or("?"), 1, most);
}

// A trajectory is cut only if the motion of a step and the events in it depend on that step alone.
void refuse_segments(const SweepBlock& block, const std::string& where) {
  if (block.command->name != "run")
    throw InputError(
        fmt::format("{}: results of kds {} are not sums over steps, so its trajectories cannot be cut; "
                    "expected command run",
                    where, block.command->name));
  const auto refuse = [&](const std::string& option, const AxisValue& value) {
    if (!value.given) return;
    if (option == "rounds")
      throw InputError(where +
                       ": median times of --rounds do not add up over segments; expected no "
                       "segment_steps beside it");
    const bool cuttable = option != "tolerance" && option != "certify" && option != "relax" &&
                          !(option == "motion" && value.text == "hermite");
    if (!cuttable)
      throw InputError(
          fmt::format("{}: steps depend on frames outside of a segment with --{}{}{}; expected no "
                      "segment_steps beside it",
                      where, option, value.words.empty() ? "" : " ", value.text));
  };
  for (const Axis& axis : block.axes)
    for (const AxisValue& value : axis.values) refuse(axis.name, value);
  for (const SweepInput& input : block.inputs) {
    if (input.files.size() > 1)
      throw InputError(
          fmt::format("{}: '{}' is several files; expected one file for segments", where, input.name));
    for (const auto& [option, value] : input.options) refuse(option, value);
  }
}

// Refuses an option that both an input and an axis set.
void refuse_settings_twice(const SweepBlock& block, const std::string& where) {
  for (const SweepInput& input : block.inputs)
    for (const auto& [option, value] : input.options)
      for (const Axis& axis : block.axes)
        if (axis.name == option)
          throw InputError(fmt::format("{}: input '{}' sets --{} too; expected it in one place", where,
                                       input.name, option));
}

// The command parses frames itself; a stride is appended to FIRST:LAST.
void refuse_two_strides(const SweepBlock& block, const std::string& where) {
  const bool strides =
      std::ranges::any_of(block.axes, [](const Axis& axis) { return axis.name == stride_axis; });
  const auto refuse = [&](const std::string& option, const AxisValue& value) {
    if (option == "frames" && std::ranges::count(value.text, ':') != 1 && value.given &&
        (strides || block.segment_steps))
      throw InputError(fmt::format("{}: --frames {}: expected FIRST:LAST beside {}", where, value.text,
                                   strides ? "the option stride" : "segment_steps"));
  };
  for (const Axis& axis : block.axes)
    for (const AxisValue& value : axis.values) refuse(axis.name, value);
  for (const SweepInput& input : block.inputs)
    for (const auto& [option, value] : input.options) refuse(option, value);
}

// Inputs that are the same files with different options get these options in their names, so that tables and
// pools tell them apart.
void tell_apart(std::vector<SweepInput>& inputs) {
  std::map<std::string, std::size_t> named;
  for (const SweepInput& input : inputs) ++named[input.name];
  for (SweepInput& input : inputs) {
    if (named[input.name] == 1) continue;
    for (const auto& [option, value] : input.options)
      if (value.given)
        input.name += fmt::format(" --{}{}{}", option, value.words.empty() ? "" : " ", value.text);
  }
}

SweepBlock read_block(const Json& json, const Json* shared_inputs, const fs::path& folder,
                      PatternFiles& files, const std::string& where, const std::string& subject) {
  Json whole = json;
  if (json.text() != nullptr) whole = {{"command", *json.text()}};
  check_keys(whole, where, {"command", "inputs", "options", "segment_steps"});
  const Json* const name = whole.find("command");
  if (name == nullptr || name->text() == nullptr)
    throw InputError(
        fmt::format("{}: needs the key 'command', one of {}", where, fmt::join(swept_commands(), ", ")));
  SweepBlock block;
  block.command = &swept_command(*name->text(), where);
  const Json* const own_inputs = whole.find("inputs");
  if (own_inputs != nullptr && !block.command->takes_inputs && own_inputs->items() != nullptr &&
      !own_inputs->items()->empty())
    throw InputError(fmt::format("{}: kds {} reads no inputs", where, block.command->name));
  const Json* const inputs = own_inputs != nullptr ? own_inputs : shared_inputs;
  if (block.command->takes_inputs && inputs != nullptr)
    block.inputs = read_inputs(*block.command, *inputs, folder, files,
                               (own_inputs != nullptr ? where : subject) + ": inputs");
  tell_apart(block.inputs);
  if (block.inputs.empty() && block.command->needs_inputs)
    throw InputError(fmt::format("{}: kds {} needs inputs", where, block.command->name));
  if (block.inputs.empty()) block.inputs.emplace_back();  // one task for each setting
  if (const Json* const options = whole.find("options")) {
    if (options->members() == nullptr)
      throw InputError(fmt::format("{}: options: expected an object with options of kds {} as keys", where,
                                   block.command->name));
    for (const auto& [key, value] : *options->members()) {
      Axis axis = read_axis(*block.command, key, value, folder, files, fmt::format("{}: {}", where, key));
      for (const Axis& other : block.axes)
        if (other.name == axis.name)
          throw InputError(fmt::format("{}: option {} is listed twice", where, axis.name));
      block.axes.push_back(std::move(axis));
    }
  }
  if (const Json* const steps = whole.find("segment_steps"))
    block.segment_steps = read_whole(*steps, where + ": segment_steps", 1'000'000'000);
  refuse_settings_twice(block, where);
  refuse_two_strides(block, where);
  if (block.segment_steps) refuse_segments(block, where);
  return block;
}

Axis read_seeds(const Json& json, const std::string& where) {
  Axis axis{"seed", {}};
  if (json.items() == nullptr) {
    const std::size_t count = read_whole(json, where, 1'000'000);
    for (std::size_t seed = 1; seed <= count; ++seed)
      axis.values.push_back({{std::to_string(seed)}, true, std::to_string(seed)});
    return axis;
  }
  std::set<std::uint64_t> listed;
  for (const Json& seed : *json.items()) {
    const std::uint64_t number = parse_whole_number(where, line_of(seed).value_or("?"), 0, UINT64_MAX);
    const std::string text = std::to_string(number);
    if (!listed.insert(number).second)
      throw InputError(fmt::format("{}: seed {} is listed twice", where, text));
    axis.values.push_back({{text}, true, text});
  }
  if (axis.values.empty()) throw InputError(where + ": lists no seed");
  return axis;
}

void add_seeds(const Json& json, std::vector<SweepBlock>& blocks, const std::string& where) {
  const Axis seeds = read_seeds(json, where);
  bool used = false;
  for (SweepBlock& block : blocks) {
    if (block.command->find("seed") == nullptr) continue;
    for (const Axis& axis : block.axes)
      if (axis.name == "seed")
        throw InputError(where + ": an option seed of a command says the seeds too; expected one of the two");
    for (const AxisValue& seed : seeds.values)
      static_cast<void>(block.command->setting("seed", seed.words, where));
    block.axes.push_back(seeds);
    used = true;
  }
  if (!used) throw InputError(where + ": no command of this sweep has the option --seed");
}

std::vector<std::string> axis_names(const std::vector<SweepBlock>& blocks) {
  std::vector<std::string> names{"command", "input"};
  for (const SweepBlock& block : blocks)
    for (const Axis& axis : block.axes)
      if (std::ranges::find(names, axis.name) == names.end()) names.push_back(axis.name);
  return names;
}

void check_axis_name(const std::string& name, const std::vector<std::string>& names,
                     const std::string& where) {
  if (std::ranges::find(names, name) == names.end())
    throw InputError(fmt::format("{}: '{}' is no axis of this sweep, expected one of {}{}", where, name,
                                 fmt::join(names, ", "), nearest_of(name, names)));
}

}  // namespace

bool matches(std::string_view text, std::string_view pattern) {
  return ::fnmatch(std::string(pattern).c_str(), std::string(text).c_str(), 0) == 0;
}

SweepSpec read_sweep(const Json& json, const fs::path& folder, PatternFiles& files,
                     const std::string& subject) {
  check_keys(json, subject, {"inputs", "commands", "seeds", "exclude", "pool"});
  const Json* const commands = json.find("commands");
  if (commands == nullptr || commands->items() == nullptr || commands->items()->empty())
    throw InputError(
        fmt::format("{}: needs the key 'commands', an array of objects such as {{\"command\": \"run\", "
                    "\"options\": {{...}}}}",
                    subject));
  SweepSpec spec;
  for (std::size_t k = 0; k < commands->items()->size(); ++k)
    spec.blocks.push_back(read_block((*commands->items())[k], json.find("inputs"), folder, files,
                                     fmt::format("{}: commands[{}]", subject, k), subject));
  const Json* const seeds = json.find("seeds");
  if (seeds != nullptr) add_seeds(*seeds, spec.blocks, subject + ": seeds");

  const std::vector<std::string> names = axis_names(spec.blocks);
  if (const Json* const exclude = json.find("exclude")) {
    if (exclude->items() == nullptr) throw InputError(subject + ": exclude: expected an array of objects");
    for (std::size_t k = 0; k < exclude->items()->size(); ++k) {
      const std::string where = fmt::format("{}: exclude[{}]", subject, k);
      const Json& item = (*exclude->items())[k];
      if (item.members() == nullptr || item.members()->empty())
        throw InputError(where +
                         ": expected an object of axes and patterns, such as {\"motion\": \"lifted\"}");
      Exclusion exclusion;
      for (const auto& [key, pattern] : *item.members()) {
        const std::string name = without_dashes(key);
        check_axis_name(name, names, where);
        exclusion.emplace_back(name, pattern.truth() != nullptr ? (*pattern.truth() ? "yes" : "no")
                                                                : scalar_text(pattern, where + ": " + key));
      }
      spec.exclusions.push_back(std::move(exclusion));
    }
  }
  if (const Json* const pool = json.find("pool")) {
    if (pool->items() == nullptr) throw InputError(subject + ": pool: expected an array of axes");
    for (const Json& name : *pool->items()) {
      spec.pooled.push_back(scalar_text(name, subject + ": pool"));
      check_axis_name(spec.pooled.back(), names, subject + ": pool");
      if (spec.pooled.back() == "command")
        throw InputError(subject + ": pool: results of different commands have no mean; expected other axes");
    }
  } else {
    spec.pooled = {seeds != nullptr ? "seed" : "input"};
  }
  return spec;
}

}  // namespace kds
