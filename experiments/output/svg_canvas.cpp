#include "experiments/output/svg_canvas.h"

#include <fmt/format.h>

#include <string_view>

#include "experiments/output/html_text.h"

namespace kds {

SvgCanvas::SvgCanvas(Width width, double height, const Margins& margins)
    : which_(width), width_(width == Width::wide ? 860 : 360), height_(height), margins_(margins) {}

void SvgCanvas::draw_x_axis(const Axis& axis, const std::vector<Tick>& ticks, std::string_view label) {
  body_ += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", left(), bottom(), right());
  for (const Tick& tick : ticks) {
    const double at = x(axis, tick.value);
    body_ += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}v4\"/>", at, bottom());
    text(at, bottom() + 18, "middle", tick.label);
  }
  text((left() + right()) / 2, bottom() + 38, "middle", label);
}

void SvgCanvas::draw_y_axis(const Axis& axis, const std::vector<Tick>& ticks, std::string_view label) {
  for (const Tick& tick : ticks) {
    const double at = y(axis, tick.value);
    body_ += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", left(), at, right());
    text(left() - 7, at + 4, "end", tick.label);
  }
  text(2, 13, "start", label);
}

void SvgCanvas::text(double x, double y, std::string_view anchor, std::string_view text) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                       html_escaped(text));
}

void SvgCanvas::hot_rectangle(double x, double y, double width, double height, std::string_view title) {
  body_ += fmt::format(
      "<rect class=\"hot\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
      "height=\"{:.1f}\"><title>{}</title></rect>\n",
      x, y, width, height, html_escaped_lines(title));
}

std::string SvgCanvas::element(std::string_view label) const {
  return fmt::format(
      "<svg class=\"{}\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
      is_wide() ? "wide" : "narrow", width_, height_, html_escaped(label), body_);
}

std::string series_class(std::size_t series) { return fmt::format("s{}", series % series_colours); }

}  // namespace kds
