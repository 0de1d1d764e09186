#include "experiments/output/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "experiments/output/html_text.h"
#include "experiments/output/svg_canvas.h"

namespace kds {
namespace {

constexpr SvgCanvas::Margins kMargins{64, 32, 26, 48};
constexpr double kHeight = 320;

// Twice, and the names of the series above: outside, so that they find room on narrow pages.
template <class Draw>
std::string in_both_widths(const std::vector<std::string>& names, const Draw& draw) {
  std::string html;
  if (names.size() > 1) {
    html += "<p class=\"key\">";
    for (std::size_t s = 0; s < names.size(); ++s)
      html += fmt::format("<span class=\"{}\">{}</span> ", series_class(s), html_escaped(names[s]));
    html += "</p>\n";
  }
  return html + draw(Width::wide) + draw(Width::narrow);
}

struct Range {
  double least = HUGE_VAL, most = -HUGE_VAL;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  [[nodiscard]] bool empty() const { return least > most; }
};

// What is measured at some values of x only has its ticks there, apart as powers are where they spread far.
struct XValues {
  std::vector<double> all;  ///< ascending, each once
  bool few = false, spread = false;
};
XValues x_values(const LinePlot& plot) {
  XValues values;
  for (const Curve& curve : plot.curves)
    for (const auto& [x, y] : curve.points) values.all.push_back(x);
  std::sort(values.all.begin(), values.all.end());
  values.all.erase(std::unique(values.all.begin(), values.all.end()), values.all.end());
  values.few = plot.drawn == Drawn::points && values.all.size() <= 8;
  values.spread = plot.drawn == Drawn::points && values.all.size() > 2 && values.all.front() > 0 &&
                  values.all.back() >= 8 * values.all.front();
  return values;
}

std::string path_of(const SvgCanvas& canvas, const Curve& curve, const Axis& x, const Axis& y, Drawn drawn) {
  std::string path;
  for (const auto& [px, py] : curve.points) {
    if (path.empty()) {
      path = fmt::format("M{:.1f} {:.1f}", canvas.x(x, px), canvas.y(y, py));
    } else if (drawn == Drawn::staircase) {
      path += fmt::format("H{:.1f}V{:.1f}", canvas.x(x, px), canvas.y(y, py));
    } else {
      path += fmt::format("L{:.1f} {:.1f}", canvas.x(x, px), canvas.y(y, py));
    }
  }
  return path;
}

void draw_curve(SvgCanvas& canvas, const Curve& curve, std::size_t series, const Axis& x, const Axis& y,
                Drawn drawn) {
  if (drawn != Drawn::points) {
    canvas.add(fmt::format("<path class=\"curve {}\" d=\"{}\"/>\n", series_class(series),
                           path_of(canvas, curve, x, y, drawn)));
    return;
  }
  for (const auto& [px, py] : curve.points)
    canvas.add(fmt::format("<circle class=\"mark {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>\n",
                           series_class(series), canvas.x(x, px), canvas.y(y, py)));
}

// Where the pointer rests, the values of all curves there: strips from one x to the next.
void draw_values(SvgCanvas& canvas, const LinePlot& plot, const std::vector<double>& all, const Axis& x) {
  const std::size_t most = canvas.is_wide() ? 300 : 100;
  const std::size_t every = (all.size() + most - 1) / most;
  std::map<double, std::string> values;
  for (std::size_t k = 0; k < all.size(); k += every) values[all[k]];
  for (const Curve& curve : plot.curves)
    for (const auto& [px, py] : curve.points)
      if (const auto place = values.find(px); place != values.end())
        place->second +=
            fmt::format("\n{}: {}", curve.name.empty() ? plot.y_label : curve.name, tick_label(py));
  for (auto place = values.begin(); place != values.end(); ++place) {
    const double at = canvas.x(x, place->first);
    const auto halfway = [&](auto other) { return (at + canvas.x(x, other->first)) / 2; };
    const double from = place == values.begin() ? canvas.left() : halfway(std::prev(place));
    const double to = std::next(place) == values.end() ? canvas.right() : halfway(std::next(place));
    canvas.hot_rectangle(from, canvas.top(), to - from, canvas.bottom() - canvas.top(),
                         plot.x_label + " " + tick_label(place->first) + place->second);
  }
}

std::string draw(const LinePlot& plot, Width width) {
  SvgCanvas canvas(width, kHeight, kMargins);
  const XValues xs = x_values(plot);
  Range range;
  for (const Curve& curve : plot.curves)
    for (const auto& [px, py] : curve.points) range.add(py);
  if (range.empty()) range.add(0);
  if (!plot.below_zero) range.add(0);
  Axis y(range.least, range.most, false);
  if (!plot.below_zero && range.most <= 0) y = Axis(0, 1, false);
  y.widen_to_ticks(canvas.y_ticks());

  double first = xs.all.empty() ? 0 : xs.all.front(), last = xs.all.empty() ? 1 : xs.all.back();
  if (plot.drawn == Drawn::points && xs.spread) {  // marks stand off the edges
    const double margin = std::pow(last / first, 0.05);
    first /= margin;
    last *= margin;
  } else if (plot.drawn == Drawn::points) {
    const double margin = 0.05 * (last - first);
    first -= margin;
    last += margin;
  }
  const Axis x(first, last, xs.spread);
  std::vector<Tick> x_ticks = x.ticks(canvas.x_ticks());
  if (xs.few) {
    x_ticks.clear();
    for (const double value : xs.all) x_ticks.push_back({value, tick_label(value)});
  }
  canvas.draw_y_axis(y, y.ticks(canvas.y_ticks()), plot.y_label);
  canvas.draw_x_axis(x, x_ticks, plot.x_label);
  for (std::size_t s = 0; s < plot.curves.size(); ++s)
    draw_curve(canvas, plot.curves[s], s, x, y, plot.drawn);
  draw_values(canvas, plot, xs.all, x);
  return canvas.element(plot.y_label + " by " + plot.x_label);
}

// Names beside points, where they do not stand on one another.
class Labels {
 public:
  void add(SvgCanvas& canvas, double x, double y, const std::string& name) {
    constexpr double letter = 6.2, line = 13;
    const double length = letter * static_cast<double>(name.size());
    const bool to_the_left = x + 8 + length > canvas.right();
    const Box box{to_the_left ? x - 8 - length : x + 8, to_the_left ? x - 8 : x + 8 + length, y};
    if (box.from < canvas.left()) return;
    for (const Box& other : boxes_)
      if (box.from < other.to && other.from < box.to && std::abs(box.y - other.y) < line) return;
    boxes_.push_back(box);
    canvas.text(to_the_left ? x - 8 : x + 8, y + 4, to_the_left ? "end" : "start", name);
  }

