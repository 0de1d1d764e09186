#include "structures/triangulation/strict_regularity.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "motions/numbers/lanes.h"
#include "structures/triangulation/hull_faces.h"

namespace kds {

namespace {

using Row = RoundedPositions<3>::Row;
template <class Real>
using TrackedRow = std::array<Tracked<Real>, 4>;

template <class Real>
[[gnu::always_inline]] inline Tracked<Real> minor(const TrackedRow<Real>& a, const TrackedRow<Real>& b,
                                                  std::size_t i, std::size_t j) {
  return a[i] * b[j] - a[j] * b[i];
}

/// Returns the determinant of the first `Size` columns.
template <class Real, std::size_t Size>
[[gnu::always_inline]] inline Tracked<Real> determinant(const std::array<TrackedRow<Real>, Size>& row) {
  if constexpr (Size == 2) {
    return minor(row[0], row[1], 0, 1);
  } else if constexpr (Size == 3) {
    return row[0][2] * minor(row[1], row[2], 0, 1) - row[1][2] * minor(row[0], row[2], 0, 1) +
           row[2][2] * minor(row[0], row[1], 0, 1);
  } else {
    const auto product = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      return minor(row[a], row[b], 0, 1) * minor(row[c], row[d], 2, 3);
    };
    return product(0, 1, 2, 3) - product(0, 2, 1, 3) + product(0, 3, 1, 2) + product(1, 2, 0, 3) -
           product(1, 3, 0, 2) + product(2, 3, 0, 1);
  }
}

using Four = std::array<const Row*, 4>;  // one bead of each of four tuples

struct Errors {
  double coordinate, weight;
};

template <std::size_t Count>
[[gnu::always_inline]] inline std::array<std::array<Lanes, 4>, Count> columns(
    const std::array<Four, Count>& beads) {
  std::array<std::array<Lanes, 4>, Count> columns;
  for (std::size_t i = 0; i < Count; ++i)
    columns[i] =
        Lanes::transposed(beads[i][0]->data(), beads[i][1]->data(), beads[i][2]->data(), beads[i][3]->data());
  return columns;
}

[[gnu::always_inline]] inline Tracked<Lanes> difference(const Lanes& a, const Lanes& b, double error) {
  return Tracked<Lanes>{a, Lanes(error)} - Tracked<Lanes>{b, Lanes(error)};
}

[[gnu::always_inline]] inline void test_positive(const Tracked<Lanes>& x, Lanes::Mask& positive) {
  positive = x.value > x.error * Lanes(Tracked<Lanes>::inflation);
}

/// Orientations: positive where the last bead lies to the left of the others (CGAL's convention).
template <int Dimension>
[[KDS_LANES_TARGETS]] void four_orientations(const std::array<Four, Dimension + 1>& beads,
                                             const Errors& errors, Lanes::Mask& positive) {
  const auto at = columns(beads);
  std::array<TrackedRow<Lanes>, Dimension> row;
  for (std::size_t i = 0; i < Dimension; ++i)
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      row[i][axis] = difference(at[i + 1][axis], at[0][axis], errors.coordinate);
  test_positive(determinant(row), positive);
}

/// Power tests: positive where the last bead is outside the power sphere of the others, a positive cell.
template <int Dimension>
[[KDS_LANES_TARGETS]] void four_power_tests(const std::array<Four, Dimension + 2>& beads,
                                            const Errors& errors, Lanes::Mask& positive) {
  const auto at = columns(beads);
  std::array<TrackedRow<Lanes>, Dimension + 1> row;
  for (std::size_t i = 0; i <= Dimension; ++i) {
    Tracked<Lanes>& lift = row[i][Dimension];
    lift = difference(at[0][Dimension], at[i + 1][Dimension], errors.weight);
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      row[i][axis] = difference(at[i + 1][axis], at[0][axis], errors.coordinate);
      lift += row[i][axis] * row[i][axis];
    }
  }
  test_positive(determinant(row), positive);
}

/// Makes tests four at a time, and tells in the end whether all results are positive.
template <std::size_t Count, class Test>
class FourByFour {
 public:
  FourByFour(const Errors& errors, Test test) : errors_(errors), test_(test) {}

  void add(const std::array<const Row*, Count>& beads) {
    for (std::size_t i = 0; i < Count; ++i) beads_[i][filled_] = beads[i];
    if (++filled_ == Lanes::width) flush();
  }
  [[nodiscard]] bool all_positive() {
    if (filled_ > 0) {
      for (Four& four : beads_) std::fill(four.begin() + filled_, four.end(), four[0]);
      flush();
    }
    return all_positive_;
  }
  [[nodiscard]] bool failed() const { return !all_positive_; }

 private:
  void flush() {
    Lanes::Mask positive;
    test_(beads_, errors_, positive);
    all_positive_ = all_positive_ && Lanes::all(positive);
    filled_ = 0;
  }

  Errors errors_;
  Test test_;
  std::array<Four, Count> beads_{};
  std::size_t filled_ = 0;
  bool all_positive_ = true;
};

