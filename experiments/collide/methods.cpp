#include "experiments/collide/methods.h"

#include <array>

#include "structures/collision/auto_detector.h"
#include "structures/collision/brute_force.h"
#include "structures/collision/cell_list.h"
#include "structures/collision/diagram_collision.h"
#include "structures/collision/hierarchy_search.h"

namespace kds {

namespace {

template <int Dimension>
class BruteForce final : public Detector<Dimension> {
 public:
  explicit BruteForce(const PairsAsked& asked) : asked_(asked) {}
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    found.pairs = pairs_by_force(balls, asked_);
    found.collide = !found.pairs->empty();
  }
  void find_closest(const Balls<Dimension>& balls, Detection& found) override {
    found.closest = closest_pair_by_force(balls, asked_);
  }

 private:
  PairsAsked asked_;
};

template <int Dimension, Hierarchy kind>
class BySpheres : public Detector<Dimension> {
 public:
  explicit BySpheres(const PairsAsked& asked) : asked_(asked), tree_(kind, asked.necklaces) {}
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    tree_.build(balls);
    PairsFound result = find_pairs(tree_, asked_);
    found.collide = !result.pairs.empty();
    found.pairs = std::move(result.pairs);
    found.family = result.family;
  }
  void find_closest(const Balls<Dimension>& balls, Detection& found) override {
    found.closest = find_closest_pair(tree_, balls, asked_);
  }

 private:
  PairsAsked asked_;
  SphereTree<Dimension> tree_;
};
template <int Dimension>
using Wrapped = BySpheres<Dimension, Hierarchy::wrapped>;
template <int Dimension>
using Layered = BySpheres<Dimension, Hierarchy::layered>;

template <int Dimension>
class ByDiagram final : public Detector<Dimension> {
 public:
  explicit ByDiagram(const PairsAsked& asked) : asked_(asked) {}
  std::optional<std::string> refusal(const Balls<Dimension>& balls) const override {
    return diagram_refusal(balls, asked_);
  }
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    DiagramCollision result = collide_by_diagram(balls, asked_);
    found = {result.collide, std::move(result.pairs), result.closest, result.edges};
  }

 private:
  PairsAsked asked_;
};

template <int Dimension, template <int> class Finder>
class PairsOnly : public Detector<Dimension> {
 public:
  explicit PairsOnly(const PairsAsked& asked) : finder_(asked) {}
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    found.pairs = finder_.pairs(balls);
    found.collide = !found.pairs->empty();
  }

 private:
  Finder<Dimension> finder_;
};
template <int Dimension>
using Cells = PairsOnly<Dimension, CellList>;
template <int Dimension>
using Auto = PairsOnly<Dimension, AutoDetector>;

template <int Dimension, template <int> class Made>
std::unique_ptr<Detector<Dimension>> make(const PairsAsked& asked) {
  return std::make_unique<Made<Dimension>>(asked);
}
template <template <int> class Made>
constexpr Method method(std::string_view name, std::string_view about) {
  return {name, about, make<2, Made>, make<3, Made>};
}

constexpr std::array kMethods{
    method<BruteForce>("brute", "all pairs of beads"),
    method<Wrapped>("wrapped", "hierarchy of minimum enclosing spheres"),
    method<Layered>("layered", "hierarchy of spheres around spheres"),
    method<ByDiagram>("power", "power diagram"),
    method<Cells>("cells", "cell list"),
    method<Auto>("auto", "blocks, and near pairs kept from frame to frame"),
};

}  // namespace

std::span<const Method> collision_methods() { return kMethods; }

}  // namespace kds
