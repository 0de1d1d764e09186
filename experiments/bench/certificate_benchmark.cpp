// Compares certificates, from beads to answers, with the nearest operation of CGAL: a static predicate at one
// moment, or algebraic numbers for the same polynomials (needs libmpfi-dev). kds and the peer are timed in
// turn. The counters are medians: `ns` per item, `peer_ns` per item, `ratio` of both, and `allocations`, our
// allocations per item.
//
//   kds_benchmarks --benchmark_filter=settle    beads to "never fails in this step"; peer: predicate
//   kds_benchmarks --benchmark_filter=failure   beads to a bracket with one proved root; peer: isolation
//   kds_benchmarks --benchmark_filter=exact     in integer arithmetic only; peer: isolation
//   kds_benchmarks --benchmark_filter=compare   two failure times with disjoint brackets; peer: two algebraic
//   numbers
//   kds_benchmarks --benchmark_filter=sign      at or just after another's failure; peer: predicate

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "certificates/search/certificate_search.h"
#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/orientation.h"
#include "experiments/bench/certificate_peers.h"
#include "experiments/bench/random_chain.h"
#include "experiments/bench/subject.h"
#include "kds/failure_order.h"
#include "motions/curves/positions.h"
#include "motions/readers/instance.h"
#include "motions/scene/scene.h"
#include "structures/power_diagram/facet_filter.h"
#include "structures/triangulation/facet_certificate.h"

namespace kds::bench {

namespace {

using Linear = BezierMotion<3, 1>;
using Cubic = BezierMotion<3, 3>;
using Facet = PowerTest<3>;

constexpr std::size_t enough = 1000;  // number of items that take microseconds each

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
  void keep(Failure::Kind kind, std::size_t most = std::numeric_limits<std::size_t>::max()) {
    settle();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < certificates.size() && kept < most; ++i) {
      if (failures[i].kind == kind) certificates[kept++] = certificates[i];
    }
    certificates.resize(kept);
    settle();
    births.assign(kept, KnownAtStart::unknown);
  }
  [[nodiscard]] ExactFunction exact_function(std::uint32_t slot) const override {
    return search->exact_function(certificates[slot]);
  }
  [[nodiscard]] std::vector<ExactFunction> functions() const {
    std::vector<ExactFunction> all;
    for (const C& c : certificates) all.push_back(search->exact_function(c));
    return all;
  }
  [[nodiscard]] std::vector<ExactPolynomial> polynomials() const {
    std::vector<ExactPolynomial> all;
    for (const ExactFunction& f : functions()) all.push_back(*f);
    return all;
  }
  [[nodiscard]] auto beads() const {
    std::vector<decltype(C{}.beads)> all;
    for (const C& c : certificates) all.push_back(c.beads);
    return all;
  }
  [[nodiscard]] StaticPredicates predicates() const {
    return {control_points(*motion, 0), control_weights(*motion, 0)};
  }

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
  const auto beads = random_chain(10240);
  return jostled<M>(beads, distance, random);
}

template <Motion M>
M instance(const std::filesystem::path& file) {
  const Scene scene(read_instance(file));
  M motion(scene.bead_count());
  scene.load(0, motion);
  return motion;
}

