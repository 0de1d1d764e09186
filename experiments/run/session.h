#pragma once
// A scene with its motion, its kinetic structures and the simulator that drives them, whatever their types
// are.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "experiments/run/run_options.h"
#include "kds/simulator.h"
#include "motions/scene/scene.h"
#include "structures/necklace/node_selection.h"

namespace kds {

/// One file of a dump: its name's ending and its text.
struct DumpFile {
  std::string ending;  ///< as in frame-7.wrapped.csv: "wrapped.csv"
  std::string text;
};

class Session {
 public:
  virtual ~Session() = default;

  /// Sets the motion to that of the step.
  virtual void load(std::size_t step) = 0;
  /// The structures as they are at a frame that has just been reached (or, frame 0, built).
  [[nodiscard]] virtual std::vector<DumpFile> dump(std::size_t frame) = 0;
  /// Builds the same structures statically at a frame; adds the seconds, one entry a structure.
  virtual void time_static_builds(std::size_t frame, std::vector<double>& seconds) const = 0;

  [[nodiscard]] virtual Simulator& simulator() = 0;
  [[nodiscard]] virtual const std::vector<KineticStructure*>& structures() const = 0;
};

struct SessionOptions {
  std::vector<std::string> structures;  ///< names as in --structures, in the order in which they act
  KernelName kernel = KernelName::filtered;
  AuditMode audits = AuditMode::none;
  NodeSelection nodes;  ///< of the wrapped hierarchy
};

/// Throws InputError where the scene or kernel and a structure do not go together.
[[nodiscard]] std::unique_ptr<Session> make_session(const Scene& scene, const SessionOptions& options);

}  // namespace kds
