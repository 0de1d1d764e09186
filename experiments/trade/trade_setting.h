#pragma once
// One way to run a structure over a trajectory: the exact run of all frames, or a run that gives up some
// accuracy.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/frames/frame_selection.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"

namespace kds {

/// The result that a user wants.
enum class Want { contacts, cages, diagram, events, scenes };
/// The names of the enumerators in order.
inline constexpr std::array<std::string_view, 5> want_names{"contacts", "cages", "diagram", "events",
                                                            "scenes"};
[[nodiscard]] constexpr std::string_view name_of(Want want) {
  return want_names[static_cast<std::size_t>(want)];
}

struct TradeSetting {
  std::string structure;
  std::size_t stride = 1;
  FrameMotion motion = FrameMotion::linear;
  double tolerance = 0;  ///< the motion's tolerance, in units of the smallest radius
  Kernel kernel = Kernel::filtered;
  StructureSettings settings{};
  bool certify = false;  ///< read the frames left out, and enlarge spheres and balls by the deviation
  bool calpha = false;   ///< use only the CA beads
  std::optional<double> calpha_radius{};  ///< empty for the policy of the finest data
  // Only for scenes:
  std::vector<std::string> besides{};  ///< further structures in the same run
  bool has_own_apart = false;          ///< settings.apart differs from the requested value
  bool element_radii = false;
  bool projected = false;  ///< project onto the plane z = 0
  FrameRange frames{};     ///< --frames of `kds trade`; `stride` leaves out more frames

  /// Returns whether the structure reports events.
  [[nodiscard]] bool has_events() const;
  /// Returns the largest number of frames over which a bead may move in a straight line. Events are matched
  /// within this distance of their true time.
  [[nodiscard]] double reach() const;
};

/// Returns the options by which the setting differs from the exact run, the structure first. All are options
/// of `kds run`, except that `stride` is the third part of --frames.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> options_of(const TradeSetting& setting);
/// Returns the structures and the options, as in "wrapped --between chord" for `kds run --structures wrapped
/// --between chord`, followed by properties that no option expresses.
[[nodiscard]] std::string words_of(const TradeSetting& setting);

/// Settings that are compared with each other.
struct TradeGroup {
  Want want;
  /// The exact run of all frames, each lever alone, and some combinations.
  std::vector<TradeSetting> settings;
};

/// The properties of the input that determine the settings.
struct TradeInput {
  std::size_t frames = 0;  ///< only strides that leave two frames are used
  BeadId beads = 0;
  std::size_t necklaces = 1;
  int dimension = 3;
  BeadId residues = 0;             ///< number of residues if CAs and other beads are known, else 0
  BeadId largest_residue = 0;      ///< number of beads in the largest residue
  double residue_radius = 0;       ///< CalphaModel::covering_radius
  bool has_element_radii = false;  ///< whether the radii of the elements are known
  bool exact_kernel = false;       ///< whether the exact kernel is one of the levers
  FrameRange range{};              ///< --frames
  BeadGroups groups{};             ///< of contacts, as in PairsAsked; empty: pairs of any beads
};

/// Returns the groups of settings. `apart` and the input's groups of beads apply to contacts.
[[nodiscard]] std::vector<TradeGroup> groups_for(Want want, const TradeInput& input, BeadId apart);

}  // namespace kds
