// Compares certificates, from beads to answers, with the nearest operation of CGAL: a static predicate at one
// moment, or algebraic numbers for the same polynomials (if libmpfi-dev is installed).
//
//   settle     beads to "never fails in this step"; peer: predicate
//   failure    beads to a bracket with one proved root; peer: isolation
//   exact      all roots in [0,1] of given polynomials, in integer arithmetic only; peer: isolation
//   compare    two failure times with disjoint brackets; peer: two algebraic numbers
//   tolerance  facets that need no certificate thanks to the slack found at an earlier frame; peer: predicate

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "certificates/search/certificate_search.h"
#include "certificates/types/bead_in_sphere.h"
#include "experiments/bench/bench.h"
#include "experiments/bench/certificate_peers.h"
#include "experiments/bench/chains.h"
#include "experiments/program/input_options.h"
#include "kds/failure_order.h"
#include "motions/curves/bezier_motion.h"
#include "motions/curves/positions.h"
#include "motions/readers/instance.h"
#include "motions/scene/scene.h"
#include "structures/power_diagram/facet_filter.h"
#include "structures/power_diagram/facet_slack.h"
#include "structures/triangulation/facet_certificate.h"

namespace kds::bench {

namespace {

using Linear = BezierMotion<3, 1>;
using Cubic = BezierMotion<3, 3>;
using Facet = PowerTest<3>;

constexpr std::size_t chain_beads = 10240;
constexpr std::size_t enough = 1000;  // number of items that take microseconds each
constexpr const char* predicate = "CGAL predicate at one moment";
constexpr const char* algebraic = "CGAL Algebraic_kernel_d_1";

using Random = std::mt19937_64;
using Point = std::array<double, 3>;

Point random_direction(Random& random) {
  std::normal_distribution<double> normal;
  Point d{normal(random), normal(random), normal(random)};
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  for (double& x : d) x /= length;
  return d;
}

std::vector<Point> random_chain(std::size_t beads) {
  const Eigen::Matrix3Xd centers = model_at_rest("random-chain", beads);
  std::vector<Point> chain(beads);
  for (std::size_t b = 0; b < beads; ++b) {
    const auto c = centers.col(static_cast<Eigen::Index>(b));
    chain[b] = {c.x(), c.y(), c.z()};
  }
  return chain;
}

/// Moves every bead by `distance` in its own direction. The velocities at both ends (Hermite) differ from
/// this displacement by the same length.
template <Motion M>
M jostled(const std::vector<Point>& beads, double distance, Random& random) {
  static_assert(M::degree == 1 || M::degree == 3);
  M motion(beads.size());
  for (BeadId b = 0; b < beads.size(); ++b) {
    const Point step = random_direction(random);
    const Point first = random_direction(random);
    const Point last = random_direction(random);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double start = beads[b][axis];
      const double end = start + distance * step[axis];
      const int i = static_cast<int>(axis);
      motion.set_coordinate(b, 0, i, start);
      motion.set_coordinate(b, M::degree, i, end);
      if constexpr (M::degree == 3) {
        motion.set_coordinate(b, 1, i, start + distance * (step[axis] + first[axis]) / 3);
        motion.set_coordinate(b, 2, i, end - distance * (step[axis] + last[axis]) / 3);
      }
    }
    for (int k = 0; k <= M::degree; ++k) motion.set_weight(b, k, 1);
  }
  return motion;
}

template <Motion M>
StaticPredicates predicates_of(const M& motion) {
  return {control_points(motion, 0), control_weights(motion, 0)};
}

// A motion and certificates on it, with the outcome of each certificate in the step.
template <class C, Motion M>
struct Input final : CertificateSource {
  explicit Input(M m) : motion(std::make_shared<const M>(std::move(m))), search(search_over<C>(seen())) {}

