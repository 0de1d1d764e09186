#include "experiments/reproduce/measurements.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "motions/models/model.h"
#include "motions/models/shapes.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "structures/collision/brute_force.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/triangulation/diagram_edges.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

constexpr double turns = 9;  // with 18 turns, 1000 beads would overlap

Subject of_models(std::vector<Trajectory> necklaces, bool planar) {
  Subject subject;
  subject.planar = planar;
  BeadId beads = 0;
  for (const Trajectory& necklace : necklaces) {
    const auto count = static_cast<BeadId>(necklace.bead_count());
    subject.necklaces.push_back({beads, beads + count - 1});
    beads += count;
  }
  subject.radii.assign(beads, 1.0);
  for (std::size_t k = 0; k < necklaces.front().frames.size(); ++k) {
    Eigen::Matrix3Xd& frame = subject.frames.emplace_back(3, beads);
    for (std::size_t n = 0; n < necklaces.size(); ++n)
      frame.middleCols(subject.necklaces[n].first, necklaces[n].frames[k].cols()) = necklaces[n].frames[k];
  }
  return subject;
}

}  // namespace

Subject model_subject(std::string_view name, std::size_t beads) {
  const models::Settings settings{.beads = beads, .frames = 1, .motion = models::ShapeMotion::rest};
  return of_models(models::generate(*models::find_model(name), settings), name == "grill");
}

Subject rolling_spiral(std::size_t beads, std::size_t frames) {
  const models::Settings settings{.beads = beads, .frames = frames, .turns = turns};
  return of_models(models::generate(*models::find_model("spiral"), settings), true);
}

Subject two_rolling_spirals(std::size_t beads, std::size_t frames) {
  const models::Settings settings{.beads = beads, .frames = frames, .turns = turns};
  const Trajectory one = models::generate(*models::find_model("spiral"), settings).front();
  Trajectory other = one;
  const double length = static_cast<double>(beads - 1) * 2 * models::usual_bond;
  for (std::size_t k = 0; k < frames; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(frames - 1);
    other.frames[k].row(2).array() += (1 - part) * 1.5 * length + part * 2.1;
  }
  return of_models({one, other}, false);
}

Subject protein(const std::filesystem::path& data, std::string_view file, std::string_view topology) {
  ReadOptions options;
  if (!topology.empty()) options.topology = data / topology;
  Trajectory necklace = read_trajectory(data / file, options);
  Subject subject;
  subject.radii = bead_radii("auto", std::span(&necklace, 1));
  subject.necklaces = {{0, static_cast<BeadId>(subject.radii.size() - 1)}};
  subject.frames = std::move(necklace.frames);
  return subject;
}

namespace {

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
  const auto seconds = seconds_in_turn(
      rounds, {[&] { return processor_seconds_of([&] { wrapped.build(balls); }); },
               [&] { return processor_seconds_of([&] { layered.build(balls); }); },
               [&] { return seconds_to_triangulate<Dimension>(subject.frames[frame], weights).processor; }});
  result.layered_per_wrapped = ratios_by_round(seconds[1], seconds[0]);
  result.power_per_wrapped = ratios_by_round(seconds[2], seconds[0]);
  result.tightness = tightness_of(wrapped, layered);
  return result;
}

