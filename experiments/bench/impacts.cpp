// Compares exact continuous collision with FCL's (if libfcl-dev is installed), query by query.
//
//   public   the queries of data/ccd
//   near     as in a simulation: features of size 1 that move by about 0.1
//   whole    degenerate: whole coordinates from -2 to 2
//
// Rows `false positives` and `false negatives` give the shares of queries that FCL answers wrongly; kds has
// the right answers.

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "experiments/bench/bench.h"
#include "experiments/bench/collision_peers.h"
#include "experiments/impacts/query_file.h"
#include "experiments/program/input_options.h"
#include "structures/impacts/impact_search.h"

namespace kds::bench {

namespace {

struct Queries {
  ImpactKind kind;
  std::vector<ImpactQuery> all;
  ImpactSearch search;

  Queries(ImpactKind own_kind, std::vector<ImpactQuery> queries)
      : kind(own_kind), all(std::move(queries)), search(own_kind) {}
  [[nodiscard]] bool collides(const ImpactQuery& query) {
    return search.first_impact(query.points).has_value();
  }
};

std::vector<ImpactQuery> read_queries(const std::string& kind) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_data_folder() / "ccd"))
    if (entry.path().parent_path().filename() == kind) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<ImpactQuery> queries;
  for (const auto& file : files) {
    QueryFile reader(file);
    for (ImpactQuery query; reader.next(query);) queries.push_back(query);
  }
  return queries;
}

/// Calls set(start, move) for each coordinate.
template <class Set>
std::vector<ImpactQuery> made_queries(std::size_t count, Set set) {
  std::vector<ImpactQuery> queries(count);
  for (ImpactQuery& query : queries)
    for (std::size_t point = 0; point < 4; ++point)
      for (std::size_t axis = 0; axis < 3; ++axis)
        set(query.points[6 * point + axis], query.points[6 * point + 3 + axis]);
  return queries;
}

std::vector<ImpactQuery> near_queries() {
  std::mt19937_64 random(53);
  std::uniform_real_distribution<double> place(0, 1), move(-0.1, 0.1);
  return made_queries(100'000, [&](double& start, double& end) {
    start = place(random);
    end = start + move(random);
  });
}

std::vector<ImpactQuery> whole_queries() {
  std::mt19937_64 random(54);
  std::uniform_int_distribution<int> place(-2, 2);
  return made_queries(10'000, [&](double& start, double& end) {
    start = place(random);
    end = place(random);
  });
}

template <class Make>
void add_queries(const std::string& input, ImpactKind kind, Make make) {
  const auto shared = lazily([=] { return std::make_unique<Queries>(kind, make()); });
  const std::string name =
      "impacts/" + input + (kind == ImpactKind::edge_edge ? " edges/0/" : " faces/0/") + "query";
  add(name, [=] {
    Queries& queries = *shared();
    return Work{queries.all.size(), "ns/query", [&queries] {
                  for (const ImpactQuery& query : queries.all)
                    benchmark::DoNotOptimize(queries.collides(query));
                }};
  });
  if (!fcl_collides(kind, ImpactQuery().points)) return;
  add(name + " beside FCL", [=] {
    Queries& queries = *shared();
    double positives = 0, negatives = 0;  // false ones
    for (const ImpactQuery& query : queries.all) {
      const bool right = queries.collides(query), found = *fcl_collides(kind, query.points);
      positives += found && !right ? 1 : 0;
      negatives += !found && right ? 1 : 0;
    }
    const auto count = static_cast<double>(queries.all.size());
    return Work{
        queries.all.size(),
        "ns/query",
        [&queries] {
          for (const ImpactQuery& query : queries.all)
            benchmark::DoNotOptimize(fcl_collides(queries.kind, query.points));
        },
        {{"false positives of FCL", positives / count}, {"false negatives of FCL", negatives / count}}};
  });
}

}  // namespace

void add_impacts() {
  for (const ImpactKind kind : {ImpactKind::edge_edge, ImpactKind::vertex_face}) {
    add_queries("public", kind,
                [=] { return read_queries(kind == ImpactKind::edge_edge ? "edge-edge" : "vertex-face"); });
    add_queries("near", kind, near_queries);
    add_queries("whole", kind, whole_queries);
  }
}

}  // namespace kds::bench