/// Returns whether an odd number of exchanges turns `a` into `b`. The beads of `a` are all different.
template <std::size_t Size>
bool is_odd_permutation(std::array<BeadId, Size> a, const std::array<BeadId, Size>& b) {
  bool is_odd = false;
  for (std::size_t i = 0; i < Size; ++i) {
    const std::size_t place = static_cast<std::size_t>(std::find(a.begin() + i, a.end(), b[i]) - a.begin());
    if (place == Size) return false;
    if (place == i) continue;
    std::swap(a[i], a[place]);
    is_odd = !is_odd;
  }
  return is_odd;
}

template <int Dimension>
class StrictRegularity {
  using Beads = CellBeads<Dimension>;
  using Face = std::array<BeadId, static_cast<std::size_t>(Dimension)>;
  using Point = std::array<TrackedDouble, static_cast<std::size_t>(Dimension)>;

 public:
  StrictRegularity(const RegularTriangulation<Dimension>& triangulation,
                   const RoundedPositions<Dimension>& positions)
      : triangulation_(triangulation), positions_(positions), is_vertex_(positions.size(), 0) {}

  [[nodiscard]] bool prove(std::span<const HiddenBead> hidden, std::span<const char> absent) {
    return cells_close_up() && is_hull_convex() && all_are_positive() && hidden_are_inside(hidden) &&
           all_are_named(hidden, absent);
  }

 private:
  /// Check 1. Marks the vertices.
  [[nodiscard]] bool cells_close_up() {
    const auto cells = triangulation_.cells();
    for (CellId cell = 0; cell < cells.size(); ++cell) {
      if (!triangulation_.is_live(cell)) continue;
      const Beads& v = cells[cell].vertex;
      std::size_t infinite = 0;
      for (const BeadId bead : v) {
        if (bead == infinite_bead) {
          ++infinite;
        } else if (bead < is_vertex_.size()) {
          is_vertex_[bead] = 1;
        } else {
          return false;
        }
      }
      if (infinite > 1) return false;
      for (int i = 0; i <= Dimension; ++i)
        if (!meets(cell, i)) return false;
    }
    return true;
  }

  [[nodiscard]] bool meets(CellId cell, int i) const {
    const FacetId beyond = triangulation_.beyond(cell, i);
    const CellId other = cell_of(beyond);
    if (other >= triangulation_.cells().size() || !triangulation_.is_live(other) ||
        index_of(beyond) > Dimension)
      return false;
    if (triangulation_.beyond(other, index_of(beyond)) != facet_id(cell, i)) return false;
    if (triangulation_.apex_beyond(cell, i) != triangulation_.apex(beyond)) return false;
    Beads across = beads_of(cell);
    across[static_cast<std::size_t>(i)] = triangulation_.apex(beyond);
    return is_odd_permutation(across, beads_of(other));
  }

