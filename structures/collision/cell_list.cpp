#include "structures/collision/cell_list.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "motions/base/floating_point_scope.h"
#include "motions/base/interruption.h"
#include "motions/numbers/lanes.h"

namespace kds {

template <int Dimension>
CellList<Dimension>::CellList(PairsAsked asked)
    : asked_(std::move(asked)), one_necklace_(asked_.necklaces.size() == 1 && asked_.at_rest.empty()) {
  check_groups(asked_);
  if (one_necklace_) least_along_ = asked_.within ? asked_.apart : std::int64_t{no_bead} + 1;
}

// Scaled coordinates X have errors of at most 2^-53 of the conversion's bound M. If two balls meet, the
// distance of their X exceeds the sum of their radii by at most 2^-50 M; the squared excess, with all
// roundings, is less than `compare` allows. A cell is wider than the reach of any two balls by 2^-20 of its
// width, and its number, below 2^20, has an error below 2^-30.
template <int Dimension>
auto CellList<Dimension>::lay_grid(const Balls<Dimension>& balls, double gap) const -> Grid {
  const SceneBox<Dimension> box = scene_box(balls);
  Grid grid;
  grid.conversion = fit_float_conversion(box, gap);
  const double scale = grid.conversion.scale;
  grid.gap = gap * scale + 0x1p-49 * grid.conversion.bound;
  const double largest = box.largest_radius * scale;
  std::array<double, dimension> length;
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    grid.low[axis] = box.low[axis] * scale - grid.conversion.shift[axis];
    length[axis] = box.high[axis] * scale - grid.conversion.shift[axis] - grid.low[axis];
  }
  const double longest = *std::max_element(length.begin(), length.end());
  const double side =
      std::max({(2 * largest + grid.gap) * (1 + 0x1p-20), longest * 0x1p-20, 0x1p-100}) * (1 + 0x1p-40);
  grid.cells_a_length = 1 / side;
  grid.keys = 1;
  // One empty cell on each side, so that keys of adjacent cells differ by strides.
  for (std::size_t axis = dimension; axis-- > 0;) {
    grid.stride[axis] = grid.keys;
    grid.keys *= static_cast<std::uint64_t>(length[axis] * grid.cells_a_length) + 3;
  }
  return grid;
}

template <int Dimension>
auto CellList<Dimension>::entry_of(const Balls<Dimension>& balls, const Grid& grid, BeadId bead) const
    -> BeadInCell {
  BeadInCell entry;
  for (std::size_t axis = 0; axis < dimension; ++axis)
    entry.center[axis] = balls.coordinates(axis)[bead] * grid.conversion.scale - grid.conversion.shift[axis];
  entry.bead = bead;
  return entry;
}

template <int Dimension>
void CellList<Dimension>::find_keys(const Balls<Dimension>& balls, const Grid& grid) {
  keys_of_beads_.assign(balls.size(), 0);
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    const double* x = balls.coordinates(axis);
    for (std::size_t b = 0; b < balls.size(); ++b) {
      const double along = x[b] * grid.conversion.scale - grid.conversion.shift[axis] - grid.low[axis];
      const auto cell = static_cast<std::uint64_t>(static_cast<std::int64_t>(along * grid.cells_a_length));
      keys_of_beads_[b] += (cell + 1) * grid.stride[axis];
    }
  }
}

template <int Dimension>
void CellList<Dimension>::count_out(const Balls<Dimension>& balls, const Grid& grid) {
  const std::size_t beads = balls.size();
  starts_.assign(grid.keys + 1, 0);
  for (const std::uint64_t key : keys_of_beads_) ++starts_[key + 1];
  for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  for (std::size_t b = 0; b < beads; ++b) {
    // Filling a cell moves its start to its end, which is the next cell's start.
    const std::uint32_t at = starts_[keys_of_beads_[b]]++;
    entries_[at] = entry_of(balls, grid, static_cast<BeadId>(b));
    keys_[at] = keys_of_beads_[b];
  }
}

