#include "structures/chord_cages/tight_cages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motions/base/floating_point_guard.h"
#include "structures/chord_cages/outward_cages.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"

namespace kds {

template <int D>
void TightCages<D>::prove(const ChordCages<StaticWrappedHierarchy<D>>& cages, const Curves<D>& curves) {
  const FloatingPointGuard to_nearest;
  bisections_ = unproved_ = 0;
  bisected_.clear();
  parts_.clear();
  const NecklaceTree& tree = cages.tree();
  if (cages.degree() == 1) {
    find_loose_nodes<D>({cages.balls(0), cages.balls(1), cages.cages(0), cages.cages(1), cages.start_bases()},
                        tightness_, loose_);
    std::sort(loose_.begin(), loose_.end());
  } else {
    loose_.resize(tree.node_count());
    for (NodeId node = 0; node < loose_.size(); ++node) loose_[node] = node;
  }
  CagePiece<D> whole;
  whole.cages.resize(static_cast<std::size_t>(cages.degree()) + 1);
  if (!loose_.empty()) there_ = cages.balls(0);
  for (const NodeId node : loose_) {
    whole.bases = {cages.start_bases()[node], cages.hierarchy().basis(node)};
    for (int k = 0; k <= cages.degree(); ++k) whole.cages[static_cast<std::size_t>(k)] = cages.cages(k)[node];
    if (!is_proved_tight(curves, whole, tightness_, 0)) bisect(node, tree.range(node), whole, curves);
  }
}

// Depth-first search from the left: the parts on the stack are not proved yet.
template <int D>
void TightCages<D>::bisect(NodeId node, const BeadRange& range, const CagePiece<D>& whole,
                           const Curves<D>& curves) {
  const int degree = curves.own_degree();
  double size = 0;
  for (BeadId b = range.first; b <= range.last; ++b) {
    for (int k = 0; k <= degree; ++k) {
      for (int axis = 0; axis < D; ++axis) size = std::max(size, std::abs(curves.coordinate(b, k, axis)));
      size = std::max(size, curves.radius(b, k));
    }
  }
  double greatest = 0;
  for (const Cage<D>& cage : whole.cages) greatest = std::max(greatest, cage.radius);
  const double error = control_ball_error(degree, size);
  if (!is_judged(greatest) || error > 0x1p-3 * tightness_ * greatest) {  // no part could be proved
    ++unproved_;
    return;
  }
  const std::size_t first = parts_.size();
  std::vector<std::pair<CagePiece<D>, int>> stack{{whole, 0}};
  while (!stack.empty()) {
    const auto [part, halvings] = std::move(stack.back());
    stack.pop_back();
    if (halvings > 0 && is_proved_tight(curves, part, tightness_, error)) {
      parts_.push_back(part);
      continue;
    }
    const std::size_t parts = parts_.size() - first + stack.size() + 1;
    if (halvings == most_halvings || parts == most_parts) {
      ++unproved_;
      parts_.push_back(part);
      continue;
    }
    ++bisections_;
    const double middle = 0.5 * (part.from + part.to);
    CagePiece<D> left, right;
    left.from = part.from;
    left.to = right.from = middle;
    right.to = part.to;
    Basis basis = part.bases[0];
    left.cages.push_back(part.cages.front());
    for (int k = 1; k <= degree; ++k)
      left.cages.push_back(cage_at(range, curves, left.from, left.to, k, error, basis));
    left.bases = {part.bases[0], basis};
    right.cages.push_back(left.cages.back());
    for (int k = 1; k < degree; ++k)
      right.cages.push_back(cage_at(range, curves, right.from, right.to, k, error, basis));
    right.cages.push_back(part.cages.back());
    right.bases = {left.bases[1], part.bases[1]};
    stack.emplace_back(std::move(right), halvings + 1);
    stack.emplace_back(std::move(left), halvings + 1);
  }
  bisected_.push_back({node, first, parts_.size()});
}

// Returns the smallest sphere around a node's control balls. The search starts from `basis`, which becomes
// the sphere's basis.
template <int D>
Cage<D> TightCages<D>::cage_at(const BeadRange& range, const Curves<D>& curves, double from, double to, int k,
                               double error, Basis& basis) {
  for (BeadId b = range.first; b <= range.last; ++b) {
    const ControlBall<D> ball = control_ball(curves, b, from, to, k);
    Point<D> center;
    std::copy_n(ball.begin(), D, center.begin());
    there_.place(b, center, ball[D]);
  }
  const SmallestSphere smallest =
      smallest_sphere(there_, range.first, range.last, {basis.begin(), basis.end()});
  basis = smallest.basis;
  Cage<D> cage;
  for (std::size_t axis = 0; axis < D; ++axis)
    cage.center[axis] = smallest.sphere.center[static_cast<Eigen::Index>(axis)];
  cage.radius = (outward_radius(there_, range.first, range.last, cage.center) + error) * (1 + 0x1p-51);
  return cage;
}

template <int D>
std::span<const CagePiece<D>> TightCages<D>::parts(NodeId node) const {
  const auto found = std::lower_bound(bisected_.begin(), bisected_.end(), node,
                                      [](const Parts& parts, NodeId id) { return parts.node < id; });
  if (found == bisected_.end() || found->node != node) return {};
  return std::span(parts_).subspan(found->first, found->end - found->first);
}

template class TightCages<2>;
template class TightCages<3>;

}  // namespace kds
