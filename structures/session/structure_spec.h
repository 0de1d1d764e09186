#pragma once
// The specification of a kinetic structure: everything that runs, dumps, reports and replays know about it.

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

#include "kds/simulator.h"
#include "motions/base/input_error.h"
#include "motions/scene/scene.h"
#include "structures/contacts/contact_distance.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/session/replay_layers.h"
#include "structures/session/scene_motion.h"

namespace kds {

/// One file of a dump: the ending of its name, and its text.
struct DumpFile {
  std::string ending;  ///< "wrapped.csv" for frame-7.wrapped.csv
  std::string text;
};

/// An element of a structure's state at a frame. The state is a set of elements, so two frames can be
/// compared.
using CombinatorialElement = std::array<BeadId, 6>;  ///< unused entries hold no_bead
struct CombinatorialElements {
  /// The first `place_ids` ids of an element are its place, the others its content: for example a hierarchy's
  /// node and the basis of this node. Places are unique.
  std::size_t place_ids = 0;
  std::vector<CombinatorialElement> all;  ///< in any order

  /// Adds an element, with at most six ids in total.
  void add(std::initializer_list<BeadId> place, std::span<const BeadId> what = {});
};
/// Returns the elements of a sequence of beads: each place k with the bead at this place.
[[nodiscard]] CombinatorialElements elements_in_order(std::span<const BeadId> beads);

/// A structure in a run, with everything in which structures differ outside the simulator.
class RunningStructure {
 public:
  virtual ~RunningStructure() = default;

