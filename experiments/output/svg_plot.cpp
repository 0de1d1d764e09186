#include "experiments/output/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "experiments/output/gnuplot.h"
#include "experiments/output/text.h"

namespace kds {
namespace {

// Told apart by the colour-blind too.
constexpr std::array<std::string_view, 8> kColours{"#2563a8", "#d9791e", "#2f855a", "#8a3f8f",
                                                   "#c0392b", "#5b6570", "#17a2b8", "#b7950b"};

// gnuplot takes what stands between single quotes as it is; a quote is doubled.
std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  for (const char c : one_line(text)) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string preamble(const std::string& y_label, double bottom) {
  return fmt::format(
      "set terminal svg size 860,330 dynamic noenhanced font 'sans-serif,13' background '#ffffff'\n"
      "set border 3 linecolor '#8a929c' linewidth 0.8\n"
      "set tics nomirror out scale 0.6 textcolor '#4a525c'\n"
      "set grid ytics linetype 1 linecolor '#e3e7ec' linewidth 0.8\n"
      "set format y '%.12g'\n"
      "set yrange [0:*]\n"
      "set ylabel {} textcolor '#4a525c'\n"
      "set lmargin 11\nset bmargin {}\n",
      gnuplot_text(y_label), bottom);
}

}  // namespace

std::string embeddable_svg(const std::string& document, const std::string& id) {
  const std::size_t start = document.find("<svg");
  const std::size_t end = document.rfind("</svg>");
  if (start == std::string::npos || end == std::string::npos)
    throw std::runtime_error("gnuplot failed: it printed no SVG");
  constexpr std::array<std::string_view, 5> marks{" id='", " id=\"", "href='#", "href=\"#", "url(#"};
  const std::string prefix = id + "-";
  std::string svg = document.substr(start, end + 6 - start);
  for (const std::string_view mark : marks)
    for (std::size_t place = 0; (place = svg.find(mark, place)) != std::string::npos; place += prefix.size())
      svg.insert(place += mark.size(), prefix);
  return svg + "\n";
}

std::string svg_plot(const LinePlot& plot) {
  std::string script = preamble(plot.y_label, 3.6);
  script += fmt::format("set xlabel {} textcolor '#4a525c'\n", gnuplot_text(plot.x_label));
  if (plot.below_zero) script += "set yrange [*:*]\n";
  script += "set format x '%.12g'\nset key outside top left horizontal textcolor '#1f2933' samplen 2\n";
  std::string curves;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    script += fmt::format("$curve{} << EOD\n", i);
    for (const auto& [x, y] : plot.curves[i].points) script += fmt::format("{:.10g} {:.10g}\n", x, y);
    script += "EOD\n";
    curves += fmt::format("{}$curve{} using 1:2 with {} linewidth 1.6 linecolor '{}' title {}",
                          i == 0 ? "" : ", ", i, plot.staircase ? "steps" : "lines",
                          kColours[i % kColours.size()], gnuplot_text(plot.curves[i].name));
  }
  return embeddable_svg(run_gnuplot(script + "plot " + curves + "\n"), plot.id);
}

std::string svg_plot(const PointPlot& plot) {
  double least = HUGE_VAL, most = 0;
  for (const PointPlot::Point& point : plot.points) {
    if (point.y > 0) least = std::min(least, point.y);
    most = std::max(most, point.y);
  }
  const double bottom = most > 0 ? std::max(least / 10, 1e-6 * most) : 1;
  std::string script = preamble(plot.y_label, 3.6);
  script += fmt::format(
      "set xlabel {} textcolor '#4a525c'\nset logscale xy\nset xrange [*:*]\nset yrange [{:.10g}:*]\n"
      "set format x '%.12g'\nset offsets graph 0.02, graph 0.1, graph 0.08, 0\n"
      "set key outside top left horizontal textcolor '#1f2933' samplen 1\n",
      gnuplot_text(plot.x_label), bottom / 2);
  std::string series;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    script += fmt::format("$series{} << EOD\n", i);
    for (const PointPlot::Point& point : plot.points)
      if (point.series == i)
        script +=
            fmt::format("{:.10g} {:.10g} \"{}\"\n", point.x, std::max(point.y, bottom), one_line(point.name));
    script += "EOD\n";
    series += fmt::format(
        "{0}$series{1} using 1:2 with points pointtype 7 pointsize 0.6 linecolor '{2}' title {3}, $series{1} "
        "using 1:2:3 with labels left rotate by 20 offset 0.7,0.3 font ',10' textcolor '#4a525c' notitle",
        i == 0 ? "" : ", ", i, kColours[i % kColours.size()], gnuplot_text(plot.series[i]));
  }
  return embeddable_svg(run_gnuplot(script + "plot " + series + "\n"), plot.id);
}

std::string svg_plot(const MapPlot& plot) {
  const std::string label = gnuplot_text(plot.label);
  std::string script = fmt::format(
      "set terminal svg size 620,540 dynamic noenhanced font 'sans-serif,13' background '#ffffff'\n"
      "set border 15 linecolor '#8a929c' linewidth 0.8\n"
      "set tics nomirror out scale 0.6 textcolor '#4a525c'\n"
      "set size square\nunset key\nset format x '%.12g'\nset format y '%.12g'\nset format cb '%.12g'\n"
      "set xlabel {0} textcolor '#4a525c'\nset ylabel {0} textcolor '#4a525c'\n"
      "set cblabel {1} textcolor '#4a525c'\nset cbrange [0:*]\n"
      "set palette defined (0 '#cfe0f3', 0.5 '{2}', 1 '#0d2847')\n"
      "set style fill solid 1 noborder\nset xrange [{3:.10g}:{4:.10g}]\nset yrange [{3:.10g}:{4:.10g}]\n"
      "$squares << EOD\n",
      label, gnuplot_text(plot.value_label), kColours[0], plot.from, plot.to);
  for (const auto& [x, y, value] : plot.squares)
    script += fmt::format("{:.10g} {:.10g} {:.10g}\n", x, y, value);
  script +=
      fmt::format("EOD\nplot $squares using 1:2:({0:.10g}):({0:.10g}):3 with boxxyerror linecolor palette\n",
                  plot.side / 2);
  return embeddable_svg(run_gnuplot(script), plot.id);
}

std::string svg_plot(const BarPlot& plot) {
  std::string script =
      preamble(plot.y_label, 2.2) + "unset key\nset boxwidth 0.6\nset style fill solid 0.9 noborder\n";
  std::string tics;
  for (std::size_t i = 0; i < plot.bars.size(); ++i)
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_text(plot.bars[i].first), i);
  script += fmt::format("set xtics ({})\nset xrange [-0.6:{}]\n$bars << EOD\n", tics,
                        static_cast<double>(plot.bars.size()) - 0.4);
  for (std::size_t i = 0; i < plot.bars.size(); ++i)
    script += fmt::format("{} {:.10g} {}\n", i, plot.bars[i].second,
                          with_thousands(static_cast<std::uint64_t>(plot.bars[i].second)));
  script += fmt::format(
      "EOD\nplot $bars using 1:2 with boxes linecolor '{}', $bars using 1:2:3 with labels offset 0,0.6 "
      "textcolor "
      "'#4a525c'\n",
      kColours[0]);
  return embeddable_svg(run_gnuplot(script), plot.id);
}

}  // namespace kds
