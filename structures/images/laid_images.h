#pragma once
// The images of beads in a periodic cell at one time, found without the search of near_images.h: for audits
// and for collisions at frames.

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "motions/curves/curves.h"
#include "motions/curves/positions.h"
#include "motions/frames/periodic.h"
#include "motions/numbers/bernstein.h"
#include "motions/scene/near_pairs.h"
#include "structures/images/shifted_beads.h"

namespace kds {

/// The beads at one time, each moved into the cell, and the images around it that may be within reach.
template <int D>
class LaidImages {
 public:
  /// Lays the images of a motion's balls at a time.
  LaidImages(const Curves<D>& curves, double u) : LaidImages(curves, u, approximate_radii(curves, u)) {}
  /// Lays those of balls with other radii, one for each bead.
  LaidImages(const Curves<D>& curves, double u, std::vector<double> radii)
      : LaidImages(approximate_positions(curves, u), std::move(radii), cell_at(curves, u)) {}
  /// Lays those of balls in a cell.
  LaidImages(const Eigen::Matrix3Xd& centers, std::vector<double> radii, const Cell& vectors)
      : images_(vectors), beads_(static_cast<BeadId>(radii.size())), radii_(std::move(radii)) {
    const Eigen::Matrix3d cell = images_.reduced();  // multiples below are of these vectors
    // The rows of vectors that span nothing are zero.
    const Eigen::Matrix3d inverse = cell.completeOrthogonalDecomposition().pseudoInverse();
    double reach = 0;
    for (const double radius : radii_) reach = std::max(reach, 2 * radius);
    homes_.resize(beads_);
    largest_ = std::max(reach, centers.cwiseAbs().maxCoeff());
    for (BeadId bead = 0; bead < beads_; ++bead) {
      for (Eigen::Index a = 0; a < D; ++a)
        homes_[bead][static_cast<std::size_t>(a)] =
            static_cast<std::int32_t>(std::floor(inverse.row(a).dot(centers.col(bead))));
      add(bead, centers.col(bead) - vector_of(homes_[bead], cell), {});
    }
    CellShift<D> most{};
    for (Eigen::Index a = 0; a < D; ++a)
      most[static_cast<std::size_t>(a)] =
          static_cast<std::int32_t>(std::ceil(inverse.row(a).norm() * (reach + 0x1p-30 * largest_)));
    CellShift<D> shift{};
    for (std::size_t a = 0; a < shift.size(); ++a) shift[a] = -most[a] - (most[a] > 0 ? 1 : 0);
    const CellShift<D> first = shift;
    for (bool more = true; more;) {
      if (shift != CellShift<D>{})
        for (BeadId bead = 0; bead < beads_; ++bead) {
          const Eigen::Vector3d point = points_[bead] + vector_of(shift, cell);
          const Eigen::Vector3d away = inverse * point;
          bool is_near = true;
          for (Eigen::Index a = 0; a < D; ++a) {
            const double spare = inverse.row(a).norm() * (reach + 0x1p-30 * largest_);
            is_near = is_near && away[a] >= -spare && away[a] <= 1 + spare;
          }
          if (is_near) add(bead, point, shift);
        }
      more = false;
      for (std::size_t a = 0; a < shift.size() && !more; ++a) {
        more = ++shift[a] <= -first[a];
        if (!more) shift[a] = first[a];
      }
    }
  }

  /// Calls visit(a, b, shift of b, gap) for the images of beads a < b that are near or may be.
  template <class Visit>
  void visit_near(Visit visit) const {
    Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(points_.size()));
    std::vector<double> larger;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      points.col(static_cast<Eigen::Index>(i)) = points_[i];
      larger.push_back(radii_[of_[i]] + 4 * spare());
    }
    visit_near_pairs(points, larger, [&](BeadId i, BeadId j) {
      if (i >= beads_) return;  // two images, which are met elsewhere
      const bool in_order = of_[i] < of_[j];
      if (of_[i] == of_[j] || (j >= beads_ && !in_order)) return;
      CellShift<D> shift = shifts_[j];
      for (std::size_t a = 0; a < shift.size(); ++a) {
        shift[a] += homes_[of_[i]][a] - homes_[of_[j]][a];
        if (!in_order) shift[a] = -shift[a];
      }
      CellShift<D> of_cell{};
      for (std::size_t v = 0; v < shift.size(); ++v)
        for (std::size_t a = 0; a < shift.size(); ++a)
          of_cell[v] += shift[a] * static_cast<std::int32_t>(images_.steps()(static_cast<Eigen::Index>(v),
                                                                             static_cast<Eigen::Index>(a)));
      const double gap = (points_[i] - points_[j]).stableNorm() - radii_[of_[i]] - radii_[of_[j]];
      visit(std::min(of_[i], of_[j]), std::max(of_[i], of_[j]), of_cell, gap);
    });
  }
  [[nodiscard]] bool is_clear(double gap) const { return std::abs(gap) > 4 * spare(); }
  /// Exceeds by far what the rounding of times, sums and squares can add to a distance.
  [[nodiscard]] double spare() const { return 0x1p-40 * largest_; }
  /// Returns the distance of the nearest images of two beads, rounded.
  [[nodiscard]] double distance(BeadId a, BeadId b) const {
    return images_.shortest(points_[b] - points_[a]).norm();
  }

 private:
  void add(BeadId bead, const Eigen::Vector3d& point, const CellShift<D>& shift) {
    points_.push_back(point);
    of_.push_back(bead);
    shifts_.push_back(shift);
    largest_ = std::max(largest_, point.cwiseAbs().maxCoeff());
  }
  static Eigen::Matrix3d cell_at(const Curves<D>& curves, double u) {
    Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();
    const int degree = curves.own_degree();
    for (int k = 0; k <= degree; ++k) {
      const double share =
          static_cast<double>(binomial(degree, k)) * std::pow(u, k) * std::pow(1 - u, degree - k);
      for (int vector = 0; vector < D; ++vector)
        for (int axis = 0; axis < D; ++axis)
          cell(axis, vector) += share * curves.cell_coordinate(vector, k, axis);
    }
    return cell;
  }

  Images images_;
  BeadId beads_;
  std::vector<double> radii_;
  std::vector<CellShift<D>> homes_;
  double largest_ = 0;
  std::vector<Eigen::Vector3d> points_;  // the beads, then their images
  std::vector<BeadId> of_;
  std::vector<CellShift<D>> shifts_;
};

}  // namespace kds
