#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "structures/box/enclosing_box.h"
#include "structures/closest/kinetic_closest_pair.h"
#include "structures/hull/convex_hull.h"
#include "structures/session/own_structures.h"
#include "structures/sorted/sorted_list.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

template <int Dimension>
class SortedInRun final : public RunningStructure {
 public:
  SortedInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion)
      : scene_(scene), list_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return list_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    return {dump_sorted(list_.order())};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    return elements_in_order(list_.order());
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_sort(scene_.centers(frame)).clock;
  }

 private:
  const Scene& scene_;
  SortedList<Dimension> list_;
};

template <int Dimension>
class BoxInRun final : public RunningStructure {
 public:
  BoxInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion)
      : scene_(scene), box_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return box_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override { return {dump_box(box_.ends())}; }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    return elements_in_order(box_.ends());
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_box(scene_.centers(frame)).clock;
  }

 private:
  const Scene& scene_;
  EnclosingBox<Dimension> box_;
};

class HullInRun final : public RunningStructure {
 public:
  HullInRun(Simulator& simulator, const Scene& scene, const MotionRef<2>& motion)
      : scene_(scene), hull_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return hull_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    return {dump_hull(hull_.corners())};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{1, {}};
    for (const BeadId bead : hull_.corners()) elements.add({bead});
    return elements;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_hull(scene_.centers(frame)).clock;
  }

 private:
  const Scene& scene_;
  ConvexHull hull_;
};

template <int Dimension>
class ClosestInRun final : public RunningStructure {
 public:
  ClosestInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion)
      : scene_(scene), closest_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return closest_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    return {dump_closest(closest_.pair())};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{1, {}};
    if (const auto& pair = closest_.pair()) elements.add({0}, *pair);
    return elements;
  }
  /// Times a Delaunay triangulation, because one of its edges joins the closest pair.
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    const std::vector<double> no_weights(scene_.bead_count(), 0);
    return seconds_to_triangulate<Dimension>(scene_.centers(frame), no_weights).clock;
  }

 private:
  const Scene& scene_;
  KineticClosestPair<Dimension> closest_;
};

}  // namespace

StructureSpec sorted_structure() {
  StructureSpec spec;
  spec.name = "sorted";
  spec.order = 10;
  spec.by_default = [](const Scene& scene) { return scene.dimension() == 1; };
  spec.make = make_of_motion<SortedInRun, 1>();
  return spec;
}

StructureSpec box_structure() {
  StructureSpec spec;
  spec.name = "box";
  spec.order = 12;
  spec.make = make_of_motion<BoxInRun, 1>();
  return spec;
}

StructureSpec hull_structure() {
  StructureSpec spec;
  spec.name = "hull";
  spec.order = 14;
  spec.refusal = [](const Scene& scene) -> std::optional<std::string> {
    if (scene.dimension() == 2) return std::nullopt;
    return "needs points in the plane, this input has " + std::to_string(scene.dimension()) +
           (scene.dimension() == 1 ? " coordinate" : " coordinates");
  };
  spec.make = [](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                 const StructureSettings&) -> std::unique_ptr<RunningStructure> {
    return std::make_unique<HullInRun>(simulator, scene, std::get<MotionRef<2>>(motion));
  };
  return spec;
}

StructureSpec closest_structure() {
  StructureSpec spec;
  spec.name = "closest";
  spec.order = 16;
  spec.refusal = [](const Scene& scene) -> std::optional<std::string> {
    if (scene.dimension() < 2) return needs_plane_or_space(scene);
    return std::nullopt;
  };
  spec.make = make_of_motion<ClosestInRun, 2>();
  return spec;
}

}  // namespace kds
