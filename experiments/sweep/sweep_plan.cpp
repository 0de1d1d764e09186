#include "experiments/sweep/sweep_plan.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "experiments/output/text.h"
#include "experiments/sweep/refuse.h"
#include "experiments/sweep/results_version.h"

namespace kds {

namespace {

constexpr std::size_t most_tasks = 10'000'000;  // about 100 bytes each, with their states

// Adds the content of a file, and its ending, which may decide the format. A file that cannot be read is
// named by its path.
void add_file(TextHash& name, const std::string& file, InputFiles& files) {
  const std::uint64_t content = files.hash(file);
  name.add(std::filesystem::path(file).extension().string());
  name.add(hex_digits(content));
  if (content == 0) name.add(file);
}

void append(Arguments& arguments, const std::string& option, const std::vector<std::string>& words) {
  arguments.push_back("--" + option);
  arguments.insert(arguments.end(), words.begin(), words.end());
}

}  // namespace

SweepPlan::SweepPlan(SweepSpec spec, InputFiles& files, const std::string& subject)
    : spec_(std::move(spec)), exclusion_matched_(spec_.exclusions.size()) {
  for (std::uint32_t block = 0; block < spec_.blocks.size(); ++block) add_tasks(block, files, subject);
  if (tasks_.empty()) refuse("{}: exclude leaves no task", subject);
  refuse_idle_exclusions(subject);
  mark_copies(subject);
}

void SweepPlan::add_tasks(std::uint32_t block, InputFiles& files, const std::string& subject) {
  const auto refuse_more_than_most = [&](std::uint64_t tasks) {
    if (tasks > most_tasks)
      refuse("{}: commands[{}]: has more than {} tasks; expected fewer values of options", subject, block,
             with_thousands(most_tasks));
  };
  std::uint64_t settings = 1;
  for (const Axis& axis : spec_.blocks[block].axes) {
    settings *= axis.values.size();
    refuse_more_than_most(settings * spec_.blocks[block].inputs.size());
  }
  SweepTask task;
  task.block = block;
  for (task.input = 0; task.input < spec_.blocks[block].inputs.size(); ++task.input)
    for (task.setting = 0; task.setting < settings; ++task.setting)
      if (is_excluded(task)) {
        ++excluded_;
      } else {
        tasks_.push_back(task);
        tasks_.back().name = name_of(task, files);
      }
  refuse_more_than_most(tasks_.size());
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
    std::string patterns;
    bool of_inputs = false;
    for (const auto& [axis, pattern] : spec_.exclusions[k]) {
      patterns += fmt::format("{}{} '{}'", patterns.empty() ? "" : " and ", axis, pattern);
      of_inputs = of_inputs || axis == "input";
    }
    if (!exclusion_matched_[k] && !of_inputs)
      refuse("{}: exclude[{}]: no task has {}; expected patterns that leave out a task", subject, k,
             patterns);
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
  for (const auto& [option, value] : input(task).options) options.emplace_back(option, &value);
  for (const Axis& axis : block(task).axes) options.emplace_back(axis.name, value(task, axis.name));
  std::erase_if(options, [](const auto& option) { return !option.second->given; });
  std::ranges::sort(options, {}, [](const auto& option) { return option.first; });
  return options;
}

// A stride is the third part of --frames.
Arguments SweepPlan::arguments(const SweepTask& task) const {
  Arguments arguments{block(task).command->name};
  const std::vector<std::string>& files = input(task).files;
  arguments.insert(arguments.end(), files.begin(), files.end());
  const AxisValue* const stride = value(task, stride_axis);
  const bool strided = stride != nullptr && stride->given;
  std::string range = ":";
  for (const auto& [option, value] : options_of(task))
    if (option == "frames" && strided)
      range = value->words.front();
    else if (option != stride_axis)
      append(arguments, option, value->words);
  if (strided) append(arguments, "frames", {range + ":" + stride->words.front()});
  return arguments;
}

TaskName SweepPlan::name_of(const SweepTask& task, InputFiles& files) const {
  TextHash name;
  name.add(hex_digits(results_version()));
  name.add(block(task).command->name);
  for (const std::string& file : input(task).files) add_file(name, file, files);
  for (const auto& [option, value] : options_of(task)) {
    name.add(option);
    for (const std::string& file : value->files) add_file(name, file, files);
    if (value->files.empty())
      for (const std::string& word : value->words) name.add(word);
    name.add(value->shape);
  }
  return name.value();
}

void SweepPlan::mark_copies(const std::string& subject) {
  std::unordered_map<TaskName, SweepTask*> named;
  std::set<std::pair<std::string, std::string>> pairs;
  const auto settings = [&](const SweepTask& task) {
    std::string text = fmt::format("{} {}", block(task).command->name, input(task).files.size());
    for (const auto& [option, value] : options_of(task))
      text += fmt::format(" {} {} {}", option, value->shape,
                          value->files.empty() ? fmt::format("{}", fmt::join(value->words, " ")) : "");
    return text;
  };
  for (SweepTask& task : tasks_) {
    const auto [found, is_new] = named.emplace(task.name, &task);
    if (is_new) continue;
    SweepTask& first = *found->second;
    const std::string words = shell_words(arguments(task)), first_words = shell_words(arguments(first));
    if (words == first_words)
      refuse(
          "{}: task 'kds {}' is listed twice and would count twice in means; expected each input and setting "
          "once",
          subject, words);
    if (settings(task) != settings(first))
      refuse("{}: tasks '{}' and '{}' have the same hash; change an option of one of them", subject, words,
             first_words);
    task.is_copy = task.has_copies = first.has_copies = true;
    const std::vector<std::string> own = files(task), its = files(first);
    for (std::size_t k = 0; k < std::min(own.size(), its.size()); ++k)
      if (own[k] != its[k] && pairs.emplace(own[k], its[k]).second)
        copies_.push_back(
            fmt::format("{} has the same content as {}; their results count once in means", own[k], its[k]));
  }
}

std::vector<std::string> SweepPlan::files(const SweepTask& task) const {
  std::vector<std::string> files = input(task).files;
  for (const auto& [option, value] : options_of(task))
    files.insert(files.end(), value->files.begin(), value->files.end());
  return files;
}

}  // namespace kds
