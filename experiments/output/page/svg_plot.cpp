#include "experiments/output/page/svg_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <string_view>

#include "experiments/output/page/drawing.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/print.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr double kMarkSize = 0.8;  // about 4 pixels

// Returns the size of the marks of a series. Marks are smaller than those of the series before, which would
// otherwise be covered where points coincide.
double mark_size(std::size_t series, std::size_t all) {
  if (all < 2 || series >= all) return kMarkSize;
  return kMarkSize + std::min(0.2, 0.5 / static_cast<double>(all)) * static_cast<double>(all - 1 - series);
}

// Returns the texts under the pointer: the values of all curves at each x. If there are more x than texts
// fit, not more than `most`.
std::map<double, std::string> values_of(const LinePlot& plot, const std::vector<double>& xs,
                                        std::size_t most) {
  std::map<double, std::string> values;
  for (std::size_t k = 0; k < xs.size(); k += (xs.size() + most - 1) / most)
    values[xs[k]] = plot.x_label + " " + tick_label(xs[k]);
  for (const Curve& curve : plot.curves)
    for (const auto& [x, y] : curve.points)
      if (const auto position = values.find(x); position != values.end())
        position->second += "\n" + (curve.name.empty() ? plot.y_label : curve.name) + ": " + tick_label(y);
  return values;
}

// Factors between values from which an axis is logarithmic, and between curves that share no linear axis.
constexpr double kFarInX = 8, kFarInY = 10;

bool is_marks(const LinePlot& plot) { return plot.drawn == Drawn::points; }

bool is_logarithmic(const LinePlot& plot) {
  Range y;
  for (const Curve& curve : plot.curves)
    for (const auto& [at, value] : curve.points) y.add(value);
  return is_marks(plot) && !plot.below_zero && !y.empty() && y.least > 0 && y.most >= kFarInY * y.least;
}

// An error bar, from one point to another.
struct ErrorBar {
  double from_x, from_y, to_x, to_y;
};

std::string bars_script(const std::string& name, const std::vector<ErrorBar>& bars) {
  std::string script = fmt::format("${} << EOD\n", name);
  for (const ErrorBar& bar : bars)
    script += fmt::format("{:.17g} {:.17g}\n{:.17g} {:.17g}\n\n", bar.from_x, bar.from_y, bar.to_x, bar.to_y);
  return script + "EOD\n";
}

// Sets the y axis. Returns the middle of the axis.
double set_y_axis(const LinePlot& plot, bool logarithmic_y, std::string& script) {
  Range y;
  for (const Curve& curve : plot.curves) {
    for (const auto& [at, value] : curve.points) y.add(value);
    for (const auto& [least, most] : curve.bars) {
      if (!logarithmic_y || least > 0) y.add(least);
      y.add(most);
    }
  }
  if (logarithmic_y) {
    y = y.with_margin(true);
    script += logarithmic('y', y, y_ticks);
    return std::sqrt(y.least) * std::sqrt(y.most);
  }
  if (!plot.below_zero) y = {0, y.most > 0 ? y.most : 1};
  y = y.around();
  const double apart = tick_step(y, y_ticks);
  y = {std::floor(y.least / apart + 1e-9) * apart, std::ceil(y.most / apart - 1e-9) * apart};
  script += linear('y', y, y_ticks);
  return (y.least + y.most) / 2;
}

