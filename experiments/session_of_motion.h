#pragma once
// A session for one type of motion: the only place where the types of motion, kernel and structures meet.

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiments/dump_files.h"
#include "experiments/make_session_of.h"
#include "motions/input_error.h"
#include "structures/power_diagram.h"
#include "structures/sorted_list.h"
#include "structures/static_build.h"
#include "structures/wrapped_hierarchy.h"

namespace kds {

template <Motion M>
inline constexpr bool has_wrapped = M::dimension == 3 && !lifted<M>;
template <Motion M>
inline constexpr bool has_power = M::dimension >= 2;

template <Motion M, Kernel K>
class SessionOf final : public Session {
 public:
  SessionOf(const Scene& scene, const std::vector<std::string>& structures, AuditMode audits)
      : scene_(scene), motion_(scene.bead_count()), simulator_(audits) {
    for (const std::string& name : structures) add(name);
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
          [this](std::size_t frame) { return seconds_to_sort(scene_.centers(frame)); });
      return;
    }
    if (lifted<M> && name != "power") {
      throw InputError(
          fmt::format("--motion lifted: its radii between frames are fictitious, and {} needs physical ones; "
                      "expected --structures power",
                      name));
    }
    const bool supported = name == "wrapped" ? has_wrapped<M> : has_power<M>;
    if (!supported) {
      throw InputError(fmt::format("--structures {}: needs {}, this input has {} coordinate{}", name,
                                   name == "wrapped" ? "points in space" : "points in the plane or in space",
                                   M::dimension, M::dimension == 1 ? "" : "s"));
    }
    if (name == "wrapped" && !scene_.equal_radii()) {
      throw InputError(
          "--structures wrapped: needs equal radii (or weights), which this input does not have; "
          "unequal ones are not supported yet");
    }
    if constexpr (has_wrapped<M>) {
      if (name == "wrapped") add_wrapped();
    }
    if constexpr (has_power<M>) {
      if (name == "power") add_power();
    }
  }

  void add_wrapped() requires has_wrapped<M> {
    auto* wrapped = own(std::make_unique<WrappedHierarchy<M, K>>(simulator_, motion_, scene_.necklaces()));
    add(
        [this, wrapped](std::size_t frame, auto& files) {
          const Dyadic time(frame == 0 ? 0.0 : 1.0);
          const Eigen::Matrix3Xd centers = scene_.centers(frame);
          std::vector<WrappedNode> nodes;
          for (NodeId id = 0; id < wrapped->tree().node_count(); ++id) {
            const Basis basis = wrapped->basis_at(id, time);
            nodes.push_back({wrapped->tree().range(id), basis, exact_sphere_of(basis, centers)});
            nodes.back().sphere.radius += scene_.radii().front();
          }
          files.push_back(dump_wrapped(nodes));
        },
        [this, wrapped](std::size_t frame) {
          return seconds_to_wrap(wrapped->tree(), scene_.centers(frame), scene_.radii());
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
          return seconds_to_triangulate<M::dimension>(scene_.centers(frame), scene_.weights(frame));
        });
  }

  const Scene& scene_;
  M motion_;
  Simulator simulator_;
  std::vector<std::unique_ptr<KineticStructure>> owned_;
  std::vector<Part> parts_;
  std::vector<KineticStructure*> structures_;
};

template <Motion M>
std::unique_ptr<Session> make_session_of(const Scene& scene, const std::vector<std::string>& structures,
                                         KernelName kernel, AuditMode audits) {
  if constexpr (elevated<M>) {
    return std::make_unique<SessionOf<M, Exact>>(scene, structures, audits);
  } else {
    switch (kernel) {
      case KernelName::fast:
        return std::make_unique<SessionOf<M, Fast>>(scene, structures, audits);
      case KernelName::exact:
        return std::make_unique<SessionOf<M, Exact>>(scene, structures, audits);
      case KernelName::filtered:
        break;
    }
    return std::make_unique<SessionOf<M, Filtered>>(scene, structures, audits);
  }
}

}  // namespace kds
