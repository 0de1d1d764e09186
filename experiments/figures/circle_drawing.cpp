#include "experiments/figures/circle_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/page/html_page.h"

namespace kds {

namespace {

constexpr double kPanel = 380, kMargin = 10, kTitle = 24;
constexpr std::size_t kLevels = 5;  // colours of levels; deeper levels share the last

// The square around everything in a panel.
struct Square {
  Eigen::Vector2d center;
  double side;
};
Square square_around(const CirclePanel& panel) {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(HUGE_VAL), most = -least;
  const auto add = [&](const Sphere& sphere) {
    least = least.cwiseMin((sphere.center.head<2>().array() - sphere.radius).matrix());
    most = most.cwiseMax((sphere.center.head<2>().array() + sphere.radius).matrix());
  };
  for (const auto& bead : panel.beads) add(bead.ball);
  for (const auto& cage : panel.cages) add(cage.sphere);
  return {(least + most) / 2, (most - least).maxCoeff()};
}

std::string group_of(const CirclePanel& panel, double scale) {
  const Square square = square_around(panel);
  const auto x = [&](const Sphere& s) { return kPanel / 2 + scale * (s.center[0] - square.center[0]); };
  const auto y = [&](const Sphere& s) { return kPanel / 2 - scale * (s.center[1] - square.center[1]); };
  std::string svg =
      fmt::format("<text x=\"{:.0f}\" y=\"-8\">{}</text>\n", kPanel / 2, html_escaped(panel.title));
  if (std::ranges::any_of(panel.beads, [](const auto& bead) { return bead.ball.radius > 0; })) {
    svg += "<polyline class=\"backbone\" points=\"";
    for (const auto& bead : panel.beads) svg += fmt::format("{:.1f},{:.1f} ", x(bead.ball), y(bead.ball));
    svg += "\"/>\n";
  }
  for (const auto& bead : panel.beads) {
    const bool is_point = bead.ball.radius == 0;
    const double r = is_point ? 3 : scale * bead.ball.radius;
    svg += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n",
                       bead.of_basis || is_point ? "basis" : "bead", x(bead.ball), y(bead.ball), r);
  }
  for (const auto& cage : panel.cages)
    svg += fmt::format("<circle class=\"cage l{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n",
                       std::min(cage.level, kLevels - 1), x(cage.sphere), y(cage.sphere),
                       scale * cage.sphere.radius);
  return svg;
}

}  // namespace

std::string svg_document(const std::vector<CirclePanel>& panels, const std::string& title) {
  double largest = 0;
  for (const CirclePanel& panel : panels) largest = std::max(largest, square_around(panel).side);
  const double scale = largest > 0 ? (kPanel - 4) / largest : 1;
  const double width = kMargin + static_cast<double>(panels.size()) * (kPanel + kMargin);
  const double height = kTitle + kPanel + 2 * kMargin;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\">\n"
      "<title>{}</title>\n<style>\n"
      "text {{ font: 14px sans-serif; text-anchor: middle; fill: #1f2933 }}\n"
      ".backbone {{ fill: none; stroke: #9aa5b1; stroke-width: 1 }}\n"
      ".bead {{ fill: #dbe7f3; stroke: #2f6ea5; stroke-width: .8 }}\n"
      ".basis {{ fill: #2f6ea5; stroke: #1d4a73; stroke-width: .8 }}\n"
      ".cage {{ fill: none; stroke-width: 1.3 }}\n"
      ".l0 {{ stroke: #1f2933; stroke-width: 1.8 }} .l1 {{ stroke: #b3462f }} .l2 {{ stroke: #c98a1b }} "
      ".l3 {{ stroke: #3b8a5a }} .l4 {{ stroke: #8fb8de }}\n"
      "</style>\n<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#fff\"/>\n",
      width, height, html_escaped(title), width, height);
  for (std::size_t p = 0; p < panels.size(); ++p)
    svg += fmt::format("<g transform=\"translate({:.0f} {:.0f})\">\n{}</g>\n",
                       kMargin + static_cast<double>(p) * (kPanel + kMargin), kMargin + kTitle,
                       group_of(panels[p], scale));
  return svg + "</svg>\n";
}

}  // namespace kds