// `names` has the name of each curve at the index of its colour.
Drawing draw(const LinePlot& plot, const DrawingSize& size, const std::vector<std::string>& names,
             bool logarithmic_y) {
  Drawing drawing{size, axes(size, plot.x_label, plot.y_label), TextsOf::strips, {}};
  std::string& script = drawing.script;
  std::vector<double> xs;
  for (const Curve& curve : plot.curves)
    for (const auto& [at, value] : curve.points) xs.push_back(at);
  std::sort(xs.begin(), xs.end());
  xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
  const double middle = set_y_axis(plot, logarithmic_y, script);

  const bool marks = is_marks(plot);
  const bool spread = marks && xs.size() > 2 && xs.front() > 0 && xs.back() >= kFarInX * xs.front();
  Range x = (xs.empty() ? Range{} : Range{xs.front(), xs.back()}).around();
  if (marks) x = x.with_margin(spread);
  script += spread ? logarithmic('x', x, x_ticks(size)) : linear('x', x, x_ticks(size));
  // If x takes only a few values, the ticks are at these values.
  if (marks && !xs.empty() && xs.size() <= 8) script += set_ticks('x', xs);

  const auto style = [&](std::size_t series) {
    return marks ? fmt::format("points pt 7 ps {:.3g}", mark_size(series, names.size()))
           : plot.drawn == Drawn::staircase ? std::string("steps linewidth 1.6")
                                            : std::string("lines linewidth 1.6");
  };
  std::string curves;
  for (std::size_t s = 0; s < plot.curves.size(); ++s) {
    const Curve& curve = plot.curves[s];
    if (curve.points.empty()) continue;
    script += fmt::format("$curve{} << EOD\n", s);
    for (const auto& [px, py] : curve.points) script += fmt::format("{:.17g} {:.17g}\n", px, py);
    script += "EOD\n";
    const auto series = static_cast<std::size_t>(std::ranges::find(names, curve.name) - names.begin());
    std::vector<ErrorBar> bars;
    for (std::size_t k = 0; k < curve.bars.size(); ++k)
      if (const auto& [least, most] = curve.bars[k]; least < most)
        bars.push_back({curve.points[k].first, least, curve.points[k].first, most});
    if (!bars.empty()) {
      script += bars_script(fmt::format("bars{}", s), bars);
      curves += fmt::format("$bars{} using 1:2 with lines linewidth 1 linecolor {}, ", s, colour(series));
    }
    curves += fmt::format("$curve{} using 1:2 with {} linecolor {} title {}, ", s, style(series),
                          colour(series), gnuplot_text(curve.name));
  }
  const auto values = values_of(plot, xs, is_wide(size) ? 300 : 100);
  if (!values.empty() && size.has_texts) {
    script += "$values << EOD\n";
    for (const auto& [at, text] : values) {
      script += fmt::format("{:.17g} {:.17g} {}\n", at, middle, drawing.texts.size());
      drawing.texts.push_back(text);
    }
    script += "EOD\n";
    curves += "$values using 1:2:3 with labels hypertext point pt 7, ";
  }
  script += "plot " + curves + "NaN\n";
  return drawing;
}

// Places names next to points, in pixels, where they cover no other name or point.
class Labels {
 public:
  Labels(double left, double right) : left_(left), right_(right) {}

  void add_mark(double x, double y) { marks_.emplace_back(x, y); }

  std::string label(double x, double y, const std::string& name) {
    constexpr double letter = 7, line = 13, mark = 4;
    const double length = letter * static_cast<double>(name.size());
    const bool to_the_left = x + 8 + length > right_;
    const Box box{to_the_left ? x - 8 - length : x + 8, to_the_left ? x - 8 : x + 8 + length, y};
    if (box.from < left_) return "";
    for (const auto& [at, level] : marks_)
      if (box.from - mark < at && at < box.to + mark && std::abs(box.y - level) < line / 2) return "";
    for (const Box& other : boxes_)
      if (box.from < other.to && other.from < box.to && std::abs(box.y - other.y) < line) return "";
    boxes_.push_back(box);
    return to_the_left ? "right offset -1,0" : "left offset 1,0";
  }

 private:
  struct Box {
    double from, to, y;
  };
  double left_, right_;
  std::vector<std::pair<double, double>> marks_;
  std::vector<Box> boxes_;
};

