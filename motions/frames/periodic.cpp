#include "motions/frames/periodic.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

namespace kds {

namespace {

// Shifts are counted in cell vectors, whole numbers held in doubles.
class Images {
 public:
  explicit Images(const Cell& cell) : cell_(cell), inverse_(cell.inverse()) {
    upright_ = cell_ == Cell(cell_.diagonal().asDiagonal());
  }

  // The shift that makes `difference` shortest; none where the present one is as short.
  Eigen::Vector3d nearest(const Eigen::Vector3d& difference) const {
    const Eigen::Vector3d guess = -(inverse_ * difference).array().round().matrix();
    // Farther off than any real file, and where the sums below would lose their digits.
    if (!(guess.cwiseAbs().maxCoeff() < 1e6)) return Eigen::Vector3d::Zero();
    Eigen::Vector3d best = Eigen::Vector3d::Zero();
    double shortest = difference.squaredNorm();
    const int reach = upright_ ? 0 : 1;  // in a skew cell rounding may miss the nearest by one
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        for (int k = -reach; k <= reach; ++k) {
          const Eigen::Vector3d shift = guess + Eigen::Vector3d(i, j, k);
          const double length = (difference + cell_ * shift).squaredNorm();
          if (length < shortest) {
            shortest = length;
            best = shift;
          }
        }
    return best;
  }

  Eigen::Vector3d shifted(const Eigen::Vector3d& point, const Eigen::Vector3d& shift) const {
    if (shift.isZero(0)) return point;
    return point + cell_ * shift;
  }

 private:
  Cell cell_;
  Cell inverse_;
  bool upright_;
};

// Returns the centroid.
Eigen::Vector3d make_frame_whole(WholeChain::Frame frame, const Images& images,
                                 const std::optional<Eigen::Vector3d>& last_centroid, bool& moved) {
  Eigen::Matrix3Xd shifts = Eigen::Matrix3Xd::Zero(3, frame.cols());
  Eigen::Matrix3Xd whole = frame;
  for (Eigen::Index i = 1; i < frame.cols(); ++i) {
    const Eigen::Vector3d before = images.shifted(frame.col(i), shifts.col(i - 1));
    shifts.col(i) = shifts.col(i - 1) + images.nearest(before - whole.col(i - 1));
    whole.col(i) = images.shifted(frame.col(i), shifts.col(i));
  }
  if (last_centroid) {
    const Eigen::Vector3d all = images.nearest(whole.rowwise().mean() - *last_centroid);
    if (!all.isZero(0)) {
      shifts.colwise() += all;
      for (Eigen::Index i = 0; i < frame.cols(); ++i)
        whole.col(i) = images.shifted(frame.col(i), shifts.col(i));
    }
  }
  moved = !shifts.isZero(0);
  frame = whole;
  return frame.rowwise().mean();
}

}  // namespace

std::optional<Cell> cell_from_lengths(const Eigen::Vector3d& lengths, const Eigen::Vector3d& cosines) {
  if (!lengths.allFinite() || !cosines.allFinite() || lengths.minCoeff() <= 1) return std::nullopt;
  const auto [cos_alpha, cos_beta, cos_gamma] = std::array{cosines[0], cosines[1], cosines[2]};
  const double sin_gamma = std::sqrt(1 - cos_gamma * cos_gamma);
  const double y = (cos_alpha - cos_beta * cos_gamma) / sin_gamma;
  const double z = std::sqrt(1 - cos_beta * cos_beta - y * y);
  if (!(sin_gamma > 1e-3 && z > 1e-3)) return std::nullopt;  // NaN too
  Cell cell;
  cell << lengths[0], lengths[1] * cos_gamma, lengths[2] * cos_beta,  //
      0, lengths[1] * sin_gamma, lengths[2] * y,                      //
      0, 0, lengths[2] * z;
  if (!cell.allFinite() || !cell.inverse().allFinite()) return std::nullopt;
  return cell;
}

std::optional<Cell> cell_from_angles(const Eigen::Vector3d& lengths, const Eigen::Vector3d& degrees) {
  const auto cosine = [](double angle) {
    return angle == 90 ? 0.0 : std::cos(angle * std::numbers::pi / 180);
  };
  return cell_from_lengths(lengths, {cosine(degrees[0]), cosine(degrees[1]), cosine(degrees[2])});
}

bool WholeChain::make_whole(Frame frame, const std::optional<Cell>& cell) {
  if (!cell || frame.cols() == 0) {
    last_centroid_.reset();
    return false;
  }
  bool moved = false;
  last_centroid_ = make_frame_whole(frame, Images(*cell), last_centroid_, moved);
  return moved;
}

}  // namespace kds
