#pragma once
// The structures that must obey the laws, one row each. A new structure needs one row here.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "structures/session/kinetic_run.h"
#include "tests/laws/exact_balls.h"

namespace kds::test {

/// Input of a judge: a structure of a run, and the exact balls at a time at which nothing fails.
struct Judged {
  const Scene& scene;
  const RunningStructure& structure;
  const RunningStructure* base;  ///< the structure on which it stands, or null
  const ExactBalls& balls;
  const Beads& present;
};

/// The edits that are allowed while time runs: none; changes of course; or changes of course, insertions and
/// erasures.
enum class Edits : std::uint8_t { none, courses, beads };

struct LawStructure {
  std::string name;  ///< of the structure specification
  StructureSettings settings = {};
  Edits edits = Edits::beads;
  /// Whether the beads' positions determine the structure, also if they tie.
  bool is_unique = false;
  /// Explains why the structure is not what its definition says, or returns nothing.
  std::function<std::optional<std::string>(const Judged&)> fault = {};
  std::size_t judge_every = 1;  ///< brute force judges every so many audits
  /// Larger scenes are left out, unless KDS_LAW_BEADS gives another limit.
  std::size_t most_beads = std::numeric_limits<std::size_t>::max();
  /// The judge accepts every structure that ties allow, so it looks at the time of the audit itself.
  bool accepts_ties = false;
  /// False if audits take minutes for numbers of thousands of digits, in scenes that are not judged.
  bool takes_long_numbers = true;

  /// Returns the name of the row, for messages.
  [[nodiscard]] std::string title() const;
};

[[nodiscard]] const std::vector<LawStructure>& law_structures();

/// Returns the structure's state now, within a step: ids in a fixed order.
[[nodiscard]] Beads state_now(const RunningStructure& structure);

}  // namespace kds::test
