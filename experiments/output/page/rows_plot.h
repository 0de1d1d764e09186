#pragma once
// Rows of bars over one axis, each on its own scale: where along the chain several things are.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace kds {

struct RowsPlot {
  struct Row {
    std::string name;
    std::string note;            ///< behind the name, where there is room
    std::vector<double> values;  ///< of each column, from 0 on
  };
  std::string x_label;
  std::size_t columns = 0;
  std::function<std::string(std::size_t)> name_of;  ///< a column, for the pointer
  std::vector<Row> rows;
};

/// Of more columns than there are places for, some together, with their mean.
[[nodiscard]] std::string svg_plot(const RowsPlot& plot);

}  // namespace kds
