#include "experiments/sweep/collect_sweep.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <unordered_map>

#include "experiments/output/output_files.h"
#include "experiments/output/report_page.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/sweep/pooled_figures.h"
#include "experiments/sweep/refuse.h"
#include "experiments/sweep/result_rows.h"
#include "motions/base/text_input.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostOnPage = 5'000, kBytesOnPage = 1'000'000, kMostNamed = 3;
constexpr std::string_view kDone = "\"done\": ";

Field field_from(const Json& json) {
  if (json.text() != nullptr) return Field(*json.text());
  if (json.truth() != nullptr) return Field(*json.truth());
  if (json.whole_number() != nullptr) return Field(*json.whole_number());
  if (const auto number = json.number()) return Field(*number);
  return {};
}

// A CSV table with fixed columns, and columns for all fields that were announced before the first row.
class WideTable {
 public:
  explicit WideTable(std::vector<std::string> fixed) : fixed_(std::move(fixed)) {}

  void announce(const RowFields& fields) {
    for (const auto& [name, value] : fields) {
      if (!by_name_.emplace(name, columns_.size()).second) continue;
      // An axis may have the name of a field, such as stride.
      columns_.push_back(std::ranges::find(fixed_, name) == fixed_.end() ? name : "result." + name);
    }
  }
  [[nodiscard]] std::string header() const {
    std::vector<std::string> cells;
    for (const auto* names : {&fixed_, &columns_})
      for (const std::string& name : *names) cells.push_back(Field(name).csv());
    return fmt::format("{}\n", fmt::join(cells, ","));
  }
  [[nodiscard]] std::string csv(const std::vector<std::string>& fixed, const RowFields& fields) const {
    std::vector<std::string> cells;
    for (const std::string& text : fixed) cells.push_back(text_or_nothing(text).csv());
    cells.resize(fixed.size() + columns_.size());
    for (const auto& [name, value] : fields)
      cells[fixed.size() + by_name_.at(name)] = field_from(value).csv();
    return fmt::format("{}\n", fmt::join(cells, ","));
  }
  [[nodiscard]] Json json(const std::vector<std::string>& fixed, const RowFields& fields) const {
    Json row = Json::object();
    for (std::size_t c = 0; c < fixed_.size(); ++c)
      row[fixed_[c]] = fixed[c].empty() ? Json() : Json(fixed[c]);
    for (const auto& [name, value] : fields) row[columns_[by_name_.at(name)]] = value;
    return row;
  }

 private:
  std::vector<std::string> fixed_, columns_;
  std::unordered_map<std::string, std::size_t> by_name_;
};

struct TaskResult {
  double seconds = 0, processor_seconds = 0;
  std::vector<std::string> warnings;
  std::vector<ResultRow> rows;
};

TaskResult result_of(const TaskStates& states, const SweepTask& task) {
  const Json record = states.read(states.of(task.name).span);
  const Json *const result = record.find("result"), *const warnings = record.find("warnings");
  if (result == nullptr || result->members() == nullptr)
    throw OutputError(fmt::format("task {}: its record has no result", hex_digits(task.name)));
  const auto number = [&](std::string_view name) {
    const Json* const found = record.find(name);
    return found != nullptr ? found->number().value_or(0) : 0;
  };
  TaskResult found{number("seconds"), number("processor_seconds"), {}, rows_of_result(*result)};
  if (warnings != nullptr && warnings->items() != nullptr)
    for (const Json& warning : *warnings->items())
      if (warning.text() != nullptr) found.warnings.push_back(*warning.text());
  return found;
}

// Returns the times of a row, which begin with those of the task in its first row.
RowFields times_of(const TaskResult& result, std::size_t row) {
  RowFields times;
  if (row == 0)
    times = {{"task_seconds", result.seconds}, {"task_processor_seconds", result.processor_seconds}};
  times.insert(times.end(), result.rows[row].times.begin(), result.rows[row].times.end());
  return times;
}

