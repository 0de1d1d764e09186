#pragma once
// The float filter of power tests (float_filter.h), cell by cell, behind calls by batches: compiled once a
// dimension, for motions of degrees 1 and 3 and lifted motion. What is not found positive is not known.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "certificates/base/kernel.h"
#include "motions/base/bead.h"
#include "motions/curves/motion_ref.h"
#include "motions/views/length_unit.h"

namespace kds {

inline constexpr std::size_t cells_in_batch = 8;

/// The beads of each cell, then beads beyond facets of it.
template <int Dimension>
using CellsInLanes =
    std::array<std::array<BeadId, 2 * (static_cast<std::size_t>(Dimension) + 1)>, cells_in_batch>;

/// Of each cell one bit for each bead beyond, in that order: its power test with the cell is proven positive
/// all over the step. Two more: the cell is proven positive where the step ends, and all over the step. A
/// filter of parts tells in the next three bytes the same of the step's first half, quarter and eighth; only
/// not of cells where these end alone.
using PositiveBits = std::array<std::uint32_t, cells_in_batch>;
inline constexpr int positive_parts = 3, bits_of_part = 8;
template <int Dimension>
inline constexpr unsigned positive_at_end = 2U << Dimension;
template <int Dimension>
inline constexpr unsigned positive_throughout = 4U << Dimension;

template <int Dimension>
class CellFilter {
 public:
  virtual ~CellFilter() = default;

  /// Of eight cells the first `beyond` beads beyond each.
  virtual void positive_cells(const CellsInLanes<Dimension>& cells, std::size_t beyond,
                              const LengthUnit& unit, Rounding rounding, PositiveBits& positive) const = 0;
  /// The first four cells alone, with all beads beyond them.
  virtual void four_positive_cells(const CellsInLanes<Dimension>& cells, const LengthUnit& unit,
                                   Rounding rounding, PositiveBits& positive) const = 0;
};

/// What is told: of cells with no beads beyond them their sign at the end of the step alone, and nothing of
/// parts; or, for a motion of degree 1, all.
enum class FilterOf : std::uint8_t { step, parts };

/// Where nothing is compiled for the motion's degree it finds nothing positive.
template <int Dimension>
[[nodiscard]] std::unique_ptr<CellFilter<Dimension>> cell_filter_over(const MotionRef<Dimension>& motion,
                                                                      FilterOf told = FilterOf::step);
/// The same as on processors without long vectors, for tests.
template <int Dimension>
[[nodiscard]] std::unique_ptr<CellFilter<Dimension>> cell_filter_for_any_processor(
    const MotionRef<Dimension>& motion);

}  // namespace kds