  [[nodiscard]] MotionRef<M::dimension> seen() const { return {*motion}; }
  void settle() {
    failures.assign(certificates.size(), {});
    search->first_failures(Kernel::filtered, certificates, start,
                           std::vector<KnownAtStart>(certificates.size(), KnownAtStart::unknown), stages,
                           TouchPolicy::ignored, failures);
  }
  // Keeps the certificates with this outcome, at most `most` of them.
  Input kept(Failure::Kind kind, std::size_t most = std::numeric_limits<std::size_t>::max()) {
    settle();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < certificates.size() && kept < most; ++i) {
      if (failures[i].kind == kind) certificates[kept++] = certificates[i];
    }
    certificates.resize(kept);
    settle();
    births.assign(kept, KnownAtStart::unknown);
    return std::move(*this);
  }
  [[nodiscard]] ExactFunction exact_function(std::uint32_t slot) const override {
    return search->exact_function(certificates[slot]);
  }
  [[nodiscard]] std::vector<ExactPolynomial> polynomials() const {
    std::vector<ExactPolynomial> all;
    for (const C& c : certificates) all.push_back(*search->exact_function(c));
    return all;
  }
  [[nodiscard]] auto beads() const {
    std::vector<decltype(C{}.beads)> all;
    for (const C& c : certificates) all.push_back(c.beads);
    return all;
  }
  [[nodiscard]] StaticPredicates predicates() const { return predicates_of(*motion); }

  std::shared_ptr<const M> motion;
  std::shared_ptr<const CertificateSearch<C>> search;  // searches over `motion`
  Instant start{0};
  std::vector<C> certificates;
  std::vector<KnownAtStart> births;
  std::vector<Failure> failures;
  mutable StageCounts stages;
};

template <Motion M>
M chain(double distance) {
  Random random(1);
  const auto beads = random_chain(chain_beads);
  return jostled<M>(beads, distance, random);
}

template <Motion M>
M instance(const std::string& name) {
  const Scene scene(read_instance(source_data_folder() / "kinetic" / (name + ".txt")));
  M motion(scene.bead_count());
  scene.load(0, motion);
  return motion;
}

// The regular triangulation at the start.
struct StartTriangulation : RegularTriangulation<3> {
  explicit StartTriangulation(const Motion auto& motion) {
    static_cast<void>(build(control_points(motion, 0), control_weights(motion, 0)));
  }
};

// Returns all inner facets of the regular triangulation at the start.
template <Motion M>
Input<Facet, M> facets(const M& motion) {
  Input<Facet, M> input(motion);
  const StartTriangulation triangulation(motion);
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (!triangulation.is_live(cell)) continue;
    for (int i = 0; i < 4; ++i) {
      const FacetId beyond = triangulation.beyond(cell, i);
      if (cell_of(beyond) < cell) continue;
      with_facet_certificate(triangulation.cells()[cell].vertex, triangulation.apex(beyond),
                             [&](const auto& c) {
                               if constexpr (std::same_as<decltype(c), const Facet&>)
                                 input.certificates.push_back(c);
                             });
    }
  }
  return input;
}

// Returns tests of a bead against the sphere through two, three or four other beads near it along the chain.
// The sign is chosen so that each certificate holds at the start.
template <class C, Motion M>
Input<C, M> spheres(const M& motion, std::size_t count, std::size_t within) {
  Input<C, M> input(motion);
  Random random(2);
  StageCounts stages;
  constexpr std::size_t size = std::tuple_size_v<decltype(C{}.beads)>;
  while (input.certificates.size() < count) {
    const std::size_t first = random() % (motion.bead_count() - within);
    decltype(C{}.beads) beads;
    for (BeadId& bead : beads) bead = static_cast<BeadId>(first + random() % within);
    std::sort(beads.begin(), beads.end() - 1);
    const bool distinct = std::adjacent_find(beads.begin(), beads.end() - 1) == beads.end() - 1 &&
                          std::find(beads.begin(), beads.end() - 1, beads.back()) == beads.end() - 1;
    if (!distinct) continue;
    for (const bool side : {true, false}) {
      C c;
      if constexpr (size == 5)
        c = C(beads, side ? 1 : -1);
      else
        c = {beads, side};
      if (input.search->sign_just_after(Kernel::filtered, c, input.start, stages) > 0)
        input.certificates.push_back(c);
    }
  }
  return input;
}