// Writes a CSV file row by row, and keeps the first rows for the page.
template <class Row>
class Listing {
 public:
  Listing(Table<Row> table, std::ostream& stream) : table_(std::move(table)), stream_(stream) {
    stream_ << table_.csv_header();
  }
  void add(Row row, bool on_page = true) {
    stream_ << table_.csv_line(row);
    if (!on_page) return;
    if (first_.size() == kMostOnPage) {
      ++left_out_;
    } else {
      first_.push_back(std::move(row));
    }
  }
  /// Adds the rows that the page shows to its data as a member, and how many are left out.
  void add_to(Json& page, const char* name) const {
    page[name] = table_.json(first_);
    if (left_out_ > 0) page["left_out"][name] = left_out_;
  }

 private:
  Table<Row> table_;
  std::ostream& stream_;
  std::vector<Row> first_;
  std::size_t left_out_ = 0;  // rows that are only in the file because there are too many
};

// The results that the page shows: the first ones, up to kBytesOnPage.
class RowsOnPage {
 public:
  // `bytes` is the size of the row's line.
  void add(const Json& row, std::size_t bytes) {
    bytes_ += bytes;
    if (bytes_ > kBytesOnPage) {
      ++left_out_;
    } else {
      rows_.add(row);
    }
  }
  // Returns the text of the page's data with these rows.
  [[nodiscard]] std::string text_within(Json page) const {
    if (left_out_ > 0) page["left_out"]["rows"] = left_out_;
    std::string text;
    rows_.write_within(page, "rows", [&](std::string_view piece) { text += piece; });
    return text;
  }

 private:
  JsonItems rows_;
  std::size_t bytes_ = 0, left_out_ = 0;
};

// Returns the tasks that are done in the order of their groups, whose first tasks are in the order of the
// plan, and the number of the group of each.
std::vector<std::pair<std::uint32_t, std::uint32_t>> tasks_by_group(const SweepPlan& plan,
                                                                    const TaskStates& states,
                                                                    const std::vector<std::string>& names) {
  std::unordered_map<std::uint64_t, std::uint32_t> groups;  // groups, by the hash of their names
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tasks;
  for (std::size_t k = 0; k < plan.tasks().size(); ++k) {
    const SweepTask& task = plan.tasks()[k];
    if (states.of(task.name).status() != TaskStatus::done) continue;
    TextHash key;
    for (const std::string& name : names) key.add(plan.text(task, name));
    const auto group = groups.emplace(key.value(), static_cast<std::uint32_t>(groups.size())).first;
    tasks.emplace_back(group->second, static_cast<std::uint32_t>(k));
  }
  std::ranges::sort(tasks);
  return tasks;
}

// A table of few results must not take the place of one of more, for instance because kds is another version.
void refuse_to_empty(const fs::path& folder, const SweepCount& all, const TaskStates& states) {
  std::array<char, 400> head{};
  std::ifstream(folder / "results.json").read(head.data(), head.size() - 1);
  const std::string_view text(head.data());
  const std::size_t at = text.find(kDone);
  const std::uint64_t before =
      at == std::string_view::npos ? 0 : std::strtoull(head.data() + at + kDone.size(), nullptr, 10);
  if (all.done == all.tasks || all.done >= before) return;
  std::string others = other_versions_text(states);
  std::ranges::replace(others, '\n', ';');
  refuse(
      "{}: results.json has results of {} and would be replaced by {} of {};{}{} run the sweep first, or "
      "remove "
      "results.json",
      folder.string(), counted(before, "task"), with_thousands(all.done), with_thousands(all.tasks),
      others.empty() ? "" : " ", others);
}

// Writes an object on one line, if it is UTF-8. File names need not be.
std::string json_line(const Json& row) {
  const auto line = line_of(row);
  return line ? *line : text_of(row);
}

void list_failures(const SweepPlan& plan, const TaskStates& states, Listing<TaskMessage>& failed) {
  for (const SweepTask& task : plan.tasks())
    if (auto failure = failure_of(plan, task, states)) failed.add(std::move(*failure));
}

}  // namespace

