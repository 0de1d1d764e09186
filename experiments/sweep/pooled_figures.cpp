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
  if (values.size() < least_pooled) return std::nullopt;
  const auto student = mean_of_independent(values);
  return counts ? above_zero(student) : student;
}

std::string PooledFigure::no_interval() const {
  if (interval()) return "";
  return values.size() < least_pooled ? fmt::format("fewer than {} values", least_pooled)
                                      : "all values are equal";
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
    const std::string key =
        fmt::format("{}\n{}\n{}\n{}", plan_.text(task, "command"), fmt::join(axes, "\n"), identity, place);
    Group& group = by_key_[key];
    if (!group.row)
      group.row = std::make_shared<PooledRow>(PooledRow{plan_.text(task, "command"), identity, axes});
    for (const auto& [name, value] : row.fields) {
      const auto number = value.number();
      if (!number || is_identity(name, value) || name.starts_with("input.")) continue;
      const auto found = std::ranges::find_if(
          group.figures, [&, &name = name](std::size_t k) { return figures_[k].measure == name; });
      const std::size_t at = found != group.figures.end() ? *found : figures_.size();
      if (at == figures_.size()) {
        group.figures.push_back(at);
        figures_.push_back({group.row, name, {}});
      }
      PooledFigure& figure = figures_[at];
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
  Table<R> table{{{"command", "command", [](const R& r) { return Field(r.of->command); }}}};
  for (std::size_t k = 0; k < axes.size(); ++k)
    table.add({{axes[k], axes[k], [k](const R& r) { return text_or_nothing(r.of->axes[k]); }}});
  table.add({
      {"row", "row", [](const R& r) { return text_or_nothing(r.of->row); }},
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
      {"no_interval", "no interval", [](const R& r) { return text_or_nothing(r.no_interval()); }},
  });
  return table;
}

}  // namespace kds
