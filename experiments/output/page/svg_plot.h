#pragma once
// Curves, points, bars and maps for a page, without a script: drawn twice, for wide pages and for narrow
// ones, of which the page's style shows one. Colours are those of the page, light or dark. A value is shown
// where the pointer rests.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace kds {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< by ascending first coordinate, finite
};

/// How a curve's points are drawn.
enum class Drawn {
  line,       ///< joined
  staircase,  ///< a value holds until the next point
  points      ///< marks alone: nothing is known in between
};

struct LinePlot {
  std::string x_label, y_label;
  Drawn drawn = Drawn::line;
  std::vector<Curve> curves;
  bool below_zero = false;  ///< values may be; else the axis begins at 0
};

/// Small plots beside each other, below each other on narrow pages. A name has one colour in all of them;
/// where there are more names than colours, each has a key of its own.
struct PanelPlot {
  struct Panel {
    std::string title;
    LinePlot plot;
  };
  std::vector<Panel> panels;
};

/// Points with their names beside them, those of one series in its colour; both axes logarithmic.
struct PointPlot {
  struct Point {
    std::string name;  ///< empty: none is shown
    double x, y;       ///< x above 0; what is 0 or but a millionth of the largest stands at the bottom
    std::size_t series = 0;
  };
  std::string x_label, y_label;
  std::vector<std::string> series;
  std::vector<Point> points;
};

/// Bars from left to right, one below the other, each with its value, those of one series in its colour.
struct BarPlot {
  struct Bar {
    std::string name;
    double value;
    std::size_t series = 0;
  };
  std::string x_label;
  std::vector<Bar> bars;
  std::vector<std::string> series = {};  ///< their names; none: nothing is to be told apart
};

/// Squares of equal size in a square, coloured by value; where there is none, nothing.
struct MapPlot {
  struct Square {
    double x, y;  ///< its middle
    double value;
  };
  std::string label;        ///< of both axes
  std::string value_label;  ///< of the colours
  double from = 0, to = 1;  ///< both axes
  double side = 1;          ///< of a square
  std::vector<Square> squares;
};

[[nodiscard]] std::string svg_plot(const LinePlot& plot);
[[nodiscard]] std::string svg_plot(const PanelPlot& plot);
[[nodiscard]] std::string svg_plot(const PointPlot& plot);
[[nodiscard]] std::string svg_plot(const BarPlot& plot);
[[nodiscard]] std::string svg_plot(const MapPlot& plot);

}  // namespace kds
