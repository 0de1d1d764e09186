#include "experiments/theorems/interleaved_grids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motions/models/shapes.h"

namespace kds {

namespace {

using Places = std::vector<Eigen::Vector3d>;

// Makes one layer of both chains. A pair of rows, one of each chain, is walked in one direction. In pair k,
// the first chain has row 2k if k is even, else row 2k + 1.
class Layer {
 public:
  Layer(std::size_t side, double gap)
      : side_(side),
        apart_(2 * models::radius * (1 + gap)),
        beside_(std::sqrt(step * step - apart_ * apart_ / 4)) {
    const std::size_t pairs = side / 2;
    for (std::size_t k = 0; k < pairs; ++k) {
      right_ = k % 2 == 0;
      for (const std::size_t chain : {0U, 1U}) {
        const std::size_t row = 2 * k + (k % 2 == chain ? 0 : 1);
        add_row(chain, row);
        if (k + 1 == pairs) continue;
        if (row % 2 == 1)
          chains_[chain].push_back(inner_turn(row));
        else
          add_outer_turn(chain, row);
      }
    }
  }

  [[nodiscard]] const Places& of(std::size_t chain) const { return chains_[chain]; }
  [[nodiscard]] double apart() const { return apart_; }
  [[nodiscard]] double beside() const { return beside_; }
  /// 1 if the layer ends at the right, else -1.
  [[nodiscard]] double end() const { return right_ ? 1 : -1; }

 private:
  static constexpr double step = 2 * models::radius * models::usual_bond;

  [[nodiscard]] double outward() const { return right_ ? 1 : -1; }
  [[nodiscard]] double x_of_end() const { return right_ ? step * static_cast<double>(side_ - 1) : 0; }
  [[nodiscard]] double y_of(std::size_t row) const { return apart_ * static_cast<double>(row); }

  void add_row(std::size_t chain, std::size_t row) {
    for (std::size_t i = 0; i < side_; ++i)
      chains_[chain].emplace_back(step * static_cast<double>(right_ ? i : side_ - 1 - i), y_of(row), 0);
  }
  [[nodiscard]] Eigen::Vector3d inner_turn(std::size_t row) const {
    return {x_of_end() + outward() * beside_, y_of(row) + apart_ / 2, 0};
  }
  // Goes straight on until the inner turn is clear, then along y past three gaps of rows, and back.
  void add_outer_turn(std::size_t chain, std::size_t row) {
    const auto beyond = static_cast<std::size_t>(std::ceil((beside_ + apart_) / step));
    const auto across = static_cast<std::size_t>(std::ceil(3 * apart_ / step));
    const auto add = [&](std::size_t out, std::size_t up) {
      chains_[chain].emplace_back(
          x_of_end() + outward() * step * static_cast<double>(out),
          y_of(row) + 3 * apart_ * static_cast<double>(up) / static_cast<double>(across), 0);
    };
    for (std::size_t out = 1; out < beyond; ++out) add(out, 0);
    for (std::size_t up = 0; up <= across; ++up) add(beyond, up);
    for (std::size_t out = beyond; out-- > 1;) add(out, across);
  }

  std::size_t side_;
  double apart_, beside_;
  bool right_ = true;
  std::array<Places, 2> chains_;
};

Eigen::Matrix3Xd stacked(const Layer& layer, std::size_t chain, std::size_t layers) {
  Places places;
  for (std::size_t l = 0; l < layers; ++l) {
    const Eigen::Vector3d up(0, 0, layer.apart() * static_cast<double>(l));
    Places next = layer.of(chain);
    if (l % 2 == 1) std::ranges::reverse(next);
    for (const Eigen::Vector3d& place : next) places.push_back(place + up);
    if (l + 1 == layers) break;
    const double out = l % 2 == 0 ? layer.end() : -1;  // every layer begins at the left
    places.push_back(places.back() + Eigen::Vector3d(out * layer.beside(), 0, layer.apart() / 2));
  }
  Eigen::Matrix3Xd centers(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t b = 0; b < places.size(); ++b) centers.col(static_cast<Eigen::Index>(b)) = places[b];
  return centers;
}

}  // namespace

TwoChains interleaved_grids(std::size_t side, int dimension, double gap) {
  const Layer layer(side, gap);
  const std::size_t layers = dimension == 2 ? 1 : side;
  return {stacked(layer, 0, layers), stacked(layer, 1, layers)};
}

}  // namespace kds
