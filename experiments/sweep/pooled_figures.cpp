#include "experiments/sweep/pooled_figures.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/output/text.h"

namespace kds {

void PooledFigure::add(double value) {
  const double difference = value - mean;
  mean += difference / static_cast<double>(++values);
  squares += difference * (value - mean);
}

std::optional<MeanInterval> PooledFigure::interval() const {
  if (values < least_pooled) return std::nullopt;
  const auto count = static_cast<double>(values);
  const double error = student_95(count - 1) * std::sqrt(squares / (count - 1) / count);
  const MeanInterval student{mean, mean - error, mean + error, values};
  return never_negative ? above_zero(student) : student;
}

std::string PooledFigure::no_interval() const {
  if (interval()) return "";
  return values < least_pooled ? fmt::format("fewer than {} values", least_pooled) : "all values are equal";
}

void PooledGroup::add(const SweepTask& task, const std::vector<ResultRow>& rows,
                      const std::vector<std::string>& pooled) {
  if (task.has_copies && !copied_.insert(task.name).second) return;
  std::unordered_map<std::string, std::size_t> seen;
  for (const ResultRow& row : rows) {
    const std::string identity = identity_of(row, pooled);
    const std::size_t copy = seen[identity]++;  // rows that nothing else tells apart
    for (const auto& [name, value] : row.fields) {
      const auto number = value.number();
      if (!number || is_identity(name, value) || name.starts_with("input.")) continue;
      const auto [found, is_new] =
          indices_.emplace(fmt::format("{}\n{}\n{}", identity, copy, name), figures_.size());
      if (is_new) figures_.push_back({identity, name});
      PooledFigure& figure = figures_[found->second];
      figure.add(*number);
      figure.never_negative = figure.never_negative && *number >= 0;
    }
  }
}

Table<MeanOfTasks> pooled_table(const std::vector<std::string>& axes) {
  using R = MeanOfTasks;
  const auto end_of = [](double MeanInterval::*end) {
    return [end](const R& r) {
      const auto interval = r.figure.interval();
      return interval ? Field((*interval).*end) : Field();
    };
  };
  Table<R> table{{{"command", "command", [](const R& r) { return Field(r.group.front()); }}}};
  for (std::size_t k = 0; k < axes.size(); ++k)
    table.add({{axes[k], axes[k], [k](const R& r) { return text_or_nothing(r.group[k + 1]); }}});
  table.add({
      {"row", "row", [](const R& r) { return text_or_nothing(r.figure.row); }},
      {"measure", "measure", [](const R& r) { return Field(r.figure.measure); }},
      {"tasks", "tasks", [](const R& r) { return Field(r.figure.values); }},
      {.key = "mean",
       .heading = "mean (95%)",
       .value = [](const R& r) { return Field(r.figure.mean); },
       .words =
           [](const R& r) {
             const auto interval = r.figure.interval();
             return interval ? interval_text(*interval) : short_decimal(r.figure.mean);
           }},
      {.key = "lower", .value = end_of(&MeanInterval::lower)},
      {.key = "upper", .value = end_of(&MeanInterval::upper)},
      {"no_interval", "no interval", [](const R& r) { return text_or_nothing(r.figure.no_interval()); }},
  });
  return table;
}

}  // namespace kds
