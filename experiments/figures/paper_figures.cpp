#include "experiments/figures/paper_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "motions/base/input_error.h"
#include "motions/models/shapes.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds {

namespace {

// Returns the number of each node's proper ancestors.
std::vector<std::size_t> levels_of(const NecklaceTree& tree) {
  std::vector<std::size_t> levels(tree.node_count(), 0);
  for (NodeId node = 0; node < tree.node_count(); ++node)
    for (const NodeId child : {tree.left(node), tree.right(node)})
      if (child != NecklaceTree::leaf) levels[child] = levels[node] + 1;
  return levels;
}

template <class Hierarchy>
std::size_t count_sticking_out(const Hierarchy& hierarchy) {
  std::size_t count = 0;
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node)
    for (const NodeId child : {hierarchy.tree().left(node), hierarchy.tree().right(node)}) {
      if (child == NecklaceTree::leaf) continue;
      const Sphere outer = hierarchy.sphere(node), inner = hierarchy.sphere(child);
      const double reach = (inner.center - outer.center).norm() + inner.radius;
      if (reach > outer.radius * (1 + 1e-9)) ++count;
    }
  return count;
}

constexpr std::size_t kAllLevels = std::numeric_limits<std::size_t>::max();

// Draws the beads and the cages of levels 0 to `last_level`. If `bases` are given, the beads of those of
// levels 0 to `last_dark` are dark.
template <class Hierarchy>
CirclePanel panel_of(std::string title, const Hierarchy& hierarchy, const Eigen::Matrix3Xd& centers,
                     double radius, std::size_t last_level, std::span<const Basis> bases = {},
                     std::size_t last_dark = 0) {
  CirclePanel panel{std::move(title), {}, {}};
  for (Eigen::Index b = 0; b < centers.cols(); ++b) panel.beads.push_back({{centers.col(b), radius}, false});
  const std::vector<std::size_t> levels = levels_of(hierarchy.tree());
  for (NodeId node = 0; node < levels.size(); ++node) {
    if (levels[node] > last_level) continue;
    panel.cages.push_back({hierarchy.sphere(node), levels[node]});
    if (bases.empty() || levels[node] > last_dark) continue;
    for (const BeadId bead : bases[node]) panel.beads[bead].of_basis = true;
  }
  return panel;
}

std::array<BeadRange, 1> one_necklace(const Eigen::Matrix3Xd& centers) {
  return {BeadRange{0, static_cast<BeadId>(centers.cols() - 1)}};
}

template <class Hierarchy>
Hierarchy built(const Eigen::Matrix3Xd& centers, double radius) {
  Hierarchy hierarchy(one_necklace(centers));
  hierarchy.build(Balls<2>(centers, std::vector<double>(static_cast<std::size_t>(centers.cols()), radius)));
  return hierarchy;
}

std::string names_of(const Basis& basis) { return fmt::format("{}", fmt::join(basis, ", ")); }

DrawnFigure draw_hierarchies() {
  const Eigen::Matrix3Xd centers = models::spiral(16, 1.25, 1);
  const auto wrapped = built<StaticWrappedHierarchy<2>>(centers, models::radius);
  const auto layered = built<LayeredHierarchy<2>>(centers, models::radius);
  DrawnFigure figure;
  figure.svg =
      svg_document({panel_of("wrapped", wrapped, centers, models::radius, 3, wrapped.bases(), 1),
                    panel_of("layered", layered, centers, models::radius, 3)},
                   "Wrapped (left) and layered (right) hierarchy of a necklace of 16 beads. Beads of "
                   "the bases of the root and its children are dark.");
  std::size_t of_three = 0;
  for (const Basis& basis : wrapped.bases()) of_three += basis.size == 3 ? 1 : 0;
  figure.panels = {
      {PaperFigure::hierarchies, "wrapped", 16, wrapped.sphere(0).radius, count_sticking_out(wrapped),
       fmt::format("{} of {} bases have three beads, the others two", of_three, wrapped.bases().size())},
      {PaperFigure::hierarchies, "layered", 16, layered.sphere(0).radius, count_sticking_out(layered),
       fmt::format("the root is {:.3f} times the wrapped one",
                   layered.sphere(0).radius / wrapped.sphere(0).radius)}};
  return figure;
}

DrawnFigure draw_stability(const StablePairSearch& search) {
  const std::optional<StablePair> pair = find_stable_pair(search);
  if (!pair)
    throw InputError(
        fmt::format("--candidates {}: no candidate keeps all bases except the root's, expected "
                    "more candidates or another --seed",
                    search.candidates));
  DrawnFigure figure;
  std::vector<CirclePanel> panels;
  for (const bool last : {false, true}) {
    const Eigen::Matrix3Xd& centers = last ? pair->frames.back() : pair->frames.front();
    const auto wrapped = built<StaticWrappedHierarchy<2>>(centers, models::radius);
    panels.push_back(
        panel_of(last ? "after" : "before", wrapped, centers, models::radius, 2, wrapped.bases(), 2));
    figure.panels.push_back(
        {PaperFigure::stability, panels.back().title, search.beads, wrapped.sphere(0).radius,
         count_sticking_out(wrapped),
         last ? fmt::format("the root's basis is {}; it changed {} times and no other basis did",
                            names_of(wrapped.basis(0)), pair->root_changes)
              : fmt::format("the root's basis is {}; candidate {}, distances of beads change by {:.0f}% of "
                            "the greatest",
                            names_of(wrapped.basis(0)), pair->candidate, 100 * pair->deformation)});
  }
  figure.svg = svg_document(panels,
                            "Two conformations of a necklace in the plane with the upper three levels of its "
                            "wrapped hierarchy. Between them only the basis of the root changes.");
  return figure;
}

DrawnFigure draw_tightness() {
  constexpr int h = 4;
  const Eigen::Matrix3Xd points = models::tightness_points(h);
  const auto layered = built<LayeredHierarchy<2>>(points, 0);
  const auto wrapped = built<StaticWrappedHierarchy<2>>(points, 0);
  DrawnFigure figure;
  CirclePanel panel = panel_of("layered", layered, points, 0, kAllLevels);
  panel.cages.push_back({wrapped.sphere(0), 4});
  figure.svg = svg_document({panel},
                            "Sixteen points on a circle of radius 1 (light blue) and the circles of their "
                            "layered hierarchy, whose root has radius 2.");
  figure.panels = {{PaperFigure::tightness, panel.title, 16, layered.sphere(0).radius,
                    count_sticking_out(layered),
                    fmt::format("the wrapped root has radius {:.3f}", wrapped.sphere(0).radius)}};
  return figure;
}

}  // namespace

DrawnFigure draw(PaperFigure figure, const StablePairSearch& search) {
  switch (figure) {
    case PaperFigure::hierarchies:
      return draw_hierarchies();
    case PaperFigure::stability:
      return draw_stability(search);
    case PaperFigure::tightness:
      return draw_tightness();
  }
  return {};
}

}  // namespace kds
