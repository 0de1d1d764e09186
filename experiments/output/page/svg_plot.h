#pragma once
// Curves, points, bars and maps for a page, without scripts. Each plot is drawn twice, for wide and for
// narrow pages, and the page's style shows one of the two. Colours follow the page, light or dark. Values
// appear under the pointer on wide pages; telephones have no pointer. The page also carries a copy of each
// plot for print (print.h).

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace kds {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< finite, ordered by the first coordinate
  /// An error bar for each point: its least and its largest value. Empty if there are none. A bar of equal
  /// values is not drawn.
  std::vector<std::pair<double, double>> bars = {};
};

/// How the points of a curve are drawn.
enum class Drawn {
  line,       ///< joined by a line
  staircase,  ///< each value holds until the next point
  points      ///< marks only, because nothing is known between them
};

/// Curves over one axis. The axes of marks are logarithmic if the values lie far apart: x from a factor of 8,
/// y from a factor of 10 if all values are above 0. If y is not logarithmic and the largest values of two
/// curves differ by more than a factor of 10, svg_plot shows a panel for each magnitude.
struct LinePlot {
  std::string x_label, y_label;
  Drawn drawn = Drawn::line;
  std::vector<Curve> curves;
  bool below_zero = false;  ///< whether values may be negative; else the axis begins at 0
};

/// Small plots side by side, or one below the other on narrow pages. A name has one colour in all plots. If
/// there are more names than colours, each plot has its own key.
struct PanelPlot {
  struct Panel {
    std::string title;
    LinePlot plot;
  };
  std::vector<Panel> panels;
};

/// Points, each with its name next to it. Both axes are logarithmic. The points of a series share its colour.
struct PointPlot {
  struct Point {
    std::string name;  ///< empty for a point without a shown name
    double x, y;       ///< x above 0; y at most a millionth of the largest, or 0, is drawn at the bottom
    std::size_t series = 0;
    double least = 0, most = 0;  ///< the ends of a vertical error bar; no bar if equal
    double from = 0, to = 0;     ///< the ends of a horizontal error bar, above 0; no bar if equal
  };
  std::string x_label, y_label;
  std::vector<std::string> series;
  std::vector<Point> points;
};

/// Horizontal bars, one below the other, each with its value. The bars of a series share its colour.
struct BarPlot {
  struct Bar {
    std::string name;
    double value;
    std::size_t series = 0;
  };
  std::string x_label;
  std::vector<Bar> bars;
  std::vector<std::string> series = {};  ///< names of the series; empty if there is only one
};

/// Horizontal bars to both sides of a line, for changes and their opposites. Both sides have one scale. Each
/// bar has its name and its value.
struct MirrorPlot {
  struct Bar {
    std::string name;
    double value = 0;
  };
  struct Row {
    Bar right;
    Bar left = {};  ///< not drawn if the name is empty
  };
  std::string x_label;
  std::vector<Row> rows;
};

/// Rectangles that fill a map. Colours show the values; a rectangle with value 0 is not drawn.
struct HeatPlot {
  std::string x_label, y_label;
  std::string value_label;                  ///< for the colour scale
  std::vector<double> x_edges, y_edges;     ///< ends of the columns and of the rows, ascending
  std::vector<std::vector<double>> values;  ///< by column, then by row; at least 0
  std::function<std::string(std::size_t column, std::size_t row)> text;  ///< shown under the pointer
};

/// Squares of equal size within a square map. Colours show the values; a square without a value stays
/// empty. Squares are drawn two pixels wide or wider, so neighbours may overlap on a small screen.
struct MapPlot {
  struct Square {
    double x, y;  ///< centre
    double value;
    std::string text = {};  ///< shown under the pointer, with the value; if empty, the centre
  };
  std::string label;        ///< for both axes
  std::string value_label;  ///< for the colour scale
  double from = 0, to = 1;  ///< range of each axis
  double side = 1;          ///< the side of one square
  std::vector<Square> squares;
  /// Short name of a whole position of the axes, for the ticks. Null: ticks are numbers.
  std::function<std::string(std::size_t position)> name_of = {};
};

/// Rows of spans over one axis, one row below the other. They show when each of several things goes on.
struct TimelinePlot {
  struct Row {
    std::string name;
    std::vector<std::pair<double, double>> spans;
  };
  std::string x_label;
  double from = 0, to = 1;  ///< range of the axis
  std::vector<Row> rows;
};

[[nodiscard]] std::string svg_plot(const LinePlot& plot);
[[nodiscard]] std::string svg_plot(const PanelPlot& plot);
[[nodiscard]] std::string svg_plot(const PointPlot& plot);
[[nodiscard]] std::string svg_plot(const BarPlot& plot);
[[nodiscard]] std::string svg_plot(const MirrorPlot& plot);
[[nodiscard]] std::string svg_plot(const HeatPlot& plot);
[[nodiscard]] std::string svg_plot(const MapPlot& plot);
[[nodiscard]] std::string svg_plot(const TimelinePlot& plot);

/// Rows of bars over one axis, each with its own scale. The rows show where along the chain several
/// quantities occur.
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

/// If there are more columns than a plot shows, neighbouring columns are combined and their mean is shown.
[[nodiscard]] std::string svg_plot(const RowsPlot& plot);

}  // namespace kds
