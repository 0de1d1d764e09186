#pragma once
// An open question of the paper, measured: a table, what was fitted to it, and what it says.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/program/power_fit.h"

namespace kds {

struct QuestionColumn {
  std::string name;  ///< in CSV and JSON
  std::string title;
};

struct QuestionRow {
  std::string subject;
  std::vector<std::optional<double>> values;  ///< in the order of the columns
};

/// A curve of a plot, both axes logarithmic, and the power fitted to it where there are enough points.
struct QuestionCurve {
  std::string plot;  ///< curves of one plot stand together
  std::string name;
  std::vector<std::pair<double, double>> points;
  /// The points without one of several equal shares of what was measured, where there are such.
  std::vector<std::vector<std::pair<double, double>>> without;
  [[nodiscard]] std::optional<PowerFit> fit() const {
    return without.empty() ? fit_power(points) : fit_power(points, without);
  }
};

struct Question {
  std::string name;    ///< of its file: energy
  std::string title;   ///< the question itself
  std::string words;   ///< what is measured, and how
  std::string answer;  ///< the gist of what was found, a sentence
  std::vector<QuestionColumn> columns;
  std::vector<QuestionRow> rows;
  std::string x_label, y_label;  ///< of the plots
  std::vector<QuestionCurve> curves;
  std::vector<std::string> findings;  ///< sentences
};

}  // namespace kds