Drawing draw(const PointPlot& plot, const DrawingSize& size) {
  Range xs, ys;
  for (const PointPlot::Point& point : plot.points) {
    xs.add(point.x);
    if (point.from < point.to) {
      xs.add(point.from);
      xs.add(point.to);
    }
    if (point.y > 0) ys.add(point.y);
    if (point.least > 0) ys.add(point.least);
    if (point.most > 0) ys.add(point.most);
  }
  if (xs.empty()) xs.add(1);
  if (ys.empty()) ys.add(1);
  const double floor = std::max(ys.least, 1e-6 * ys.most);
  const bool has_zero = std::any_of(plot.points.begin(), plot.points.end(),
                                    [&](const PointPlot::Point& point) { return point.y < floor; });
  const double bottom = has_zero ? floor / 10 : floor;
  const Range x = xs.with_margin(true), y = Range{bottom, ys.most}.with_margin(true);

  Drawing drawing{size, axes(size, plot.x_label, plot.y_label), TextsOf::marks, {}};
  std::string& script = drawing.script;
  script += logarithmic('x', x, x_ticks(size)) + logarithmic('y', y, y_ticks);
  Labels labels(size.left, size.width - size.right);
  const auto share = [](const Range& range, double value) {
    return std::log(value / range.least) / std::log(range.most / range.least);
  };
  const auto pixels = [&](const PointPlot::Point& point) {
    return std::pair(size.left + share(x, point.x) * (size.width - size.left - size.right),
                     -share(y, std::max(point.y, bottom)) * (size.height - size.top - size.bottom));
  };
  for (const PointPlot::Point& point : plot.points) {
    const auto [across, down] = pixels(point);
    labels.add_mark(across, down);
  }
  std::map<std::size_t, std::string> marks;
  std::map<std::size_t, std::vector<ErrorBar>> bars;
  for (const PointPlot::Point& point : plot.points) {
    const double at_y = std::max(point.y, bottom);
    const auto [across, down] = pixels(point);
    const std::string where =
        is_wide(size) && !point.name.empty() ? labels.label(across, down, point.name) : "";
    if (!where.empty())
      script += fmt::format("set label {} at {:.17g},{:.17g} {} textcolor rgb c_soft\n",
                            gnuplot_text(point.name), point.x, at_y, where);
    if (point.least < point.most)
      bars[point.series].push_back(
          {point.x, std::max(point.least, bottom), point.x, std::max(point.most, bottom)});
    if (point.from < point.to) bars[point.series].push_back({point.from, at_y, point.to, at_y});
    marks[point.series] += fmt::format("{:.17g} {:.17g} {}\n", point.x, at_y, drawing.texts.size());
    if (!size.has_texts) continue;
    const std::string& series = point.series < plot.series.size() ? plot.series[point.series] : point.name;
    drawing.texts.push_back(fmt::format("{}\n{}: {}\n{}: {}", point.name.empty() ? series : point.name,
                                        plot.x_label, tick_label(point.x), plot.y_label,
                                        tick_label(point.y)));
  }
  std::string curves;
  for (const auto& [series, ends] : bars) {
    script += bars_script(fmt::format("bars{}", series), ends);
    curves += fmt::format("$bars{} using 1:2 with lines linewidth 1 linecolor {}, ", series, colour(series));
  }
  for (const auto& [series, data] : marks) {
    script += fmt::format("$series{} << EOD\n{}EOD\n", series, data);
    curves += fmt::format("$series{} using {} pt 7 ps {:.3g} linecolor {}, ", series,
                          size.has_texts ? "1:2:3 with labels hypertext point" : "1:2 with points",
                          mark_size(series, plot.series.size()), colour(series));
  }
  script += "plot " + curves + "NaN\n";
  return drawing;
}

Drawing draw(const BarPlot& plot, DrawingSize size) {
  std::size_t longest = 0;
  double most = 0;
  for (const BarPlot::Bar& bar : plot.bars) {
    longest = std::max(longest, bar.name.size());
    most = std::max(most, bar.value);
  }
  const double pitch = plot.series.size() > 1 ? 20 : 28;
  size.height = pitch * static_cast<double>(plot.bars.size()) + 34 + size.head;
  constexpr double letter = 7.2, beside = 14;
  size.left = std::min(letter * static_cast<double>(longest) + beside, is_wide(size) ? 300.0 : 140.0);
  const auto room = static_cast<std::size_t>((size.left - beside) / letter + 0.5);
  size.right = 90;
  size.top = 4 + size.head;
  size.bottom = 28;
  Drawing drawing{size, axes(size, plot.x_label, ""), TextsOf::marks, {}};
  std::string& script = drawing.script;
  script +=
      fmt::format("set border 2\nunset grid\nunset xtics\nset xrange [0:{:.17g}]\nset yrange [{}:-0.5]\n",
                  most > 0 ? most : 1, static_cast<double>(plot.bars.size()) - 0.5);
  std::vector<std::string> names;
  std::map<std::size_t, std::string> of_series;
  for (std::size_t row = 0; row < plot.bars.size(); ++row) {
    const auto& [name, value, series] = plot.bars[row];
    script += fmt::format("set label {} at {:.17g},{} left offset 0.8,0 textcolor rgb c_soft\n",
                          gnuplot_text(tick_label(value)), value, row);
    of_series[series] += fmt::format("{0:.17g} {1} 0 {0:.17g} {2} {3}\n", value, row,
                                     static_cast<double>(row) - 0.36, static_cast<double>(row) + 0.36);
    names.push_back(gnuplot_text(shortened(name, room)) + fmt::format(" {}", row));
  }
  script += fmt::format("set ytics ({})\n", fmt::join(names, ","));
  std::string bars;
  for (const auto& [series, data] : of_series) {
    script += fmt::format("$bars{} << EOD\n{}EOD\n", series, data);
    bars += fmt::format("$bars{} using 1:2:3:4:5:6 with boxxyerror linecolor {}, ", series, colour(series));
  }
  script += "plot " + bars + "NaN\n";
  return drawing;
}

