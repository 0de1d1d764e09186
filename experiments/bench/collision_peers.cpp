#include "experiments/bench/collision_peers.h"

#include <array>
#include <memory>
#include <vector>

#ifdef KDS_FCL
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#endif
#ifdef KDS_BULLET
#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#endif

namespace kds::bench {

namespace {

// Both libraries find pairs of boxes. A test in doubles then decides for both libraries whether
// the balls meet.
[[maybe_unused]] bool are_counted(const Balls<3>& balls, std::size_t a, std::size_t b) {
  if ((a > b ? a - b : b - a) < 2) return false;
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = balls.coordinates(axis)[a] - balls.coordinates(axis)[b];
    square += d * d;
  }
  const double reach = balls.radii()[a] + balls.radii()[b];
  return square <= reach * reach;
}

#ifdef KDS_FCL
class FclTree final : public PeerTree {
 public:
  explicit FclTree(const Balls<3>& balls) : balls_(balls) {
    objects_.reserve(balls.size());
    for (BeadId b = 0; b < balls.size(); ++b)
      objects_.emplace_back(
          std::make_shared<fcl::Sphere<double>>(balls.radius(b)), fcl::Matrix3<double>::Identity(),
          fcl::Vector3<double>(balls.coordinate(b, 0), balls.coordinate(b, 1), balls.coordinate(b, 2)));
    std::vector<fcl::CollisionObject<double>*> all;
    for (auto& object : objects_) all.push_back(&object);
    tree_.registerObjects(all);
    tree_.setup();
  }
  std::size_t pairs() override {
    pairs_ = 0;
    tree_.collide(this, [](fcl::CollisionObject<double>* a, fcl::CollisionObject<double>* b, void* data) {
      auto& self = *static_cast<FclTree*>(data);
      const auto bead_of = [&self](const fcl::CollisionObject<double>* object) {
        return static_cast<std::size_t>(object - self.objects_.data());
      };
      self.pairs_ += are_counted(self.balls_, bead_of(a), bead_of(b)) ? 1 : 0;
      return false;
    });
    return pairs_;
  }

 private:
  const Balls<3>& balls_;
  std::vector<fcl::CollisionObject<double>> objects_;
  fcl::DynamicAABBTreeCollisionManager<double> tree_;
  std::size_t pairs_ = 0;
};
#endif

#ifdef KDS_BULLET
class BulletTree final : public PeerTree, private btDbvt::ICollide {
 public:
  explicit BulletTree(const Balls<3>& balls) : balls_(balls) {
    for (BeadId b = 0; b < balls.size(); ++b) {
      const btVector3 center(static_cast<btScalar>(balls.coordinate(b, 0)),
                             static_cast<btScalar>(balls.coordinate(b, 1)),
                             static_cast<btScalar>(balls.coordinate(b, 2)));
      const auto box = btDbvtVolume::FromCR(center, static_cast<btScalar>(balls.radius(b)));
      tree_.insert(box, nullptr)->dataAsInt = static_cast<int>(b);
    }
    tree_.optimizeTopDown();
  }
  std::size_t pairs() override {
    pairs_ = 0;
    tree_.collideTT(tree_.m_root, tree_.m_root, *this);
    return pairs_;
  }

 private:
  void Process(const btDbvtNode* a, const btDbvtNode* b) override {
    const auto bead_of = [](const btDbvtNode* node) { return static_cast<std::size_t>(node->dataAsInt); };
    pairs_ += are_counted(balls_, bead_of(a), bead_of(b)) ? 1 : 0;
  }

  const Balls<3>& balls_;
  btDbvt tree_;
  std::size_t pairs_ = 0;
};
#endif

template <class Tree>
[[maybe_unused]] std::unique_ptr<PeerTree> build(const Balls<3>& balls) {
  return std::make_unique<Tree>(balls);
}

}  // namespace

std::span<const CollisionPeer> collision_peers() {
  static const std::vector<CollisionPeer> peers{
#ifdef KDS_FCL
      {"FCL dynamic AABB tree, built before", build<FclTree>},
#endif
#ifdef KDS_BULLET
      {"Bullet btDbvt, built before", build<BulletTree>},
#endif
  };
  return peers;
}

std::optional<bool> fcl_collides([[maybe_unused]] ImpactKind kind,
                                 [[maybe_unused]] std::span<const double> points) {
#ifdef KDS_FCL
  using Intersect = fcl::detail::Intersect<double>;
  const auto at = [&](std::size_t point, std::size_t end) {
    const double* const p = &points[6 * point + 3 * end];
    return fcl::Vector3<double>(p[0], p[1], p[2]);
  };
  double time = 0;
  fcl::Vector3<double> place;
  if (kind == ImpactKind::vertex_face)
    return Intersect::intersect_VF(at(1, 0), at(2, 0), at(3, 0), at(0, 0), at(1, 1), at(2, 1), at(3, 1),
                                   at(0, 1), &time, &place);
  return Intersect::intersect_EE(at(0, 0), at(1, 0), at(2, 0), at(3, 0), at(0, 1), at(1, 1), at(2, 1),
                                 at(3, 1), &time, &place);
#else
  return std::nullopt;
#endif
}

}  // namespace kds::bench