template <int Dimension>
SelfCollision self_collision(const Subject& subject, std::size_t frame, std::size_t rounds) {
  const Balls<Dimension> balls = balls_at<Dimension>(subject, frame);
  const PairsAsked asked{subject.necklaces, true, 2, true};
  SelfCollision result;
  SphereTree<Dimension> wrapped(Hierarchy::wrapped, subject.necklaces),
      layered(Hierarchy::layered, subject.necklaces);
  wrapped.build(balls);
  layered.build(balls);
  const auto search = [&asked](SphereTree<Dimension>& tree, std::uint64_t& pairs) {
    return [&] { return processor_seconds_of([&] { pairs = find_pairs(tree, asked).family; }); };
  };
  std::size_t colliding = 0;  // used, so that the compiler keeps the work
  const auto seconds = seconds_in_turn(
      rounds, {search(wrapped, result.wrapped_pairs), search(layered, result.layered_pairs), [&] {
                 return processor_seconds_of([&] { colliding += pairs_by_force(balls, asked).size(); });
               }});
  result.layered_per_wrapped = ratios_by_round(seconds[1], seconds[0]);
  result.quadratic_per_wrapped = ratios_by_round(seconds[2], seconds[0]);
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

// Times an update repeatedly. After each timed update the hierarchy moves back without being timed, so every
// call starts from the same state.
template <int Dimension>
class TimedUpdate {
 public:
  using Hierarchy = StaticWrappedHierarchy<Dimension>;

  TimedUpdate(const Subject& subject, std::size_t from, std::size_t to, Update how)
      : before_(balls_at<Dimension>(subject, from)),
        after_(balls_at<Dimension>(subject, to)),
        hierarchy_(subject.necklaces),
        how_(how) {
    hierarchy_.build(before_);
    go_back();
  }

  /// The time includes `arrived`.
  template <class Arrived>
  double seconds(const Arrived& arrived) {
    const double seconds = processor_seconds_of([&] {
      const WrapCounts counts = hierarchy_.update(after_, how_);
      arrived(hierarchy_, counts);
    });
    go_back();
    return seconds;
  }

 private:
  void go_back() { hierarchy_.update(before_, how_ == Update::cascade ? how_ : Update::naive); }

  Balls<Dimension> before_, after_;
  Hierarchy hierarchy_;
  Update how_;
};

template <int Dimension>
double mean_frontier(const StaticWrappedHierarchy<Dimension>& hierarchy, const WrapCounts& counts) {
  return static_cast<double>(counts.frontier) / static_cast<double>(hierarchy.tree().node_count());
}

template <int Dimension>
Step step(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds) {
  Step result;
  const auto tests = [](const WrapCounts& counts) {
    return static_cast<double>(counts.bead_tests + counts.cage_tests);
  };
  TimedUpdate<Dimension> lazy(subject, from, to, Update::trust), naive(subject, from, to, Update::naive),
      cascade(subject, from, to, Update::cascade);
  const auto seconds =
      seconds_in_turn(rounds, {[&] { return lazy.seconds([](const auto&, const WrapCounts&) {}); },
                               [&] {
                                 return naive.seconds([&](const auto&, const WrapCounts& counts) {
                                   result.naive_tests = tests(counts);
                                 });
                               },
                               [&] {
                                 return cascade.seconds([&](const auto& hierarchy, const WrapCounts& counts) {
                                   result.bases_changed = counts.changed;
                                   result.cascade_tests = tests(counts);
                                   result.frontier = mean_frontier(hierarchy, counts);
                                 });
                               }});
  result.lazy_per_naive = ratios_by_round(seconds[0], seconds[1]);
  result.cascade_per_naive = ratios_by_round(seconds[2], seconds[1]);
  result.cells_changed = from == to ? 0 : cells_changed<Dimension>(subject, from, to);
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
  TimedUpdate<Dimension> lazy(subject, from, to, Update::lazy), full(subject, from, to, Update::cascade);
  std::uint64_t lazily_found = 0;  // used, so that the compiler keeps the search
  const auto seconds =
      seconds_in_turn(rounds, {[&] {
                                 return processor_seconds_of([&] {
                                   layered.build(after);
                                   result.layered_pairs = SearchBetween(layered, subject, to).pairs();
                                 });
                               },
                               [&] {
                                 return lazy.seconds([&](const auto& hierarchy, const WrapCounts&) {
                                   lazily_found += SearchBetween(hierarchy, subject, to).pairs();
                                 });
                               },
                               [&] {
                                 return full.seconds([&](const auto& hierarchy, const WrapCounts& counts) {
                                   result.wrapped_pairs = SearchBetween(hierarchy, subject, to).pairs();
                                   result.frontier = mean_frontier(hierarchy, counts);
                                 });
                               }});
  result.layered_per_full = ratios_by_round(seconds[0], seconds[2]);
  result.lazy_per_full = ratios_by_round(seconds[1], seconds[2]);
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
