#include "structures/collision/separation.h"

#include "structures/necklace/ball_distance.h"

namespace kds {

int compare_separation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s,
                       double distance) {
  if (distance == 0) return compare_distance(a, b, r, s);
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero(), beyond(distance, 0, 0);
  return compare_gaps(a, b, {r, s}, origin, beyond, {});
}

}  // namespace kds