Drawing draw(const MirrorPlot& plot, DrawingSize size) {
  constexpr double letter = 7.2, beside = 14;
  const double most_room = is_wide(size) ? 300 : 170;
  double most = 0;
  const auto room = [&](MirrorPlot::Bar MirrorPlot::Row::*side) {
    std::size_t longest = 0;
    for (const MirrorPlot::Row& row : plot.rows) {
      const MirrorPlot::Bar& bar = row.*side;
      most = std::max(most, bar.value);
      longest = std::max(longest, bar.name.size() + 2 + tick_label(bar.value).size());
    }
    return std::min(letter * static_cast<double>(longest) + beside, most_room);
  };
  size.left = room(&MirrorPlot::Row::left);
  size.right = room(&MirrorPlot::Row::right);
  size.top = 4 + size.head;
  size.bottom = 28;
  size.height = 28 * static_cast<double>(plot.rows.size()) + 34 + size.head;
  Drawing drawing{size, axes(size, plot.x_label, ""), TextsOf::marks, {}};
  const double end = most > 0 ? most : 1;
  drawing.script += fmt::format(
      "unset border\nunset grid\nunset xtics\nunset ytics\nset xrange [{:.17g}:{:.17g}]\n"
      "set yrange [{}:-0.5]\nset arrow from 0, graph 0 to 0, graph 1 nohead linecolor rgb c_soft\n",
      -end, end, static_cast<double>(plot.rows.size()) - 0.5);
  std::string data;
  const auto add = [&](const MirrorPlot::Bar& bar, std::size_t row, int sign) {
    if (bar.name.empty()) return;
    const std::string value = tick_label(bar.value);
    const auto letters = static_cast<std::size_t>((most_room - beside) / letter) - value.size() - 2;
    drawing.script += fmt::format("set label {} at {:.17g},{} {} textcolor rgb c_soft\n",
                                  gnuplot_text(shortened(bar.name, letters) + ": " + value), sign * bar.value,
                                  row, sign > 0 ? "left offset 0.8,0" : "right offset -0.8,0");
    data += fmt::format("{:.17g} {} {:.17g} 0.36\n", sign * bar.value / 2, row, bar.value / 2);
  };
  for (std::size_t row = 0; row < plot.rows.size(); ++row) {
    add(plot.rows[row].right, row, 1);
    add(plot.rows[row].left, row, -1);
  }
  drawing.script += fmt::format("$bars << EOD\n{}EOD\n", data);
  drawing.script += fmt::format("plot $bars using 1:2:3:4 with boxxyerror linecolor {}, NaN\n", colour(0));
  return drawing;
}

// A rectangle that shows a value by its colour.
struct Box {
  double x, y, half_width, half_height, value;
  std::string text;
};

// Draws boxes with their values under the pointer, and nothing else.
void add_boxes(Drawing& drawing, const std::vector<Box>& boxes, const std::string& value_label) {
  double most = 0;
  for (const Box& box : boxes) most = std::max(most, box.value);
  drawing.script += "$boxes << EOD\n";
  for (const Box& box : boxes) {
    const double opacity = 0.25 + 0.75 * (most > 0 ? box.value / most : 1);
    drawing.script +=
        fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {}\n", box.x, box.y, box.half_width, box.half_height,
                    std::lround(255 * (1 - opacity)) << 24);  // covers the colour of series 0
    if (drawing.size.has_texts)
      drawing.texts.push_back(fmt::format("{}\n{}: {}", box.text, value_label, tick_label(box.value)));
  }
  drawing.script += "EOD\nplot ";
  if (!boxes.empty())
    drawing.script +=
        "$boxes using 1:2:3:4:($5 + int('0x'.c_s0[2:])) with boxxyerror linecolor rgb variable, ";
  drawing.script += "NaN\n";
}

