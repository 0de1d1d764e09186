#include "experiments/collide/contact_map.h"

#include <fmt/format.h>

#include "experiments/output/page/svg_plot.h"

namespace kds {

ContactMap::ContactMap(std::size_t beads)
    : beads_(beads),
      in_group_((beads + most_groups - 1) / most_groups),
      groups_((beads + in_group_ - 1) / in_group_),
      counts_(groups_ * groups_, 0) {}

void ContactMap::add_frame(std::span<const BeadPair> pairs) {
  ++frames_;
  pairs_ += pairs.size();
  for (const auto& [i, j] : pairs) ++counts_[i / in_group_ * groups_ + j / in_group_];
}

std::string ContactMap::plot() const {
  const auto side = static_cast<double>(in_group_);
  MapPlot map{
      "bead", in_group_ == 1 ? "share of frames" : fmt::format("pairs a frame of {} beads each", in_group_),
      -0.5,   static_cast<double>(beads_) - 0.5,
      side,   {}};
  const auto middle = [&](std::size_t group) { return side * (static_cast<double>(group) + 0.5) - 0.5; };
  for (std::size_t i = 0; i < groups_; ++i) {
    for (std::size_t j = i; j < groups_; ++j) {
      const std::uint64_t count = counts_[i * groups_ + j];
      if (count == 0) continue;
      const double value = static_cast<double>(count) / static_cast<double>(frames_);
      map.squares.push_back({middle(i), middle(j), value});
      if (i != j) map.squares.push_back({middle(j), middle(i), value});
    }
  }
  return svg_plot(map);
}

}  // namespace kds
