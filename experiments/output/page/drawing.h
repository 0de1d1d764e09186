#pragma once
// What plots share: a drawing is a script of gnuplot, made once for wide pages and once for narrow ones, with
// axes that have round ticks.

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/page/page_svg.h"

namespace kds {

struct Drawing {
  DrawingSize size;
  std::string script;
  TextsOf of = TextsOf::marks;
  std::vector<std::string> texts;  ///< where the pointer rests
};

/// As wide as the page's column, and as wide as a telephone's.
[[nodiscard]] bool is_wide(const DrawingSize& size);
[[nodiscard]] DrawingSize wide(double height);
[[nodiscard]] DrawingSize narrow(double height);

/// The page's style shows one of the two.
struct Plotted {
  Drawing wide, narrow;
};

/// The SVG of each, all drawn by one process; `labels` say what they show to those who do not see it.
[[nodiscard]] std::vector<std::string> drawn(const std::vector<Plotted>& plots,
                                             const std::vector<std::string>& labels);

/// Which colour is whose; empty where there is nothing to tell apart.
[[nodiscard]] std::string html_key(const std::vector<std::string>& names);

/// Between single quotes, as gnuplot takes it.
[[nodiscard]] std::string gnuplot_text(std::string_view text);
[[nodiscard]] std::string colour(std::size_t series);
/// No more than `most` bytes of it, with an ellipsis behind them, and no half characters.
[[nodiscard]] std::string shortened(std::string text, std::size_t most);

/// Margins, labels, style: what every script begins with.
[[nodiscard]] std::string axes(const DrawingSize& size, std::string_view x_label, std::string_view y_label);

struct Range {
  double least = HUGE_VAL, most = -HUGE_VAL;

  void add(double value);
  [[nodiscard]] bool empty() const { return least > most; }
  /// Wider than what doubles tell apart.
  [[nodiscard]] bool wide() const;
  /// Wide, whatever it is.
  [[nodiscard]] Range around() const;
  /// Marks stand off the edges.
  [[nodiscard]] Range with_margin(bool logarithmic) const;
};

/// How many ticks an axis has room for.
[[nodiscard]] int x_ticks(const DrawingSize& size);
inline constexpr int y_ticks = 5;

/// Between ticks, `most` of them: 1, 2 or 5 times a power of ten.
[[nodiscard]] double tick_step(const Range& range, int most);

/// An axis ('x' or 'y') with its range and round ticks. Of logarithmic ones these are powers of ten, about
/// `most` at the most; 1, 2 and 5 of each where there are less than two, and round values where there are
/// still less.
[[nodiscard]] std::string linear(char axis, const Range& range, int most);
[[nodiscard]] std::string logarithmic(char axis, const Range& range, int most);
[[nodiscard]] std::string set_range(char axis, const Range& range);
[[nodiscard]] std::string set_ticks(char axis, const std::vector<double>& values);

}  // namespace kds