Drawing draw(const HeatPlot& plot, const DrawingSize& size) {
  Drawing drawing{size, axes(size, plot.x_label, plot.y_label), TextsOf::squares, {}};
  drawing.script += linear('x', {plot.x_edges.front(), plot.x_edges.back()}, x_ticks(size)) +
                    linear('y', {plot.y_edges.front(), plot.y_edges.back()}, y_ticks) + "unset grid\n";
  std::vector<Box> boxes;
  for (std::size_t c = 0; c < plot.values.size(); ++c) {
    const double left = plot.x_edges[c], right = plot.x_edges[c + 1];
    for (std::size_t r = 0; r < plot.values[c].size(); ++r) {
      const double low = plot.y_edges[r], high = plot.y_edges[r + 1], value = plot.values[c][r];
      if (value > 0)
        boxes.push_back({(left + right) / 2, (low + high) / 2, (right - left) / 2, (high - low) / 2, value,
                         plot.text(c, r)});
    }
  }
  add_boxes(drawing, boxes, plot.value_label);
  return drawing;
}

// Returns the ticks of an axis of a map, with the names of the positions.
std::string named_ticks(char axis, const MapPlot& plot, int most) {
  const double apart = std::max(1.0, tick_step({plot.from, plot.to}, most));
  std::vector<std::string> ticks;
  for (double position = std::ceil(plot.from / apart) * apart; position <= plot.to; position += apart)
    ticks.push_back(gnuplot_text(plot.name_of(static_cast<std::size_t>(position))) +
                    fmt::format(" {:.17g}", position));
  return fmt::format("set {}tics ({})\n", axis, fmt::join(ticks, ","));
}

Drawing draw(const MapPlot& plot, DrawingSize size) {
  const double side = size.for_print ? 440 : is_wide(size) ? 700 : 280;
  size.left = 68;
  size.right = size.width - size.left - side;
  size.height = side + size.top + size.bottom;
  Drawing drawing{size, axes(size, plot.label, plot.label), TextsOf::squares, {}};
  const Range range{plot.from, plot.to};
  const int most_ticks = is_wide(size) ? 8 : 4;
  drawing.script += linear('x', range, most_ticks) + linear('y', range, most_ticks);
  if (plot.name_of) drawing.script += named_ticks('x', plot, most_ticks) + named_ticks('y', plot, most_ticks);
  const double half = std::max(plot.side / 2, (plot.to - plot.from) / side);  // at least two pixels wide
  std::vector<Box> boxes;
  for (const auto& [x, y, value, text] : plot.squares)
    boxes.push_back(
        {x, y, half, half, value,
         text.empty() ? fmt::format("{} {}, {}", plot.label, tick_label(x), tick_label(y)) : text});
  add_boxes(drawing, boxes, plot.value_label);
  return drawing;
}

