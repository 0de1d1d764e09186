#include "experiments/sweep/pooled_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "experiments/output/text.h"

namespace kds {

double PooledFigure::mean() const {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<MeanInterval> PooledFigure::interval() const {
  const auto student = mean_of_independent(values);
  return counts ? above_zero(student) : student;
}

PooledFigures::PooledFigures(const SweepPlan& plan) : plan_(plan) {
  names_.emplace_back("input");
  for (const std::string& axis : plan.axes()) names_.push_back(axis);
  std::erase_if(names_, [&](const std::string& axis) {
    return std::ranges::find(plan.spec().pooled, axis) != plan.spec().pooled.end();
  });
}

void PooledFigures::add(const SweepTask& task, const std::vector<ResultRow>& rows) {
  std::vector<std::string> axes;
  for (const std::string& axis : names_) axes.push_back(plan_.text(task, axis));
  std::map<std::string, std::size_t> seen;
  for (const ResultRow& row : rows) {
    const std::string identity = identity_of(row, plan_.spec().pooled);
    const std::size_t place = seen[identity]++;  // rows that nothing else tells apart
    for (const auto& [name, value] : row.fields) {
      const auto number = value.number();
      if (!number || is_identity(name, value) || name.starts_with("input.")) continue;
      const std::string key = fmt::format("{}\n{}\n{}\n{}\n{}", plan_.text(task, "command"),
                                          fmt::join(axes, "\n"), identity, place, name);
      const auto [found, is_new] = by_key_.emplace(key, figures_.size());
      if (is_new) figures_.push_back({plan_.text(task, "command"), identity, name, axes, {}});
      PooledFigure& figure = figures_[found->second];
      figure.values.push_back(*number);
      figure.counts = figure.counts && value.whole_number() != nullptr;
    }
  }
}

Table<PooledFigure> pooled_table(const std::vector<std::string>& axes) {
  using R = PooledFigure;
  const auto end_of = [](double MeanInterval::*end) {
    return [end](const R& r) {
      const auto interval = r.interval();
      return interval ? Field((*interval).*end) : Field();
    };
  };
  Table<R> table{{{"command", "command", [](const R& r) { return Field(r.command); }}}};
  for (std::size_t k = 0; k < axes.size(); ++k)
    table.add({{axes[k], axes[k], [k](const R& r) { return text_or_nothing(r.axes[k]); }}});
  table.add({
      {"row", "row", [](const R& r) { return text_or_nothing(r.row); }},
      {"measure", "measure", [](const R& r) { return Field(r.measure); }},
      {"tasks", "tasks", [](const R& r) { return Field(r.values.size()); }},
      {.key = "mean",
       .heading = "mean (95%)",
       .value = [](const R& r) { return Field(r.mean()); },
       .words =
           [](const R& r) {
             const auto interval = r.interval();
             return interval ? interval_text(*interval) : short_decimal(r.mean());
           }},
      {.key = "lower", .value = end_of(&MeanInterval::lower)},
      {.key = "upper", .value = end_of(&MeanInterval::upper)},
  });
  return table;
}

}  // namespace kds
