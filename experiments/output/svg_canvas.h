#pragma once
// A drawing in SVG with room for axes around it, in pixels of its own.

#include <cstddef>
#include <string>
#include <string_view>

#include "experiments/output/axis.h"

namespace kds {

/// The two widths that each plot is drawn for.
enum class Width { wide, narrow };

class SvgCanvas {
 public:
  struct Margins {
    double left, right, top, bottom;
  };
  SvgCanvas(Width width, double height, const Margins& margins);

  [[nodiscard]] bool is_wide() const { return which_ == Width::wide; }
  [[nodiscard]] double left() const { return margins_.left; }
  [[nodiscard]] double right() const { return width_ - margins_.right; }
  [[nodiscard]] double top() const { return margins_.top; }
  [[nodiscard]] double bottom() const { return height_ - margins_.bottom; }
  [[nodiscard]] double x(const Axis& axis, double value) const {
    return left() + axis.share(value) * (right() - left());
  }
  [[nodiscard]] double y(const Axis& axis, double value) const {
    return bottom() - axis.share(value) * (bottom() - top());
  }

  /// How many ticks have room.
  [[nodiscard]] std::size_t x_ticks() const { return is_wide() ? 8 : 4; }
  [[nodiscard]] std::size_t y_ticks() const { return 5; }
  void draw_x_axis(const Axis& axis, const std::vector<Tick>& ticks, std::string_view label);
  void draw_y_axis(const Axis& axis, const std::vector<Tick>& ticks, std::string_view label);

  void add(std::string_view element) { body_ += element; }
  /// `anchor`: start, middle or end.
  void text(double x, double y, std::string_view anchor, std::string_view text);
  /// Shows `title` where the pointer is on it.
  void hot_rectangle(double x, double y, double width, double height, std::string_view title);

  [[nodiscard]] std::string element(std::string_view label) const;

 private:
  Width which_;
  double width_, height_;
  Margins margins_;
  std::string body_;
};

/// The class by which a style colours the series of this number.
[[nodiscard]] std::string series_class(std::size_t series);
inline constexpr std::size_t series_colours = 8;

}  // namespace kds
