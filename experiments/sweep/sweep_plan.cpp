#include "experiments/sweep/sweep_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <unordered_map>

#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr std::size_t most_tasks = 10'000'000;  // about 100 bytes each

constexpr std::array<std::string_view, 9> kReadingOptions{
    "topology", "select", "chain", "format", "dt", "units", "groups", "until-damage", "obstacle"};

std::string stride_of(const SweepPlan& plan, const SweepTask& task) {
  const AxisValue* const stride = plan.value(task, stride_axis);
  return stride != nullptr && stride->given ? stride->words.front() : "1";
}

// Returns FIRST:LAST of --frames, or : if the task reads all frames.
std::string range_of(const std::vector<std::pair<std::string, const AxisValue*>>& options) {
  for (const auto& [option, value] : options)
    if (option == "frames" && value->given) return value->words.front();
  return ":";
}

// Returns which items of a comma list are empty: the files of a list are named by their content alone.
std::string shape_of(const std::string& list) {
  std::string shape;
  for (const std::string& item : split(list, ',')) shape += item.empty() ? '-' : '+';
  return shape;
}

// Adds the content of a file, and its ending, which may decide the format. A file that cannot be read is
// named by its path.
void add_file(TextHash& name, const std::string& file, InputHashes& hashes) {
  const std::uint64_t content = hashes.hash(file);
  name.add(std::filesystem::path(file).extension().string());
  name.add(hex_digits(content));
  if (content == 0) name.add(file);
}

void append(Arguments& arguments, const std::string& option, const std::vector<std::string>& words) {
  arguments.push_back("--" + option);
  arguments.insert(arguments.end(), words.begin(), words.end());
}

}  // namespace

SweepPlan::SweepPlan(SweepSpec spec, InputHashes& hashes, const std::string& subject)
    : spec_(std::move(spec)), exclusion_matched_(spec_.exclusions.size()) {
  for (std::uint32_t block = 0; block < spec_.blocks.size(); ++block) add_tasks(block, hashes, subject);
  if (tasks_.empty()) throw InputError(subject + ": exclude leaves no task");
  refuse_idle_exclusions(subject);
  refuse_equal_names(subject);
}

void SweepPlan::add_tasks(std::uint32_t block, InputHashes& hashes, const std::string& subject) {
  const auto refuse_more_than_most = [&](std::uint64_t tasks) {
    if (tasks > most_tasks)
      throw InputError(
          fmt::format("{}: commands[{}]: has more than {} tasks; expected fewer values of options", subject,
                      block, with_thousands(most_tasks)));
  };
  std::uint64_t settings = 1;
  for (const Axis& axis : spec_.blocks[block].axes) {
    settings *= axis.values.size();
    refuse_more_than_most(settings * spec_.blocks[block].inputs.size());
  }
  SweepTask task;
  task.block = block;
  for (task.input = 0; task.input < spec_.blocks[block].inputs.size(); ++task.input)
    for (task.setting = 0; task.setting < settings; ++task.setting) {
      if (is_excluded(task)) {
        ++excluded_;
      } else if (spec_.blocks[block].segment_steps) {
        add_segments(task, hashes);
      } else {
        tasks_.push_back(task);
        tasks_.back().name = name_of(task, hashes);
      }
      refuse_more_than_most(tasks_.size());
    }
}

