#include "experiments/reproduce/measurements.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "structures/collision/hierarchy_search.h"
#include "structures/power_diagram/diagram_update.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

std::vector<double> no_radii(const Subject& subject) { return std::vector<double>(subject.beads(), 0.0); }

template <int Dimension>
Balls<Dimension> centers_at(const Subject& subject, std::size_t frame) {
  return Balls<Dimension>(subject.frames[frame], no_radii(subject));
}

// Runs the works in turn and returns their times in the same order.
template <std::size_t Count>
std::array<Timed, Count> timed_in_turn(std::size_t rounds,
                                       const std::array<std::function<double()>, Count>& works) {
  const auto seconds = seconds_in_turn(rounds, {works.begin(), works.end()});
  std::array<Timed, Count> times;
  for (std::size_t i = 0; i < Count; ++i) times[i] = {spread_of(seconds[i]), seconds[i]};
  return times;
}

template <class Work>
std::function<double()> processor_time(Work work) {
  return [work = std::move(work)] { return processor_seconds_per_call(work); };
}

template <int Dimension>
Construction construction(const Subject& subject, std::size_t frame, std::size_t rounds) {
  const Eigen::Matrix3Xd& centers = subject.frames[frame];
  const std::vector<double> zeros = no_radii(subject);
  const Balls<Dimension> balls(centers, zeros);
  StaticWrappedHierarchy<Dimension> wrapped(subject.necklaces);
  LayeredHierarchy<Dimension> layered(subject.necklaces);
  Construction result;
  const auto times = timed_in_turn<4>(
      rounds, {processor_time([&] { wrapped.build(balls); }), processor_time([&] { layered.build(balls); }),
               processor_time(spheres_by_cgal<Dimension>(wrapped.tree().ranges(), centers, zeros)),
               processor_time(triangulation_by_cgal<Dimension>(centers, zeros))});
  result.wrapped = times[0];
  result.layered = times[1];
  result.cgal = times[2];
  result.diagram = times[3];
  result.tightness = tightness_of(wrapped, layered);
  return result;
}

// The paper's quadratic method. The early return also keeps the compiler from testing several pairs at once.
template <int Dimension>
bool collides(const Balls<Dimension>& balls) {
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const BallRow<Dimension>& a = balls.rows()[i];
    for (std::size_t j = i + 2; j < balls.size(); ++j) {
      const BallRow<Dimension>& b = balls.rows()[j];
      const double reach = a.radius + b.radius;
      double squared = 0;
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        squared += (a.center[axis] - b.center[axis]) * (a.center[axis] - b.center[axis]);
      if (squared <= reach * reach) return true;
    }
  }
  return false;
}

// Returns the number of edges of the centres' diagram, including those to the infinite vertex, which joins
// every vertex of the hull. In the plane, the triangulation with the infinite vertex is a sphere of V + 1
// vertices, which has 3V - 3 edges. In space the hull is a sphere of 2 hull - 4 facets, and 4C = 2F - facets
// counts the facets of cells. Euler's V - E + F - C = 1 then gives hull = E - V - C + 3.
template <int Dimension>
std::uint64_t all_edges(const Eigen::Matrix3Xd& centers) {
  RegularTriangulation<Dimension> diagram;
  const auto beads = static_cast<std::size_t>(centers.cols());
  const auto built = diagram.build_bare(centers, std::vector<double>(beads, 0.0));
  const std::size_t edges = diagram.finite_edges().size(), vertices = beads - built.hidden.size();
  if (built.dimension == 3) return 2 * edges + 3 - vertices - diagram.finite_cells().size();
  if (built.dimension == 2) return 3 * vertices - 3;
  return edges + 2;  // on a line, whose two ends are the hull
}

