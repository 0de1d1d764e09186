#include "experiments/questions/deformation.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>

namespace kds {

namespace {

using Vector = Eigen::Vector3d;

Vector bond_of(const Eigen::Matrix3Xd& chain, Eigen::Index bead) {
  return chain.col(bead + 1) - chain.col(bead);
}

std::optional<double> bending_angle(const Eigen::Matrix3Xd& chain, Eigen::Index bead) {
  const Vector a = -bond_of(chain, bead - 1), b = bond_of(chain, bead);
  if (a.isZero(0) || b.isZero(0)) return std::nullopt;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Returns the torsion angle of the bond from this bead to the next.
std::optional<double> torsion_angle(const Eigen::Matrix3Xd& chain, Eigen::Index bead) {
  const Vector a = bond_of(chain, bead - 1), b = bond_of(chain, bead), c = bond_of(chain, bead + 1);
  const Vector n = a.cross(b), m = b.cross(c);
  if (n.isZero(0) || m.isZero(0)) return std::nullopt;
  return std::atan2(b.norm() * a.dot(m), n.dot(m));
}

double half_square(const std::optional<double>& before, const std::optional<double>& after) {
  if (!before || !after) return 0;
  const double change = std::remainder(*after - *before, 2 * std::numbers::pi);
  return change * change / 2;
}

}  // namespace

Deformation deformation(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& after) {
  Deformation result;
  const Eigen::Index beads = before.cols();
  for (Eigen::Index bead = 1; bead + 1 < beads; ++bead)
    result.bending += half_square(bending_angle(before, bead), bending_angle(after, bead));
  for (Eigen::Index bead = 1; bead + 2 < beads; ++bead)
    result.torsion += half_square(torsion_angle(before, bead), torsion_angle(after, bead));
  return result;
}

Eigen::Matrix3Xd chain_of(const ChainAngles& angles, double bond) {
  const auto beads = static_cast<Eigen::Index>(angles.bending.size()) + 2;
  Eigen::Matrix3Xd chain = Eigen::Matrix3Xd::Zero(3, beads);
  Vector along = Vector::UnitX(), normal = Vector::UnitZ();
  chain.col(1) = bond * along;
  for (Eigen::Index bead = 2; bead < beads; ++bead) {
    const auto k = static_cast<std::size_t>(bead - 2);
    if (k > 0) normal = Eigen::AngleAxisd(angles.torsion[k - 1], along) * normal;
    along = Eigen::AngleAxisd(std::numbers::pi - angles.bending[k], normal) * along;
    along.normalize();
    normal = (normal - normal.dot(along) * along).normalized();
    chain.col(bead) = chain.col(bead - 1) + bond * along;
  }
  return chain;
}

}  // namespace kds
