#include "experiments/output/page/drawing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/output/page/gnuplot.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr double kHeadLine = 18;  // pixels from line to line

// Positions of the names of a key: across and down from the upper left corner, in pixels.
std::vector<std::pair<double, double>> positions_of(const std::vector<std::string>& names, double width,
                                                    bool below_title) {
  constexpr double letter = 6.9, mark = 28, left = 10;
  std::vector<std::pair<double, double>> positions;
  double x = left, y = 10 + (below_title ? kHeadLine : 0);
  for (const std::string& name : names) {
    const double length = letter * static_cast<double>(name.size()) + mark;
    if (x > left && x + length > width) {
      x = left;
      y += kHeadLine;
    }
    positions.emplace_back(x, y);
    x += length;
  }
  return positions;
}

std::string key_name(const std::string& name) { return shortened(name, 72); }

}  // namespace

bool is_wide(const DrawingSize& size) { return size.width > 500; }
DrawingSize wide(double height) { return {860, height, 64, 32, 26, 48}; }
DrawingSize narrow(double height) { return {360, height, 64, 32, 26, 48, false, 0, false}; }

DrawingSize print_size(double height, const std::string& title, const std::vector<std::string>& names) {
  DrawingSize size{560, height, 64, 32, 26, 48, true, 0, false};
  if (names.size() > 1)
    size.head = positions_of(names, size.width, !title.empty()).back().second + kHeadLine / 2;
  else if (!title.empty())
    size.head = kHeadLine;
  size.height += size.head;
  size.top += size.head;
  return size;
}

std::string print_head(const DrawingSize& size, const std::string& title,
                       const std::vector<std::string>& names) {
  const auto at = [&](double x, double y) {
    return fmt::format("at screen {:.6f}, screen {:.6f} left", x / size.width, 1 - y / size.height);
  };
  std::string script;
  if (!title.empty())
    script += fmt::format("set label {} {}\n", gnuplot_text(shortened(title, 78)), at(2, 10));
  if (names.size() < 2) return script;
  const auto positions = positions_of(names, size.width, !title.empty());
  for (std::size_t s = 0; s < names.size(); ++s)
    script +=
        fmt::format("set label {} {} offset 0.9,0 point pointtype 7 pointsize 0.8 linecolor {}\n",
                    gnuplot_text(key_name(names[s])), at(positions[s].first, positions[s].second), colour(s));
  return script;
}

// Returns the text in single quotes, which gnuplot takes literally. A quote within the text is doubled.
std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  for (const char c : one_line(text)) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string colour(std::size_t series) { return fmt::format("rgb c_s{}", series % series_colours); }

std::string shortened(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;
  return text.substr(0, most) + "…";
}

std::string axes(const DrawingSize& size, std::string_view x_label, std::string_view y_label) {
  const double right = size.width - size.right, top = size.height - size.top;
  return fmt::format(
      "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n"
      "set bmargin at screen {:.6f}\nset tmargin at screen {:.6f}\n"
      "set border 1 linecolor rgb c_soft\nset tics nomirror out scale 0.7 textcolor rgb c_soft\n"
      "set ytics scale 0\nset xtics offset 0,0.4\nset grid ytics linetype 1 linecolor rgb c_line linewidth "
      "1\nunset key\n"
      "set label {} at screen {:.6f}, screen {:.6f} left textcolor rgb c_soft\n"
      "set label {} at screen {:.6f}, screen {:.6f} center textcolor rgb c_soft\n"
      "set style fill solid 1 noborder\n",
      size.left / size.width, right / size.width, size.bottom / size.height, top / size.height,
      gnuplot_text(y_label), 2 / size.width, 1 - (size.head + 9) / size.height, gnuplot_text(x_label),
      (size.left + right) / 2 / size.width, 10 / size.height);
}

