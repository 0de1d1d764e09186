#pragma once
// One way to run a structure over a trajectory: the exact run of all frames, or one that gives up something.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/scene/scene.h"
#include "structures/session/session.h"

namespace kds {

/// What a user is after.
enum class Want { contacts, cages, diagram, events };
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 4> want_names{"contacts", "cages", "diagram", "events"};
[[nodiscard]] constexpr std::string_view name_of(Want want) {
  return want_names[static_cast<std::size_t>(want)];
}

struct TradeSetting {
  std::string structure;
  std::size_t stride = 1;
  FrameMotion motion = FrameMotion::linear;
  double tolerance = 0;  ///< of the motion, in smallest radii
  Kernel kernel = Kernel::filtered;
  StructureSettings settings{};

  /// Whether it tells when something changes.
  [[nodiscard]] bool has_events() const;
  /// Over how many frames a bead may go straight on: events are looked for so far from where they truly are.
  [[nodiscard]] double reach() const;
};

/// Its options as `kds run` takes them, the structure first; those that are as in the exact run are left out.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> options_of(const TradeSetting& setting);
/// The same as words: "wrapped --between chord".
[[nodiscard]] std::string words_of(const TradeSetting& setting);

/// Settings that are compared with each other.
struct TradeGroup {
  Want want;
  std::vector<TradeSetting> settings;  ///< the exact run of all frames, every lever alone, some together
};

/// Strides are taken that leave two frames of `frames`; `apart` is of contacts.
[[nodiscard]] std::vector<TradeGroup> groups_for(Want want, std::size_t frames, BeadId apart);

}  // namespace kds