template <int Dimension>
SelfCollision self_collision(const Subject& subject, std::size_t frame, std::size_t rounds) {
  SelfCollision result;
  {
    const Balls<Dimension> balls(subject.frames[frame], subject.radii);
    const PairsAsked nonadjacent{subject.necklaces, true, 2, true};
    for (const Hierarchy kind : {Hierarchy::wrapped, Hierarchy::layered}) {
      SphereTree<Dimension> tree(kind, subject.necklaces);
      tree.build(balls);
      const PairsFound found = find_pairs(tree, nonadjacent);
      (kind == Hierarchy::wrapped ? result.wrapped_family : result.layered_family) = found.family;
      result.collisions = found.pairs.size();
    }
  }
  const Balls<Dimension> centers = centers_at<Dimension>(subject, frame);
  const PairsAsked all{subject.necklaces, true, 1, true};
  SphereTree<Dimension> wrapped(Hierarchy::wrapped, subject.necklaces),
      layered(Hierarchy::layered, subject.necklaces);
  wrapped.build(centers);
  layered.build(centers);
  std::size_t colliding = 0;  // used, so that the compiler keeps the work
  const auto times = timed_in_turn<3>(
      rounds, {processor_time([&] { colliding += collides(centers) ? 1 : 0; }),
               processor_time([&] { result.wrapped_pairs = find_pairs(wrapped, all).family; }),
               processor_time([&] { result.layered_pairs = find_pairs(layered, all).family; })});
  result.quadratic = times[0];
  result.wrapped = times[1];
  result.layered = times[2];
  result.edges = all_edges<Dimension>(subject.frames[frame]);
  return result;
}

template <int Dimension>
std::uint64_t cells_changed(const Subject& subject, std::size_t from, std::size_t to) {
  const auto before = static_triangulation<Dimension>(subject.frames[from], no_radii(subject)).cells;
  const auto after = static_triangulation<Dimension>(subject.frames[to], no_radii(subject)).cells;
  std::vector<CellBeads<Dimension>> added;
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(added));
  return added.size();
}

// Times an update from one frame to another. An update that trusts its bases leaves them as they are, so it
// can be repeated. A cascade repairs bases, so it goes back by a cascade each time, which takes about as
// long.
template <int Dimension>
class TimedUpdate {
 public:
  using Hierarchy = StaticWrappedHierarchy<Dimension>;

  TimedUpdate(const Subject& subject, std::size_t from, std::size_t to, Update how)
      : from_(from),
        to_(to),
        before_(centers_at<Dimension>(subject, from)),
        after_(centers_at<Dimension>(subject, to)),
        hierarchy_(subject.necklaces),
        how_(how) {
    hierarchy_.build(before_);
    hierarchy_.update(before_, how_ == Update::cascade ? how_ : Update::naive);
  }

  [[nodiscard]] const Balls<Dimension>& after() const { return after_; }

  /// Returns the seconds of an update with `arrived`, which is called with the hierarchy, its counts and the
  /// frame. For a cascade they are the mean of the way there and back.
  template <class Arrived>
  double seconds(const Arrived& arrived) {
    const auto go = [&](const Balls<Dimension>& balls, std::size_t frame) {
      const WrapCounts counts = hierarchy_.update(balls, how_);
      arrived(hierarchy_, counts, frame);
    };
    if (how_ != Update::cascade) return processor_seconds_per_call([&] { go(after_, to_); });
    return processor_seconds_per_call([&] {
             go(after_, to_);
             go(before_, from_);
           }) /
           2;
  }

 private:
  std::size_t from_, to_;
  Balls<Dimension> before_, after_;
  Hierarchy hierarchy_;
  Update how_;
};

// The paper's naive verification: returns the number of nodes from whose spheres a bead has escaped. It tests
// bead by bead; the early end also keeps the compiler from testing several beads at once.
template <int Dimension>
std::size_t escaped_nodes(const StaticWrappedHierarchy<Dimension>& hierarchy, const Balls<Dimension>& balls) {
  constexpr double slack = 1e-9;  // for rounding: spheres pass through the centres of their bases
  std::size_t escaped = 0;
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
    const Sphere sphere = hierarchy.sphere(node);
    const double most = sphere.radius * sphere.radius * (1 + slack);
    const BeadRange& range = hierarchy.tree().range(node);
    for (BeadId bead = range.first; bead <= range.last; ++bead) {
      double squared = 0;
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const double along = balls.rows()[bead].center[axis] - sphere.center[static_cast<Eigen::Index>(axis)];
        squared += along * along;
      }
      if (squared <= most) continue;
      ++escaped;
      break;
    }
  }
  return escaped;
}

