#include "python/timing.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "experiments/program/timing.h"
#include "motions/base/input_error.h"
#include "motions/frames/trajectory.h"
#include "motions/scene/scene.h"
#include "python/arrays.h"
#include "python/balls_given.h"
#include "python/watch.h"
#include "structures/collision/auto_detector.h"
#include "structures/collision/balls_meet.h"
#include "structures/collision/block_tree.h"
#include "structures/collision/box_tree.h"
#include "structures/collision/cell_list.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/collision/sphere_tree.h"
#include "structures/dual_complex/union_measures.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/necklace/balls.h"
#include "structures/session/kinetic_run.h"
#include "structures/triangulation/static_build.h"
#include "structures/triangulation/static_dual_complex.h"

namespace kds::python {

namespace py = pybind11;

namespace {

template <int Dimension>
Balls<Dimension> balls_of(const char* name, const Numbers& points, double radius) {
  const Eigen::Matrix3Xd centers = points_given(name, points, 2);
  return Balls<Dimension>(centers, std::vector<double>(static_cast<std::size_t>(centers.cols()), radius));
}

std::vector<BeadRange> one_necklace(const Numbers& points) {
  return {{0, static_cast<BeadId>(points.shape(0) - 1)}};
}

// Calls `measure` with the dimension as a constant.
template <class Measure>
py::dict in_dimension(const Numbers& points, Measure measure) {
  if (points.ndim() == 2 && points.shape(1) == 2) return measure(std::integral_constant<int, 2>());
  return measure(std::integral_constant<int, 3>());
}

// Computes with the GIL released.
template <class Compute>
auto released(Compute compute) {
  const Watch watch;
  return compute();
}

struct Work {
  std::string name;
  std::function<double()> seconds;
};
template <class Repeated>
Work work(const char* name, Repeated repeated) {
  return {name, [repeated] { return processor_seconds_per_call(repeated); }};
}

// Runs the works in turn. Work that takes more than a second is run once.
py::dict timed_in_turn(std::size_t rounds, const std::vector<Work>& works) {
  std::vector<std::function<double()>> functions;
  for (const Work& one : works) functions.push_back(one.seconds);
  std::vector<std::vector<double>> seconds(works.size());
  if (rounds > 0) seconds = released([&] { return seconds_in_turn(rounds, functions); });
  py::dict times;
  for (std::size_t i = 0; i < works.size(); ++i)
    times[py::str(works[i].name)] = array_of(std::move(seconds[i]));
  return times;
}

template <int Dimension>
py::dict builds(const Numbers& points, std::size_t rounds) {
  const Eigen::Matrix3Xd centers = points_given("centers", points, 2);
  const std::vector<double> zeros(static_cast<std::size_t>(centers.cols()), 0.0);
  const Balls<Dimension> balls(centers, zeros);
  StaticWrappedHierarchy<Dimension> wrapped(one_necklace(points));
  LayeredHierarchy<Dimension> layered(one_necklace(points));
  const Tightness rho = released([&] {
    wrapped.build(balls);
    layered.build(balls);
    return tightness_of(wrapped, layered);
  });
  py::dict found = timed_in_turn(
      rounds, {work("wrapped", [&] { wrapped.build(balls); }), work("layered", [&] { layered.build(balls); }),
               work("wrapped_by_cgal", spheres_by_cgal<Dimension>(wrapped.tree().ranges(), centers, zeros)),
               work("power", triangulation_by_cgal<Dimension>(centers, zeros))});
  found["rho_avg"] = rho.average;
  found["rho_min"] = rho.least;
  return found;
}

py::dict surfaces(const Numbers& points, const Numbers& lengths, std::size_t rounds) {
  const BallsGiven balls(points, lengths);
  std::vector<double> weights = balls.radii;
  for (double& weight : weights) weight *= weight;
  const ComplexSimplices complex = released([&] { return static_dual_complex(balls.centers, weights); });
  return timed_in_turn(
      rounds,
      {work("triangulation", triangulation_by_cgal<3>(balls.centers, weights)),
       work("complex", [&] { static_cast<void>(static_dual_complex(balls.centers, weights)); }),
       work("measures", [&] { static_cast<void>(measure_union(balls.centers, balls.radii, complex)); })});
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

template <int Dimension>
py::dict searches(const Numbers& points, double radius, std::size_t apart, std::size_t rounds) {
  const Balls<Dimension> balls = balls_of<Dimension>("centers", points, radius);
  const std::vector<BeadRange> necklaces = one_necklace(points);
  const PairsAsked asked{necklaces, true, static_cast<BeadId>(apart), true};
  SphereTree<Dimension> wrapped(Hierarchy::wrapped, necklaces), layered(Hierarchy::layered, necklaces);
  const auto [by_wrapped, by_layered] = released([&] {
    wrapped.build(balls);
    layered.build(balls);
    return std::pair(find_pairs(wrapped, asked), find_pairs(layered, asked));
  });
  std::size_t colliding = 0;  // used, so that the compiler keeps the work
  py::dict found =
      timed_in_turn(rounds, {work("quadratic", [&] { colliding += collides(balls) ? 1 : 0; }),
                             work("wrapped", [&] { colliding += find_pairs(wrapped, asked).pairs.size(); }),
                             work("layered", [&] { colliding += find_pairs(layered, asked).pairs.size(); })});
  found["wrapped_pairs"] = by_wrapped.family;
  found["layered_pairs"] = by_layered.family;
  found["collisions"] = by_wrapped.pairs.size();
  return found;
}

// Times an update from one frame to another. An update that trusts its bases leaves them as they are, so it
// can be repeated. A cascade repairs bases, so it goes back by a cascade each time, which takes about as
// long.
template <int Dimension>
class TimedUpdate {
 public:
  using Hierarchy = StaticWrappedHierarchy<Dimension>;

  TimedUpdate(const Numbers& before, const Numbers& after, const std::vector<BeadRange>& necklaces,
              Update how)
      : before_(balls_of<Dimension>("before", before, 0)),
        after_(balls_of<Dimension>("after", after, 0)),
        hierarchy_(necklaces),
        how_(how) {
    hierarchy_.build(before_);
    hierarchy_.update(before_, how_ == Update::cascade ? how_ : Update::naive);
  }

  [[nodiscard]] const Balls<Dimension>& after() const { return after_; }

  /// Returns the seconds of an update with `arrived`, which is called with the hierarchy, its counts and the
  /// balls. For a cascade they are the mean of the way there and back.
  template <class Arrived>
  double seconds(const Arrived& arrived) {
    const auto go = [&](const Balls<Dimension>& balls) {
      const WrapCounts counts = hierarchy_.update(balls, how_);
      arrived(hierarchy_, counts, balls);
    };
    if (how_ != Update::cascade) return processor_seconds_per_call([&] { go(after_); });
    return processor_seconds_per_call([&] {
             go(after_);
             go(before_);
           }) /
           2;
  }

 private:
  Balls<Dimension> before_, after_;
  Hierarchy hierarchy_;
  Update how_;
};

// The paper's naive verification: returns the number of nodes from whose spheres a bead has escaped. It tests
// bead by bead; the early end also keeps the compiler from testing several beads at once.
template <int Dimension>
std::size_t escaped_nodes(const StaticWrappedHierarchy<Dimension>& hierarchy, const Balls<Dimension>& balls) {
  constexpr double margin = 1e-9;  // for rounding: spheres pass through the centres of their bases
  std::size_t escaped = 0;
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
    const Sphere sphere = hierarchy.sphere(node);
    const double most = sphere.radius * sphere.radius * (1 + margin);
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
                     const Balls<Dimension>& balls) {
  return static_cast<double>(counts.frontier) /
         static_cast<double>(hierarchy.tree().node_count() + balls.size());
}

void check_frames(const Numbers& before, const Numbers& after) {
  const Eigen::Index beads = points_given("before", before, 2).cols();
  if (points_given("after", after, 2).cols() != beads || before.shape(1) != after.shape(1))
    throw InputError(fmt::format("after: has the shape {}; expected that of before, {}",
                                 std::string(py::str(after.attr("shape"))),
                                 std::string(py::str(before.attr("shape")))));
}

template <int Dimension>
py::dict updates(const Numbers& before, const Numbers& after, std::size_t rounds) {
  const std::vector<BeadRange> necklaces = one_necklace(before);
  TimedUpdate<Dimension> lazy(before, after, necklaces, Update::trust),
      cascade(after, after, necklaces, Update::cascade), naive(after, after, necklaces, Update::trust);
  std::size_t escaped = 0;  // used, so that the compiler keeps the work
  py::dict found = timed_in_turn(
      rounds,
      {{"lazy", [&] { return lazy.seconds([](const auto&, const WrapCounts&, const auto&) {}); }},
       {"cascade", [&] { return cascade.seconds([](const auto&, const WrapCounts&, const auto&) {}); }},
       {"naive", [&] {
          return naive.seconds([&](const auto& hierarchy, const WrapCounts&, const auto& balls) {
            escaped += escaped_nodes(hierarchy, balls);
          });
        }}});
  StaticWrappedHierarchy<Dimension> moved(necklaces);
  const Balls<Dimension> start = balls_of<Dimension>("before", before, 0);
  const auto tests = [](const WrapCounts& counts) { return counts.bead_tests + counts.cage_tests; };
  const auto [by_naive, by_cascade] = released([&] {
    moved.build(start);
    const WrapCounts counts = moved.update(naive.after(), Update::naive);
    moved.build(start);
    moved.update(start, Update::cascade);
    return std::pair(counts, moved.update(naive.after(), Update::cascade));
  });
  found["naive_tests"] = tests(by_naive);
  found["cascade_tests"] = tests(by_cascade);
  found["bases_changed"] = by_cascade.changed;
  found["frontier"] = mean_frontier(moved, by_cascade, start);
  return found;
}

// The search of the paper's Figure 6 for two necklaces. If the spheres of two nodes meet, it splits the node
// with more beads. Beads that meet would form a pair of their own.
template <class H, int Dimension>
class SearchBetween {
 public:
  SearchBetween(const H& hierarchy, const std::vector<BeadRange>& necklaces, const Balls<Dimension>& balls)
      : hierarchy_(hierarchy), necklaces_(necklaces), balls_(balls) {}

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
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      bead.center[static_cast<Eigen::Index>(axis)] = balls_.rows()[beads.first].center[axis];
    return {node, beads, bead};
  }
  [[nodiscard]] Part root(std::size_t necklace) const {
    const BeadRange& beads = necklaces_[necklace];
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
  const std::vector<BeadRange>& necklaces_;
  const Balls<Dimension>& balls_;
  std::uint64_t pairs_ = 0;
};

template <int Dimension>
py::dict updates_between(const Numbers& before, const Numbers& after, std::size_t first, std::size_t rounds) {
  const auto beads = static_cast<std::size_t>(before.shape(0));
  if (beads < 4)
    throw InputError(fmt::format("before: has {} beads; expected two necklaces of 2 or more", beads));
  if (first < 2 || first > beads - 2)
    throw InputError(fmt::format("first: is {}; expected the number of beads of the first necklace, 2 to {}",
                                 first, beads - 2));
  const std::vector<BeadRange> necklaces{{0, static_cast<BeadId>(first - 1)},
                                         {static_cast<BeadId>(first), static_cast<BeadId>(beads - 1)}};
  const Balls<Dimension> end = balls_of<Dimension>("after", after, 0);
  LayeredHierarchy<Dimension> layered(necklaces);
  TimedUpdate<Dimension> lazy(before, after, necklaces, Update::lazy),
      full(before, after, necklaces, Update::cascade);
  std::uint64_t pairs_seen = 0;  // used, so that the compiler keeps the search
  const auto search = [&](const auto& hierarchy, const Balls<Dimension>& balls) {
    const std::uint64_t pairs = SearchBetween(hierarchy, necklaces, balls).pairs();
    pairs_seen += pairs;
    return pairs;
  };
  const auto arrived = [&](const auto& hierarchy, const WrapCounts&, const Balls<Dimension>& balls) {
    search(hierarchy, balls);
  };
  py::dict found = timed_in_turn(rounds, {work("layered",
                                               [&] {
                                                 layered.build(end);
                                                 search(layered, end);
                                               }),
                                          {"lazy", [&] { return lazy.seconds(arrived); }},
                                          {"full", [&] { return full.seconds(arrived); }}});
  StaticWrappedHierarchy<Dimension> wrapped(necklaces);
  const Balls<Dimension> start = balls_of<Dimension>("before", before, 0);
  const WrapCounts counts = released([&] {
    layered.build(end);
    wrapped.build(start);
    wrapped.update(start, Update::cascade);
    return wrapped.update(end, Update::cascade);
  });
  found["layered_pairs"] = search(layered, end);
  found["wrapped_pairs"] = search(wrapped, end);
  found["frontier"] = mean_frontier(wrapped, counts, end);
  return found;
}

// Frames of a chain of balls in space. A work is timed over all steps at once, because a step may take less
// than a reading of the clock. Its time includes that of bringing the frames in.
class MovingChain {
 public:
  MovingChain(const std::vector<Numbers>& given, double radius) {
    if (given.size() < 2) throw InputError("frames: has fewer than two frames");
    Trajectory trajectory;
    trajectory.file = "frames";
    for (const Numbers& frame : given) {
      if (frame.ndim() != 2 || frame.shape(1) != 3)
        throw InputError("frames: expected the shape (frames, beads, 3)");
      trajectory.frames.push_back(points_given("frames", frame, 2));
    }
    radii.assign(static_cast<std::size_t>(given[0].shape(0)), radius);
    necklaces = one_necklace(given[0]);
    scene.emplace(std::span(&trajectory, 1), radii);
    if (scene->dimension() != 3) throw InputError("frames: all beads lie in one plane");
    frames = std::move(trajectory.frames);
  }

  /// Calls look(balls) at each stride-th frame. The first frame comes before the time is taken.
  template <class Look>
  [[nodiscard]] Work at_frames(std::string name, Look look, std::size_t stride = 1) const {
    return {std::move(name), [this, look, stride] {
              Balls<3> balls(frames[0], radii);
              look(balls);
              return processor_seconds_of([&] {
                for (std::size_t frame = stride; frame < frames.size(); frame += stride) {
                  balls.move_to(frames[frame]);
                  look(balls);
                }
              });
            }};
  }
  [[nodiscard]] Work run(std::string name, std::string structure,
                         const StructureSettings& settings = {}) const {
    const KineticRunOptions options{.structures = {std::move(structure)}, .settings = settings};
    return {std::move(name), [this, options] {
              KineticRun run(*scene, options);
              run.build();
              return processor_seconds_of([&] { run.run(); });
            }};
  }

  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> radii;
  std::vector<BeadRange> necklaces;
  std::optional<Scene> scene;
};

// Axis-aligned boxes over the balanced tree of a chain. A refit computes all boxes again, children first.
// BoxTree<3>::build bounds slabs of any directions, and takes about 15 times as long for these three (108 to
// 100,000 beads), so it would be no fair peer.
class AxisBoxes {
 public:
  explicit AxisBoxes(const std::vector<BeadRange>& necklaces)
      : tree_(necklaces, 3), boxes_(tree_.nodes().size()) {}

  void refit(const Balls<3>& balls) {
    for (std::size_t k = boxes_.size(); k-- > 0;) {
      const TreeBox& node = tree_.nodes()[k];
      if (node.is_bead()) {
        const BallRow<3>& ball = balls.rows()[node.first];
        const Eigen::Array3d center = Eigen::Map<const Eigen::Array3d>(ball.center.data());
        const double reach =
            ball.radius + 0x1p-50 * (ball.radius + center.abs().maxCoeff());  // rounds outwards
        boxes_[k] = {(center - reach).matrix(), (center + reach).matrix()};
      } else {
        boxes_[k] = boxes_[node.left].merged(boxes_[node.right]);
      }
    }
  }
  /// Returns the pairs of beads that meet and are at least `apart` along the chain.
  const std::vector<BeadPair>& pairs(const Balls<3>& balls, std::size_t apart) {
    pairs_.clear();
    waiting_ = {{0, 0}};
    while (!waiting_.empty()) {
      const auto [i, j] = waiting_.back();
      waiting_.pop_back();
      const TreeBox &a = tree_.nodes()[i], &b = tree_.nodes()[j];
      if (b.last - a.first < apart) continue;
      if (i == j) {
        waiting_.insert(waiting_.end(), {{a.left, a.left}, {a.right, a.right}, {a.left, a.right}});
      } else if (!boxes_[i].intersects(boxes_[j])) {
        continue;
      } else if (a.is_bead() && b.is_bead()) {
        if (balls_meet(balls, a.first, b.first)) pairs_.push_back({a.first, b.first});
      } else if (a.last - a.first >= b.last - b.first) {
        waiting_.insert(waiting_.end(), {{a.left, j}, {a.right, j}});
      } else {
        waiting_.insert(waiting_.end(), {{i, b.left}, {i, b.right}});
      }
    }
    return pairs_;
  }

 private:
  BoxTree<3> tree_;  // its nodes only
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<std::array<std::uint32_t, 2>> waiting_;
  std::vector<BeadPair> pairs_;
};

py::dict hierarchy_steps(const std::vector<Numbers>& frames, double radius, std::size_t rounds) {
  const MovingChain chain(frames, radius);
  StaticWrappedHierarchy<3> wrapped(chain.necklaces), updated(chain.necklaces);
  updated.build(Balls<3>(chain.frames[0], chain.radii));
  LayeredHierarchy<3> layered(chain.necklaces);
  AxisBoxes boxes(chain.necklaces);
  return timed_in_turn(
      rounds, {chain.run("events", "wrapped"), chain.run("chords", "wrapped", {.between = Between::chord}),
               chain.run("tight_chords", "wrapped", {.between = Between::chord, .tightness = 0.01}),
               chain.run("layered_chords", "layered"), chain.run("box_events", "boxes"),
               chain.at_frames("updated", [&](const Balls<3>& balls) { updated.update(balls); }),
               chain.at_frames("rebuilt", [&](const Balls<3>& balls) { wrapped.build(balls); }),
               chain.at_frames("layered", [&](const Balls<3>& balls) { layered.build(balls); }),
               chain.at_frames("boxes", [&](const Balls<3>& balls) { boxes.refit(balls); })});
}

// Finds the times at which contacts begin and end on straight paths, in doubles and without events. Beads
// that meet within a step are at its start at most twice the largest displacement farther apart. Times of a
// step are put in order, as those of events are, although only their number is read here.
class PathContacts {
 public:
  using Near = std::function<std::span<const BeadPair>(const Balls<3>&, double gap)>;
  explicit PathContacts(Near near) : near_(std::move(near)) {}

  void follow(const MovingChain& chain) {
    begins_ = ends_ = 0;
    Balls<3> balls(chain.frames[0], chain.radii);
    for (std::size_t frame = 1; frame < chain.frames.size(); ++frame) {
      const Eigen::Matrix3Xd &before = chain.frames[frame - 1], &after = chain.frames[frame];
      const double moved = std::sqrt((after - before).colwise().squaredNorm().maxCoeff());
      times_.clear();
      for (const BeadPair& pair : near_(balls, 2 * moved * (1 + 1e-12)))
        find(pair, before.col(pair.second) - before.col(pair.first),
             after.col(pair.second) - after.col(pair.first), 2 * chain.radii[0]);
      std::sort(times_.begin(), times_.end());
      balls.move_to(after);
    }
  }
  [[nodiscard]] std::array<std::size_t, 2> begins_and_ends() const { return {begins_, ends_}; }

 private:
  // The squared distance less that of a contact is a u^2 + 2 b u + c.
  void find(const BeadPair& pair, const Eigen::Vector3d& before, const Eigen::Vector3d& after, double reach) {
    const Eigen::Vector3d moved = after - before;
    const double a = moved.squaredNorm(), b = before.dot(moved), c = before.squaredNorm() - reach * reach;
    const bool meet_before = c <= 0, meet_after = a + 2 * b + c <= 0;
    if (meet_before ? meet_after : b >= 0 || b * b < a * c) return;
    const double root = std::sqrt(b * b - a * c), begin = c / (root - b);
    if (!meet_before && begin > 1) return;
    if (!meet_before) times_.emplace_back(begin, pair), ++begins_;
    if (!meet_after) times_.emplace_back(b > 0 ? -c / (root + b) : (root - b) / a, pair), ++ends_;
  }

  Near near_;
  std::vector<std::pair<double, BeadPair>> times_;
  std::size_t begins_ = 0, ends_ = 0;
};

py::dict contact_steps(const std::vector<Numbers>& frames, double radius, std::size_t apart,
                       const std::vector<std::size_t>& strides, std::size_t rounds) {
  const MovingChain chain(frames, radius);
  const PairsAsked asked{chain.necklaces, true, static_cast<BeadId>(apart), true};
  CellList<3> cells(asked), cells_of_paths(asked);
  VerletList<3> verlet(asked, radius);
  BlockTree<3> blocks(asked);
  AutoDetector<3> blocks_of_paths(asked);
  SphereTree<3> wrapped(Hierarchy::wrapped, chain.necklaces), layered(Hierarchy::layered, chain.necklaces);
  AxisBoxes boxes(chain.necklaces);
  const auto search = [&](SphereTree<3>& tree) {
    return [&](const Balls<3>& balls) {
      tree.build(balls);
      return find_pairs(tree, asked).pairs.size();
    };
  };
  const std::vector<std::pair<std::string, std::function<std::size_t(const Balls<3>&)>>> methods{
      {"cells", [&](const Balls<3>& balls) { return cells.pairs(balls).size(); }},
      {"verlet", [&](const Balls<3>& balls) { return verlet.pairs(balls).size(); }},
      {"blocks",
       [&](const Balls<3>& balls) {
         blocks.forget_order();  // each frame is a new scene
         return blocks.pairs(balls).size();
       }},
      {"wrapped", search(wrapped)},
      {"layered", search(layered)},
      {"boxes", [&](const Balls<3>& balls) {
         boxes.refit(balls);
         return boxes.pairs(balls, apart).size();
       }}};
  PathContacts paths(
      [&](const Balls<3>& balls, double gap) { return cells_of_paths.near_pairs(balls, gap); });
  PathContacts block_paths([&](const Balls<3>& balls, double gap) -> std::span<const BeadPair> {
    return blocks_of_paths.pairs_within(balls, gap);
  });
  std::optional<std::size_t> pairs;  // of all frames
  released([&] {
    for (const auto& [name, count] : methods) {
      std::size_t found = 0;
      static_cast<void>(
          chain.at_frames(name, [&](const Balls<3>& balls) { found += count(balls); }).seconds());
      if (found != pairs.value_or(found)) throw std::logic_error(name + " finds other pairs");
      pairs = found;
    }
    paths.follow(chain);
    block_paths.follow(chain);
    if (paths.begins_and_ends() != block_paths.begins_and_ends())
      throw std::logic_error("paths have other contacts");
    return 0;
  });
  StructureSettings settings;
  settings.apart = asked.apart;
  std::vector<Work> works{
      chain.run("events", "contacts", settings),
      {"paths", [&] { return processor_seconds_of([&] { paths.follow(chain); }); }},
      {"block_paths", [&] { return processor_seconds_of([&] { block_paths.follow(chain); }); }}};
  for (const auto& [name, count] : methods)
    for (const std::size_t stride : strides)
      works.push_back(chain.at_frames(fmt::format("{}_{}", name, stride), count, stride));
  py::dict found = timed_in_turn(rounds, works);
  found["pairs"] = *pairs;
  found["begins"] = paths.begins_and_ends()[0];
  found["ends"] = paths.begins_and_ends()[1];
  return found;
}

}  // namespace

void bind_timing(py::module_& module) {
  module.def("time_builds", [](const Numbers& centers, std::size_t rounds) {
    return in_dimension(centers, [&](auto dimension) { return builds<dimension>(centers, rounds); });
  });
  module.def("time_surfaces", surfaces);
  module.def(
      "time_searches", [](const Numbers& centers, double radius, std::size_t apart, std::size_t rounds) {
        return in_dimension(
            centers, [&](auto dimension) { return searches<dimension>(centers, radius, apart, rounds); });
      });
  module.def("time_updates", [](const Numbers& before, const Numbers& after, std::size_t rounds) {
    check_frames(before, after);
    return in_dimension(before, [&](auto dimension) { return updates<dimension>(before, after, rounds); });
  });
  module.def("time_updates_between",
             [](const Numbers& before, const Numbers& after, std::size_t first, std::size_t rounds) {
               check_frames(before, after);
               return in_dimension(before, [&](auto dimension) {
                 return updates_between<dimension>(before, after, first, rounds);
               });
             });
  module.def("time_hierarchy_steps", hierarchy_steps);
  module.def("time_contact_steps", contact_steps);
}

}  // namespace kds::python
