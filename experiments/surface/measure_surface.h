#pragma once
// Measures areas and volumes at times of a trajectory for `kds surface`.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/surface/union_task.h"
#include "motions/scene/scene.h"
#include "structures/contacts/contact_elements.h"
#include "structures/dual_complex/union_measures.h"

namespace kds {

struct SurfaceTask : UnionTask {
  std::vector<double> times;  ///< --at, ascending: in frames that are read, from 0; empty for all frames
  std::optional<std::size_t> threads;  ///< empty for all cores
};

/// The measures at one time. Areas and volumes are in powers of the input's unit of length.
struct SurfaceFrame {
  double frame = 0;  ///< number in the file, with a fraction between frames
  std::optional<double> picoseconds;
  double area = 0, volume = 0;
  std::vector<double> residue_areas, residue_volumes;                 ///< empty without residues
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> between;  ///< contact area of pairs of necklaces
  UnionMeasures measures;                     ///< of beads and edges, if they are kept
  std::vector<ComplexSimplices::Edge> edges;  ///< those of `measures.contacts`

  /// Returns the contact area between different necklaces.
  [[nodiscard]] double buried() const;
};

struct SurfaceReport {
  std::unique_ptr<const Scene> scene;
  std::size_t frame_count = 0;              ///< of the input
  std::string unit;                         ///< of lengths; empty if they have none
  ContactElements chains;                   ///< the necklaces
  std::optional<ContactElements> residues;  ///< none if a bead has no residue
  std::vector<SurfaceFrame> frames;         ///< one for each time
};

/// Reads the inputs and measures all times on several threads. If `keep`, the frames keep the measures of
/// beads and contacts. Each warning goes to `warn` as one line. Throws InputError, also if the scene is
/// planar.
[[nodiscard]] SurfaceReport measure_surface(const SurfaceTask& task, bool keep,
                                            const std::function<void(std::size_t, std::size_t)>& progress,
                                            const std::function<void(const std::string&)>& warn);

}  // namespace kds
