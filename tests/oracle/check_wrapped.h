#pragma once
// Checks whether a list of nodes is a binary tree over the sequence, in which each node has its smallest
// enclosing sphere.

#include <string>
#include <vector>

#include "dump.h"
#include "report.h"
#include "scene.h"

namespace oracle {

/// Makes nodes by halving each necklace, with spheres by CGAL.
[[nodiscard]] std::vector<Node> static_hierarchy(const Frame& frame, const std::vector<std::size_t>& ends);

/// Proves every node. Also compares every `every`-th node (counted over all frames) with CGAL's sphere.
void check_wrapped(const Frame& frame, const std::vector<std::size_t>& ends, const std::vector<Node>& nodes,
                   std::size_t every, const std::string& where, Report& report);

}  // namespace oracle