void SweepPlan::add_segments(const SweepTask& whole, InputHashes& hashes) {
  const auto options = options_of(whole);
  const std::string stride = stride_of(*this, whole), range = range_of(options);
  Arguments reading{input(whole).files};
  TextHash key;
  for (const std::string& file : reading) key.add(hex_digits(hashes.hash(file)));
  std::string radius = "auto";
  for (const auto& [option, value] : options) {
    if (option == "radius" && value->given) radius = value->words.front();
    if (option != "radius" && std::ranges::find(kReadingOptions, option) == kReadingOptions.end()) continue;
    if (!value->given) continue;
    append(reading, option, value->words);
    key.add(option);
    for (const std::string& word : value->words) key.add(word);
    for (const std::string& file : value->files) key.add(hex_digits(hashes.hash(file)));
  }
  append(reading, "frames", {range + ":" + stride});
  key.add(range + ":" + stride);
  key.add(program_version());
  const auto found = hashes.frames(key.value(), reading);
  const std::uint64_t steps = found && found->frames > 1 ? found->frames - 1 : 0;
  const std::uint64_t most = *block(whole).segment_steps;
  if (steps <= most) {
    tasks_.push_back(whole);
    tasks_.back().name = name_of(whole, hashes);
    return;
  }
  std::uint64_t first = 0, every = 1;
  const std::string begin = range.substr(0, range.find(':'));
  std::from_chars(begin.data(), begin.data() + begin.size(), first);
  std::from_chars(stride.data(), stride.data() + stride.size(), every);
  const std::uint64_t segments = (steps + most - 1) / most;
  for (std::uint64_t segment = 0; segment < segments; ++segment) {
    SweepTask task = whole;
    task.segment = static_cast<std::uint32_t>(segment);
    task.segments = static_cast<std::uint32_t>(segments);
    task.first_frame = first + steps * segment / segments * every;
    task.last_frame = first + steps * (segment + 1) / segments * every;
    task.radius = found->radius;
    task.name = name_of(task, hashes);
    tasks_.push_back(std::move(task));
  }
}

bool SweepPlan::is_excluded(const SweepTask& task) {
  bool excluded = false;
  for (std::size_t k = 0; k < spec_.exclusions.size(); ++k) {
    const bool matched = std::ranges::all_of(spec_.exclusions[k], [&](const auto& axis) {
      return (axis.first == "command" || axis.first == "input" || value(task, axis.first) != nullptr) &&
             matches(text(task, axis.first), axis.second);
    });
    exclusion_matched_[k] = exclusion_matched_[k] || matched;
    excluded = excluded || matched;
  }
  return excluded;
}

// An exclusion that matches no task is misspelt, and tasks would run that were to be left out. Files come and
// go, so an exclusion of inputs may match none.
void SweepPlan::refuse_idle_exclusions(const std::string& subject) const {
  for (std::size_t k = 0; k < spec_.exclusions.size(); ++k) {
    const bool of_inputs =
        std::ranges::any_of(spec_.exclusions[k], [](const auto& axis) { return axis.first == "input"; });
    if (exclusion_matched_[k] || of_inputs) continue;
    std::string patterns;
    for (const auto& [axis, pattern] : spec_.exclusions[k])
      patterns += fmt::format("{}{} '{}'", patterns.empty() ? "" : " and ", axis, pattern);
    throw InputError(fmt::format("{}: exclude[{}]: no task has {}; expected patterns that leave out a task",
                                 subject, k, patterns));
  }
}

const AxisValue* SweepPlan::value(const SweepTask& task, std::string_view name) const {
  std::uint64_t setting = task.setting;
  const std::vector<Axis>& axes = block(task).axes;
  for (std::size_t k = axes.size(); k-- > 0;) {  // the last axis changes fastest
    const std::uint64_t count = axes[k].values.size();
    if (axes[k].name == name) return &axes[k].values[setting % count];
    setting /= count;
  }
  for (const auto& [option, of_input] : input(task).options)
    if (option == name) return &of_input;
  return nullptr;
}

std::string SweepPlan::text(const SweepTask& task, std::string_view axis) const {
  if (axis == "command") return block(task).command->name;
  if (axis == "input") return input(task).name;
  const AxisValue* const found = value(task, axis);
  return found != nullptr ? found->text : std::string();
}

std::vector<std::string> SweepPlan::axes() const {
  std::vector<std::string> names;
  for (const SweepBlock& block : spec_.blocks)
    for (const Axis& axis : block.axes)
      if (std::ranges::find(names, axis.name) == names.end()) names.push_back(axis.name);
  return names;
}

