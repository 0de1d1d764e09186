#pragma once
// Counts of the checks, and the mismatches found.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace oracle {

struct Report {
  std::size_t frames = 0, cells = 0, nodes = 0, cross_checked = 0, degenerate = 0;
  std::size_t mismatch_count = 0;
  std::vector<std::string> mismatches;  ///< the first 20 mismatches, one line each

  void mismatch(std::string line) {
    if (mismatch_count++ < 20) mismatches.push_back(std::move(line));
  }
};

}  // namespace oracle
