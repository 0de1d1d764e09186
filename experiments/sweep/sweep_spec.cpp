#include "experiments/sweep/sweep_spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>
#include <glob.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>

#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

// The sweep sets these options itself, or their files would be those of every task.
constexpr std::array<std::string_view, 11> kOwnOptions{"help", "o",   "out",    "json", "quiet", "paper",
                                                       "dump", "log", "events", "view", "data"};
constexpr std::array<std::string_view, 2> kFileOptions{"topology", "obstacle"};
constexpr std::string_view kRadiusFile = "file:";

std::string bare(std::string_view option) {
  return std::string(option.substr(std::min(option.find_first_not_of('-'), option.size())));
}

bool is_own(std::string_view option) { return std::ranges::find(kOwnOptions, option) != kOwnOptions.end(); }

// Returns the command, or nothing if a sweep cannot run it: it needs --json, and files that the sweep knows.
std::optional<SweptCommand> described(const Command& command) {
  if (command.name == "sweep" || command.name == "replay" || command.name == "generate") return std::nullopt;
  try {
    command.run({"--help"});
  } catch (const HelpRequest& help) {
    SweptCommand swept{std::string(command.name),
                       help.operand.find("INPUT") != std::string::npos,
                       help.operand.starts_with("INPUT"),
                       {}};
    const bool other_operand = !help.operand.empty() && !swept.takes_inputs;
    bool has_json = false;
    for (const OptionSpec& option : help.options) {
      const std::string name = bare(option.name);
      has_json = has_json || name == "json";
      if (name == "data") return std::nullopt;
      if (!is_own(name)) swept.options.push_back({name, std::string(option.value), option.count});
    }
    if (has_json && !(other_operand && help.operand.front() != '[')) return swept;
  }
  return std::nullopt;
}

const std::vector<SweptCommand>& all_swept() {
  static const std::vector<SweptCommand> all = [] {
    std::vector<SweptCommand> found;
    for (const Command& command : all_commands())
      if (auto swept = described(command)) found.push_back(std::move(*swept));
    return found;
  }();
  return all;
}

