#include "experiments/sweep/collect_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "experiments/output/output_files.h"
#include "experiments/output/page/paper.h"
#include "experiments/output/page/table.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/sweep/pooled_figures.h"
#include "experiments/sweep/result_rows.h"
#include "experiments/sweep/sweep_page.h"
#include "experiments/sweep/sweep_status.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

Field field_from(const Json& json) {
  if (json.text() != nullptr) return Field(*json.text());
  if (json.truth() != nullptr) return Field(*json.truth());
  if (json.whole_number() != nullptr) return Field(*json.whole_number());
  if (const auto number = json.number()) return Field(*number);
  return {};
}

// Returns JSON on one line, if it is UTF-8. File names need not be.
std::string one_object(const Json& row) {
  const auto line = line_of(row);
  return line ? *line : text_of(row);
}

// Rows whose columns are found while they are added.
class WideTable {
 public:
  struct Row {
    std::vector<std::string> fixed;
    std::vector<std::pair<std::uint32_t, Json>> cells;
  };

  explicit WideTable(std::vector<std::string> fixed) : fixed_(std::move(fixed)) {}

  void add(std::vector<std::string> fixed, const RowFields& fields) {
    Row row{std::move(fixed), {}};
    for (const auto& [name, value] : fields) {
      const auto [found, is_new] = by_name_.emplace(name, static_cast<std::uint32_t>(columns_.size()));
      // An axis may have the name of a field, such as stride.
      if (is_new)
        columns_.push_back(std::ranges::find(fixed_, name) == fixed_.end() ? name : "result." + name);
      row.cells.emplace_back(found->second, value);
    }
    rows_.push_back(std::move(row));
  }

  void write_csv(std::ostream& stream) const {
    std::string line;
    const auto append = [&line](const std::string& cell) { line += (line.empty() ? "" : ",") + cell; };
    for (const auto* names : {&fixed_, &columns_})
      for (const std::string& name : *names) append(Field(name).csv());
    stream << line << '\n';
    std::vector<std::string> cells(columns_.size());
    for (const Row& row : rows_) {
      std::ranges::fill(cells, "");
      for (const auto& [column, value] : row.cells) cells[column] = field_from(value).csv();
      line = Field(row.fixed.front()).csv();
      for (std::size_t k = 1; k < row.fixed.size(); ++k) line += ',' + text_or_nothing(row.fixed[k]).csv();
      for (const std::string& cell : cells) line += ',' + cell;
      stream << line << '\n';
    }
  }

  // Writes an array with an object on each line.
  void write_json(std::ostream& stream) const {
    stream << '[';
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Json row = Json::object();
      for (std::size_t c = 0; c < fixed_.size(); ++c)
        row[fixed_[c]] = rows_[k].fixed[c].empty() ? Json() : Json(rows_[k].fixed[c]);
      for (const auto& [column, value] : rows_[k].cells) row[columns_[column]] = value;
      stream << (k > 0 ? ",\n    " : "\n    ") << one_object(row);
    }
    stream << "\n  ]";
  }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }

 private:
  std::vector<std::string> fixed_, columns_;
  std::unordered_map<std::string, std::uint32_t> by_name_;
  std::vector<Row> rows_;
};

// Returns the rows of a task's result. Adds its times to `seconds` and `processor_seconds`.
std::vector<ResultRow> read_rows(const TaskStates& states, const SweepTask& task, double& seconds,
                                 double& processor_seconds) {
  const Json record = parse_json(states.read(states.of(task.name).done));
  const Json* const result = record.find("result");
  if (result == nullptr || result->members() == nullptr)
    throw OutputError(fmt::format("task {}: its record has no result", hex_digits(task.name)));
  const auto number = [&](std::string_view name) {
    const Json* const found = record.find(name);
    return found != nullptr ? found->number().value_or(0) : 0;
  };
  seconds += number("seconds");
  processor_seconds += number("processor_seconds");
  return rows_of_result(*result);
}

}  // namespace

CollectedSweep collect_sweep(const SweepPlan& plan, const fs::path& folder, const std::string& command_line) {
  TaskStates states(results_folder(folder));
  states.refresh();
  std::vector<std::string> fixed{"task", "command", "input"};
  const std::vector<std::string> axes = plan.axes();
  fixed.insert(fixed.end(), axes.begin(), axes.end());
  WideTable results(fixed), times({"task", "row"});
  PooledFigures pool(plan);
  CollectedSweep collected;
  const std::vector<SweepTask>& tasks = plan.tasks();
  for (std::size_t first = 0; first < tasks.size(); first += tasks[first].segments) {
    const SweepTask& task = tasks[first];
    std::vector<std::vector<ResultRow>> segments;
    double seconds = 0, processor_seconds = 0;
    for (std::size_t segment = 0; segment < task.segments; ++segment) {
      const SweepTask& one = tasks[first + segment];
      const TaskStatus status = status_of(states.of(one.name));
      ++collected.tasks;
      collected.done += status == TaskStatus::done ? 1U : 0U;
      collected.failed += status == TaskStatus::failed ? 1U : 0U;
      collected.crashed += status == TaskStatus::crashed ? 1U : 0U;
      if (status == TaskStatus::open) {
        ++collected.missing;
        constexpr std::size_t most_named = 3;
        if (collected.first_missing.size() < most_named)
          collected.first_missing.push_back("kds " + shell_words(plan.arguments(one)));
      }
      if (status == TaskStatus::done) segments.push_back(read_rows(states, one, seconds, processor_seconds));
    }
    if (segments.size() < task.segments) continue;
    bool uneven = false;
    const std::vector<ResultRow> rows =
        task.segments > 1 ? joined_segments(segments, uneven) : segments.front();
    if (uneven)
      throw InputError(
          fmt::format("{}: its segments have different beads or dimensions and cannot be joined; expected "
                      "no segment_steps for this input",
                      plan.text(task, "input")));
    std::vector<std::string> names{hex_digits(task.name), plan.text(task, "command"),
                                   plan.text(task, "input")};
    for (const std::string& axis : axes) names.push_back(plan.text(task, axis));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      results.add(names, rows[row].fields);
      RowFields of_task;
      if (row == 0) of_task = {{"task_seconds", seconds}, {"task_processor_seconds", processor_seconds}};
      of_task.insert(of_task.end(), rows[row].times.begin(), rows[row].times.end());
      times.add({names.front(), std::to_string(row)}, of_task);
    }
    pool.add(task, rows);
  }
  collected.rows = results.size();
  collected.damaged = states.damaged();

  const std::vector<FailedTask> failed = failed_tasks(plan, states);
  const Table<PooledFigure> pooled = pooled_table(pool.names());
  AtomicFiles files;
  results.write_csv(files.open(folder / "results.csv"));
  times.write_csv(files.open(folder / "times.csv"));
  std::ostream& json = files.open(folder / "results.json");
  json << fmt::format("{{\n  \"version\": \"{}\",\n  \"tasks\": {},\n  \"done\": {},\n  \"rows\": ",
                      program_version(), collected.tasks, collected.done);
  results.write_json(json);
  json << "\n}\n";
  std::ostream& means = files.open(folder / "pooled.csv");
  means << pooled.csv_header();
  for (const PooledFigure& figure : pool.figures())
    means << pooled.csv_line(figure);  // one in memory at a time
  files.write(folder / "failed.csv", failed_table().csv(failed));
  files.write(folder / "report.html",
              without_copies(sweep_page(plan, collected, pool, failed, counts_from(plan, states, folder),
                                        command_line)));
  commit_together({&files});
  return collected;
}

}  // namespace kds
