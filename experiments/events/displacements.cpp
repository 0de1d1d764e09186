#include "experiments/events/displacements.h"

#include <algorithm>
#include <utility>

namespace kds {

void Displacements::add_frame(Eigen::Matrix3Xd centers, std::size_t number) {
  if (last_.cols() > 0) {
    if (steps_ % width_ == 0) bins_.push_back({number_, 0, 0, 0});
    Bin& bin = bins_.back();
    const Eigen::VectorXd moved = (centers - last_).colwise().norm();
    ++steps_;
    ++bin.steps;
    bin.sum_of_means += moved.mean();
    bin.most = std::max(bin.most, moved.maxCoeff());
  }
  last_ = std::move(centers);
  number_ = number;
}

}  // namespace kds