std::vector<std::string> drawn(const std::vector<Plotted>& plots, const std::vector<std::string>& labels) {
  std::string script = page_colours_script();
  for (const Plotted& plot : plots)
    for (const Drawing* drawing : {&plot.wide, &plot.narrow})
      script += fmt::format(
          "reset\nset encoding utf8\n"
          "set terminal svg size {:.0f},{:.0f} dynamic noenhanced font 'sans-serif,12.5'\n{}set output\n",
          drawing->size.width, drawing->size.height, drawing->script);
  const std::string output = run_gnuplot(script);
  constexpr std::string_view ending = "</svg>";
  std::size_t start = 0;
  const auto next = [&](const Drawing& drawing, std::string_view shown, const std::string& label) {
    const std::size_t end = std::min(output.find(ending, start), output.size());
    const std::string_view one = std::string_view(output).substr(start, end - start);
    start = std::min(end + ending.size(), output.size());
    return page_svg(one, drawing.size, drawing.of, drawing.texts,
                    fmt::format("class=\"{}\" role=\"img\" aria-label=\"{}\"", shown, html_escaped(label)));
  };
  std::vector<std::string> html;
  for (std::size_t k = 0; k < plots.size(); ++k) {
    html.push_back(next(plots[k].wide, "wide", labels[k]));
    html.back() += next(plots[k].narrow, "narrow", labels[k]);
  }
  return html;
}

std::string html_key(const std::vector<std::string>& names) {
  if (names.size() < 2) return "";
  std::string html = "<p class=\"key\">";
  for (std::size_t s = 0; s < names.size(); ++s)
    html += fmt::format("<span class=\"s{}\">{}</span> ", s % series_colours, html_escaped(names[s]));
  return html + "</p>\n";
}

void Range::add(double value) {
  least = std::min(least, value);
  most = std::max(most, value);
}

namespace {
constexpr double least_width = 1e-290;  // gnuplot draws no axis of less than about 1e-306
}

bool Range::wide() const {
  return least + std::max(least_width, 1e-9 * std::max(std::abs(least), std::abs(most))) < most;
}

Range Range::around() const {
  if (empty()) return {0, 1};
  if (wide()) return *this;
  const double by = least == 0 ? 1 : std::max(least_width, std::abs(least) / 2);
  return {least - by, most + by};
}

Range Range::with_margin(bool logarithmic) const {
  if (!logarithmic) return {least - 0.05 * (most - least), most + 0.05 * (most - least)};
  const double by = std::max(1.1, std::pow(most / least, 0.06));
  return {least / by, most * by};
}

std::string set_range(char axis, const Range& range) {
  return fmt::format("set {}range [{:.17g}:{:.17g}]\n", axis, range.least, range.most);
}

std::string set_ticks(char axis, const std::vector<double>& values) {
  std::vector<std::string> ticks;
  for (const double value : values) ticks.push_back(fmt::format("'{}' {:.17g}", tick_label(value), value));
  return fmt::format("set {}tics ({})\n", axis, fmt::join(ticks, ","));
}

int x_ticks(const DrawingSize& size) { return size.for_print ? 6 : is_wide(size) ? 8 : 4; }

double tick_step(const Range& range, int most) {
  const double wanted = (range.most - range.least) / most;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  return power * (wanted <= power ? 1 : wanted <= 2 * power ? 2 : wanted <= 5 * power ? 5 : 10);
}

std::string linear(char axis, const Range& range, int most) {
  const double apart = tick_step(range, most), tolerance = 1e-6;
  std::vector<double> ticks;
  for (double k = std::ceil(range.least / apart - tolerance); k <= range.most / apart + tolerance; ++k)
    ticks.push_back(k == 0 ? 0 : k * apart);
  return set_range(axis, range) + set_ticks(axis, ticks);
}

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
    const double apart = tick_step(range, most);
    for (double k = std::ceil(range.least / apart); k * apart <= range.most; ++k) ticks.push_back(k * apart);
  }
  return set_range(axis, range) + fmt::format("set logscale {}\n", axis) + set_ticks(axis, ticks);
}

}  // namespace kds