// Averages over all nodes of the tree, beads included, as the paper does. A bead has no frontier.
template <int Dimension>
double mean_frontier(const StaticWrappedHierarchy<Dimension>& hierarchy, const WrapCounts& counts,
                     const Subject& subject) {
  return static_cast<double>(counts.frontier) /
         static_cast<double>(hierarchy.tree().node_count() + subject.beads());
}

template <int Dimension>
Step step(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds) {
  Step result;
  TimedUpdate<Dimension> lazy(subject, from, to, Update::trust), cascade(subject, to, to, Update::cascade),
      naive(subject, to, to, Update::trust);
  std::size_t escaped = 0;  // used, so that the compiler keeps the work
  const auto times = timed_in_turn<3>(
      rounds, {[&] { return lazy.seconds([](const auto&, const WrapCounts&, std::size_t) {}); },
               [&] { return cascade.seconds([](const auto&, const WrapCounts&, std::size_t) {}); },
               [&] {
                 return naive.seconds([&](const auto& hierarchy, const WrapCounts&, std::size_t) {
                   escaped += escaped_nodes(hierarchy, naive.after());
                 });
               }});
  result.lazy = times[0];
  result.cascade = times[1];
  result.naive = times[2];
  StaticWrappedHierarchy<Dimension> moved(subject.necklaces);
  const auto before = centers_at<Dimension>(subject, from);
  const auto tests = [](const WrapCounts& counts) {
    return static_cast<double>(counts.bead_tests + counts.cage_tests);
  };
  moved.build(before);
  result.naive_tests = tests(moved.update(naive.after(), Update::naive));
  moved.build(before);
  moved.update(before, Update::cascade);
  const WrapCounts counts = moved.update(naive.after(), Update::cascade);
  result.cascade_tests = tests(counts);
  result.bases_changed = counts.changed;
  result.frontier = mean_frontier(moved, counts, subject);
  result.cells_changed = from == to ? 0 : cells_changed<Dimension>(subject, from, to);
  return result;
}

template <int Dimension>
DiagramStep diagram_step(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds) {
  DiagramStep result;
  const std::vector<double> zeros = no_radii(subject);
  std::array<std::uint64_t, 3> rebuilds{};
  const auto advance = [&](UpdateTechnique technique, std::uint64_t& rebuilt) -> std::function<double()> {
    return [&, technique] {
      const auto update = make_diagram_update<Dimension>(technique);
      update->build(subject.frames[from], zeros);
      return processor_seconds_of([&] { rebuilt = update->advance(subject.frames[to], zeros).rebuilds; });
    };
  };
  const auto times = timed_in_turn<3>(rounds, {advance(UpdateTechnique::rebuild, rebuilds[0]),
                                               advance(UpdateTechnique::reinsert, rebuilds[1]),
                                               advance(UpdateTechnique::greedy, rebuilds[2])});
  result.rebuild = times[0];
  result.reinsert = times[1];
  result.greedy = times[2];
  result.rebuilds = rebuilds[1] + rebuilds[2];
  return result;
}

// The search of the paper's Figure 6 for two necklaces. If the spheres of two nodes meet, it splits the node
// with more beads. Beads that meet would form a pair of their own.
template <class H>
class SearchBetween {
 public:
  SearchBetween(const H& hierarchy, const Subject& subject, std::size_t frame)
      : hierarchy_(hierarchy), subject_(subject), frame_(frame) {}

  [[nodiscard]] std::uint64_t pairs() {
    pairs_ = 0;
    visit(root(0), root(1));
    return pairs_;
  }

 private:
  struct Part {
    NodeId node;  ///< NecklaceTree::leaf for a bead
    BeadRange beads;
    Sphere sphere;
  };