  /// Checks 2 and 4.
  [[nodiscard]] bool all_are_positive() const {
    const Errors errors{positions_.coordinate_error(), positions_.weight_error()};
    FourByFour<Dimension + 1, decltype(&four_orientations<Dimension>)> orientations(
        errors, &four_orientations<Dimension>);
    FourByFour<Dimension + 2, decltype(&four_power_tests<Dimension>)> power_tests(
        errors, &four_power_tests<Dimension>);
    for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell) {
      if (!triangulation_.is_live(cell) || is_infinite(cell)) continue;
      std::array<const Row*, Dimension + 2> rows{};
      const Beads& v = beads_of(cell);
      std::transform(v.begin(), v.end(), rows.begin(), [&](BeadId b) { return &positions_.row(b); });
      std::array<const Row*, Dimension + 1> own{};
      std::copy(rows.begin(), rows.end() - 1, own.begin());
      orientations.add(own);
      for (int i = 0; i <= Dimension; ++i) {
        const BeadId apex = triangulation_.apex_beyond(cell, i);
        if (apex == infinite_bead || cell_of(triangulation_.beyond(cell, i)) < cell) continue;
        rows.back() = &positions_.row(apex);
        power_tests.add(rows);
      }
      if (orientations.failed() || power_tests.failed()) return false;
    }
    return orientations.all_positive() && power_tests.all_positive();
  }

  /// Check 3.
  [[nodiscard]] bool is_hull_convex() const {
    std::vector<Face> faces;
    std::optional<CellId> some_finite;
    for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell) {
      if (!triangulation_.is_live(cell)) continue;
      const auto face = hull_face<Dimension>(beads_of(cell));
      if (!face) {
        if (!some_finite) some_finite = cell;
        continue;
      }
      faces.push_back(*face);
      for (int i = 0; i <= Dimension; ++i) {
        const BeadId apex = triangulation_.apex_beyond(cell, i);
        const bool ridge = beads_of(cell)[static_cast<std::size_t>(i)] != infinite_bead;
        if (ridge && !lies_inside(*face, point(apex))) return false;
      }
    }
    if (!some_finite || faces.empty()) return false;
    const Point inside = somewhere_in<Dimension + 1>(beads_of(*some_finite));
    const Point aim = somewhere_in<Dimension>(faces.front());
    if (meets_no_ray(faces.front(), inside, aim)) return false;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (!lies_inside(faces[i], inside)) return false;
      if (i > 0 && !meets_no_ray(faces[i], inside, aim)) return false;
    }
    return true;
  }

  /// Returns whether a point is proved to lie strictly on the inner side of a face.
  [[nodiscard]] bool lies_inside(const Face& face, const Point& of) const {
    std::array<Point, Dimension + 1> points;
    for (std::size_t i = 0; i < Dimension; ++i) points[i] = point(face[i]);
    points.back() = of;
    return is_positive(-orientation(points));
  }

  /// Returns whether the ray from `from` through `to` is proved to miss the face. `from` lies inside of the
  /// face.
  [[nodiscard]] bool meets_no_ray(const Face& face, const Point& from, const Point& to) const {
    std::array<Point, Dimension + 1> points;
    points.back() = from;
    for (std::size_t out = 0; out < Dimension; ++out) {
      for (std::size_t i = 0; i < Dimension; ++i) points[i] = i == out ? to : point(face[i]);
      if (is_positive(orientation(points))) return true;
    }
    return false;
  }

  /// Check 5 for hidden beads.
  [[nodiscard]] bool hidden_are_inside(std::span<const HiddenBead> hidden) const {
    const Errors errors{positions_.coordinate_error(), positions_.weight_error()};
    FourByFour<Dimension + 1, decltype(&four_orientations<Dimension>)> orientations(
        errors, &four_orientations<Dimension>);
    FourByFour<Dimension + 2, decltype(&four_power_tests<Dimension>)> power_tests(
        errors, &four_power_tests<Dimension>);
    for (const auto& [bead, host] : hidden) {
      if (bead >= positions_.size() || host >= triangulation_.cells().size() ||
          !triangulation_.is_live(host) || is_infinite(host))
        return false;
      std::array<const Row*, Dimension + 2> rows{};
      std::array<const Row*, Dimension + 1> own{};
      for (std::size_t i = 0; i <= Dimension; ++i) own[i] = rows[i] = &positions_.row(beads_of(host)[i]);
      rows.back() = &positions_.row(bead);
      power_tests.add(rows);
      for (std::size_t i = 0; i <= Dimension; ++i) {
        auto part = own;
        part[i] = rows.back();
        orientations.add(part);
      }
    }
    return orientations.all_positive() && power_tests.all_positive();
  }

  /// Check 5: every bead is a vertex, hidden or absent, and only one of the three.
  [[nodiscard]] bool all_are_named(std::span<const HiddenBead> hidden, std::span<const char> absent) {
    for (const HiddenBead& h : hidden) {
      if (is_vertex_[h.bead] != 0) return false;
      is_vertex_[h.bead] = 1;
    }
    for (BeadId bead = 0; bead < is_vertex_.size(); ++bead) {
      const bool is_absent = bead < absent.size() && absent[bead] != 0;
      if ((is_vertex_[bead] != 0) == is_absent) return false;
    }
    return true;
  }

  [[nodiscard]] const Beads& beads_of(CellId cell) const { return triangulation_.cells()[cell].vertex; }
  [[nodiscard]] bool is_infinite(CellId cell) const {
    const Beads& v = beads_of(cell);
    return std::find(v.begin(), v.end(), infinite_bead) != v.end();
  }
  [[nodiscard]] Point point(BeadId bead) const {
    Point point;
    for (std::size_t axis = 0; axis < Dimension; ++axis) point[axis] = positions_.coordinate(bead, axis);
    return point;
  }
  /// Returns a point near the centroid. It counts as exact, so it has no error.
  template <std::size_t Size>
  [[nodiscard]] Point somewhere_in(const std::array<BeadId, Size>& beads) const {
    Point point{};
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      for (const BeadId bead : beads) point[axis].value += positions_.row(bead)[axis] / double{Size};
    }
    return point;
  }
  [[nodiscard]] static TrackedDouble orientation(const std::array<Point, Dimension + 1>& points) {
    std::array<TrackedRow<double>, Dimension> row;
    for (std::size_t i = 0; i < Dimension; ++i)
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        row[i][axis] = points[i + 1][axis] - points[0][axis];
    return determinant(row);
  }
  [[nodiscard]] static bool is_positive(const TrackedDouble& x) {
    return x.value > x.error * TrackedDouble::inflation;
  }

  const RegularTriangulation<Dimension>& triangulation_;
  const RoundedPositions<Dimension>& positions_;
  std::vector<char> is_vertex_;
};

}  // namespace

template <int Dimension>
bool is_strictly_regular(const RegularTriangulation<Dimension>& triangulation,
                         std::span<const HiddenBead> hidden, const RoundedPositions<Dimension>& positions,
                         std::span<const char> absent) {
  return StrictRegularity<Dimension>(triangulation, positions).prove(hidden, absent);
}

template bool is_strictly_regular(const RegularTriangulation<2>&, std::span<const HiddenBead>,
                                  const RoundedPositions<2>&, std::span<const char>);
template bool is_strictly_regular(const RegularTriangulation<3>&, std::span<const HiddenBead>,
                                  const RoundedPositions<3>&, std::span<const char>);

}  // namespace kds
