#pragma once
// The rows of `kds bench collision` about contacts: all their begin and end times, beside a cell list that
// looks at frames only.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "experiments/bench/bench_chains.h"
#include "experiments/bench/bench_report.h"

namespace kds {

/// From frame to frame, both from the positions that were read; radii so many times the chain's, beads at
/// least 5 apart along it.
void bench_contacts(const BenchChain& chain, double radius_factor, std::optional<double> goal,
                    std::size_t rounds, std::vector<BenchRow>& rows);

/// Time a bead of ten times the beads, of what is built at a frame and the steps to the next two.
void bench_contacts_growth(std::string_view model, std::size_t beads, std::optional<double> goal,
                           std::size_t rounds, std::vector<BenchRow>& rows);

}  // namespace kds