Drawing draw(const TimelinePlot& plot, DrawingSize size) {
  constexpr double pitch = 16, letter = 7.2, beside = 14;
  std::size_t longest = 0;
  for (const TimelinePlot::Row& row : plot.rows) longest = std::max(longest, row.name.size());
  size.height = pitch * static_cast<double>(plot.rows.size()) + size.bottom + 6 + size.head;
  size.top = 6 + size.head;
  size.left = std::min(letter * static_cast<double>(longest) + beside, is_wide(size) ? 260.0 : 150.0);
  const auto room = static_cast<std::size_t>((size.left - beside) / letter + 0.5);
  Drawing drawing{size, axes(size, plot.x_label, ""), TextsOf::squares, {}};
  drawing.script +=
      linear('x', {plot.from, plot.to}, x_ticks(size)) +
      fmt::format("set yrange [{}:-0.5]\nset grid xtics noytics linetype 1 linecolor '#000009'\n",
                  static_cast<double>(plot.rows.size()) - 0.5);
  std::vector<std::string> names;
  std::string data;
  const double least = (plot.to - plot.from) / (size.width - size.left - size.right);  // a pixel
  for (std::size_t row = 0; row < plot.rows.size(); ++row) {
    names.push_back(gnuplot_text(shortened(plot.rows[row].name, room)) + fmt::format(" {}", row));
    for (const auto& [begin, end] : plot.rows[row].spans) {
      const double middle = 0.5 * (begin + end), half = 0.5 * std::max(end - begin, least);
      data += fmt::format("{0:.17g} {1} {2:.17g} {3:.17g} {4} {5}\n", middle, row, middle - half,
                          middle + half, static_cast<double>(row) - 0.36, static_cast<double>(row) + 0.36);
    }
  }
  drawing.script += fmt::format("set ytics ({})\n", fmt::join(names, ","));
  if (!data.empty()) drawing.script += "$spans << EOD\n" + data + "EOD\n";
  drawing.script += "plot ";
  if (!data.empty())
    drawing.script += fmt::format("$spans using 1:2:3:4:5:6 with boxxyerror linecolor {}, ", colour(0));
  drawing.script += "NaN\n";
  return drawing;
}

// Returns a plot's copy for print, as `draw_it` draws it for a size.
template <class Draw>
std::string print_copy(double height, const std::string& title, const std::vector<std::string>& names,
                       const Draw& draw_it) {
  Drawing drawing = draw_it(print_size(height, title, names));
  drawing.script = print_head(drawing.size, title, names) + drawing.script;
  return plot_for_print(drawing);
}

// Returns the key of a plot, the plot, which `draw_it` draws for a size, and its copy for print.
template <class Draw>
std::string drawn_once(double height, const std::vector<std::string>& names, const std::string& label,
                       const Draw& draw_it) {
  return html_key(names) + drawn({{draw_it(wide(height)), draw_it(narrow(height))}}, {label}).front() +
         print_copy(height, "", names, draw_it);
}

std::string label_of(const LinePlot& plot) { return plot.y_label + " by " + plot.x_label; }

void add_names(const LinePlot& plot, std::vector<std::string>& names) {
  for (const Curve& curve : plot.curves)
    if (std::ranges::find(names, curve.name) == names.end()) names.push_back(curve.name);
}

double magnitude_of(const Curve& curve) {
  double most = 0;
  for (const auto& [x, y] : curve.points) most = std::max(most, std::abs(y));
  return most;
}

// Returns the curves in groups of similar magnitude, in the order of their first curves. A curve that is zero
// everywhere joins the smallest.
std::vector<LinePlot> by_magnitude(const LinePlot& plot) {
  std::vector<std::pair<double, std::size_t>> curves;
  for (std::size_t k = 0; k < plot.curves.size(); ++k) curves.emplace_back(magnitude_of(plot.curves[k]), k);
  std::ranges::stable_sort(curves, std::ranges::greater{}, &std::pair<double, std::size_t>::first);
  std::vector<std::vector<std::size_t>> groups;
  double most = 0;
  for (const auto& [magnitude, k] : curves) {
    if (groups.empty() || (magnitude > 0 && kFarInY * magnitude < most)) {
      groups.emplace_back();
      most = magnitude;
    }
    groups.back().push_back(k);
  }
  for (auto& group : groups) std::ranges::sort(group);
  std::ranges::sort(groups);
  std::vector<LinePlot> plots;
  for (const auto& group : groups) {
    LinePlot& part =
        plots.emplace_back(LinePlot{plot.x_label, plot.y_label, plot.drawn, {}, plot.below_zero});
    for (const std::size_t k : group) part.curves.push_back(plot.curves[k]);
  }
  return plots;
}

std::string title_of(const LinePlot& plot) {
  std::string title;
  for (const Curve& curve : plot.curves) title += (title.empty() ? "" : ", ") + curve.name;
  return title;
}

}  // namespace