std::vector<std::string_view> views_of(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

void check_keys(const Json& object, const std::string& where, std::initializer_list<std::string_view> known) {
  if (object.members() == nullptr)
    throw InputError(fmt::format("{}: expected an object with the keys {}", where, fmt::join(known, ", ")));
  const std::vector<std::string_view> names(known);
  for (const auto& [key, value] : *object.members())
    if (std::ranges::find(names, key) == names.end())
      throw InputError(fmt::format("{}: unknown key '{}', expected one of {}{}", where, key,
                                   fmt::join(names, ", "), suggestion(key, names)));
}

std::string scalar_text(const Json& value, const std::string& where) {
  if (value.text() != nullptr) return *value.text();
  if (value.number()) return line_of(value).value_or("");
  throw InputError(fmt::format("{}: expected a text or a number", where));
}

fs::path in_folder(const fs::path& folder, const std::string& path) {
  return (folder / path).lexically_normal();  // an absolute path replaces the folder
}

// Makes the files of a value absolute, since tasks run in any folder.
std::string with_absolute_files(const std::string& option, const std::string& word, const fs::path& folder) {
  if (option == "radius" && word.starts_with(kRadiusFile))
    return std::string(kRadiusFile) + in_folder(folder, word.substr(kRadiusFile.size())).string();
  if (std::ranges::find(kFileOptions, option) == kFileOptions.end()) return word;
  std::error_code none;
  if (fs::exists(in_folder(folder, word), none))
    return in_folder(folder, word).string();  // commas in its name
  std::vector<std::string> files;
  for (const std::string& file : split(word, ','))
    files.push_back(file.empty() ? file : in_folder(folder, file).string());
  return fmt::format("{}", fmt::join(files, ","));
}

AxisValue read_value(const SweptCommand& command, const std::string& name, const Json& json,
                     const fs::path& folder, const std::string& where) {
  AxisValue value;
  if (json.is_null()) {
    value.given = false;
    return value;
  }
  if (name == stride_axis) {
    value.text = scalar_text(json, where);
    const auto stride = parse_whole_number(where, value.text, 1, 1'000'000'000);
    value.words = {std::to_string(stride)};
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
    value.words = {with_absolute_files(name, value.text, folder)};
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
  return value;
}

// Returns the option's name, without dashes.
std::string known_option(const SweptCommand& command, const std::string& key, const std::string& where) {
  const std::string name = bare(key);
  if (is_own(name))
    throw InputError(fmt::format(
        "{}: the sweep sets --{} of its tasks itself; expected an option that is a setting", where, name));
  const bool has_frames = command.find("frames") != nullptr;
  if (command.find(name) != nullptr || (has_frames && name == stride_axis)) return name;
  std::vector<std::string> names;
  for (const SweptCommand::Option& option : command.options) names.push_back(option.name);
  if (has_frames) names.emplace_back(stride_axis);
  throw InputError(fmt::format("{}: kds {} has no option --{}{} (see kds {} --help)", where, command.name,
                               name, suggestion(name, views_of(names)), command.name));
}

// An array lists the values of an axis. For an option with several values, each item is an array itself.
Axis read_axis(const SweptCommand& command, const std::string& key, const Json& json, const fs::path& folder,
               const std::string& where) {
  Axis axis{known_option(command, key, where), {}};
  const SweptCommand::Option* const option = command.find(axis.name);
  const Json::Items* const items = json.items();
  const bool one_of_several = option != nullptr && option->count > 1 && items != nullptr &&
                              (items->empty() || items->front().items() == nullptr);
  if (items == nullptr || one_of_several) {
    axis.values = {read_value(command, axis.name, json, folder, where)};
    return axis;
  }
  if (items->empty()) throw InputError(where + ": has no value; expected at least one");
  std::set<std::pair<bool, std::vector<std::string>>> listed;
  for (const Json& item : *items) {
    axis.values.push_back(read_value(command, axis.name, item, folder, where));
    const AxisValue& value = axis.values.back();
    if (!listed.emplace(value.given, value.words).second)
      throw InputError(fmt::format("{}: value '{}' is listed twice", where, value.text));
  }
  return axis;
}

// Returns a pattern that matches the path only.
fs::path as_pattern(const fs::path& path) {
  std::string pattern;
  for (const char c : path.string()) {
    if (std::string_view("*?[\\").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

std::vector<std::string> found_files(const std::string& pattern, const fs::path& folder,
                                     const std::string& where) {
  if (pattern.find("**") != std::string::npos)
    throw InputError(fmt::format(
        "{}: '{}': ** is not supported; expected one pattern for each depth of folders", where, pattern));
  glob_t found{};
  const int failed = ::glob(in_folder(as_pattern(folder), pattern).c_str(), 0, nullptr, &found);
  const std::unique_ptr<glob_t, decltype(&::globfree)> owner(&found, &::globfree);
  if (failed == GLOB_NOMATCH || (failed == 0 && found.gl_pathc == 0))
    throw InputError(fmt::format("{}: no file matches '{}' in {}", where, pattern, folder.string()));
  if (failed != 0) throw InputError(fmt::format("{}: cannot list the files of '{}'", where, pattern));
  return {found.gl_pathv, found.gl_pathv + found.gl_pathc};
}

// Returns the path as sweep.json would give it.
std::string short_name(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return relative.empty() ? file.string() : relative.string();
}

std::vector<SweepInput> inputs_from(const SweptCommand& command, const Json& item, const fs::path& folder,
                                    const std::string& where) {
  const Json* files = &item;
  std::vector<std::pair<std::string, AxisValue>> options;
  if (item.members() != nullptr) {
    files = item.find("file");
    if (files == nullptr)
      throw InputError(where +
                       ": an input that is an object needs the key 'file', beside options of the input");
    for (const auto& [key, value] : *item.members()) {
      if (key == "file") continue;
      const std::string name = known_option(command, key, where);
      options.emplace_back(name, read_value(command, name, value, folder, fmt::format("{}: {}", where, key)));
    }
  }
  std::vector<SweepInput> inputs;
  if (files->items() != nullptr) {  // several files of one task
    SweepInput input{{}, {}, options};
    std::vector<std::string> names;
    for (const Json& file : *files->items()) {
      names.push_back(scalar_text(file, where));
      input.files.push_back(in_folder(folder, names.back()).string());
    }
    if (names.empty()) throw InputError(where + ": 'file' lists no file");
    input.name = fmt::format("{}", fmt::join(names, " "));
    return {input};
  }
  if (files->text() == nullptr || files->text()->empty())
    throw InputError(where + ": expected a path, or an object with the key 'file'");
  const std::string& path = *files->text();
  std::error_code none;
  if (path.find_first_of("*?[") == std::string::npos || fs::exists(in_folder(folder, path), none))
    return {{path, {in_folder(folder, path).string()}, options}};
  for (const std::string& file : found_files(path, folder, where))
    inputs.push_back({short_name(file, folder), {file}, options});
  return inputs;
}

std::vector<SweepInput> read_inputs(const SweptCommand& command, const Json& json, const fs::path& folder,
                                    const std::string& where) {
  if (json.items() == nullptr) return inputs_from(command, json, folder, where);
  std::vector<SweepInput> inputs;
  for (std::size_t k = 0; k < json.items()->size(); ++k)
    for (SweepInput& input :
         inputs_from(command, (*json.items())[k], folder, fmt::format("{}[{}]", where, k)))
      inputs.push_back(std::move(input));
  return inputs;
}

std::size_t read_whole(const Json& json, const std::string& where, std::size_t most) {
  return parse_whole_number(where, line_of(json).value_or("?"), 1, most);
}

// Steps are cut from one another only where the motion of a step and the events in it depend on that step
// alone.
void refuse_parts(const SweepBlock& block, const std::string& where) {
  if (block.command->name != "run")
    throw InputError(
        fmt::format("{}: results of kds {} are not sums over steps, so its trajectories cannot be cut; "
                    "expected command run",
                    where, block.command->name));
  const auto refuse = [&](const std::string& option, const AxisValue& value) {
    if (!value.given) return;
    const bool cuttable = option != "tolerance" && option != "certify" && option != "relax" &&
                          option != "log" && option != "rounds" &&
                          !(option == "motion" && value.text == "hermite");
    if (!cuttable)
      throw InputError(
          fmt::format("{}: steps depend on frames outside of a part with --{}{}{}; expected no "
                      "part_steps beside it",
                      where, option, value.words.empty() ? "" : " ", value.text));
  };
  for (const Axis& axis : block.axes)
    for (const AxisValue& value : axis.values) refuse(axis.name, value);
  for (const SweepInput& input : block.inputs) {
    if (input.files.size() > 1)
      throw InputError(
          fmt::format("{}: '{}' is several files; expected one file for parts", where, input.name));
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
        (strides || block.part_steps))
      throw InputError(fmt::format("{}: --frames {}: expected FIRST:LAST beside {}", where, value.text,
                                   strides ? "the option stride" : "part_steps"));
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
                      const std::string& where, const std::string& subject) {
  Json whole = json;
  if (json.text() != nullptr) whole = {{"command", *json.text()}};
  check_keys(whole, where, {"command", "inputs", "options", "part_steps"});
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
    block.inputs =
        read_inputs(*block.command, *inputs, folder, (own_inputs != nullptr ? where : subject) + ": inputs");
  tell_apart(block.inputs);
  if (block.inputs.empty() && block.command->needs_inputs)
    throw InputError(fmt::format("{}: kds {} needs inputs", where, block.command->name));
  if (block.inputs.empty()) block.inputs.emplace_back();  // one task for each setting
  if (const Json* const options = whole.find("options")) {
    if (options->members() == nullptr)
      throw InputError(fmt::format("{}: options: expected an object with options of kds {} as keys", where,
                                   block.command->name));
    for (const auto& [key, value] : *options->members()) {
      Axis axis = read_axis(*block.command, key, value, folder, fmt::format("{}: {}", where, key));
      for (const Axis& other : block.axes)
        if (other.name == axis.name)
          throw InputError(fmt::format("{}: option {} is listed twice", where, axis.name));
      block.axes.push_back(std::move(axis));
    }
  }
  if (const Json* const steps = whole.find("part_steps"))
    block.part_steps = read_whole(*steps, where + ": part_steps", 1'000'000'000);
  refuse_settings_twice(block, where);
  refuse_two_strides(block, where);
  if (block.part_steps) refuse_parts(block, where);
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
                                 fmt::join(names, ", "), suggestion(name, views_of(names))));
}

}  // namespace

const SweptCommand::Option* SweptCommand::find(std::string_view option) const {
  const auto found = std::ranges::find(options, option, &Option::name);
  return found == options.end() ? nullptr : &*found;
}

const std::vector<std::string>& swept_commands() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const SweptCommand& command : all_swept()) all.push_back(command.name);
    return all;
  }();
  return names;
}

const SweptCommand& swept_command(const std::string& name, const std::string& subject) {
  for (const SweptCommand& command : all_swept())
    if (command.name == name) return command;
  throw InputError(fmt::format("{}: '{}' is no command that can be swept, expected one of {}{}", subject,
                               name, fmt::join(swept_commands(), ", "),
                               suggestion(name, views_of(swept_commands()))));
}

bool matches(std::string_view text, std::string_view pattern) {
  return ::fnmatch(std::string(pattern).c_str(), std::string(text).c_str(), 0) == 0;
}

std::vector<std::string> files_of_value(const std::string& option, const AxisValue& value) {
  std::vector<std::string> files;
  if (!value.given || value.words.empty()) return files;
  const std::string& word = value.words.front();
  if (option == "radius" && word.starts_with(kRadiusFile)) files.push_back(word.substr(kRadiusFile.size()));
  if (std::ranges::find(kFileOptions, option) == kFileOptions.end()) return files;
  std::error_code none;
  if (fs::exists(word, none)) return {word};
  for (std::string& file : split(word, ','))
    if (!file.empty()) files.push_back(std::move(file));
  return files;
}

SweepSpec read_sweep(const Json& json, const fs::path& folder, const std::string& subject) {
  check_keys(json, subject, {"inputs", "commands", "seeds", "exclude", "pool"});
  const Json* const commands = json.find("commands");
  if (commands == nullptr || commands->items() == nullptr || commands->items()->empty())
    throw InputError(
        fmt::format("{}: needs the key 'commands', an array of objects such as {{\"command\": \"run\", "
                    "\"options\": {{...}}}}",
                    subject));
  SweepSpec spec;
  for (std::size_t k = 0; k < commands->items()->size(); ++k)
    spec.blocks.push_back(read_block((*commands->items())[k], json.find("inputs"), folder,
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
        const std::string name = bare(key);
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
