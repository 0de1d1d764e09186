#pragma once
// Is a list of nodes a binary tree over the sequence, each node with its smallest enclosing sphere?

#include <string>
#include <vector>

#include "dump.h"
#include "report.h"
#include "scene.h"

namespace oracle {

/// Nodes by halving each necklace, spheres by CGAL.
[[nodiscard]] std::vector<Node> static_hierarchy(const Frame& frame, const std::vector<std::size_t>& ends);

/// Every node is proved; every `every`-th (counted over all frames) is compared with CGAL's sphere as well.
void check_wrapped(const Frame& frame, const std::vector<std::size_t>& ends, const std::vector<Node>& nodes,
                   std::size_t every, const std::string& where, Report& report);

}  // namespace oracle