// Returns all inner facets of the regular triangulation at the start.
template <Motion M>
Input<Facet, M> facets(const M& motion) {
  Input<Facet, M> input(motion);
  RegularTriangulation<3> triangulation;
  static_cast<void>(triangulation.build(control_points(motion, 0), control_weights(motion, 0)));
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

template <class I>
void settle(Turns& turns, I input) {
  input.keep(Failure::Kind::never);
  const auto beads = input.beads();
  const StaticPredicates peer = input.predicates();
  input.stages = {};
  turns.take(
      beads.size(), [&] { search(Kernel::filtered, input); }, [&] { return peer.seconds_for(beads); });
  turns.note("by_coefficients", static_cast<double>(input.stages.coefficients) /
                                    static_cast<double>(input.stages.coefficients + input.stages.isolation +
                                                        input.stages.refined + input.stages.exact +
                                                        input.stages.identically_zero));
}

// Tests all facets of a triangulation in the order of its cells. Facets that are not proved positive are
// left.
template <Motion M>
void classify_in_cells(Turns& turns, const M& motion, bool on_any_processor) {
  RegularTriangulation<3> triangulation;
  static_cast<void>(triangulation.build(control_points(motion, 0), control_weights(motion, 0)));
  const auto cells = triangulation.cells();
  const Input<Facet, M> input = facets(motion);
  const auto beads = input.beads();
  const StaticPredicates peer = input.predicates();
  std::uint64_t positive = 0;
  const auto filter =
      on_any_processor ? cell_filter_for_any_processor<3>(motion) : cell_filter_over<3>(motion);
  FacetCover cover;
  turns.take(
      beads.size(),
      [&] {
        cover.start(cells.size());
        FacetFilter<3> facets(*filter, LengthUnit(exponent_of_length(Curves<3>(motion), cells)));
        const auto leave = [](CellId, unsigned, unsigned) {};
        for (CellId cell = 0; cell < cells.size(); ++cell) {
          const unsigned finite = finite_facets(cells[cell]);
          const unsigned mine = cover.facets_of(cells[cell], cell, finite == all_facets<3>);
          if (finite != 0) facets.look_at(cells[cell], cell, mine & finite, leave);
        }
        facets.finish(leave);
        positive = facets.count();
      },
      [&] { return peer.seconds_for(beads); });
  turns.note("settled", static_cast<double>(positive) / static_cast<double>(beads.size()));
}

template <class I>
void failure(Turns& turns, Kernel kernel, I input) {
  input.keep(Failure::Kind::later, enough);
  const AlgebraicKernel peer(input.polynomials());
  turns.take(
      input.certificates.size(), [&] { search(kernel, input); }, [&] { return peer.seconds_to_isolate(); });
}

// Measures the construction of polynomials from beads.
template <class I>
void exact_function(Turns& turns, I input) {
  input.keep(Failure::Kind::later, enough);
  turns.take(
      input.certificates.size(), [&] { keep(input.functions().data()); }, [] { return no_peer; });
}

// Measures the search for the first failure of given polynomials.
template <class I>
void exact_failure(Turns& turns, I input) {
  input.keep(Failure::Kind::later, enough);
  const std::vector<ExactPolynomial> polynomials = input.polynomials();
  const AlgebraicKernel peer(polynomials);
  const ExactTime start(Dyadic(0.0));
  turns.take(
      polynomials.size(),
      [&] {
        for (const ExactPolynomial& p : polynomials) {
          const auto found = first_failure_after(p, start);
          keep(found->touch);
        }
      },
      [&] { return peer.seconds_to_isolate(); });
}

// Measures the isolation of all roots in [0,1] of given polynomials.
template <class I>
void exact_isolation(Turns& turns, I input) {
  input.keep(Failure::Kind::later, enough);
  const std::vector<ExactPolynomial> polynomials = input.polynomials();
  const AlgebraicKernel peer(polynomials);
  turns.take(
      polynomials.size(),
      [&] {
        for (const ExactPolynomial& p : polynomials) {
          const auto roots = isolate_roots(p.square_free(), Dyadic(0.0), Dyadic(1.0));
          keep(roots.data());
        }
      },
      [&] { return peer.seconds_to_isolate(); });
}

template <class I>
void compare(Turns& turns, I input) {
  input.keep(Failure::Kind::later, enough);
  AlgebraicKernel peer(input.polynomials());
  std::vector<ScheduledFailure> times;
  for (const Failure& f : input.failures) times.push_back({f.time, 0, 0, nullptr});
  Random random(3);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  while (pairs.size() < 100000) {
    const std::pair pair{random() % times.size(), random() % times.size()};
    const FailureTime &a = times[pair.first].time, &b = times[pair.second].time;
    if (a.upper < b.lower || b.upper < a.lower) pairs.push_back(pair);
  }
  FailureOrder order;
  static_cast<void>(peer.seconds_to_compare(pairs));  // the peer narrows its intervals as it compares
  turns.take(
      pairs.size(),
      [&] {
        int sum = 0;
        for (const auto& [a, b] : pairs) sum += order.before(times[a], times[b]) ? 1 : 0;
        keep(sum);
      },
      [&] { return peer.seconds_to_compare(pairs); });
}

template <class I>
std::vector<Instant> instants_of(const I& input) {
  std::vector<Instant> instants;
  for (std::uint32_t i = 0; i < input.certificates.size(); ++i)
    instants.emplace_back(input.failures[i].time, input, i);
  return instants;
}

// Measures the signs of certificates at the failure times of other certificates.
template <class I>
void sign(Turns& turns, I input) {
  input.keep(Failure::Kind::later, enough);
  const std::vector<Instant> instants = instants_of(input);
  auto others = input.certificates;
  Random random(4);
  std::shuffle(others.begin(), others.end(), random);
  // A certificate is known to be zero at its own failure time, so another one is taken.
  for (std::size_t i = 0; i < others.size(); ++i) {
    while (others[i].beads == input.certificates[i].beads) others[i] = others[random() % others.size()];
  }
  std::vector<decltype(Facet{}.beads)> beads;
  for (const Facet& c : others) beads.push_back(c.beads);
  const StaticPredicates peer = input.predicates();
  turns.take(
      others.size(),
      [&] {
        int sum = 0;
        for (std::size_t i = 0; i < instants.size(); ++i)
          sum += input.search->sign_just_after(Kernel::filtered, others[i], instants[i], input.stages);
        keep(sum);
      },
      [&] { return peer.seconds_for(beads); });
}

// Measures whether four cells are positive at the failure times of other certificates. All four cells are
// positive.
template <class I>
void positive_cells(Turns& turns, I input) {
  input.keep(Failure::Kind::later, enough);
  const std::vector<Instant> instants = instants_of(input);
  const auto orientations = search_over<Orientation<3>>(input.seen());
  std::vector<Orientation<3>> cells;
  StageCounts stages;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    for (std::size_t at = i, found = 0; found < 4; ++at) {
      const auto& b = input.certificates[at % instants.size()].beads;
      Orientation<3> cell({b[0], b[1], b[2], b[3]}, 1);
      const int s = orientations->sign_now(Kernel::filtered, cell, instants[i], stages);
      cell.sign *= s;
      if (s != 0 && ++found != 0) cells.push_back(cell);
    }
  }
  const std::span<const Orientation<3>> all(cells);
  turns.take(
      cells.size(),
      [&] {
        int sum = 0;
        for (std::size_t i = 0; i < instants.size(); ++i)
          sum += int{orientations->all_positive_now(Kernel::filtered, all.subspan(4 * i, 4), instants[i],
                                                    input.stages)};
        keep(sum);
      },
      [] { return no_peer; });
}

}  // namespace

