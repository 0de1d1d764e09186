#pragma once
// The float filter of power tests (float_filter.h) for whole cells, behind virtual calls on batches. The
// filter is compiled once per dimension, for motions of degrees 1 and 3 and for lifted motion. Tests not
// proved positive are undecided.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "motions/base/bead.h"
#include "motions/curves/motion_ref.h"
#include "motions/views/lanes_view.h"

namespace kds {

inline constexpr std::size_t cells_in_batch = 8;

/// The beads of each cell, followed by the beads beyond its facets.
template <int Dimension>
using CellsInLanes =
    std::array<std::array<BeadId, 2 * (static_cast<std::size_t>(Dimension) + 1)>, cells_in_batch>;

/// The bits of each cell, in this order:
///
/// - one bit per bead beyond: its power test with the cell is proved positive on the whole step,
/// - one bit: the cell is proved positive at the end of the step,
/// - one bit: the cell is proved positive on the whole step.
///
/// With FilterOf::parts, the next three bytes say the same for the step's first half, quarter and eighth,
/// except that they leave out the bit for the end of the part.
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

  /// Tests eight cells with the first `beyond` beads beyond each.
  virtual void positive_cells(const CellsInLanes<Dimension>& cells, std::size_t beyond,
                              const LengthUnit& unit, PositiveBits& positive) const = 0;
  /// Tests only the first four cells, with all beads beyond them.
  virtual void four_positive_cells(const CellsInLanes<Dimension>& cells, const LengthUnit& unit,
                                   PositiveBits& positive) const = 0;
};

/// The answers requested. `step`: nothing about parts, and for cells without beads beyond them only their
/// sign at the end of the step. `parts`: all bits, for a motion of degree 1.
enum class FilterOf : std::uint8_t { step, parts };

/// Returns the filter for a motion. If nothing is compiled for the motion's degree, the filter proves nothing
/// positive.
template <int Dimension>
[[nodiscard]] std::unique_ptr<CellFilter<Dimension>> cell_filter_over(const MotionRef<Dimension>& motion,
                                                                      FilterOf told = FilterOf::step);
/// Returns the filter for processors without long vectors, for tests.
template <int Dimension>
[[nodiscard]] std::unique_ptr<CellFilter<Dimension>> cell_filter_for_any_processor(
    const MotionRef<Dimension>& motion);

}  // namespace kds
