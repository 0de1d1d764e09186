#include "python/impacts.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "motions/base/interruption.h"
#include "python/arrays.h"
#include "python/watch.h"
#include "structures/impacts/impact_search.h"

namespace kds::python {

namespace py = pybind11;

py::tuple impacts(std::string_view kind, const Numbers& points, bool all) {
  const auto controls = static_cast<std::size_t>(points.shape(2));
  const std::size_t size = 4 * controls * 3;
  const double* const first = points.data();
  const auto queries = static_cast<std::size_t>(points.shape(0));
  std::vector<std::int64_t> of_query;
  std::vector<double> lower, upper;
  std::vector<std::uint8_t> passes;
  {
    const Watch watch;
    ImpactSearch search(kind == "vertex-face" ? ImpactKind::vertex_face : ImpactKind::edge_edge,
                        static_cast<int>(controls) - 1);
    const auto add = [&](std::size_t query, const Impact& impact) {
      of_query.push_back(static_cast<std::int64_t>(query));
      lower.push_back(impact.lower);
      upper.push_back(impact.upper);
      passes.push_back(impact.passes ? 1 : 0);
    };
    for (std::size_t query = 0; query < queries; ++query) {
      InterruptionCheck::ask();
      const std::span<const double> own(first + query * size, size);
      if (!all) {
        if (const auto impact = search.first_impact(own)) add(query, *impact);
        continue;
      }
      for (const Impact& impact : search.all_impacts(own)) add(query, impact);
    }
  }
  return py::make_tuple(array_of(std::move(of_query)), array_of(std::move(lower)), array_of(std::move(upper)),
                        array_of(std::move(passes)));
}

}  // namespace kds::python