std::vector<Subject> certificate_subjects(const std::filesystem::path& instances) {
  const auto near = [] { return chain<Linear>(0.01); };
  const auto near_cubic = [] { return chain<Cubic>(0.01); };
  const auto linear = [motion = instance<Linear>(instances / "d3_n200_linear.txt")] { return motion; };
  const auto cubic = [motion = instance<Cubic>(instances / "d3_n100_degree3.txt")] { return motion; };
  constexpr std::size_t many = 20000;
  constexpr std::size_t window = 16;
  const std::string predicate = "CGAL predicate at one moment", algebraic = "CGAL Algebraic_kernel_d_1";
  constexpr std::optional<double> none;

  std::vector<Subject> all;
  const auto on_chain = [&](const char* name, std::optional<double> most_ns, auto run) {
    all.push_back({name, "random-chain 0.01 r", 10240, predicate, most_ns, none, run});
  };
  const auto on_linear = [&](const char* name, const std::string& peer, std::optional<double> most_ns,
                             std::optional<double> most_ratio, auto run) {
    all.push_back({name, "d3_n200_linear", 200, peer, most_ns, most_ratio, run});
  };
  const auto on_cubic = [&](const char* name, const std::string& peer, std::optional<double> most_ratio,
                            auto run) {
    all.push_back({name, "d3_n100_degree3", 100, peer, none, most_ratio, run});
  };

  on_chain("settle/facet/linear", none, [=](Turns& t) { settle(t, facets(near())); });
  on_chain("settle/facet/cells/linear", 25, [=](Turns& t) { classify_in_cells(t, near(), false); });
  on_chain("settle/facet/cells/linear/any_processor", 60,
           [=](Turns& t) { classify_in_cells(t, near(), true); });
  on_chain("settle/sphere2/linear", none,
           [=](Turns& t) { settle(t, spheres<BeadInSphere<2>>(near(), many, window)); });
  on_chain("settle/sphere3/linear", none,
           [=](Turns& t) { settle(t, spheres<BeadInSphere<3>>(near(), many, window)); });
  on_chain("settle/sphere4/linear", none, [=](Turns& t) { settle(t, spheres<Facet>(near(), many, window)); });
  on_chain("settle/facet/hermite", none, [=](Turns& t) { settle(t, facets(near_cubic())); });
  on_chain("settle/sphere2/hermite", none,
           [=](Turns& t) { settle(t, spheres<BeadInSphere<2>>(near_cubic(), many, window)); });
  on_chain("settle/sphere3/hermite", none,
           [=](Turns& t) { settle(t, spheres<BeadInSphere<3>>(near_cubic(), many, window)); });
  on_chain("settle/sphere4/hermite", none,
           [=](Turns& t) { settle(t, spheres<Facet>(near_cubic(), many, window)); });

  on_linear("failure/facet/linear", algebraic, 200, none,
            [=](Turns& t) { failure(t, Kernel::filtered, facets(linear())); });
  on_linear("failure/sphere2/linear", algebraic, none, none,
            [=](Turns& t) { failure(t, Kernel::filtered, spheres<BeadInSphere<2>>(linear(), many, 100)); });
  on_linear("failure/sphere3/linear", algebraic, none, none,
            [=](Turns& t) { failure(t, Kernel::filtered, spheres<BeadInSphere<3>>(linear(), many, 100)); });
  on_linear("failure/sphere4/linear", algebraic, none, none,
            [=](Turns& t) { failure(t, Kernel::filtered, spheres<Facet>(linear(), many, 100)); });
  on_cubic("failure/facet/cubic", algebraic, none,
           [=](Turns& t) { failure(t, Kernel::filtered, facets(cubic())); });
  on_cubic("failure/sphere2/cubic", algebraic, none,
           [=](Turns& t) { failure(t, Kernel::filtered, spheres<BeadInSphere<2>>(cubic(), many, 50)); });
  on_cubic("failure/sphere3/cubic", algebraic, none,
           [=](Turns& t) { failure(t, Kernel::filtered, spheres<BeadInSphere<3>>(cubic(), many, 50)); });
  on_cubic("failure/sphere4/cubic", algebraic, none,
           [=](Turns& t) { failure(t, Kernel::filtered, spheres<Facet>(cubic(), many, 50)); });

  on_linear("exact/bracket/facet/linear", algebraic, none, none,
            [=](Turns& t) { failure(t, Kernel::exact, facets(linear())); });
  on_cubic("exact/bracket/facet/cubic", algebraic, none,
           [=](Turns& t) { failure(t, Kernel::exact, facets(cubic())); });
  on_linear("exact/function/facet/linear", "", none, none,
            [=](Turns& t) { exact_function(t, facets(linear())); });
  on_cubic("exact/function/facet/cubic", "", none, [=](Turns& t) { exact_function(t, facets(cubic())); });
  on_linear("exact/failure/facet/linear", algebraic, none, none,
            [=](Turns& t) { exact_failure(t, facets(linear())); });
  on_cubic("exact/failure/facet/cubic", algebraic, none,
           [=](Turns& t) { exact_failure(t, facets(cubic())); });
  on_linear("exact/isolation/facet/linear", algebraic, none, 0.25,
            [=](Turns& t) { exact_isolation(t, facets(linear())); });
  on_cubic("exact/isolation/facet/cubic", algebraic, 0.25,
           [=](Turns& t) { exact_isolation(t, facets(cubic())); });

  on_linear("compare/facet/linear", algebraic, 5, none, [=](Turns& t) { compare(t, facets(linear())); });
  on_linear("sign/just_after/facet/linear", predicate, none, none,
            [=](Turns& t) { sign(t, facets(linear())); });
  on_linear("sign/all_positive_now/cell/linear", "", none, none,
            [=](Turns& t) { positive_cells(t, facets(linear())); });
  on_cubic("sign/just_after/facet/cubic", predicate, none, [=](Turns& t) { sign(t, facets(cubic())); });
  on_cubic("sign/all_positive_now/cell/cubic", "", none,
           [=](Turns& t) { positive_cells(t, facets(cubic())); });
  return all;
}

}  // namespace kds::bench
