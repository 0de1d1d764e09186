#include "experiments/sweep/collect_sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>

#include "experiments/output/output_files.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/paper.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/sweep/pooled_figures.h"
#include "experiments/sweep/result_rows.h"
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
      stream << (k > 0 ? ",\n    " : "\n    ") << line_of(row).value_or("{}");
    }
    stream << "\n  ]";
  }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }

 private:
  std::vector<std::string> fixed_, columns_;
  std::unordered_map<std::string, std::uint32_t> by_name_;
  std::vector<Row> rows_;
};

struct FailedTask {
  std::string task, command, input, status, error, repeat;
  std::uint64_t code = 0;
};

std::string json_text(const Json& json, std::string_view name) {
  const Json* const found = json.find(name);
  return found != nullptr && found->text() != nullptr ? *found->text() : std::string();
}

std::vector<FailedTask> failed_tasks(const SweepPlan& plan, const TaskStates& states) {
  std::vector<FailedTask> failed;
  for (const SweepTask& task : plan.tasks()) {
    const TaskState& state = states.of(task.name);
    const TaskStatus status = status_of(state);
    if (status != TaskStatus::failed && status != TaskStatus::crashed) continue;
    const bool crashed = status == TaskStatus::crashed;
    const RecordPlace& place = crashed ? state.death : state.failure;
    const Json json = place.length > 0 ? parse_json(states.read(place)) : Json();
    FailedTask& row = failed.emplace_back();
    row.task = hex_digits(task.name);
    row.command = plan.text(task, "command");
    row.input = plan.text(task, "input");
    row.status = crashed ? "crashed" : "failed";
    row.error = json_text(json, "error");
    if (row.error.empty()) row.error = "the sweep was killed";
    if (crashed) row.error = fmt::format("{} attempts left no result; the last {}", state.lost(), row.error);
    const Json* const code = json.find("code");
    row.code = code != nullptr && code->whole_number() != nullptr ? *code->whole_number() : 0;
    row.repeat = "kds " + shell_words(plan.arguments(task));
  }
  return failed;
}

Table<FailedTask> failed_table() {
  using R = FailedTask;
  return {{
      {"task", "task", [](const R& r) { return Field(r.task); }},
      {"command", "command", [](const R& r) { return Field(r.command); }},
      {"input", "input", [](const R& r) { return text_or_nothing(r.input); }},
      {"status", "status", [](const R& r) { return Field(r.status); }},
      {"code", "", [](const R& r) { return r.code > 0 ? Field(r.code) : Field(); }},
      {"error", "error", [](const R& r) { return Field(r.error); }},
      {"repeat", "repeat", [](const R& r) { return Field(r.repeat); }},
  }};
}

Table<SweepCount> count_table() {
  using R = SweepCount;
  return {{
      {"command", "command", [](const R& r) { return Field(r.command); }},
      {"tasks", "tasks", [](const R& r) { return Field(r.tasks); }},
      {"done", "done", [](const R& r) { return Field(r.done); }},
      {"failed", "failed", [](const R& r) { return Field(r.failed); }},
      {"crashed", "crashed", [](const R& r) { return Field(r.crashed); }},
      {"running", "running", [](const R& r) { return Field(r.running); }},
      {"open", "open", [](const R& r) { return Field(r.open); }},
      {.key = "seconds",
       .heading = "seconds of tasks done",
       .value = [](const R& r) { return Field(r.seconds); },
       .format = shortly},
      {.key = "left",
       .heading = "core hours left",
       .value =
           [](const R& r) {
             const auto left = static_cast<double>(r.open + r.running);
             return r.done > 0 ? Field(r.seconds / static_cast<double>(r.done) * left / 3600) : Field();
           },
       .format = shortly},
  }};
}

// Leaves out the sum over all commands if there is only one.
std::span<const SweepCount> without_repeated_sum(const std::vector<SweepCount>& counts) {
  return std::span(counts).first(counts.size() - (counts.size() == 2 ? 1 : 0));
}