  [[nodiscard]] Part part(NodeId node, const BeadRange& beads) const {
    if (node != NecklaceTree::leaf) return {node, beads, hierarchy_.sphere(node)};
    Sphere bead;
    bead.center = subject_.frames[frame_].col(beads.first);
    return {node, beads, bead};
  }
  [[nodiscard]] Part root(std::size_t necklace) const {
    const BeadRange& beads = subject_.necklaces[necklace];
    return part(*hierarchy_.tree().find(beads), beads);
  }
  void visit(const Part& a, const Part& b) {
    const double reach = a.sphere.radius + b.sphere.radius;
    const bool both_beads = a.node == NecklaceTree::leaf && b.node == NecklaceTree::leaf;
    if (both_beads || (a.sphere.center - b.sphere.center).squaredNorm() > reach * reach) {
      ++pairs_;
      return;
    }
    if (a.beads.last - a.beads.first >= b.beads.last - b.beads.first) {
      for (const Part& half : halves(a)) visit(half, b);
    } else {
      for (const Part& half : halves(b)) visit(a, half);
    }
  }
  [[nodiscard]] std::array<Part, 2> halves(const Part& whole) const {
    const BeadId middle = whole.beads.first + (whole.beads.last - whole.beads.first) / 2;
    return {part(hierarchy_.tree().left(whole.node), {whole.beads.first, middle}),
            part(hierarchy_.tree().right(whole.node), {middle + 1, whole.beads.last})};
  }

  const H& hierarchy_;
  const Subject& subject_;
  std::size_t frame_;
  std::uint64_t pairs_ = 0;
};

template <int Dimension>
CollisionBetween between(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds) {
  CollisionBetween result;
  const Balls<Dimension> after = centers_at<Dimension>(subject, to);
  LayeredHierarchy<Dimension> layered(subject.necklaces);
  TimedUpdate<Dimension> lazy(subject, from, to, Update::lazy), full(subject, from, to, Update::cascade);
  std::uint64_t lazily_found = 0;  // used, so that the compiler keeps the search
  const auto times = timed_in_turn<3>(
      rounds, {processor_time([&] {
                 layered.build(after);
                 result.layered_pairs = SearchBetween(layered, subject, to).pairs();
               }),
               [&] {
                 return lazy.seconds([&](const auto& hierarchy, const WrapCounts&, std::size_t at) {
                   lazily_found += SearchBetween(hierarchy, subject, at).pairs();
                 });
               },
               [&] {
                 return full.seconds([&](const auto& hierarchy, const WrapCounts& counts, std::size_t at) {
                   const std::uint64_t pairs = SearchBetween(hierarchy, subject, at).pairs();
                   if (at != to) return;
                   result.wrapped_pairs = pairs;
                   result.frontier = mean_frontier(hierarchy, counts, subject);
                 });
               }});
  result.layered = times[0];
  result.lazy = times[1];
  result.full = times[2];
  return result;
}

}  // namespace

Construction construction_of(const Subject& subject, std::size_t frame, std::size_t rounds) {
  return subject.planar ? construction<2>(subject, frame, rounds) : construction<3>(subject, frame, rounds);
}
SelfCollision self_collision_of(const Subject& subject, std::size_t frame, std::size_t rounds) {
  return subject.planar ? self_collision<2>(subject, frame, rounds)
                        : self_collision<3>(subject, frame, rounds);
}
Step step_of(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds) {
  return subject.planar ? step<2>(subject, from, to, rounds) : step<3>(subject, from, to, rounds);
}
DiagramStep diagram_step_of(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds) {
  return subject.planar ? diagram_step<2>(subject, from, to, rounds)
                        : diagram_step<3>(subject, from, to, rounds);
}
CollisionBetween collision_between(const Subject& subject, std::size_t from, std::size_t to,
                                   std::size_t rounds) {
  return subject.planar ? between<2>(subject, from, to, rounds) : between<3>(subject, from, to, rounds);
}

}  // namespace kds
