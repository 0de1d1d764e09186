#pragma once
// Runs power diagrams over random lattice scenes with audits between all events, including edits at events.

#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>

namespace kds::test {

struct LatticeCounts {
  std::uint64_t scenes = 0;
  std::uint64_t events = 0;
  std::uint64_t rebuilt = 0;  ///< scenes with a rebuild or a repair
  std::uint64_t refused = 0;  ///< scenes in which all beads stay in one plane (on one line)
  std::uint64_t edited = 0;   ///< scenes in which beads were inserted, erased or changed course
};

/// Runs one scene of each dimension, degree (1 to 3) and kind, each from `seed`. Returns the first failure
/// as a sentence that names dimension, degree, kind and seed.
std::optional<std::string> run_lattice_scenes(std::uint32_t seed, LatticeCounts& counts);

}  // namespace kds::test