std::vector<SweepCount> counts_from(const SweepPlan& plan, const TaskStates& states, const fs::path& folder) {
  std::vector<SweepCount> counts;
  const TaskLocks locks(locks_file(folder), TaskLocks::Use::look);
  SweepCount all;
  all.command = "all";
  for (const SweepTask& task : plan.tasks()) {
    const std::string command = plan.text(task, "command");
    auto count = std::ranges::find(counts, command, &SweepCount::command);
    if (count == counts.end()) {
      counts.emplace_back().command = command;
      count = counts.end() - 1;
    }
    const TaskState& state = states.of(task.name);
    const TaskStatus status = status_of(state);
    const bool settled = status == TaskStatus::done || status == TaskStatus::failed;
    const bool running = !settled && state.lost() > 0 && locks.taken_by_another(task.name);
    double seconds = 0;
    if (status == TaskStatus::done) {
      const std::string json = states.read(state.done);  // begins with {"seconds":
      const std::size_t colon = json.find(':');
      seconds = colon == std::string::npos ? 0 : std::strtod(json.c_str() + colon + 1, nullptr);
    }
    for (SweepCount* one : {&*count, &all}) {
      ++one->tasks;
      one->seconds += seconds;
      if (running)
        ++one->running;
      else if (status == TaskStatus::done)
        ++one->done;
      else if (status == TaskStatus::failed)
        ++one->failed;
      else if (status == TaskStatus::crashed)
        ++one->crashed;
      else
        ++one->open;
    }
  }
  counts.push_back(std::move(all));
  return counts;
}

// Plots the figures of a command over its first axis with several numbers, one plot for each of the first
// measures. Axes of one value do not name series. `pooled` says over what the means are.
std::string plots_of(const PooledFigures& pool, const std::string& command, const std::string& pooled) {
  constexpr std::size_t most_plots = 4, most_series = 12;
  const auto number_of = [](const std::string& text) -> std::optional<double> {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0' && number > 0 ? std::optional(number) : std::nullopt;
  };
  std::vector<const PooledFigure*> figures;
  std::vector<std::set<std::string>> values(pool.names().size());
  for (const PooledFigure& figure : pool.figures()) {
    if (figure.command != command) continue;
    figures.push_back(&figure);
    for (std::size_t axis = 0; axis < values.size(); ++axis) values[axis].insert(figure.axes[axis]);
  }
  std::string html;
  for (std::size_t axis = 0; axis < pool.names().size() && html.empty(); ++axis) {
    std::map<std::string, PointPlot> plots;  // by measure
    std::vector<std::string> order;
    for (const PooledFigure* figure : figures) {
      const auto x = number_of(figure->axes[axis]);
      if (!x || !(figure->mean() > 0)) continue;
      const std::string& name = figure->measure;
      if (!plots.contains(name)) {
        if (order.size() == most_plots) continue;
        order.push_back(name);
        plots[name] = {pool.names()[axis], name, {}, {}};
      }
      PointPlot& plot = plots[name];
      std::string series = figure->row;
      for (std::size_t k = 0; k < figure->axes.size(); ++k)
        if (k != axis && values[k].size() > 1 && !figure->axes[k].empty() &&
            figure->row.find(figure->axes[k]) == std::string::npos)
          series += (series.empty() ? "" : ", ") + figure->axes[k];
      auto found = std::ranges::find(plot.series, series);
      if (found == plot.series.end()) {
        if (plot.series.size() == most_series) continue;
        plot.series.push_back(series);
        found = plot.series.end() - 1;
      }
      plot.points.push_back({"", *x, figure->mean(), static_cast<std::size_t>(found - plot.series.begin())});
    }
    for (const std::string& name : order) {
      std::vector<double> places;
      for (const auto& point : plots[name].points) places.push_back(point.x);
      std::ranges::sort(places);
      if (places.empty() || places.front() == places.back()) continue;
      html += html_figure(svg_plot(plots[name]),
                          html_escaped(fmt::format("{}: {} by {}, means over {}, both axes logarithmic.",
                                                   command, name, pool.names()[axis], pooled)));
    }
  }
  return html;
}

