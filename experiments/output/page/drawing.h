#pragma once
// Common parts of plots. A drawing is a gnuplot script with round ticks on its axes. Each plot is drawn once
// for wide pages, once for narrow pages and, if asked for, once for print.

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/page/gnuplot.h"

namespace kds {

struct Drawing {
  DrawingSize size;
  std::string script;  ///< names the colours as page_colours says
  TextsOf of = TextsOf::marks;
  std::vector<std::string> texts;  ///< shown under the pointer
};

/// Drawings as wide as the page's column, and as wide as a telephone's screen, which has no pointer.
[[nodiscard]] bool is_wide(const DrawingSize& size);
[[nodiscard]] DrawingSize wide(double height);
[[nodiscard]] DrawingSize narrow(double height);
/// A drawing for print, as wide as a column of text, with room for its head (`print_head`).
[[nodiscard]] DrawingSize print_size(double height, const std::string& title,
                                     const std::vector<std::string>& names);
/// Returns the script of the title and of the key of names and colours above a drawing for print. The key is
/// left out if there is at most one name.
[[nodiscard]] std::string print_head(const DrawingSize& size, const std::string& title,
                                     const std::vector<std::string>& names);

/// The two drawings of a plot. The page's style shows one of them.
struct Plotted {
  Drawing wide, narrow;
};

/// Returns the SVG of each plot, all drawn by one gnuplot process. `labels` describe the plots for
/// screen readers.
[[nodiscard]] std::vector<std::string> drawn(const std::vector<Plotted>& plots,
                                             const std::vector<std::string>& labels);

/// Returns a key of names and colours, or an empty text if there is at most one name.
[[nodiscard]] std::string html_key(const std::vector<std::string>& names);

/// Returns the text in single quotes for gnuplot.
[[nodiscard]] std::string gnuplot_text(std::string_view text);
/// Returns the colour of a series as gnuplot takes it after `linecolor`.
[[nodiscard]] std::string colour(std::size_t series);
/// Returns at most `most` bytes of the text followed by an ellipsis. Never cuts a character in half.
[[nodiscard]] std::string shortened(std::string text, std::size_t most);

/// Returns the common beginning of all scripts: margins, labels and style.
[[nodiscard]] std::string axes(const DrawingSize& size, std::string_view x_label, std::string_view y_label);

struct Range {
  double least = HUGE_VAL, most = -HUGE_VAL;

  void add(double value);
  [[nodiscard]] bool empty() const { return least > most; }
  /// Returns whether the width exceeds the resolution of doubles, and is one that gnuplot can draw.
  [[nodiscard]] bool wide() const;
  /// Returns a range around this one that is wide in any case.
  [[nodiscard]] Range around() const;
  /// Returns the range with a margin, so that marks stay off the edges.
  [[nodiscard]] Range with_margin(bool logarithmic) const;
};

/// Returns how many ticks fit on an x axis.
[[nodiscard]] int x_ticks(const DrawingSize& size);
inline constexpr int y_ticks = 5;

/// Returns the distance between ticks for at most `most` ticks: 1, 2 or 5 times a power of ten.
[[nodiscard]] double tick_step(const Range& range, int most);

/// Returns the script for an axis ('x' or 'y') with its range and round ticks. A logarithmic axis has about
/// `most` ticks at powers of ten. If fewer than two are in range, it has ticks at 1, 2 and 5 times powers of
/// ten. If that still gives fewer than two, it has ticks at evenly spaced round values.
[[nodiscard]] std::string linear(char axis, const Range& range, int most);
[[nodiscard]] std::string logarithmic(char axis, const Range& range, int most);
[[nodiscard]] std::string set_range(char axis, const Range& range);
/// Ticks with labels as tick_label() writes them.
[[nodiscard]] std::string set_ticks(char axis, const std::vector<double>& values);

}  // namespace kds
