#pragma once
// Continuous collision of points with triangles and of edges, for arrays of queries.

#include <pybind11/pybind11.h>

#include <string_view>

#include "python/static_structures.h"
#include "structures/impacts/impact_search.h"

namespace kds::python {

/// Returns the times at which the features of queries begin to meet: the query of each time, the two ends of
/// a bracket around the time, and whether the features pass through each other, four arrays of one length.
/// `points` has the shape (queries, 4, control points, 3). Without `all`, returns only the first time of each
/// query.
[[nodiscard]] pybind11::tuple impacts(std::string_view kind, const Numbers& points, bool all);

}  // namespace kds::python
