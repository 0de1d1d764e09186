#include "experiments/output/page/svg_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "experiments/output/page/gnuplot.h"
#include "experiments/output/page/html_text.h"
#include "experiments/output/page/page_svg.h"
#include "experiments/output/text.h"

namespace kds {
namespace {

constexpr double kMarkSize = 0.8;  // about 4 pixels

struct Drawing {
  DrawingSize size;
  std::string script;
  TextsOf of = TextsOf::marks;
  std::vector<std::string> texts;  ///< where the pointer rests
};

bool is_wide(const DrawingSize& size) { return size.width > 500; }
DrawingSize wide(double height) { return {860, height, 64, 32, 26, 48}; }
DrawingSize narrow(double height) { return {360, height, 64, 32, 26, 48}; }

// gnuplot takes what stands between single quotes as it is; a quote is doubled.
std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  for (const char c : one_line(text)) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string colour(std::size_t series) { return fmt::format("'#{:06x}'", series % series_colours); }

std::string axes(const DrawingSize& size, std::string_view x_label, std::string_view y_label) {
  const double right = size.width - size.right, top = size.height - size.top;
  return fmt::format(
      "reset\nset encoding utf8\n"
      "set terminal svg size {0:.0f},{1:.0f} dynamic noenhanced font 'sans-serif,12.5'\n"
      "set lmargin at screen {2:.6f}\nset rmargin at screen {3:.6f}\n"
      "set bmargin at screen {4:.6f}\nset tmargin at screen {5:.6f}\n"
      "set border 1 linecolor '#000008'\nset tics nomirror out scale 0.7 textcolor '#000008'\n"
      "set ytics scale 0\nset xtics offset 0,0.4\nset grid ytics linetype 1 linecolor '#000009' linewidth "
      "1\nunset key\n"
      "set format '{6}'\n"
      "set label {7} at screen {8:.6f}, screen {9:.6f} left textcolor '#000008'\n"
      "set label {10} at screen {11:.6f}, screen {12:.6f} center textcolor '#000008'\n"
      "set style fill solid 1 noborder\n",
      size.width, size.height, size.left / size.width, right / size.width, size.bottom / size.height,
      top / size.height, number_format, gnuplot_text(y_label), 2 / size.width, 1 - 9 / size.height,
      gnuplot_text(x_label), (size.left + right) / 2 / size.width, 10 / size.height);
}

// Both widths by one process.
std::string drawn(const std::vector<Drawing>& drawings, const std::vector<std::string>& names,
                  const std::string& label) {
  std::string script;
  for (const Drawing& drawing : drawings) script += drawing.script + "set output\n";
  const std::string output = run_gnuplot(script);
  std::string html;
  if (names.size() > 1) {
    html += "<p class=\"key\">";
    for (std::size_t s = 0; s < names.size(); ++s)
      html += fmt::format("<span class=\"s{}\">{}</span> ", s % series_colours, html_escaped(names[s]));
    html += "</p>\n";
  }
  constexpr std::string_view ending = "</svg>";
  std::size_t start = 0;
  for (const Drawing& drawing : drawings) {
    const std::size_t end = std::min(output.find(ending, start), output.size());
    html +=
        page_svg(std::string_view(output).substr(start, end - start), drawing.size, drawing.of, drawing.texts,
                 fmt::format("class=\"{}\" role=\"img\" aria-label=\"{}\"",
                             is_wide(drawing.size) ? "wide" : "narrow", html_escaped(label)));
    start = std::min(end + ending.size(), output.size());
  }
  return html;
}

struct Range {
  double least = HUGE_VAL, most = -HUGE_VAL;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  [[nodiscard]] bool empty() const { return least > most; }
  // Wider than what doubles tell apart.
  [[nodiscard]] bool wide() const { return least + 1e-9 * std::max(std::abs(least), std::abs(most)) < most; }
  [[nodiscard]] Range around() const {
    if (empty()) return {0, 1};
    if (wide()) return *this;
    const double by = least == 0 ? 1 : std::abs(least) / 2;
    return {least - by, most + by};
  }
  // Marks stand off the edges.
  [[nodiscard]] Range with_margin(bool logarithmic) const {
    if (!logarithmic) return {least - 0.05 * (most - least), most + 0.05 * (most - least)};
    const double by = std::max(1.1, std::pow(most / least, 0.06));
    return {least / by, most * by};
  }
};

std::string set_range(char axis, const Range& range) {
  return fmt::format("set {}range [{:.17g}:{:.17g}]\n", axis, range.least, range.most);
}

std::string set_ticks(char axis, const std::vector<double>& values) {
  return fmt::format("set {}tics ({:.17g})\n", axis, fmt::join(values, ","));
}

// Between ticks, `most` of them: 1, 2 or 5 times a power of ten.
double step(const Range& range, int most) {
  const double wanted = (range.most - range.least) / most;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  return power * (wanted <= power ? 1 : wanted <= 2 * power ? 2 : wanted <= 5 * power ? 5 : 10);
}

std::string linear(char axis, const Range& range, int most) {
  return set_range(axis, range) + fmt::format("set {}tics {:.17g}\n", axis, step(range, most));
}

int x_ticks(const DrawingSize& size) { return is_wide(size) ? 8 : 4; }
constexpr int kYTicks = 5;

// Powers of ten, about `most` at the most; 1, 2 and 5 of each where there are less than two, and
// round values where there are still less.
std::string logarithmic(char axis, const Range& range, int most) {
  const int first = static_cast<int>(std::floor(std::log10(range.least)));
  const int last = static_cast<int>(std::ceil(std::log10(range.most)));
  std::vector<double> ticks;
  const auto add = [&](double value) {
    if (range.least <= value && value <= range.most) ticks.push_back(value);
  };
  for (int k = first; k <= last; k += last - first > most ? (last - first) / most + 1 : 1)
    add(std::pow(10, k));
  if (ticks.size() < 2) {
    ticks.clear();
    for (int k = first; k <= last; ++k)
      for (const double factor : {1.0, 2.0, 5.0}) add(factor * std::pow(10, k));
  }
  if (ticks.size() < 2) {
    ticks.clear();
    const double apart = step(range, most);
    for (double k = std::ceil(range.least / apart); k * apart <= range.most; ++k) ticks.push_back(k * apart);
  }
  return set_range(axis, range) + fmt::format("set logscale {}\n", axis) + set_ticks(axis, ticks);
}

// The values of all curves where the pointer rests; of long ones not more than there are places for.
std::map<double, std::string> values_of(const LinePlot& plot, const std::vector<double>& xs,
                                        std::size_t most) {
  std::map<double, std::string> values;
  for (std::size_t k = 0; k < xs.size(); k += (xs.size() + most - 1) / most)
    values[xs[k]] = plot.x_label + " " + tick_label(xs[k]);
  for (const Curve& curve : plot.curves)
    for (const auto& [x, y] : curve.points)
      if (const auto place = values.find(x); place != values.end())
        place->second += "\n" + (curve.name.empty() ? plot.y_label : curve.name) + ": " + tick_label(y);
  return values;
}

Drawing draw(const LinePlot& plot, const DrawingSize& size) {
  Drawing drawing{size, axes(size, plot.x_label, plot.y_label), TextsOf::strips, {}};
  std::string& script = drawing.script;
  std::vector<double> xs;
  Range y;
  for (const Curve& curve : plot.curves)
    for (const auto& [px, py] : curve.points) {
      xs.push_back(px);
      y.add(py);
    }
  std::sort(xs.begin(), xs.end());
  xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
  if (!plot.below_zero) y = {0, y.most > 0 ? y.most : 1};
  y = y.around();
  const double apart = step(y, kYTicks);
  y = {std::floor(y.least / apart + 1e-9) * apart, std::ceil(y.most / apart - 1e-9) * apart};
  script += linear('y', y, kYTicks);

  const bool marks = plot.drawn == Drawn::points;
  const bool spread = marks && xs.size() > 2 && xs.front() > 0 && xs.back() >= 8 * xs.front();
  Range x = (xs.empty() ? Range{} : Range{xs.front(), xs.back()}).around();
  if (marks) x = x.with_margin(spread);
  script += spread ? logarithmic('x', x, x_ticks(size)) : linear('x', x, x_ticks(size));
  // What is measured at some values of x only has its ticks there.
  if (marks && !xs.empty() && xs.size() <= 8) script += set_ticks('x', xs);

  const std::string style = marks                            ? fmt::format("points pt 7 ps {}", kMarkSize)
                            : plot.drawn == Drawn::staircase ? "steps linewidth 1.6"
                                                             : "lines linewidth 1.6";
  std::string curves;
  for (std::size_t s = 0; s < plot.curves.size(); ++s) {
    if (plot.curves[s].points.empty()) continue;
    script += fmt::format("$curve{} << EOD\n", s);
    for (const auto& [px, py] : plot.curves[s].points) script += fmt::format("{:.17g} {:.17g}\n", px, py);
    script += "EOD\n";
    curves += fmt::format("$curve{} using 1:2 with {} linecolor {}, ", s, style, colour(s));
  }
  const auto values = values_of(plot, xs, is_wide(size) ? 300 : 100);
  if (!values.empty()) {
    script += "$values << EOD\n";
    for (const auto& [at, text] : values) {
      script += fmt::format("{:.17g} {:.17g} {}\n", at, (y.least + y.most) / 2, drawing.texts.size());
      drawing.texts.push_back(text);
    }
    script += "EOD\n";
    curves += "$values using 1:2:3 with labels hypertext point pt 7, ";
  }
  script += "plot " + curves + "NaN\n";
  return drawing;
}

// Names beside points, where they do not stand on one another; in pixels.
class Labels {
 public:
  Labels(double left, double right) : left_(left), right_(right) {}

