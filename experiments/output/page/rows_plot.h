#pragma once
// Rows of bars over one axis, each with its own scale. They show where along the chain several quantities
// occur.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace kds {

struct RowsPlot {
  struct Row {
    std::string name;
    std::string note;            ///< shown after the name if there is room
    std::vector<double> values;  ///< one per column, at least 0
  };
  std::string x_label;
  std::size_t columns = 0;
  std::function<std::string(std::size_t)> name_of;  ///< name of a column, shown under the pointer
  std::vector<Row> rows;
};

/// If there are more columns than places, neighbouring columns are combined and their mean is shown.
[[nodiscard]] std::string svg_plot(const RowsPlot& plot);

}  // namespace kds
