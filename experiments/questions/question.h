#pragma once
// An open question of the paper with the measured answer: a table, the fits to it, and the conclusions.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/program/power_fit.h"

namespace kds {

struct QuestionColumn {
  std::string name;  ///< name in CSV and JSON
  std::string title;
};

struct QuestionRow {
  std::string subject;
  std::vector<std::optional<double>> values;  ///< in the order of the columns
};

/// A curve of a plot with two logarithmic axes. A power law is fitted to the curve if it has enough points.
struct QuestionCurve {
  std::string plot;  ///< name of the plot; curves with one name share a plot
  std::string name;
  std::vector<std::pair<double, double>> points;
  /// Each element has the points as they are without one of several equal shares of the measurements. Empty
  /// if there are no shares.
  std::vector<std::vector<std::pair<double, double>>> without;
  [[nodiscard]] std::optional<PowerFit> fit() const {
    return without.empty() ? fit_power(points) : fit_power(points, without);
  }
};

struct Question {
  std::string name;    ///< name of its file, such as energy
  std::string title;   ///< the question itself
  std::string words;   ///< what is measured, and how
  std::string answer;  ///< the main result in a sentence
  std::vector<QuestionColumn> columns;
  std::vector<QuestionRow> rows;
  std::string x_label, y_label;  ///< labels of the plots' axes
  std::vector<QuestionCurve> curves;
  std::vector<std::string> findings;  ///< sentences
};

}  // namespace kds