CollectedSweep collect_sweep(const SweepPlan& plan, const TaskStates& states, const fs::path& folder,
                             const std::string& command_line) {
  CollectedSweep collected{count_tasks(plan, states, false).back(), 0, {}};
  refuse_to_empty(folder, collected.all, states);
  const std::vector<std::string>& pooled = plan.spec().pooled;
  std::vector<std::string> fixed{"command", "input"}, group_names;
  for (const std::string& axis : plan.axes()) fixed.push_back(axis);
  std::ranges::copy_if(fixed, std::back_inserter(group_names), [&](const std::string& axis) {
    return std::ranges::find(pooled, axis) == pooled.end();
  });
  std::vector<std::string> columns{"task"};
  columns.insert(columns.end(), fixed.begin(), fixed.end());
  WideTable results(columns), times({"task", "row"});

  AtomicFiles out;
  Listing<MeanOfTasks> means(pooled_table({group_names.begin() + 1, group_names.end()}),
                             out.open(folder / "pooled.csv"));
  const auto tasks = tasks_by_group(plan, states, group_names);
  PooledGroup group;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const SweepTask& task = plan.tasks()[tasks[k].second];
    const TaskResult result = result_of(states, task);
    group.add(task, result.rows, pooled);
    for (std::size_t row = 0; row < result.rows.size(); ++row) {
      results.announce(result.rows[row].fields);
      times.announce(times_of(result, row));
    }
    if (k + 1 < tasks.size() && tasks[k + 1].first == tasks[k].first) continue;
    std::vector<std::string> texts;
    for (const std::string& name : group_names) texts.push_back(plan.text(task, name));
    for (const PooledFigure& figure : group.figures())
      means.add({texts, figure}, figure.mean != 0 || figure.squares != 0);
    group = {};
  }

  std::ostream &csv = out.open(folder / "results.csv"), &json = out.open(folder / "results.json"),
               &of_times = out.open(folder / "times.csv");
  Listing<TaskMessage> failed(message_table(true), out.open(folder / "failed.csv"));
  Listing<TaskMessage> warnings(message_table(false), out.open(folder / "warnings.csv"));
  csv << results.header();
  of_times << times.header();
  json << fmt::format("{{\n  \"version\": \"{}\",\n  \"tasks\": {},\n  {}{},\n  \"rows\": [",
                      program_version(), collected.all.tasks, kDone, collected.all.done);
  RowsOnPage on_page;
  for (const SweepTask& task : plan.tasks()) {
    const TaskStatus status = states.of(task.name).status();
    if (status == TaskStatus::open && collected.first_missing.size() < kMostNamed)
      collected.first_missing.push_back("kds " + shell_words(plan.arguments(task)));
    if (status != TaskStatus::done) continue;
    const TaskResult result = result_of(states, task);
    std::vector<std::string> texts{hex_digits(task.name)};
    for (const std::string& name : fixed) texts.push_back(plan.text(task, name));
    for (std::size_t row = 0; row < result.rows.size(); ++row) {
      const RowFields& fields = result.rows[row].fields;
      csv << results.csv(texts, fields);
      const Json object = results.json(texts, fields);
      const std::string line = json_line(object);
      json << (collected.rows++ > 0 ? ",\n    " : "\n    ") << line;
      on_page.add(object, line.size());
      of_times << times.csv({texts.front(), std::to_string(row)}, times_of(result, row));
    }
    for (const std::string& warning : result.warnings) warnings.add(message_of(plan, task, warning));
  }
  json << "\n  ]\n}\n";
  list_failures(plan, states, failed);

  Json page{
      {"kind", "sweep"},  {"tasks", collected.all.tasks}, {"done", collected.all.done}, {"axes", plan.axes()},
      {"pooled", pooled}, {"left_out", Json::object()},   {"warnings", plan.copies()}};
  means.add_to(page, "means");
  failed.add_to(page, "failed");
  warnings.add_to(page, "warned");
  add_provenance(page, command_line);
  write_report(out, folder / report_name, on_page.text_within(std::move(page)),
               {{"results.csv", "results.json", "pooled.csv", "times.csv", "failed.csv", "warnings.csv"}});
  commit_together({&out});
  return collected;
}

void write_failed(const SweepPlan& plan, const TaskStates& states, const fs::path& folder) {
  AtomicFiles out;
  Listing<TaskMessage> failed(message_table(true), out.open(folder / "failed.csv"));
  list_failures(plan, states, failed);
  commit_together({&out});
}

}  // namespace kds
