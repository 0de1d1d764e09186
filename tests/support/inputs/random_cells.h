#pragma once
// Random motions in periodic cells.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "motions/base/bead.h"
#include "motions/frames/periodic.h"
#include "tests/support/inputs/random.h"

namespace kds::test {

[[nodiscard]] inline Cell box(double x, double y, double z) { return Eigen::Vector3d(x, y, z).asDiagonal(); }

/// The kinds of cells of random scenes.
enum class CellKind { box, small, skewed, changing, one_vector, two_vectors };

/// Returns the kinds that have a cell in this dimension.
[[nodiscard]] inline std::vector<CellKind> cell_kinds(int dimension) {
  std::vector<CellKind> kinds{CellKind::box, CellKind::small, CellKind::skewed, CellKind::changing,
                              CellKind::one_vector};
  if (dimension > 2) kinds.push_back(CellKind::two_vectors);
  return kinds;
}

[[nodiscard]] inline Cell random_cell(Random& random, CellKind kind, int dimension) {
  const auto whole = [&](int from, int to) { return static_cast<double>(pick(random, from, to)); };
  Cell cell = box(whole(6, 9), whole(6, 9), whole(6, 9));
  if (kind == CellKind::small) cell = box(whole(2, 4), whole(2, 4), whole(2, 4));
  if (kind == CellKind::skewed || kind == CellKind::changing) {
    cell(0, 1) = 0.5 * whole(-6, 6);
    cell(0, 2) = 0.5 * whole(-6, 6);
    cell(1, 2) = 0.5 * whole(-6, 6);
  }
  if (kind == CellKind::one_vector) cell.rightCols(2).setZero();
  if (kind == CellKind::two_vectors) cell.col(1).setZero();
  if (dimension == 2) {
    cell.col(2).setZero();
    cell.row(2).setZero();
  }
  return cell;
}

/// Returns two steps of beads in a cell, on a grid of halves or anywhere.
template <class M>
[[nodiscard]] std::vector<M> random_steps_in_cell(Random& random, CellKind kind, std::size_t beads,
                                                  bool on_grid) {
  std::vector<M> steps;
  Cell start = random_cell(random, kind, M::dimension);
  for (int s = 0; s < 2; ++s) {
    M& step = steps.emplace_back(beads);
    Cell end = start;
    if (kind == CellKind::changing)
      for (int i = 0; i < M::dimension; ++i)
        for (int j = 0; j < M::dimension; ++j) end(i, j) += 0.125 * pick(random, -3, 3);
    for (BeadId b = 0; b < beads; ++b) {
      for (int k = 0; k <= M::degree; ++k) {
        step.set_radius(b, k, b % 3 == 0 ? 1 : 0.5);
        for (int axis = 0; axis < M::dimension; ++axis) {
          double x = on_grid ? 0.5 * pick(random, -8, 16) : 6 * uniform(random);
          if (k > 0 && !on_grid) x = step.coordinate(b, 0, axis) + 2 * uniform(random);
          if (s > 0 && k == 0) x = steps[0].coordinate(b, M::degree, axis);
          step.set_coordinate(b, k, axis, x);
        }
      }
    }
    step.own_cell().set(start, end, M::degree);
    start = end;
  }
  return steps;
}

}  // namespace kds::test
