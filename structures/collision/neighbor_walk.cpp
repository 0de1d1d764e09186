#include "structures/collision/neighbor_walk.h"

#include <algorithm>
#include <stdexcept>

#include "motions/base/floating_point_guard.h"
#include "structures/collision/separation.h"

namespace kds {

namespace {

// Groups beads of equal centre under the one of them that is in the diagram.
template <int Dimension>
class Coincident {
 public:
  Coincident(const Balls<Dimension>& balls, std::span<const BeadId> hidden) {
    if (hidden.empty()) return;
    std::vector<BeadId> visible;
    for (BeadId b = 0; b < balls.size(); ++b)
      if (!std::binary_search(hidden.begin(), hidden.end(), b)) visible.push_back(b);
    const auto before = [&](BeadId a, BeadId b) {
      return detail::center_of(balls, a) < detail::center_of(balls, b);
    };
    std::sort(visible.begin(), visible.end(), before);
    for (const BeadId b : hidden) {
      const auto place = std::lower_bound(visible.begin(), visible.end(), b, before);
      if (place == visible.end() || before(b, *place))
        throw std::invalid_argument("bead " + std::to_string(b) + " is hidden, but by none of its centre");
      others_.push_back({*place, b});
    }
    std::sort(others_.begin(), others_.end());
  }

  /// Calls visit(b) for the bead and for all others with its centre.
  template <class Visit>
  void for_each_at(BeadId bead, const Visit& visit) const {
    visit(bead);
    const BeadPair none_before{bead, 0};
    for (auto other = std::lower_bound(others_.begin(), others_.end(), none_before);
         other != others_.end() && other->first == bead; ++other)
      visit(other->second);
  }

 private:
  std::vector<BeadPair> others_;
};

}  // namespace

template <int Dimension>
std::vector<BeadPair> pairs_by_walk(const Balls<Dimension>& balls, const DiagramEdges& diagram,
                                    const PairsAsked& asked, double distance) {
  if (!balls.equal_radii()) throw std::invalid_argument("only balls of equal radii are found by walking");
  const FloatingPointGuard to_nearest;
  const Coincident<Dimension> coincident(balls, diagram.hidden);
  std::vector<BeadPair> pairs;
  const auto add = [&](BeadId a, BeadId b) {
    const auto [first, second] = std::minmax(a, b);
    if (first != second && asked.asks({first, second})) pairs.push_back({first, second});
  };
  std::vector<BeadId> met_from(balls.size(), no_bead);  // the last walk that met the bead
  std::vector<BeadId> walk;
  for (BeadId start = 0; start < balls.size(); ++start) {
    if (std::binary_search(diagram.hidden.begin(), diagram.hidden.end(), start)) continue;
    const Point<Dimension> center = detail::center_of(balls, start);
    const double radius = balls.radius(start);
    walk.assign(1, start);
    met_from[start] = start;
    for (std::size_t at = 0; at < walk.size(); ++at) {
      for (const BeadId b : diagram.edges.of(walk[at])) {
        if (met_from[b] == start) continue;
        met_from[b] = start;
        if (within<Dimension>(center, detail::center_of(balls, b), radius, radius, distance))
          walk.push_back(b);
      }
    }
    for (const BeadId b : walk) {
      if (b < start) continue;  // found by the walk from b
      coincident.for_each_at(start, [&](BeadId of_start) {
        coincident.for_each_at(b, [&](BeadId other) {
          if (b != start || of_start < other) add(of_start, other);
        });
      });
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template std::vector<BeadPair> pairs_by_walk(const Balls<2>&, const DiagramEdges&, const PairsAsked&, double);
template std::vector<BeadPair> pairs_by_walk(const Balls<3>&, const DiagramEdges&, const PairsAsked&, double);

}  // namespace kds
