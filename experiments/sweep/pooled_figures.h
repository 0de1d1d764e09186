#pragma once
// Means of a sweep's figures over the tasks that differ in the pooled axes only.

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "experiments/output/table.h"
#include "experiments/program/mean_interval.h"
#include "experiments/sweep/result_rows.h"
#include "experiments/sweep/sweep_plan.h"

namespace kds {

/// A measure over all tasks that are pooled: count, mean and sum of squared differences from the mean, by
/// Welford's update.
struct PooledFigure {
  std::string row, measure;  ///< which rows of the results, and which of their fields
  std::size_t values = 0;
  double mean = 0, squares = 0;
  bool never_negative = true;

  void add(double value);
  /// Returns Student's interval, for independent values. The interval stays above 0 if no value is negative
  /// (above_zero). Returns nothing for fewer than `least_pooled` values, and for such values that are equal.
  [[nodiscard]] std::optional<MeanInterval> interval() const;
  /// Returns why there is no interval, or an empty text if there is one.
  [[nodiscard]] std::string no_interval() const;
};

/// The figures of one group: of tasks that differ in the pooled axes only.
class PooledGroup {
 public:
  /// Adds the numbers of all rows of a task, apart from those that describe its input. Tasks whose files have
  /// the same content count once. Rows are told apart by their texts, apart from those of `pooled` axes.
  void add(const SweepTask& task, const std::vector<ResultRow>& rows, const std::vector<std::string>& pooled);
  /// Returns the figures, in the order in which they were found.
  [[nodiscard]] const std::vector<PooledFigure>& figures() const { return figures_; }

 private:
  std::unordered_set<TaskName> copied_;
  std::unordered_map<std::string, std::size_t> indices_;  ///< of figures, by row and measure
  std::vector<PooledFigure> figures_;
};

/// A figure with the names of its group.
struct MeanOfTasks {
  std::vector<std::string> group;  ///< the command, and the texts of the axes that are not pooled
  PooledFigure figure;
};
/// Returns the table of figures with these axes.
[[nodiscard]] Table<MeanOfTasks> pooled_table(const std::vector<std::string>& axes);

}  // namespace kds