template <int Dimension>
void CellList<Dimension>::sort_by_radix(const Balls<Dimension>& balls, const Grid& grid) {
  const std::size_t beads = balls.size();
  keyed_.resize(beads);
  more_keyed_.resize(beads);
  for (std::size_t b = 0; b < beads; ++b) keyed_[b] = {keys_of_beads_[b], b};
  constexpr int digit = 11;
  constexpr std::uint64_t mask = (1U << digit) - 1;
  std::array<std::uint32_t, mask + 2> starts;
  for (int shift = 0; shift < static_cast<int>(std::bit_width(grid.keys)); shift += digit) {
    starts.fill(0);
    for (const auto& keyed : keyed_) ++starts[(keyed[0] >> shift & mask) + 1];
    for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
    for (const auto& keyed : keyed_) more_keyed_[starts[keyed[0] >> shift & mask]++] = keyed;
    keyed_.swap(more_keyed_);
  }
  for (std::size_t k = 0; k < beads; ++k) {
    keys_[k] = keyed_[k][0];
    entries_[k] = entry_of(balls, grid, static_cast<BeadId>(keyed_[k][1]));
  }
}

// The entries around a cell are listed first. Each bead then scans one list of known length instead of five
// short lists whose ends mislead branch prediction.
template <int Dimension>
void CellList<Dimension>::list_more(std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t at_once = 4;
  if (around_.size() < listed_ + (last - first) + at_once)
    around_.resize(2 * (listed_ + (last - first) + 64));
  std::uint32_t* out = around_.data() + listed_;
  for (std::uint32_t k = 0; k < at_once; ++k) out[k] = first + k;
  listed_ += last - first;
  for (std::uint32_t k = at_once; first + k < last; ++k) out[k] = first + k;
}

template <int Dimension>
template <bool Equal>
void CellList<Dimension>::compare_cell(const Balls<Dimension>& balls, std::uint32_t begin, std::uint32_t end,
                                       const Grid& grid) {
  const double reach_of_equal = 2 * balls.radius(0) * grid.conversion.scale + grid.gap;
  double limit = reach_of_equal * reach_of_equal * (1 + 0x1p-40) + 0x1p-1000;
  for (std::uint32_t e = begin; e < end; ++e) {
    const BeadInCell& entry = entries_[e];
    for (std::size_t k = e - begin + 1; k < listed_; ++k) {
      const BeadInCell& other = entries_[around_[k]];
      double square = 0;
      for (std::size_t axis = 0; axis < dimension; ++axis) {
        const double d = entry.center[axis] - other.center[axis];
        square += d * d;
      }
      if constexpr (!Equal) {
        const double reach =
            (balls.radii()[entry.bead] + balls.radii()[other.bead]) * grid.conversion.scale + grid.gap;
        limit = reach * reach * (1 + 0x1p-40) + 0x1p-1000;
      }
      // Neighbours along the chain are always near, so both conditions form a single branch.
      const std::int64_t along = std::int64_t{entry.bead} - std::int64_t{other.bead};
      if (static_cast<unsigned>(square <= limit) & static_cast<unsigned>(std::abs(along) >= least_along_)) {
        const BeadPair pair{std::min(entry.bead, other.bead), std::max(entry.bead, other.bead)};
        if (one_necklace_ ? asked_.joins_groups(pair) : asked_.asks(pair)) candidates_.push_back(pair);
      }
    }
  }
}

template <int Dimension>
template <bool Equal>
void CellList<Dimension>::look_around(const Balls<Dimension>& balls, const Grid& grid) {
  const std::uint64_t* keys = keys_.data();
  const auto beads = static_cast<std::uint32_t>(entries_.size());
  const bool dense = grid.is_dense(beads);
  const std::uint64_t row = grid.stride[dimension - 2], layer = dimension == 3 ? grid.stride[0] : 0;
  const std::array<std::uint64_t, 4> ahead{row, layer - row, layer, layer + row};
  constexpr std::size_t rows = dimension == 3 ? 4 : 1;
  std::array<std::uint32_t, 4> from{};  // sorted form: the first entry in or after a row of cells
  for (std::uint32_t begin = 0, end; begin < beads; begin = end) {
    InterruptionCheck::ask();
    const std::uint64_t key = keys[begin];
    end = begin + 1;
    while (keys[end] == key) ++end;
    std::uint32_t next_end = end;
    while (keys[next_end] == key + 1) ++next_end;
    listed_ = 0;
    list_more(begin, next_end);
    if (dense) {  // starts_[k] is the end of cell k and the start of the next
      for (std::size_t r = 0; r < rows; ++r)
        list_more(starts_[key + ahead[r] - 2], starts_[key + ahead[r] + 1]);
    } else {
      for (std::size_t r = 0; r < rows; ++r) {
        const std::uint64_t middle = key + ahead[r];
        while (keys[from[r]] < middle - 1) ++from[r];
        std::uint32_t to = from[r];
        while (keys[to] <= middle + 1) ++to;
        if (to > from[r]) list_more(from[r], to);
      }
    }
    compare_cell<Equal>(balls, begin, end, grid);
  }
}