// Passes the certificates in groups, as structures do, so that the results of a group stay in the cache.
template <class I>
void search(Kernel kernel, I& input) {
  constexpr std::size_t some = 64;
  const std::span certificates(std::as_const(input.certificates));
  for (std::size_t i = 0; i < certificates.size(); i += some) {
    const std::size_t count = std::min(some, certificates.size() - i);
    input.search->first_failures(kernel, certificates.subspan(i, count), input.start,
                                 std::span(std::as_const(input.births)).first(count), input.stages,
                                 TouchPolicy::ignored, std::span(input.failures).first(count));
  }
}

std::string on_chain(const std::string& measure) {
  return fmt::format("certificates/random-chain 0.01 r/{}/{}", chain_beads, measure);
}

template <class Make>
void add_settle(const std::string& measure, const Make& make) {
  using I = std::invoke_result_t<Make>;
  struct Settled {
    explicit Settled(I made) : input(made.kept(Failure::Kind::never)) {}
    I input;
    decltype(input.beads()) beads = input.beads();
    StaticPredicates peer = input.predicates();
    std::size_t items = beads.size();
  };
  add_pair(
      on_chain(measure), predicate, "ns", [=] { return Settled(make()); },
      [](Settled& s) { search(Kernel::filtered, s.input); }, [](Settled& s) { s.peer.test(s.beads); });
}

// Facets of a triangulation, with the power tests of those that are finite.
template <Motion M>
struct Facets {
  explicit Facets(M made) : motion(std::move(made)) {}
  M motion;
  StartTriangulation triangulation{motion};
  std::vector<std::array<BeadId, 5>> finite = facets(motion).beads();
  StaticPredicates peer = predicates_of(motion);
  std::size_t items = finite.size();
};

// Tests all facets of a triangulation in the order of its cells. Facets that are not proved positive are
// left.
void add_cells(const std::string& measure, bool on_any_processor) {
  struct Cells : Facets<Linear> {
    explicit Cells(bool any)
        : Facets(chain<Linear>(0.01)),
          filter(any ? cell_filter_for_any_processor<3>(motion) : cell_filter_over<3>(motion)) {}
    std::unique_ptr<CellFilter<3>> filter;
    FacetCover cover;
  };
  add_pair(
      on_chain(measure), predicate, "ns", [=] { return Cells(on_any_processor); },
      [](Cells& c) {
        const auto cells = std::as_const(c.triangulation).cells();
        c.cover.start(cells.size());
        FacetFilter<3> facets(*c.filter, LengthUnit(exponent_of_length(Curves<3>(c.motion), cells)));
        const auto leave = [](CellId, unsigned, unsigned) {};
        for (CellId cell = 0; cell < cells.size(); ++cell) {
          const unsigned finite = finite_facets(cells[cell]);
          const unsigned mine = c.cover.facets_of(cells[cell], cell, finite == all_facets<3>);
          if (finite != 0) facets.look_at(cells[cell], cell, mine & finite, leave);
        }
        facets.finish(leave);
        benchmark::DoNotOptimize(facets.count());
      },
      [](Cells& c) { c.peer.test(c.finite); });
}

// One step examines all beads and all facets. The slack is known beforehand. Beads move by `distance` times
// their radius.
void add_tolerance(double distance) {
  struct Slow : Facets<Linear> {
    explicit Slow(double by) : Facets(chain<Linear>(by)) {
      step();  // records the reference positions
    }
    void step() {
      std::size_t others = 0;
      slack.start_step(Curves<3>(motion), triangulation);
      slack.for_the_others(triangulation, [&](CellId, unsigned left) { others += count_of<3>(left); });
      benchmark::DoNotOptimize(others);
    }
    FacetSlack<3> slack;
  };
  add_pair(
      fmt::format("certificates/random-chain {0} r/{1}/tolerance/facet/linear/{0}r", distance, chain_beads),
      predicate, "ns", [=] { return Slow(distance); }, [](Slow& r) { r.step(); },
      [](Slow& r) { r.peer.test(r.finite); });
}

