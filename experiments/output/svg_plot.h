#pragma once
// Curves, bars and maps as SVG elements that can stand side by side in one page.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace kds {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< by increasing first coordinate
};

struct LinePlot {
  std::string id;  ///< a word, its own within the page
  std::string x_label, y_label;
  bool staircase = false;  ///< a value holds until the next point
  std::vector<Curve> curves;
  bool below_zero = false;  ///< values may be; else the axis begins at 0
};

/// Points with their names beside them, those of one series in its colour; both axes logarithmic.
struct PointPlot {
  struct Point {
    std::string name;  ///< empty: none is shown
    double x, y;       ///< x above 0; what is 0 or but a millionth of the largest stands at the bottom
    std::size_t series = 0;
  };
  std::string id;
  std::string x_label, y_label;
  std::vector<std::string> series;
  std::vector<Point> points;
};

struct BarPlot {
  std::string id;
  std::string y_label;
  std::vector<std::pair<std::string, double>> bars;
};

/// Squares of equal size in a square, coloured by value; where there is none, nothing.
struct MapPlot {
  struct Square {
    double x, y;  ///< its middle
    double value;
  };
  std::string id;
  std::string label;        ///< of both axes
  std::string value_label;  ///< of the colours
  double from = 0, to = 1;  ///< both axes
  double side = 1;          ///< of a square
  std::vector<Square> squares;
};

[[nodiscard]] std::string svg_plot(const LinePlot& plot);
[[nodiscard]] std::string svg_plot(const PointPlot& plot);
[[nodiscard]] std::string svg_plot(const BarPlot& plot);
[[nodiscard]] std::string svg_plot(const MapPlot& plot);

/// The <svg> element alone, its ids and the references to them prefixed: two plots of one page must not share
/// any.
[[nodiscard]] std::string embeddable_svg(const std::string& document, const std::string& id);

}  // namespace kds