 private:
  struct Box {
    double from, to, y;
  };
  std::vector<Box> boxes_;
};

std::string draw(const PointPlot& plot, Width width) {
  SvgCanvas canvas(width, kHeight + 30, kMargins);
  Range xs, ys;
  for (const PointPlot::Point& point : plot.points) {
    xs.add(point.x);
    if (point.y > 0) ys.add(point.y);
  }
  if (xs.empty()) xs.add(1);
  if (ys.empty()) ys.add(1);
  const double floor = std::max(ys.least, 1e-6 * ys.most);
  const bool has_zero = std::any_of(plot.points.begin(), plot.points.end(),
                                    [&](const PointPlot::Point& point) { return point.y < floor; });
  const double bottom = has_zero ? floor / 10 : floor;
  const auto margin = [](double least, double most) { return std::max(1.1, std::pow(most / least, 0.06)); };
  const Axis x(xs.least / margin(xs.least, xs.most), xs.most * margin(xs.least, xs.most), true);
  const Axis y(bottom / margin(bottom, ys.most), ys.most * margin(bottom, ys.most), true);
  canvas.draw_y_axis(y, y.ticks(canvas.y_ticks()), plot.y_label);
  canvas.draw_x_axis(x, x.ticks(canvas.x_ticks()), plot.x_label);
  Labels labels;
  for (const PointPlot::Point& point : plot.points) {
    const double at_x = canvas.x(x, point.x), at_y = canvas.y(y, std::max(point.y, bottom));
    const std::string& series = point.series < plot.series.size() ? plot.series[point.series] : point.name;
    const std::string title =
        fmt::format("{}\n{}: {}\n{}: {}", point.name.empty() ? series : point.name, plot.x_label,
                    tick_label(point.x), plot.y_label, tick_label(point.y));
    canvas.add(fmt::format(
        "<circle class=\"mark {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"><title>{}</title></circle>\n",
        series_class(point.series), at_x, at_y, html_escaped_lines(title)));
    if (canvas.is_wide() && !point.name.empty()) labels.add(canvas, at_x, at_y, point.name);
  }
  return canvas.element(plot.y_label + " by " + plot.x_label);
}

std::string draw(const BarPlot& plot, Width width) {
  constexpr double row = 28;
  std::size_t longest = 0;
  double most = 0;
  for (const auto& [name, value] : plot.bars) {
    longest = std::max(longest, name.size());
    most = std::max(most, value);
  }
  const double names =
      std::min(7.2 * static_cast<double>(longest) + 14, width == Width::wide ? 300.0 : 130.0);
  SvgCanvas canvas(width, row * static_cast<double>(plot.bars.size()) + 34, {names, 90, 4, 28});
  const Axis x(0, most > 0 ? most : 1, false);
  double y = canvas.top();
  for (const auto& [name, value] : plot.bars) {
    const double end = canvas.x(x, value);
    canvas.text(canvas.left() - 8, y + row / 2 + 4, "end", name);
    canvas.add(
        fmt::format("<rect class=\"bar s0\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                    canvas.left(), y + 4, std::max(0.0, end - canvas.left()), row - 8));
    canvas.text(end + 6, y + row / 2 + 4, "start", tick_label(value));
    y += row;
  }
  canvas.add(fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", canvas.left(), canvas.top(),
                         canvas.bottom()));
  canvas.text(canvas.left(), canvas.bottom() + 20, "start", plot.x_label);
  return canvas.element(plot.x_label);
}

std::string draw(const MapPlot& plot, Width width) {
  const SvgCanvas::Margins margins =
      width == Width::wide ? SvgCanvas::Margins{64, 256, 26, 48} : SvgCanvas::Margins{56, 12, 26, 48};
  const double side = width == Width::wide ? 540 : 292;
  SvgCanvas canvas(width, side + margins.top + margins.bottom, margins);
  const Axis axis(plot.from, plot.to, false);
  canvas.draw_y_axis(axis, axis.ticks(canvas.y_ticks()), plot.label);
  canvas.draw_x_axis(axis, axis.ticks(canvas.y_ticks()), plot.label);
  double most = 0;
  for (const MapPlot::Square& square : plot.squares) most = std::max(most, square.value);
  const double pixels = side * plot.side / (plot.to - plot.from);
  for (const auto& [x, y, value] : plot.squares)
    canvas.add(
        fmt::format("<rect class=\"s0 bar\" fill-opacity=\"{:.2f}\" x=\"{:.2f}\" y=\"{:.2f}\" "
                    "width=\"{:.2f}\" height=\"{:.2f}\"><title>{} {}, {}\n{}: {}</title></rect>\n",
                    0.25 + 0.75 * (most > 0 ? value / most : 1), canvas.x(axis, x) - pixels / 2,
                    canvas.y(axis, y) - pixels / 2, pixels, pixels, html_escaped(plot.label), tick_label(x),
                    tick_label(y), html_escaped(plot.value_label), tick_label(value)));
  return canvas.element(plot.value_label + " by " + plot.label);
}

template <class Plot>
std::string drawn_twice(const Plot& plot, const std::vector<std::string>& names) {
  return in_both_widths(names, [&](Width width) { return draw(plot, width); });
}

}  // namespace

std::string svg_plot(const LinePlot& plot) {
  std::vector<std::string> names;
  for (const Curve& curve : plot.curves) names.push_back(curve.name);
  return drawn_twice(plot, names);
}
std::string svg_plot(const PointPlot& plot) { return drawn_twice(plot, plot.series); }
std::string svg_plot(const BarPlot& plot) { return drawn_twice(plot, {}); }
std::string svg_plot(const MapPlot& plot) { return drawn_twice(plot, {}); }

}  // namespace kds
