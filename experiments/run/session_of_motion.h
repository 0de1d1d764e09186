#pragma once
// A session for one type of motion: the only place where the types of motion, kernel and structures meet.

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiments/run/dump_files.h"
#include "experiments/run/make_session_of.h"
#include "motions/base/input_error.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/sorted/sorted_list.h"
#include "structures/triangulation/static_build.h"

namespace kds {

template <Motion M>
inline constexpr bool has_wrapped = M::dimension >= 2 && !lifted<M>;
/// Motions of trajectories; radical certificates take long to compile.
template <Motion M>
inline constexpr bool has_unequal_wrapped =
    !elevated<M> && (M::degree == 1 || M::degree == 3) && has_wrapped<M>;
template <Motion M>
inline constexpr bool has_power = M::dimension >= 2;

template <Motion M, Kernel K>
class SessionOf final : public Session {
 public:
  SessionOf(const Scene& scene, const SessionOptions& options)
      : scene_(scene), nodes_(options.nodes), motion_(scene.bead_count()), simulator_(options.audits) {
    for (const std::string& name : options.structures) add(name);
  }

  void load(std::size_t step) override { scene_.load(step, motion_); }

  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) override {
    std::vector<DumpFile> files;
    for (const auto& part : parts_) part.dump(frame, files);
    return files;
  }

  void time_static_builds(std::size_t frame, std::vector<double>& seconds) const override {
    seconds.resize(parts_.size(), 0);
    for (std::size_t p = 0; p < parts_.size(); ++p) seconds[p] += parts_[p].time_static(frame);
  }

  [[nodiscard]] Simulator& simulator() override { return simulator_; }
  [[nodiscard]] const std::vector<KineticStructure*>& structures() const override { return structures_; }

 private:
  /// What differs between structures outside the simulator.
  struct Part {
    std::function<void(std::size_t frame, std::vector<DumpFile>&)> dump;
    std::function<double(std::size_t frame)> time_static;
  };

  template <class S>
  S* own(std::unique_ptr<S> structure) {
    S* observed = structure.get();
    structures_.push_back(observed);
    owned_.push_back(std::move(structure));
    return observed;
  }
  void add(std::function<void(std::size_t, std::vector<DumpFile>&)> dump,
           std::function<double(std::size_t)> time_static) {
    parts_.push_back({std::move(dump), std::move(time_static)});
  }

  void add(const std::string& name) {
    if (name == "sorted") {
      auto* list = own(std::make_unique<SortedList<M, K>>(simulator_, motion_));
      add([list](std::size_t, auto& files) { files.push_back(dump_sorted(list->order())); },
          [this](std::size_t frame) { return seconds_to_sort(scene_.centers(frame)).clock; });
      return;
    }
    if (lifted<M> && name != "power") {
      throw InputError(
          fmt::format("--motion lifted: its radii between frames are fictitious, and {} needs physical ones; "
                      "expected --structures power",
                      name));
    }
    if (M::dimension < 2) {
      throw InputError(
          fmt::format("--structures {}: needs points in the plane or in space, this input has {} "
                      "coordinate",
                      name, M::dimension));
    }
    if constexpr (has_wrapped<M>) {
      if (name == "wrapped") add_wrapped();
    }
    if constexpr (has_power<M>) {
      if (name == "power") add_power();
    }
  }

  void add_wrapped() requires has_wrapped<M> {
    if (scene_.equal_radii()) return add_wrapped_of<Radii::equal>();
    if constexpr (has_unequal_wrapped<M>) {
      if (scene_.has_radii()) return add_wrapped_of<Radii::any>();
    }
    throw InputError(
        "--structures wrapped: the points of an instance have weights that differ, and those are no radii; "
        "expected equal weights, or a trajectory");
  }
  template <Radii radii>
  void add_wrapped_of() {
    auto* wrapped =
        own(std::make_unique<WrappedHierarchy<M, K, radii>>(simulator_, motion_, scene_.necklaces(), nodes_));
    std::vector<BeadRange> kept;
    for (NodeId id = 0; id < wrapped->tree().node_count(); ++id)
      if (wrapped->keeps(id)) kept.push_back(wrapped->tree().range(id));
    add(
        [this, wrapped](std::size_t frame, auto& files) {
          const std::vector<Basis> bases = wrapped->bases_at(Dyadic(frame == 0 ? 0.0 : 1.0));
          const Balls<M::dimension> balls(scene_.centers(frame), scene_.radii());
          std::vector<WrappedNode> nodes;
          for (NodeId id = 0; id < bases.size(); ++id) {
            if (!wrapped->keeps(id)) continue;
            Sphere sphere = exact_sphere_of(bases[id], balls);
            sphere.center = scene_.in_input(sphere.center);
            nodes.push_back({wrapped->tree().range(id), bases[id], sphere});
          }
          files.push_back(dump_wrapped(nodes));
        },
        [this, kept](std::size_t frame) {
          return seconds_to_wrap<M::dimension>(kept, scene_.centers(frame), scene_.radii()).clock;
        });
  }

  void add_power() requires has_power<M> {
    auto* power = own(std::make_unique<PowerDiagram<M, K>>(simulator_, motion_));
    add(
        [power](std::size_t frame, auto& files) {
          const auto at_frame = power->at_frame(frame == 0);
          files.push_back(dump_cells(at_frame.cells));
          files.push_back(dump_hidden(at_frame.hidden));
        },
        [this](std::size_t frame) {
          return seconds_to_triangulate<M::dimension>(scene_.centers(frame), scene_.weights(frame)).clock;
        });
  }

  const Scene& scene_;
  NodeSelection nodes_;
  M motion_;
  Simulator simulator_;
  std::vector<std::unique_ptr<KineticStructure>> owned_;
  std::vector<Part> parts_;
  std::vector<KineticStructure*> structures_;
};

template <Motion M>
std::unique_ptr<Session> make_session_of(const Scene& scene, const SessionOptions& options) {
  if constexpr (elevated<M>) {
    return std::make_unique<SessionOf<M, Exact>>(scene, options);
  } else {
    switch (options.kernel) {
      case KernelName::fast:
        return std::make_unique<SessionOf<M, Fast>>(scene, options);
      case KernelName::exact:
        return std::make_unique<SessionOf<M, Exact>>(scene, options);
      case KernelName::filtered:
        break;
    }
    return std::make_unique<SessionOf<M, Filtered>>(scene, options);
  }
}

}  // namespace kds
