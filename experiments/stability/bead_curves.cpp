#include "experiments/stability/bead_curves.h"

#include <fmt/format.h>

#include <utility>

namespace kds {

Instance BeadCurves::instance(std::string name) const {
  bool weighted = false;
  for (std::size_t bead = 0; bead < beads_; ++bead)
    for (int k = 0; k <= degree_; ++k) weighted |= dimension_ == 3 && weight(bead, k) != 0;
  Instance instance;
  instance.file = std::move(name);
  instance.columns = dimension_ + (weighted ? 1 : 0);
  instance.degree = degree_;
  for (std::size_t bead = 0; bead < beads_; ++bead)
    for (int column = 0; column < instance.columns; ++column)
      for (int k = 0; k <= degree_; ++k) instance.control_points.push_back(numbers_[at(bead, k, column)]);
  return instance;
}

std::string instance_text(const Instance& instance) {
  std::string text = fmt::format("{} {} {}\n", instance.point_count(), instance.columns, instance.degree);
  const auto a_line = static_cast<std::size_t>(instance.columns * (instance.degree + 1));
  for (std::size_t i = 0; i < instance.control_points.size(); ++i)
    text += fmt::format("{}{}", instance.control_points[i], (i + 1) % a_line == 0 ? '\n' : ' ');
  return text;
}

}  // namespace kds
