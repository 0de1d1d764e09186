#include "experiments/reproduce/measurements.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "experiments/program/timing.h"
#include "structures/collision/brute_force.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/triangulation/diagram_edges.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

template <class Work>
double median_seconds(std::size_t rounds, const Work& work) {
  return repeated_seconds(rounds, work).median;
}

std::vector<double> weights_of(const Subject& subject) {
  std::vector<double> weights;
  for (const double radius : subject.radii) weights.push_back(radius * radius);
  return weights;
}

template <int Dimension>
Balls<Dimension> balls_at(const Subject& subject, std::size_t frame) {
  return Balls<Dimension>(subject.frames[frame], subject.radii);
}

template <int Dimension>
Construction construction(const Subject& subject, std::size_t frame, std::size_t rounds) {
  const Balls<Dimension> balls = balls_at<Dimension>(subject, frame);
  StaticWrappedHierarchy<Dimension> wrapped(subject.necklaces);
  LayeredHierarchy<Dimension> layered(subject.necklaces);
  const std::vector<double> weights = weights_of(subject);
  Construction result;
  result.wrapped =
      median_seconds(rounds, [&] { return processor_seconds_of([&] { wrapped.build(balls); }); });
  result.layered =
      median_seconds(rounds, [&] { return processor_seconds_of([&] { layered.build(balls); }); });
  result.power = median_seconds(
      rounds, [&] { return seconds_to_triangulate<Dimension>(subject.frames[frame], weights).processor; });
  result.tightness = tightness_of(wrapped, layered);
  return result;
}

template <int Dimension>
SelfCollision self_collision(const Subject& subject, std::size_t frame, std::size_t rounds) {
  const Balls<Dimension> balls = balls_at<Dimension>(subject, frame);
  const PairsAsked asked{subject.necklaces, true, 2, true};
  SelfCollision result;
  const auto search = [&](Hierarchy kind, double& seconds, std::uint64_t& pairs) {
    SphereTree<Dimension> tree(kind, subject.necklaces);
    tree.build(balls);
    seconds = median_seconds(
        rounds, [&] { return processor_seconds_of([&] { pairs = find_pairs(tree, asked).family; }); });
  };
  search(Hierarchy::wrapped, result.wrapped, result.wrapped_pairs);
  search(Hierarchy::layered, result.layered, result.layered_pairs);
  std::size_t colliding = 0;  // used, so that nothing can be left out
  result.quadratic = median_seconds(rounds, [&] {
    return processor_seconds_of([&] { colliding += pairs_by_force(balls, asked).size(); });
  });
  result.edges = static_edges<Dimension>(subject.frames[frame], weights_of(subject)).edges.size();
  return result;
}

template <int Dimension>
std::uint64_t cells_changed(const Subject& subject, std::size_t from, std::size_t to) {
  const std::vector<double> weights = weights_of(subject);
  const auto before = static_triangulation<Dimension>(subject.frames[from], weights).cells;
  const auto after = static_triangulation<Dimension>(subject.frames[to], weights).cells;
  std::vector<CellBeads<Dimension>> added;
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(added));
  return added.size();
}

// The hierarchy goes to and fro, so that each call has the same before it; the way back is not timed.
template <int Dimension, class Arrived>
double seconds_to_update(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds,
                         Update how, const Arrived& arrived) {
  const Balls<Dimension> before = balls_at<Dimension>(subject, from),
                         after = balls_at<Dimension>(subject, to);
  StaticWrappedHierarchy<Dimension> hierarchy(subject.necklaces);
  hierarchy.build(before);
  hierarchy.update(before, how == Update::cascade ? how : Update::naive);
  return median_seconds(rounds, [&] {
    WrapCounts counts;
    const double seconds = processor_seconds_of([&] {
      counts = hierarchy.update(after, how);
      arrived(hierarchy, counts);
    });
    hierarchy.update(before, how == Update::cascade ? how : Update::naive);
    return seconds;
  });
}

template <int Dimension>
Step step(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds) {
  Step result;
  const auto nothing = [](const auto&, const WrapCounts&) {};
  const auto tests = [](const WrapCounts& counts) {
    return static_cast<double>(counts.bead_tests + counts.cage_tests);
  };
  result.lazy = seconds_to_update<Dimension>(subject, from, to, rounds, Update::trust, nothing);
  result.naive = seconds_to_update<Dimension>(
      subject, from, to, rounds, Update::naive,
      [&](const auto&, const WrapCounts& counts) { result.naive_tests = tests(counts); });
  result.cascade = seconds_to_update<Dimension>(
      subject, from, to, rounds, Update::cascade, [&](const auto& hierarchy, const WrapCounts& counts) {
        result.bases_changed = counts.changed;
        result.cascade_tests = tests(counts);
        result.frontier =
            static_cast<double>(counts.frontier) / static_cast<double>(hierarchy.tree().node_count());
      });
  result.cells_changed = from == to ? 0 : cells_changed<Dimension>(subject, from, to);
  return result;
}

// The paper's Figure 6 for two necklaces: of two nodes whose spheres meet the one with more beads is split.
// Beads that meet would be a pair of their own.
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
    NodeId node;  ///< NecklaceTree::leaf: a bead
    BeadRange beads;
    Sphere sphere;
  };

  [[nodiscard]] Part part(NodeId node, const BeadRange& beads) const {
    if (node != NecklaceTree::leaf) return {node, beads, hierarchy_.sphere(node)};
    Sphere bead;
    bead.center = subject_.frames[frame_].col(beads.first);
    bead.radius = subject_.radii[beads.first];
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
  const Balls<Dimension> after = balls_at<Dimension>(subject, to);
  LayeredHierarchy<Dimension> layered(subject.necklaces);
  result.layered = median_seconds(rounds, [&] {
    return processor_seconds_of([&] {
      layered.build(after);
      result.layered_pairs = SearchBetween(layered, subject, to).pairs();
    });
  });
  const auto search = [&](const auto& hierarchy, const WrapCounts& counts) {
    result.wrapped_pairs = SearchBetween(hierarchy, subject, to).pairs();
    result.frontier =
        static_cast<double>(counts.frontier) / static_cast<double>(hierarchy.tree().node_count());
  };
  result.lazy = seconds_to_update<Dimension>(subject, from, to, rounds, Update::lazy, search);
  result.full = seconds_to_update<Dimension>(subject, from, to, rounds, Update::cascade, search);
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
CollisionBetween collision_between(const Subject& subject, std::size_t from, std::size_t to,
                                   std::size_t rounds) {
  return subject.planar ? between<2>(subject, from, to, rounds) : between<3>(subject, from, to, rounds);
}

}  // namespace kds