std::string sweep_page(const SweepPlan& plan, const CollectedSweep& collected, const PooledFigures& pool,
                       const std::vector<FailedTask>& failed, const std::vector<SweepCount>& counts,
                       const std::string& command_line) {
  constexpr std::size_t most_rows = 300;
  Page page;
  page.title = "kds sweep";
  page.command_line = command_line;
  page.data = {"results.csv", "results.json", "pooled.csv", "times.csv", "failed.csv"};
  const std::size_t tasks = collected.tasks;
  page.found = fmt::format(
      "<p>{} of {} tasks have results, in {} rows.{}</p>\n", with_thousands(collected.done),
      with_thousands(tasks), with_thousands(collected.rows),
      collected.done == tasks ? " The sweep is complete."
                              : fmt::format(" {} failed, {} crashed, {} are missing.", collected.failed,
                                            collected.crashed, collected.missing));
  std::vector<PooledFigure> figures = pool.figures();
  std::erase_if(figures, [](const PooledFigure& figure) {
    return std::ranges::all_of(figure.values, [](double value) { return value == 0; });
  });
  const auto shown = std::span(figures).first(std::min(most_rows, figures.size()));
  std::string pooled = pooled_table(pool.names()).html(shown);
  pooled += fmt::format("<p>{} of {} means; pooled.csv has all.</p>\n", shown.size(),
                        with_thousands(pool.figures().size()));
  const std::vector<std::string>& over = plan.spec().pooled;
  std::string plots;
  for (const SweepCount& count : counts)
    plots += plots_of(pool, count.command,
                      over.empty() ? "equal settings" : fmt::format("{}", fmt::join(over, " and ")));
  page.body = html_section("Plots", plots);
  if (!failed.empty())
    page.body +=
        html_section("Tasks without a result",
                     failed_table().html(std::span(failed).first(std::min(most_rows, failed.size()))));
  page.body += html_section("Tasks", count_table().html(without_repeated_sum(counts)));
  page.body += html_section("Means", pooled);
  page.words =
      html_escaped(fmt::format("Means pool the tasks that differ in {} only. Their 95% intervals are "
                               "Student's, for independent values.",
                               fmt::join(plan.spec().pooled, ", ")));
  return html_page(page);
}

// Returns the rows of a task's result, and the seconds that the task took.
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

std::vector<SweepCount> count_tasks(const SweepPlan& plan, const fs::path& folder) {
  TaskStates states(results_folder(folder));
  states.refresh();
  return counts_from(plan, states, folder);
}

std::string status_text(const std::vector<SweepCount>& counts) {
  return count_table().text(without_repeated_sum(counts));
}

std::size_t write_failed(const SweepPlan& plan, const fs::path& folder) {
  TaskStates states(results_folder(folder));
  states.refresh();
  const std::vector<FailedTask> failed = failed_tasks(plan, states);
  AtomicFiles files;
  files.write(folder / "failed.csv", failed_table().csv(failed));
  commit_together({&files});
  return failed.size();
}

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
  for (std::size_t first = 0; first < tasks.size(); first += tasks[first].parts) {
    const SweepTask& task = tasks[first];
    std::vector<std::vector<ResultRow>> parts;
    double seconds = 0, processor_seconds = 0;
    for (std::size_t part = 0; part < task.parts; ++part) {
      const SweepTask& one = tasks[first + part];
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
      if (status == TaskStatus::done) parts.push_back(read_rows(states, one, seconds, processor_seconds));
    }
    if (parts.size() < task.parts) continue;
    bool uneven = false;
    const std::vector<ResultRow> rows = task.parts > 1 ? joined_parts(parts, uneven) : parts.front();
    if (uneven)
      throw InputError(
          fmt::format("{}: its parts have different beads or dimensions and cannot be joined; expected "
                      "no part_steps for this input",
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
  files.write(folder / "pooled.csv", pooled.csv(pool.figures()));
  files.write(folder / "failed.csv", failed_table().csv(failed));
  files.write(folder / "report.html",
              without_copies(sweep_page(plan, collected, pool, failed, counts_from(plan, states, folder),
                                        command_line)));
  commit_together({&files});
  return collected;
}

}  // namespace kds
