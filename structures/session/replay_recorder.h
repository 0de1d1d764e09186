#pragma once
// Records what a replay of a run needs: for each structure its events and, for each layer (replay_layers.h),
// the elements at the first frame and the changes at each event. From these, the state at any time follows
// forward and backward. Frames are not kept: they are the scene's.
//
//   KineticRun run(scene, options);
//   ReplayRecorder recorder(run);
//   run.listen(recorder);
//   run.build();
//   recorder.begin();
//   while (run.run_step()) recorder.reach_frame();
//
// Memory grows with the state and with the number of changes. It grows with the number of frames only for
// structures whose spheres follow curves between frames.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "kds/event.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/replay_layers.h"

namespace kds {

class ReplayRecorder final : public EventListener {
 public:
  /// All events of a structure in their order; every column but `ids` has one number for each event.
  struct Events {
    std::vector<std::uint32_t> order;  ///< index among the events of all structures
    std::vector<std::uint32_t> step;
    std::vector<double> lower, upper;  ///< canonical bracket of the time u in the step
    std::vector<std::uint8_t> kind;    ///< index into Structure::kinds
    std::vector<DecidedBy> stage;      ///< that decided the time
    std::vector<std::uint8_t> size;    ///< number of ids
    std::vector<BeadId> ids;           ///< of all events, one after another

    [[nodiscard]] std::size_t count() const { return step.size(); }
  };
  struct Layer {
    ReplayLayer layer;
    std::vector<BeadId> initial;  ///< elements at the first frame, `arity` ids each, ascending
    /// One record for each event that changes the layer: the event's index in the structure, the number r of
    /// elements removed and s of elements added, then these elements. Each removed element is present, each
    /// added one is absent.
    std::vector<std::uint32_t> changes;
    std::size_t change_count = 0;
  };
  struct Structure {
    std::string name;
    /// The structure's kinds. If a frame changed the layers without an event, `rebuilt_at_frame` follows: an
    /// event without ids at u = 1 of the step before the frame.
    std::vector<EventKind> kinds;
    Events events;
    std::vector<Layer> layers;
    std::vector<ReplayNode> nodes;
    std::vector<std::uint32_t> sphere_nodes;  ///< nodes with spheres that follow curves between frames
    /// Their spheres at the first frame, then at the control points of each step except for its start.
    std::vector<std::array<float, 4>> spheres;
  };
  static constexpr EventKind rebuilt_at_frame{"rebuild-at-frame", false, true, {}};

  /// Records the structures that the run has now. The run must outlive the recorder. A run that goes back in
  /// time makes its structures anew, and needs a new recorder.
  explicit ReplayRecorder(KineticRun& run);

  /// Reads the state at the first frame. Must be called when the structures are built, before any event.
  void begin();
  /// Adds an event. Throws std::logic_error before `begin`.
  void on_event(const Event& event) override;
  /// Must be called at each frame after the first, when the step that leads to the frame has been run. Takes
  /// time only if a structure was rebuilt or has spheres that follow curves.
  void reach_frame();

  [[nodiscard]] const std::vector<Structure>& structures() const { return structures_; }
  /// Returns the elements of a layer now, ascending. Throws std::invalid_argument if there is no such layer.
  [[nodiscard]] std::vector<ReplayElement> elements(std::size_t structure, std::size_t layer) const;

 private:
  struct HashOfPlace {
    std::size_t operator()(const ReplayElement& place) const {
      std::uint64_t hash = 0;
      for (const BeadId id : place) hash = (hash ^ id) * 0x9e3779b97f4a7c15U;
      return static_cast<std::size_t>(hash ^ hash >> 32U);
    }
  };
  using Elements = std::unordered_map<ReplayElement, ReplayElement, HashOfPlace>;  // elements, by their place
  struct LayerChange {
    std::vector<ReplayElement> removed, added;
  };

  void add_spheres(std::size_t structure, bool built);
  void add_event(std::size_t structure, std::uint32_t step, double lower, double upper, std::uint8_t kind,
                 DecidedBy stage, std::span<const BeadId> ids);
  /// Returns the changes of a structure's layers that lead to its state now.
  [[nodiscard]] std::vector<LayerChange> changes_to_now(std::size_t structure);
  [[nodiscard]] std::vector<LayerChange> changes_by(std::size_t structure,
                                                    const std::vector<ReplayEdit>& edits);
  void add_changes(std::size_t structure, const std::vector<LayerChange>& changes);

  KineticRun& run_;
  std::vector<Structure> structures_;
  std::vector<std::vector<Elements>> now_;  // for each structure and layer
  std::vector<std::uint64_t> rebuilds_;     // number of each structure's rebuilds, when it was last read
  std::vector<ReplayEdit> edits_;
  std::uint32_t order_ = 0;
  bool begun_ = false;
};

}  // namespace kds
