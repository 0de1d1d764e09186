#include "experiments/collide/methods.h"

#include <fmt/format.h>

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
  explicit BruteForce(const CollisionQuery& query) : query_(query) {}
  std::optional<std::string> refusal(const Balls<Dimension>& balls) const override {
    constexpr std::size_t most_beads = 300'000;  // takes half a minute per frame
    if (balls.size() <= most_beads) return std::nullopt;
    return fmt::format("looks at all pairs of {} beads; expected {} beads or fewer", balls.size(),
                       most_beads);
  }
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    found.pairs = pairs_by_force(balls, query_.asked, query_.distance);
    found.collide = !found.pairs->empty();
  }
  void find_closest(const Balls<Dimension>& balls, Detection& found) override {
    found.closest = closest_pair_by_force(balls, query_.asked);
  }

 private:
  CollisionQuery query_;
};

template <int Dimension, Hierarchy kind>
class BySpheres : public Detector<Dimension> {
 public:
  explicit BySpheres(const CollisionQuery& query) : query_(query), tree_(kind, query.asked.necklaces) {}
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    tree_.build(balls);
    PairsFound result = find_pairs(tree_, query_.asked, query_.distance);
    found.collide = !result.pairs.empty();
    found.pairs = std::move(result.pairs);
    found.family = result.family;
  }
  void find_closest(const Balls<Dimension>& balls, Detection& found) override {
    found.closest = find_closest_pair(tree_, balls, query_.asked);
  }

 private:
  CollisionQuery query_;
  SphereTree<Dimension> tree_;
};
template <int Dimension>
using Wrapped = BySpheres<Dimension, Hierarchy::wrapped>;
template <int Dimension>
using Layered = BySpheres<Dimension, Hierarchy::layered>;

template <int Dimension>
class ByDiagram final : public Detector<Dimension> {
 public:
  explicit ByDiagram(const CollisionQuery& query) : query_(query) {}
  std::optional<std::string> refusal(const Balls<Dimension>& balls) const override {
    if (query_.distance > 0) return "the power diagram tells of beads that meet; expected --within 0";
    return diagram_refusal(balls, query_.asked);
  }
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    DiagramCollision result = collide_by_diagram(balls, query_.asked);
    found = {result.collide, std::move(result.pairs), result.closest, result.edges};
  }

 private:
  CollisionQuery query_;
};

template <int Dimension>
class Cells final : public Detector<Dimension> {
 public:
  explicit Cells(const CollisionQuery& query) : distance_(query.distance), cells_(query.asked) {}
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    found.pairs = cells_.pairs_within(balls, distance_);
    found.collide = !found.pairs->empty();
  }

 private:
  double distance_;
  CellList<Dimension> cells_;
};

template <int Dimension>
class Auto final : public Detector<Dimension> {
 public:
  explicit Auto(const CollisionQuery& query) : distance_(query.distance), detector_(query.asked) {}
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    found.pairs = distance_ > 0 ? detector_.pairs_within(balls, distance_) : detector_.pairs(balls);
    found.collide = !found.pairs->empty();
  }
  void find_closest(const Balls<Dimension>& balls, Detection& found) override {
    found.closest = detector_.closest_pair(balls);
  }

 private:
  double distance_;
  AutoDetector<Dimension> detector_;
};

template <int Dimension, template <int> class Made>
std::unique_ptr<Detector<Dimension>> make(const CollisionQuery& query) {
  return std::make_unique<Made<Dimension>>(query);
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
