#pragma once
// Means of a sweep's figures over the tasks that differ in the pooled axes only.

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/output/page/table.h"
#include "experiments/program/mean_interval.h"
#include "experiments/sweep/result_rows.h"
#include "experiments/sweep/sweep_plan.h"

namespace kds {

/// A measure with its values in all tasks that are pooled.
struct PooledFigure {
  std::string command, row, measure;
  std::vector<std::string> axes;  ///< texts of the axes that are not pooled
  std::vector<double> values;
  bool counts = true;  ///< whole numbers, none below 0

  [[nodiscard]] double mean() const;
  /// Returns Student's interval, for independent values. The interval of counts stays above 0 (above_zero).
  /// Returns nothing for a single value, and for counts that are all equal.
  [[nodiscard]] std::optional<MeanInterval> interval() const;
};

class PooledFigures {
 public:
  /// `plan` must outlive this object.
  explicit PooledFigures(const SweepPlan& plan);

  /// Adds the numbers of all rows of a task, apart from those that describe its input.
  void add(const SweepTask& task, const std::vector<ResultRow>& rows);

  /// Returns the names of the axes that are not pooled.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Returns the figures, in the order in which they were found.
  [[nodiscard]] const std::vector<PooledFigure>& figures() const { return figures_; }

 private:
  const SweepPlan& plan_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> by_key_;
  std::vector<PooledFigure> figures_;
};

/// Returns the table of figures with these axes.
[[nodiscard]] Table<PooledFigure> pooled_table(const std::vector<std::string>& axes);

}  // namespace kds
