#pragma once
// One way to run a structure over a trajectory: the exact run of all frames, or one that gives up something.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/scene/scene.h"
#include "structures/session/session.h"

namespace kds {

/// What a user is after.
enum class Want { contacts, cages, diagram, events, scenes };
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 5> want_names{"contacts", "cages", "diagram", "events",
                                                            "scenes"};
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
  bool certify = false;  ///< what was left out is read, and spheres and balls are made larger by it
  bool calpha = false;   ///< of the beads CA alone
  std::optional<double> calpha_radius{};  ///< none: by the policy of the finest data
  // Of scenes:
  std::vector<std::string> besides{};  ///< structures in the same run
  bool has_own_apart = false;          ///< settings.apart is not what was asked for
  bool element_radii = false;
  bool projected = false;  ///< on the plane z = 0

  /// Whether it tells when something changes.
  [[nodiscard]] bool has_events() const;
  /// Over how many frames a bead may go straight on: events are looked for so far from where they truly are.
  [[nodiscard]] double reach() const;
};

/// Its options as `kds run` takes them, the structure first; those that are as in the exact run are left out.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> options_of(const TradeSetting& setting);
/// The same as words: "wrapped --between chord", and what no option says.
[[nodiscard]] std::string words_of(const TradeSetting& setting);

/// Settings that are compared with each other.
struct TradeGroup {
  Want want;
  std::vector<TradeSetting> settings;  ///< the exact run of all frames, every lever alone, some together
};

/// What decides which settings there are.
struct TradeInput {
  std::size_t frames = 0;  ///< strides are taken that leave two
  BeadId beads = 0;
  std::size_t necklaces = 1;
  int dimension = 3;
  BeadId residues = 0;             ///< whose beads are known, CA and others; 0: they are not
  BeadId largest_residue = 0;      ///< beads of the one that has most
  double residue_radius = 0;       ///< CalphaModel::covering_radius
  bool has_element_radii = false;  ///< that are known
  bool exact_kernel = false;       ///< is a lever too
};

/// `apart` is of contacts.
[[nodiscard]] std::vector<TradeGroup> groups_for(Want want, const TradeInput& input, BeadId apart);

}  // namespace kds