std::vector<std::pair<std::string, const AxisValue*>> SweepPlan::options_of(const SweepTask& task) const {
  std::vector<std::pair<std::string, const AxisValue*>> options;
  for (const auto& [option, value] : input(task).options)
    if (option != stride_axis) options.emplace_back(option, &value);
  for (const Axis& axis : block(task).axes)
    if (axis.name != stride_axis) options.emplace_back(axis.name, value(task, axis.name));
  std::ranges::sort(options, {}, [](const auto& option) { return option.first; });
  return options;
}

Arguments SweepPlan::arguments(const SweepTask& task) const {
  Arguments arguments{block(task).command->name};
  const std::vector<std::string>& files = input(task).files;
  arguments.insert(arguments.end(), files.begin(), files.end());
  const auto options = options_of(task);
  const AxisValue* const stride = value(task, stride_axis);
  const bool strided = stride != nullptr && stride->given;
  for (const auto& [option, value] : options)
    if (value->given && !(option == "frames" && (strided || task.segments > 1)) &&
        !(option == "radius" && !task.radius.empty()))
      append(arguments, option, value->words);
  if (task.segments > 1)
    append(arguments, "frames",
           {fmt::format("{}:{}:{}", task.first_frame, task.last_frame + 1,
                        strided ? stride->words.front() : "1")});
  else if (strided)
    append(arguments, "frames", {range_of(options) + ":" + stride->words.front()});
  if (!task.radius.empty()) append(arguments, "radius", {task.radius});
  return arguments;
}

TaskName SweepPlan::name_of(const SweepTask& task, InputHashes& hashes) const {
  TextHash name;
  name.add(program_version());
  name.add(block(task).command->name);
  for (const std::string& file : input(task).files) add_file(name, file, hashes);
  for (const auto& [option, value] : options_of(task)) {
    if (!value->given) continue;
    name.add(option);
    for (const std::string& file : value->files) add_file(name, file, hashes);
    if (value->files.empty())
      for (const std::string& word : value->words) name.add(word);
    else
      name.add(value->lists_files() ? shape_of(value->words.front()) : "+");
  }
  name.add(stride_of(*this, task));
  name.add(task.segments > 1 ? fmt::format("{} {} {}", task.first_frame, task.last_frame, task.radius) : "");
  return name.value();
}

// Two tasks may share a name only if they have equal files under two names.
void SweepPlan::refuse_equal_names(const std::string& subject) const {
  std::unordered_map<TaskName, const SweepTask*> named;
  for (const SweepTask& task : tasks_) {
    const auto [found, is_new] = named.emplace(task.name, &task);
    if (is_new) continue;
    const std::string words = shell_words(arguments(task));
    if (words == shell_words(arguments(*found->second)))
      throw InputError(fmt::format(
          "{}: task 'kds {}' is listed twice and would count twice in means; expected each input and setting "
          "once",
          subject, words));
    const auto settings = [&](const SweepTask& one) {
      std::string text = block(one).command->name + " " + stride_of(*this, one);
      for (const auto& [option, value] : options_of(one))
        if (value->given && value->files.empty())
          text += fmt::format(" {} {}", option, fmt::join(value->words, " "));
      return fmt::format("{} {} {} {}", text, input(one).files.size(), one.first_frame, one.last_frame);
    };
    if (settings(task) != settings(*found->second))
      throw InputError(
          fmt::format("{}: tasks '{}' and '{}' have the same hash; change an option of one of them", subject,
                      words, shell_words(arguments(*found->second))));
  }
}

std::vector<std::string> SweepPlan::files(const SweepTask& task) const {
  std::vector<std::string> files = input(task).files;
  for (const auto& [option, value] : options_of(task))
    files.insert(files.end(), value->files.begin(), value->files.end());
  return files;
}

double SweepPlan::size(const SweepTask& task, const InputHashes& hashes) const {
  double bytes = 0;
  for (const std::string& file : input(task).files) bytes += static_cast<double>(hashes.bytes(file));
  return std::max(bytes, 1.0) / std::stod(stride_of(*this, task)) / task.segments;
}

}  // namespace kds