  [[nodiscard]] virtual KineticStructure& kinetic() = 0;
  /// Returns the dump of the structure at a frame just reached (frame 0: just built).
  [[nodiscard]] virtual std::vector<DumpFile> dump(std::size_t frame) const = 0;
  /// Returns the structure's elements at a frame just reached (frame 0: just built). Returns nothing if such
  /// structures are not compared from frame to frame.
  [[nodiscard]] virtual std::optional<CombinatorialElements> elements(std::size_t frame) const {
    static_cast<void>(frame);
    return std::nullopt;
  }
  /// Returns whether a run of the structure may be cut at frames, because `state` has everything that later
  /// events depend on.
  [[nodiscard]] virtual bool can_be_cut() const { return false; }
  /// Returns numbers that determine, with the motion, all later events and their order. Called at a frame
  /// just reached; at the first frame, the structure has just been built. Returns nothing if more than
  /// positions decided the state, for example if cells are flat. The numbers must not depend on memory, as
  /// cell ids do.
  [[nodiscard]] virtual std::optional<std::vector<BeadId>> state() const { return std::nullopt; }
  /// Returns the changes that build the structure from nothing, with which logs of its events begin.
  [[nodiscard]] virtual std::vector<Change> built() const { return {}; }
  /// Returns the spheres of the structure's nodes, as the structure has them, at time u of the step that is
  /// under way or was just run, in the scene's coordinates. Empty if the structure has no nodes. Spheres are
  /// rounded up: each contains the exact one.
  [[nodiscard]] virtual std::vector<NodeSphere> spheres_at(const Dyadic& u) const {
    static_cast<void>(u);
    return {};
  }
  /// Returns the layers that a replay shows of the structure (replay_layers.h). By default there are none.
  [[nodiscard]] virtual ReplayScheme replay_scheme() const { return {}; }
  /// Returns the elements of each layer now, in any order. `built` says whether the structure has just been
  /// built; otherwise it has run at least part of a step.
  [[nodiscard]] virtual std::vector<std::vector<ReplayElement>> replay_elements(bool built) const {
    static_cast<void>(built);
    return {};
  }
  /// Appends what a change that was just made does to the layers. Returns false if the change alone
  /// does not determine this; `replay_elements` must then be read again.
  [[nodiscard]] virtual bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const {
    static_cast<void>(change);
    static_cast<void>(edits);
    return true;
  }
  /// Returns the spheres of the scheme's `sphere_nodes` at the control points of the step just run, except
  /// for its start, one control point after another. If `built`, returns those at the first frame.
  [[nodiscard]] virtual std::vector<Sphere> replay_spheres(bool built) const {
    static_cast<void>(built);
    return {};
  }
  /// Follows, from the next step on, how many certificates name each bead. A structure that always knows this
  /// number does nothing.
  virtual void follow_certificates() {}
  /// Updates statistics.certificates.per_bead_max, the largest number of certificates on one bead, between
  /// two events. `changed` are the beads of the events since the last call; only their certificates may have
  /// become more. A structure whose numbers do not change within a step, or that does not know them, does
  /// nothing.
  virtual void count_certificates(std::span<const BeadId> changed) { static_cast<void>(changed); }
  /// Returns the wall time in seconds to build the structure statically at a frame, as a user would without
  /// this library.
  [[nodiscard]] virtual double static_seconds(std::size_t frame) const = 0;
};

/// The spheres of a wrapped hierarchy between frames.
enum class Between {
  events,  ///< smallest spheres at all times; bases change at events
  chord    ///< chords of the smallest spheres at both frames (chord_cages.h)
};
/// Names of the enumerators, in their order.
inline constexpr std::array<std::string_view, 2> between_names{"events", "chord"};
[[nodiscard]] constexpr std::string_view name_of(Between between) {
  return between_names[static_cast<std::size_t>(between)];
}

struct StructureSettings {
  NodeSelection nodes = {};           ///< for hierarchies
  Between between = Between::events;  ///< for `wrapped`
  /// For chords: radii are at most 1 + tightness times the smallest radii at all times. No value: no bound.
  std::optional<double> tightness{};
  BeadId apart = 2;  ///< for contacts: pairs in one necklace are at least this far apart along it
  /// For contacts: the groups of each bead, as PairsAsked::groups has them. Empty: all pairs.
  BeadGroups groups{};
  /// For boxes: one of box_direction_counts (box_hierarchy.h). No value: the axes.
  std::optional<int> directions{};
  double stretch = 3;  ///< for `spanner`: above 1
  /// For contacts: the distance at which beads are in contact. No value: balls with the scene's radii meet.
  std::optional<ContactDistance> contact_distance{};
  /// Set by the run for a structure that stands on another one (StructureSpec::stands_on).
  KineticStructure* base = nullptr;
};

struct StructureSpec {
  std::string name;
  std::string about = {};        ///< what is maintained, for `kds help structures`
  std::string net_changes = {};  ///< what its elements are, if it has any
  /// The structure on which this one stands, which must have a lower `order`. A run that has this structure
  /// has the other one too, with the same beads. Empty if there is none.
  std::string stands_on = {};
  /// Determines the order of structures, both in acting at one time and in reports: ascending, then by name.
  /// The framework's own structures have 10 to 45.
  int order = 100;
  /// Returns whether a run of this scene contains the structure if no structures are chosen.
  std::function<bool(const Scene&)> by_default = [](const Scene&) { return false; };
  /// Returns why the structure does not fit the scene, as the end of a sentence, or nothing if it fits.
  std::function<std::optional<std::string>(const Scene&)> refusal = [](const Scene&) {
    return std::optional<std::string>();
  };
  /// Plural noun for messages, such as "contacts": what images across cell walls add to the structure. Empty
  /// if the structure ignores images.
  std::string across_walls = {};
  /// Whether the structure is about near beads, but takes no images of them in a periodic cell.
  bool lacks_images = false;
  /// Returns whether the structure has events at all, and can be logged, replayed and audited between events.
  std::function<bool(const StructureSettings&)> has_events = [](const StructureSettings&) { return true; };
  /// Makes the structure. Simulator, scene and motion outlive it.
  std::function<std::unique_ptr<RunningStructure>(Simulator&, const Scene&, const SceneMotion::Ref&,
                                                  const StructureSettings&)>
      make;
};

class StructureRegistry {
 public:
  /// Throws std::logic_error if there is a structure of the same name, or if the specification has no `make`.
  void add(StructureSpec spec);
  /// Returns null if there is no structure of this name.
  [[nodiscard]] const StructureSpec* find(std::string_view name) const;
  /// Returns all specifications in the order of StructureSpec::order.
  [[nodiscard]] const std::vector<StructureSpec>& all() const { return specs_; }

 private:
  std::vector<StructureSpec> specs_;
};

/// Thrown if a structure is not known or does not fit the scene.
class StructureRefusal : public InputError {
 public:
  StructureRefusal(const std::string& structure, const std::string& reason)
      : InputError(structure + ": " + reason) {}
};

/// Returns the registry of the process: the framework's own structures and all structures added before the
/// first run.
[[nodiscard]] StructureRegistry& structure_registry();
/// Returns the names of the structures that the scene has by default.
[[nodiscard]] std::vector<std::string> default_structures(const Scene& scene);

}  // namespace kds
