#pragma once
// The targets of the fuzzer of kernels. Each of them judges a run of a small scene.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/small_scene.h"

namespace kds::test {

/// Limb operations after which a run is given up, within about a second even under the sanitizers.
inline constexpr std::uint64_t most_work = 1'000'000;

struct FuzzTarget {
  std::string_view name;
  Values values;
  std::string_view structure;  ///< if any, scenes have it, and frames that are joined by lines
  /// Explains what is wrong with a run of the scene, or returns nothing. May throw.
  std::optional<std::string> (*judge)(const SmallScene&);

  [[nodiscard]] SmallScene scene_of(std::string_view bytes) const {
    return scene_of_bytes(bytes, values, structure);
  }
  /// Returns the fault that the judge finds, or the message of an exception. A scene that is refused, or
  /// takes too much exact work, has no fault.
  [[nodiscard]] std::optional<std::string> fault_of(const SmallScene& scene) const;
};

/// Targets:
///
/// - `kernels`: the filtered and the exact kernel have the same events, brackets, dumps and fingerprint.
/// - `audits`: every audit between events passes, brute force finds the same, and audits change no event.
/// - `contacts`: contacts have the events of each pair by itself, over rationals (judges/contact_events.h).
/// - `crossings`: crossings have the events of all pairs of bonds (judges/crossings.h).
[[nodiscard]] const std::vector<FuzzTarget>& fuzz_targets();
/// Returns null if there is no target of this name.
[[nodiscard]] const FuzzTarget* find_target(std::string_view name);

}  // namespace kds::test
