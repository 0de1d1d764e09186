#include "python/paper_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "experiments/program/timing.h"
#include "motions/base/input_error.h"
#include "python/balls_given.h"
#include "python/separating_families.h"
#include "python/watch.h"
#include "structures/collision/closest_pair.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/collision/sphere_tree.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds::python {

namespace {

constexpr std::array<std::string_view, 5> rules{"more beads", "larger sphere", "first node", "explicit",
                                                "smallest"};

template <std::size_t Count>
std::size_t index_of(const char* name, const std::string& word,
                     const std::array<std::string_view, Count>& known) {
  const auto* const found = std::find(known.begin(), known.end(), word);
  if (found == known.end())
    throw InputError(fmt::format("{}: '{}' is not one of {}", name, word, fmt::join(known, ", ")));
  return static_cast<std::size_t>(found - known.begin());
}

struct Family {
  std::uint64_t pairs = 0;
  std::optional<std::uint64_t> tests;
};

template <int Dimension>
Family search(const SphereTree<Dimension>& tree, const PairsAsked& asked, std::size_t rule, BeadId leaf) {
  if (rules[rule] == "explicit") return {explicit_family(tree, asked), std::nullopt};
  if (rules[rule] == "more beads" && leaf == 1) {  // the paper's rule, timed as the library's own search
    const PairsFound found = find_pairs(tree, asked);
    return {found.family, found.tests};
  }
  const FamilySize size = rules[rule] == "smallest"
                              ? smallest_family(tree, asked)
                              : ruled_family(tree, asked, static_cast<Split>(rule), leaf);
  return {size.pairs, size.tests};
}

}  // namespace

py::tuple separating_family(const Numbers& centers, const Numbers& radii,
                            const std::vector<std::size_t>& necklaces, const std::string& hierarchy,
                            const std::string& rule, std::size_t leaf, std::size_t apart, bool between,
                            std::size_t rounds) {
  const BallsGiven balls(centers, radii);
  const auto kind = static_cast<Hierarchy>(index_of("hierarchy", hierarchy, hierarchy_names));
  const std::size_t which = index_of("rule", rule, rules);
  if (leaf < 1 || leaf > balls.radii.size())
    throw InputError(fmt::format("leaf: {} is not a number of beads from 1 to {}", leaf, balls.radii.size()));
  PairsAsked asked = balls.pairs(necklaces, apart);
  asked.within = !between;
  Family family;
  std::vector<double> seconds;
  {
    const Watch watch;
    balls.in_dimension([&](auto dimension) {
      SphereTree<dimension> tree(kind, asked.necklaces);
      tree.build(Balls<dimension>(balls.centers, balls.radii));
      const auto work = [&] { family = search(tree, asked, which, static_cast<BeadId>(leaf)); };
      work();
      seconds = seconds_in_turn(rounds, {[&] { return processor_seconds_per_call(work); }}).front();
    });
  }
  return py::make_tuple(family.pairs, family.tests ? py::object(py::int_(*family.tests)) : py::none(),
                        array_of(std::move(seconds)));
}

py::tuple closest_by_diagram(const Numbers& centers, const Numbers& radii,
                             const std::vector<std::size_t>& necklaces, std::size_t rounds) {
  const BallsGiven balls(centers, radii);
  const BeadPairs neighbors = BeadPairs::along(balls.radii.size(), balls.ranges(necklaces));
  ClosestPairReport report;
  std::vector<double> seconds;
  {
    const Watch watch;
    balls.in_dimension([&](auto dimension) {
      const auto work = [&] { report = closest_pair<dimension>(balls.centers, balls.radii, neighbors); };
      work();
      seconds = seconds_in_turn(rounds, {[&] { return processor_seconds_per_call(work); }}).front();
    });
  }
  py::object pair = py::none();
  if (report.pair && !std::isfinite(report.pair->distance))
    throw InputError("centers: are too large, so that their distances overflow doubles");
  if (report.pair) pair = py::make_tuple(report.pair->first, report.pair->second, report.pair->distance);
  const PairsLookedAt& looked = report.looked_at;
  py::dict counts;
  counts["edges"] = looked.edges;
  counts["common_neighbors"] = looked.common_neighbors;
  counts["unconnected"] = looked.unconnected;
  counts["centers"] = looked.centers;
  counts["near"] = looked.near;
  return py::make_tuple(pair, counts, array_of(std::move(seconds)));
}

py::tuple trusted_hierarchy(const Numbers& before, const Numbers& after, const Numbers& radii,
                            std::size_t rounds) {
  const BallsGiven first(before, radii, "before"), second(after, radii, "after");
  if (first.radii.size() != second.radii.size() || first.dimension != second.dimension)
    throw InputError("after: has another shape than before; expected the same beads");
  std::vector<std::int64_t> bases;
  std::vector<double> spheres, seconds;
  {
    const Watch watch;
    first.in_dimension([&](auto dimension) {
      const Balls<dimension> from(first.centers, first.radii), to(second.centers, second.radii);
      StaticWrappedHierarchy<dimension> hierarchy(first.ranges({}));
      for (std::size_t round = 0; round < rounds; ++round) {
        hierarchy.build(from);
        seconds.push_back(processor_seconds_per_call([&] { hierarchy.update(to, Update::trust); }));
        hierarchy.build(from);
        seconds.push_back(processor_seconds_per_call([&] {
                            hierarchy.update(to);
                            hierarchy.update(from);
                          }) /
                          2);
      }
      hierarchy.build(from);
      hierarchy.update(to, Update::trust);
      spheres = spheres_of(hierarchy);
      for (const Basis& basis : hierarchy.bases())
        for (std::size_t k = 0; k < Basis::max_size; ++k)
          bases.push_back(k < basis.size ? std::int64_t{basis.beads[k]} : -1);
    });
  }
  const auto nodes = static_cast<py::ssize_t>(spheres.size() / 4);
  return py::make_tuple(array_of(std::move(bases), {nodes, 4}), array_of_spheres(std::move(spheres)),
                        array_of(std::move(seconds), {static_cast<py::ssize_t>(rounds), 2}));
}

}  // namespace kds::python