  std::string label(double x, double y, const std::string& name) {
    constexpr double letter = 6.2, line = 13;
    const double length = letter * static_cast<double>(name.size());
    const bool to_the_left = x + 8 + length > right_;
    const Box box{to_the_left ? x - 8 - length : x + 8, to_the_left ? x - 8 : x + 8 + length, y};
    if (box.from < left_) return "";
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
  std::vector<Box> boxes_;
};

Drawing draw(const PointPlot& plot, const DrawingSize& size) {
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
  const Range x = xs.with_margin(true), y = Range{bottom, ys.most}.with_margin(true);

  Drawing drawing{size, axes(size, plot.x_label, plot.y_label), TextsOf::marks, {}};
  std::string& script = drawing.script;
  script += logarithmic('x', x, x_ticks(size)) + logarithmic('y', y, kYTicks);
  Labels labels(size.left, size.width - size.right);
  std::map<std::size_t, std::string> marks;
  for (const PointPlot::Point& point : plot.points) {
    const double at_y = std::max(point.y, bottom);
    const auto share = [](const Range& range, double value) {
      return std::log(value / range.least) / std::log(range.most / range.least);
    };
    const std::string where =
        is_wide(size) && !point.name.empty()
            ? labels.label(size.left + share(x, point.x) * (size.width - size.left - size.right),
                           -share(y, at_y) * (size.height - size.top - size.bottom), point.name)
            : "";
    if (!where.empty())
      script += fmt::format("set label {} at {:.17g},{:.17g} {} textcolor '#000008'\n",
                            gnuplot_text(point.name), point.x, at_y, where);
    marks[point.series] += fmt::format("{:.17g} {:.17g} {}\n", point.x, at_y, drawing.texts.size());
    const std::string& series = point.series < plot.series.size() ? plot.series[point.series] : point.name;
    drawing.texts.push_back(fmt::format("{}\n{}: {}\n{}: {}", point.name.empty() ? series : point.name,
                                        plot.x_label, tick_label(point.x), plot.y_label,
                                        tick_label(point.y)));
  }
  std::string curves;
  for (const auto& [series, data] : marks) {
    script += fmt::format("$series{} << EOD\n{}EOD\n", series, data);
    curves += fmt::format("$series{} using 1:2:3 with labels hypertext point pt 7 ps {} linecolor {}, ",
                          series, kMarkSize, colour(series));
  }
  script += "plot " + curves + "NaN\n";
  return drawing;
}

Drawing draw(const BarPlot& plot, DrawingSize size) {
  std::size_t longest = 0;
  double most = 0;
  for (const auto& [name, value] : plot.bars) {
    longest = std::max(longest, name.size());
    most = std::max(most, value);
  }
  size.height = 28 * static_cast<double>(plot.bars.size()) + 34;
  size.left = std::min(7.2 * static_cast<double>(longest) + 14, is_wide(size) ? 300.0 : 130.0);
  size.right = 90;
  size.top = 4;
  size.bottom = 28;
  Drawing drawing{size, axes(size, plot.x_label, ""), TextsOf::marks, {}};
  std::string& script = drawing.script;
  script +=
      fmt::format("set border 2\nunset grid\nunset xtics\nset xrange [0:{:.17g}]\nset yrange [{}:-0.5]\n",
                  most > 0 ? most : 1, static_cast<double>(plot.bars.size()) - 0.5);
  std::vector<std::string> names;
  std::string data;
  for (const auto& [name, value] : plot.bars) {
    const std::size_t row = names.size();
    script += fmt::format("set label {} at {:.17g},{} left offset 0.8,0 textcolor '#000008'\n",
                          gnuplot_text(tick_label(value)), value, row);
    data += fmt::format("{0:.17g} {1} 0 {0:.17g} {2} {3}\n", value, row, static_cast<double>(row) - 0.36,
                        static_cast<double>(row) + 0.36);
    names.push_back(gnuplot_text(name) + fmt::format(" {}", row));
  }
  script += fmt::format(
      "set ytics ({})\n$bars << EOD\n{}EOD\nplot {}NaN\n", fmt::join(names, ","), data,
      names.empty() ? "" : "$bars using 1:2:3:4:5:6 with boxxyerror linecolor " + colour(0) + ", ");
  return drawing;
}

Drawing draw(const MapPlot& plot, DrawingSize size) {
  const double side = is_wide(size) ? 540 : 292;
  size.left = is_wide(size) ? 64 : 56;
  size.right = size.width - size.left - side;
  size.height = side + size.top + size.bottom;
  Drawing drawing{size, axes(size, plot.label, plot.label), TextsOf::squares, {}};
  const Range range{plot.from, plot.to};
  drawing.script += linear('x', range, kYTicks) + linear('y', range, kYTicks) + "$squares << EOD\n";
  double most = 0;
  for (const MapPlot::Square& square : plot.squares) most = std::max(most, square.value);
  for (const auto& [x, y, value] : plot.squares) {
    const double opacity = 0.25 + 0.75 * (most > 0 ? value / most : 1);
    drawing.script += fmt::format("{:.17g} {:.17g} {}\n", x, y,
                                  std::lround(255 * (1 - opacity)) << 24);  // over the colour of series 0
    drawing.texts.push_back(fmt::format("{} {}, {}\n{}: {}", plot.label, tick_label(x), tick_label(y),
                                        plot.value_label, tick_label(value)));
  }
  drawing.script += "EOD\nplot ";
  if (!plot.squares.empty())
    drawing.script += fmt::format(
        "$squares using 1:2:({0:.17g}):({0:.17g}):3 with boxxyerror linecolor rgb variable, ", plot.side / 2);
  drawing.script += "NaN\n";
  return drawing;
}

}  // namespace

std::string svg_plot(const LinePlot& plot) {
  std::vector<std::string> names;
  for (const Curve& curve : plot.curves) names.push_back(curve.name);
  return drawn({draw(plot, wide(320)), draw(plot, narrow(320))}, names, plot.y_label + " by " + plot.x_label);
}
std::string svg_plot(const PointPlot& plot) {
  return drawn({draw(plot, wide(350)), draw(plot, narrow(350))}, plot.series,
               plot.y_label + " by " + plot.x_label);
}
std::string svg_plot(const BarPlot& plot) {
  return drawn({draw(plot, wide(0)), draw(plot, narrow(0))}, {}, plot.x_label);
}
std::string svg_plot(const MapPlot& plot) {
  return drawn({draw(plot, wide(0)), draw(plot, narrow(0))}, {}, plot.value_label + " by " + plot.label);
}

}  // namespace kds
