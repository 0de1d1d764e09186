#pragma once
// Means of a sweep's figures over the tasks that differ in the pooled axes only.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/output/page/table.h"
#include "experiments/program/mean_interval.h"
#include "experiments/sweep/result_rows.h"
#include "experiments/sweep/sweep_plan.h"

namespace kds {

/// An interval takes this many values. For two values Student's quantile is 12.7, so that the interval of a
/// count can reach a factor of exp(12.7), which is 330,000, to either side. For three it is 4.3.
inline constexpr std::size_t least_pooled = 3;

/// A row of the tasks that are pooled.
struct PooledRow {
  std::string command, row;
  std::vector<std::string> axes;  ///< texts of the axes that are not pooled
};

/// A measure with its values in all tasks that are pooled.
struct PooledFigure {
  std::shared_ptr<const PooledRow> of;
  std::string measure;
  std::vector<double> values;
  bool counts = true;  ///< whole numbers, none below 0

  [[nodiscard]] double mean() const;
  /// Returns Student's interval, for independent values. The interval of counts stays above 0 (above_zero).
  /// Returns nothing for fewer than `least_pooled` values, and for counts that are all equal.
  [[nodiscard]] std::optional<MeanInterval> interval() const;
  /// Returns why there is no interval, or an empty text if there is one.
  [[nodiscard]] std::string no_interval() const;
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
  struct Group {
    std::shared_ptr<const PooledRow> row;
    std::vector<std::size_t> figures;  ///< their places
  };

  const SweepPlan& plan_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, Group> by_key_;
  std::vector<PooledFigure> figures_;
};

/// Returns the table of figures with these axes.
[[nodiscard]] Table<PooledFigure> pooled_table(const std::vector<std::string>& axes);

}  // namespace kds
