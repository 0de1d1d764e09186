#include "experiments/output/page/rows_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "experiments/output/page/drawing.h"
#include "experiments/output/text.h"

namespace kds {
namespace {

constexpr double kRow = 62;          // pixels for a name and the bars below it
constexpr double kBars = 34 / kRow;  // share of a row
constexpr std::size_t kLetters = 7;  // largest average width of a letter in pixels

std::string heading(const RowsPlot::Row& row, const DrawingSize& size) {
  const auto room = static_cast<std::size_t>(size.width - size.left - size.right) / kLetters;
  const std::string with_note = row.note.empty() ? row.name : row.name + ": " + row.note;
  return with_note.size() <= room ? with_note : shortened(row.name, room);
}

// A bin of `width` columns from `first` on. The last bin may have fewer columns.
struct Bin {
  std::size_t first, width;
  [[nodiscard]] double left() const { return static_cast<double>(first) - 0.5; }
  [[nodiscard]] double right() const { return left() + static_cast<double>(width); }
  [[nodiscard]] double mean(const std::vector<double>& values) const {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(width), 0.0) /
           static_cast<double>(width);
  }
};

std::vector<Bin> bins_of(std::size_t columns, std::size_t most) {
  const std::size_t width = std::max<std::size_t>(1, (columns + most - 1) / most);
  std::vector<Bin> bins;
  for (std::size_t first = 0; first < columns; first += width)
    bins.push_back({first, std::min(width, columns - first)});
  return bins;
}

std::string column_text(const RowsPlot& plot, const Bin& bin) {
  std::string text = plot.name_of(bin.first);
  if (bin.width > 1) text += " to " + plot.name_of(bin.first + bin.width - 1) + ", mean";
  for (const RowsPlot::Row& row : plot.rows)
    text += fmt::format("\n{}: {}", row.name, tick_label(bin.mean(row.values)));
  return text;
}

Drawing draw(const RowsPlot& plot, DrawingSize size) {
  size.left = 10;
  size.right = 24;  // leaves room for a tick label
  size.top = 0;
  size.height = kRow * static_cast<double>(plot.rows.size()) + size.bottom;
  const std::vector<Bin> bins = bins_of(plot.columns, is_wide(size) ? 400 : 160);

  Drawing drawing{size, axes(size, plot.x_label, ""), TextsOf::strips, {}};
  std::string& script = drawing.script;
  const auto columns = static_cast<double>(plot.columns);
  script += linear('x', {-0.5, std::max(columns, 1.0) - 0.5}, x_ticks(size));
  script +=
      fmt::format("unset ytics\nunset grid\nset yrange [{}:0]\n", std::max<std::size_t>(1, plot.rows.size()));
  std::string bars;
  for (std::size_t r = 0; r < plot.rows.size(); ++r) {
    const RowsPlot::Row& row = plot.rows[r];
    const double base = static_cast<double>(r) + 1;
    script += fmt::format("set label {} at graph 0, first {:.6g} left textcolor '#000008'\n",
                          gnuplot_text(heading(row, size)), base - kBars - 12 / kRow);
    script += fmt::format(
        "set arrow from graph 0, first {0} to graph 1, first {0} nohead linecolor '#000009'\n", base);
    std::vector<double> means;
    for (const Bin& bin : bins) means.push_back(bin.mean(row.values));
    const double most = means.empty() ? 0 : *std::ranges::max_element(means);
    if (!(most > 0)) continue;
    script += fmt::format("$row{} << EOD\n{:.17g} {:.6f}\n", r, bins.front().left(), base);
    for (std::size_t b = 0; b < bins.size(); ++b) {
      const double top = base - kBars * means[b] / most;
      script += fmt::format("{:.17g} {:.6f}\n{:.17g} {:.6f}\n", bins[b].left(), top, bins[b].right(), top);
    }
    script += fmt::format("{:.17g} {:.6f}\nEOD\n", bins.back().right(), base);
    bars += fmt::format("$row{} using 1:2 with filledcurves closed linecolor {}, ", r, colour(0));
  }
  if (!bins.empty()) {
    script += "$values << EOD\n";
    for (const Bin& bin : bins) {
      script += fmt::format("{:.17g} 0 {}\n", (bin.left() + bin.right()) / 2, drawing.texts.size());
      drawing.texts.push_back(column_text(plot, bin));
    }
    script += "EOD\n";
    bars += "$values using 1:2:3 with labels hypertext point pt 7, ";
  }
  script += "plot " + bars + "NaN\n";
  return drawing;
}

}  // namespace

std::string svg_plot(const RowsPlot& plot) {
  return drawn({{draw(plot, wide(0)), draw(plot, narrow(0))}}, {"by " + plot.x_label}).front();
}

}  // namespace kds