std::string svg_plot(const LinePlot& plot) {
  const bool is_log = is_logarithmic(plot);
  std::vector<LinePlot> parts = is_log ? std::vector{plot} : by_magnitude(plot);
  if (parts.size() > 1) {
    PanelPlot panels;
    for (LinePlot& part : parts) {
      std::string title = title_of(part);
      panels.panels.push_back({std::move(title), std::move(part)});
    }
    return svg_plot(panels);
  }
  std::vector<std::string> names;
  add_names(plot, names);
  return drawn_once(320, names, label_of(plot),
                    [&](const DrawingSize& size) { return draw(plot, size, names, is_log); });
}

std::string svg_plot(const PanelPlot& plot) {
  constexpr DrawingSize panel{420, 220, 64, 20, 26, 48};
  std::vector<std::string> all;
  for (const PanelPlot::Panel& one : plot.panels) add_names(one.plot, all);
  const bool one_key = all.size() <= series_colours;
  // Panels side by side have axes of one kind.
  const bool is_log = !plot.panels.empty() && std::ranges::all_of(plot.panels, [](const auto& one) {
    return is_logarithmic(one.plot);
  });
  std::vector<Plotted> plots;
  std::vector<std::string> keys, labels, copies;
  for (const PanelPlot::Panel& one : plot.panels) {
    std::vector<std::string> own;
    add_names(one.plot, own);
    keys.push_back(one_key ? "" : html_key(own));
    labels.push_back(one.title + ": " + label_of(one.plot));
    const std::vector<std::string>& names = one_key ? all : own;
    const auto draw_it = [&](const DrawingSize& size) { return draw(one.plot, size, names, is_log); };
    plots.push_back({draw_it(panel), draw_it(narrow(panel.height))});
    const bool key_says_title = own.size() > 1 && one.title == title_of(one.plot);
    copies.push_back(print_copy(panel.height, key_says_title ? "" : one.title, own,
                                [&](const DrawingSize& size) { return draw(one.plot, size, own, is_log); }));
  }
  const bool has_titles_for_key = std::ranges::all_of(plot.panels, [](const PanelPlot::Panel& one) {
    return one.plot.curves.size() == 1 && one.plot.curves.front().name == one.title;
  });
  std::string html = (one_key && !has_titles_for_key ? html_key(all) : "") + "<div class=\"panels\">\n";
  const std::vector<std::string> svgs = drawn(plots, labels);
  for (std::size_t k = 0; k < svgs.size(); ++k)
    html += fmt::format("<div><h3>{}</h3>\n{}{}{}</div>\n", html_escaped(plot.panels[k].title), keys[k],
                        svgs[k], copies[k]);
  return html + "</div>\n";
}

std::string svg_plot(const PointPlot& plot) {
  return drawn_once(350, plot.series, plot.y_label + " by " + plot.x_label,
                    [&](const DrawingSize& size) { return draw(plot, size); });
}
std::string svg_plot(const BarPlot& plot) {
  return drawn_once(0, plot.series, plot.x_label, [&](const DrawingSize& size) { return draw(plot, size); });
}
std::string svg_plot(const MirrorPlot& plot) {
  return drawn_once(0, {}, plot.x_label, [&](const DrawingSize& size) { return draw(plot, size); });
}
std::string svg_plot(const HeatPlot& plot) {
  return drawn_once(320, {}, fmt::format("{} by {} and {}", plot.value_label, plot.x_label, plot.y_label),
                    [&](const DrawingSize& size) { return draw(plot, size); });
}
std::string svg_plot(const MapPlot& plot) {
  return drawn_once(0, {}, plot.value_label + " by " + plot.label,
                    [&](const DrawingSize& size) { return draw(plot, size); });
}

std::string svg_plot(const TimelinePlot& plot) {
  return drawn_once(0, {}, "times by " + plot.x_label,
                    [&](const DrawingSize& size) { return draw(plot, size); });
}

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
  size.top = size.head;
  size.height = kRow * static_cast<double>(plot.rows.size()) + size.bottom + size.head;
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
    script += fmt::format("set label {} at graph 0, first {:.6g} left textcolor rgb c_soft\n",
                          gnuplot_text(heading(row, size)), base - kBars - 12 / kRow);
    script += fmt::format(
        "set arrow from graph 0, first {0} to graph 1, first {0} nohead linecolor rgb c_line\n", base);
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
  if (!bins.empty() && size.has_texts) {
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
  return drawn_once(0, {}, "by " + plot.x_label, [&](const DrawingSize& size) { return draw(plot, size); });
}

}  // namespace kds