// Facets of a scene that fail in the step.
template <Motion M>
struct Failing {
  explicit Failing(const std::string& name)
      : input(facets(instance<M>(name)).kept(Failure::Kind::later, enough)) {}
  Input<Facet, M> input;
  std::vector<ExactPolynomial> polynomials = input.polynomials();
  AlgebraicKernel peer{polynomials};
  std::size_t items = polynomials.size();
};

struct Comparing : Failing<Linear> {
  explicit Comparing(const std::string& name) : Failing(name) {
    for (const Failure& f : input.failures) times.push_back({f.time, 0, 0, nullptr});
    Random random(3);
    while (pairs.size() < 100000) {
      const std::pair pair{random() % times.size(), random() % times.size()};
      const FailureTime &a = times[pair.first].time, &b = times[pair.second].time;
      if (a.upper < b.lower || b.upper < a.lower) pairs.push_back(pair);
    }
    items = pairs.size();
  }
  std::vector<ScheduledFailure> times;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  FailureOrder order;
};

// Adds a measure of the facets of an instance and, if CGAL's algebraic kernel is there, its peer.
template <class T, class Ours, class Theirs>
void add_algebraic(const std::string& measure, const std::string& scene, std::size_t points, const Ours& ours,
                   const Theirs& theirs) {
  const std::string name = fmt::format("certificates/{}/{}/{}", scene, points, measure);
  const auto make = [scene] { return T(scene); };
  if (AlgebraicKernel::available) return add_pair(name, algebraic, "ns", make, ours, theirs);
  const auto made = lazily(make);
  add(name, [=] { return Work{made().items, "ns", [=] { ours(made()); }}; });
}

template <Motion M>
void add_failures(const std::string& kind, const std::string& scene, std::size_t points) {
  const auto isolate = [](Failing<M>& f) { f.peer.isolate(); };
  add_algebraic<Failing<M>>(
      "failure/facet/" + kind, scene, points, [](Failing<M>& f) { search(Kernel::filtered, f.input); },
      isolate);
  add_algebraic<Failing<M>>(
      "exact/isolation/facet/" + kind, scene, points,
      [](Failing<M>& f) {
        for (const ExactPolynomial& p : f.polynomials)
          benchmark::DoNotOptimize(isolate_roots(p.square_free(), Dyadic(0.0), Dyadic(1.0)).data());
      },
      isolate);
}

}  // namespace

void add_certificates() {
  const auto near = [] { return chain<Linear>(0.01); };
  const auto near_cubic = [] { return chain<Cubic>(0.01); };
  constexpr std::size_t many = 20000;
  constexpr std::size_t window = 16;
  add_settle("settle/facet/linear", [=] { return facets(near()); });
  add_cells("settle/facet/cells/linear", false);
  add_cells("settle/facet/cells/linear/any_processor", true);
  add_settle("settle/sphere2/linear", [=] { return spheres<BeadInSphere<2>>(near(), many, window); });
  add_settle("settle/sphere3/linear", [=] { return spheres<BeadInSphere<3>>(near(), many, window); });
  add_settle("settle/facet/hermite", [=] { return facets(near_cubic()); });
  add_settle("settle/sphere2/hermite", [=] { return spheres<BeadInSphere<2>>(near_cubic(), many, window); });
  add_settle("settle/sphere3/hermite", [=] { return spheres<BeadInSphere<3>>(near_cubic(), many, window); });
  add_failures<Linear>("linear", "d3_n200_linear", 200);
  add_failures<Cubic>("cubic", "d3_n100_degree3", 100);
  add_algebraic<Comparing>(
      "compare/facet/linear", "d3_n200_linear", 200,
      [](Comparing& c) {
        int sum = 0;
        for (const auto& [a, b] : c.pairs) sum += c.order.before(c.times[a], c.times[b]) ? 1 : 0;
        benchmark::DoNotOptimize(sum);
      },
      [](Comparing& c) { c.peer.compare(c.pairs); });
  add_tolerance(0.0001);
  add_tolerance(0.001);
}

}  // namespace kds::bench
