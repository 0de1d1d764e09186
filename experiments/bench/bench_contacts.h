#pragma once
// The rows of `kds bench collision` about contacts. They compare the computation of all begin and end times
// with a cell list that examines only frames.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "experiments/bench/bench_chains.h"
#include "experiments/bench/bench_report.h"

namespace kds {

/// Measures consecutive frames; both methods start from the positions that were read. Radii are
/// `radius_factor` times the chain's. Pairs are at least 5 beads apart along the chain.
void bench_contacts(const BenchChain& chain, double radius_factor, std::optional<double> goal,
                    std::size_t rounds, std::vector<BenchRow>& rows);

/// Compares the time per bead with the time per bead for ten times as many beads. The time covers the build
/// at a frame and the steps to the next two frames.
void bench_contacts_growth(std::string_view model, std::size_t beads, std::optional<double> goal,
                           std::size_t rounds, std::vector<BenchRow>& rows);

}  // namespace kds
