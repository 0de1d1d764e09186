#pragma once
// What a run knows of a kinetic structure: one specification a structure, by which runs, dumps, reports and
// replays know it.

#include <array>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/base/relaxation.h"
#include "kds/simulator.h"
#include "motions/scene/scene.h"
#include "structures/necklace/node_selection.h"
#include "structures/necklace/node_sphere.h"
#include "structures/session/scene_motion.h"

namespace kds {

/// One file of a dump: its name's ending and its text.
struct DumpFile {
  std::string ending;  ///< as in frame-7.wrapped.csv: "wrapped.csv"
  std::string text;
};

/// What a structure is at a frame, as a set by which two frames can be compared.
using CombinatorialElement = std::array<BeadId, 6>;  ///< no_bead where it has fewer
struct CombinatorialElements {
  /// So many ids say where the element is, and the others what is there: a hierarchy's node and its basis.
  /// Places are all different.
  std::size_t place_ids = 0;
  std::vector<CombinatorialElement> all;  ///< in any order

  /// One more, of at most six ids together.
  void add(std::initializer_list<BeadId> place, std::span<const BeadId> what = {});
};
/// Of beads in an order: where the k-th place is, and who is there.
[[nodiscard]] CombinatorialElements elements_in_order(std::span<const BeadId> beads);

/// A structure in a run, and what differs between structures outside the simulator.
class RunningStructure {
 public:
  virtual ~RunningStructure() = default;

  [[nodiscard]] virtual KineticStructure& kinetic() = 0;
  /// The structure at a frame that has just been reached (or, frame 0, built).
  [[nodiscard]] virtual std::vector<DumpFile> dump(std::size_t frame) const = 0;
  /// What it is at the frame that has just been reached (or, frame 0, built); none: such structures are not
  /// compared from frame to frame.
  [[nodiscard]] virtual std::optional<CombinatorialElements> elements(std::size_t frame) const {
    static_cast<void>(frame);
    return std::nullopt;
  }
  /// What it was built as, for logs of its events to begin with: the changes that would make it of nothing.
  [[nodiscard]] virtual std::vector<Change> built() const { return {}; }
  /// The spheres of its nodes at time u of the step that is being run or has just been run, as the structure
  /// has them then, in the scene's coordinates; none where it has no nodes. Rounded up: each holds the true
  /// one.
  [[nodiscard]] virtual std::vector<NodeSphere> spheres_at(const Dyadic& u) const {
    static_cast<void>(u);
    return {};
  }
  /// Wall seconds to build the same structure statically at a frame, as a user would without this library.
  [[nodiscard]] virtual double static_seconds(std::size_t frame) const = 0;
};

/// What a wrapped hierarchy is between frames.
enum class Between {
  events,  ///< the smallest spheres at all times: bases change at events
  chord    ///< chords of the smallest spheres at both frames (chord_cages.h)
};
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 2> between_names{"events", "chord"};
[[nodiscard]] constexpr std::string_view name_of(Between between) {
  return between_names[static_cast<std::size_t>(between)];
}

struct StructureSettings {
  NodeSelection nodes = {};           ///< of hierarchies
  Between between = Between::events;  ///< wrapped
  /// Of chords: radii are within 1 + this of the smallest at all times; none: whatever they are.
  std::optional<double> tightness{};
  BeadId apart = 2;    ///< contacts: of beads of one necklace, those at least so far apart along it
  Relaxation relax{};  ///< wrapped: by what share of a sphere's radius beads may stick out of it
};

struct StructureSpec {
  std::string name;
  /// In what order structures act at one time, and stand in reports: ascending, then by name. Those of the
  /// framework have 10 to 40.
  int order = 100;
  /// Whether a run of this scene has it when nobody says which structures to run.
  std::function<bool(const Scene&)> by_default = [](const Scene&) { return false; };
  /// Why the scene and this structure do not go together, as the end of a sentence; nothing where they do.
  std::function<std::optional<std::string>(const Scene&)> refusal = [](const Scene&) {
    return std::optional<std::string>();
  };
  /// Whether it has events at all, and can be logged, replayed and audited between them.
  std::function<bool(const StructureSettings&)> has_events = [](const StructureSettings&) { return true; };
  /// Scene and motion outlive what is made.
  std::function<std::unique_ptr<RunningStructure>(Simulator&, const Scene&, const SceneMotion::Ref&,
                                                  const StructureSettings&)>
      make;
};

class StructureRegistry {
 public:
  /// Throws std::logic_error where there is one of that name, or it cannot be made.
  void add(StructureSpec spec);
  /// Null where there is none.
  [[nodiscard]] const StructureSpec* find(std::string_view name) const;
  /// In their order.
  [[nodiscard]] const std::vector<StructureSpec>& all() const { return specs_; }

 private:
  std::vector<StructureSpec> specs_;
};

/// Of the process: the framework's own structures, and whatever is added before the first run.
[[nodiscard]] StructureRegistry& structure_registry();

}  // namespace kds