template <int Dimension>
std::span<const BeadPair> CellList<Dimension>::near_pairs(const Balls<Dimension>& balls, double gap) {
  const FloatingPointScope to_nearest;
  const std::size_t beads = asked_.necklaces.empty() ? 0 : std::size_t{asked_.necklaces.back().last} + 1;
  if (balls.size() != beads) throw std::invalid_argument("balls and necklaces must be of the same beads");
  candidates_.clear();
  if (beads == 0) return candidates_;
  const Grid grid = lay_grid(balls, gap);
  find_keys(balls, grid);
  entries_.resize(beads);
  keys_.resize(beads + 1);
  keys_[beads] = ~std::uint64_t{0};
  grid.is_dense(beads) ? count_out(balls, grid) : sort_by_radix(balls, grid);
  balls.equal_radii() ? look_around<true>(balls, grid) : look_around<false>(balls, grid);
  return candidates_;
}

template <int Dimension>
const std::vector<BeadPair>& CellList<Dimension>::pairs_within(const Balls<Dimension>& balls,
                                                               double distance) {
  const FloatingPointScope to_nearest;
  pairs_.clear();
  for (const BeadPair& pair : near_pairs(balls, distance))
    if (distance == 0 ? balls_meet(balls, pair.first, pair.second)
                      : balls_within(balls, pair.first, pair.second, distance))
      pairs_.push_back(pair);
  sorter_.sort(pairs_, balls.size());
  return pairs_;
}

template class CellList<2>;
template class CellList<3>;

namespace {

/// Returns the greatest squared displacement of any of these points, given by rows with the numbers of one
/// axis.
template <std::size_t Dimension>
[[KDS_LANES_TARGETS]] double greatest_square(const std::array<const double*, Dimension>& now,
                                             const std::array<const double*, Dimension>& before,
                                             std::size_t count) {
  Lanes greatest(0.0);
  std::size_t b = 0;
  for (; b + Lanes::width <= count; b += Lanes::width) {
    Lanes square(0.0);
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const Lanes d(Lanes::load(now[axis] + b) - Lanes::load(before[axis] + b));
      square += d * d;
    }
    greatest = Lanes::max(greatest, square);
  }
  double result = 0;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane)
    result = greatest.v[lane] > result ? greatest.v[lane] : result;
  for (; b < count; ++b) {
    double square = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double d = now[axis][b] - before[axis][b];
      square += d * d;
    }
    result = square > result ? square : result;
  }
  return result;
}

}  // namespace

template <int Dimension>
bool VerletList<Dimension>::holds(const Balls<Dimension>& balls) const {
  if (made_at_[0].empty() || made_at_[0].size() != balls.size()) return false;
  const double limit = 0.25 * skin_ * skin_ * (1 - 0x1p-40);
  if (!(limit >= 0x1p-900 && limit <= 0x1p900)) return false;
  std::array<const double*, dimension> now, before;
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    now[axis] = balls.coordinates(axis);
    before[axis] = made_at_[axis].data();
  }
  return greatest_square<dimension>(now, before, balls.size()) <= limit;
}

template <int Dimension>
void VerletList<Dimension>::rebuild(const Balls<Dimension>& balls) {
  ++rebuilds_;
  const auto near = cells_.near_pairs(balls, skin_);
  near_.assign(near.begin(), near.end());
  sorter_.sort(near_, balls.size());
  starts_.assign(balls.size() + 1, 0);
  others_.clear();
  for (const BeadPair& pair : near_) {
    ++starts_[pair.first + 1];
    others_.push_back(pair.second);
  }
  for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    const double* x = balls.coordinates(axis);
    made_at_[axis].assign(x, x + balls.size());
  }
}

template <int Dimension>
const std::vector<BeadPair>& VerletList<Dimension>::pairs(const Balls<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  if (!holds(balls)) rebuild(balls);
  pairs_.clear();
  const MeetingBalls meet(balls);
  for (BeadId a = 0; a < balls.size(); ++a) {
    for (std::uint32_t k = starts_[a]; k < starts_[a + 1]; ++k)
      if (meet(a, others_[k])) pairs_.push_back({a, others_[k]});
  }
  return pairs_;
}

template class VerletList<2>;
template class VerletList<3>;

}  // namespace kds
