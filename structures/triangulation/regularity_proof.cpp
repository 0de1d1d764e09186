#include "structures/triangulation/regularity_proof.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "motions/numbers/lanes.h"
#include "structures/triangulation/facet_certificate.h"

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

/// Orientations of four tuples: positive if the last bead lies to the left of the others (CGAL's convention).
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

/// Power tests of four tuples: positive if the last bead lies outside the power sphere of the others, which
/// must form a positive cell.
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

/// Tests beads four at a time, and asks `judge` about each test that is not proved positive.
template <int Dimension, std::size_t Count, class Test, class Judge>
class FourByFour {
 public:
  FourByFour(const RoundedPositions<Dimension>& positions, Test test, Judge judge)
      : positions_(positions), test_(test), judge_(judge) {}

  void add(const std::array<BeadId, Count>& beads) {
    beads_[filled_] = beads;
    if (++filled_ == Lanes::width) flush();
  }
  /// Makes the remaining tests, and returns whether all tests since the start have passed.
  [[nodiscard]] bool all_pass() {
    if (filled_ > 0) {
      std::fill(beads_.begin() + filled_, beads_.end(), beads_[0]);
      flush();
    }
    return all_pass_;
  }
  [[nodiscard]] bool failed() const { return !all_pass_; }

 private:
  void flush() {
    std::array<Four, Count> rows;
    for (std::size_t i = 0; i < Count; ++i) {
      for (std::size_t lane = 0; lane < Lanes::width; ++lane)
        rows[i][lane] = &positions_.row(beads_[lane][i]);
    }
    Lanes::Mask positive;
    test_(rows, Errors{positions_.coordinate_error(), positions_.weight_error()}, positive);
    for (std::size_t lane = 0; lane < filled_; ++lane)
      all_pass_ = all_pass_ && (positive[lane] != 0 || judge_(beads_[lane]));
    filled_ = 0;
  }

  const RoundedPositions<Dimension>& positions_;
  Test test_;
  Judge judge_;
  std::array<std::array<BeadId, Count>, Lanes::width> beads_{};
  std::size_t filled_ = 0;
  bool all_pass_ = true;
};

/// Returns whether an odd number of exchanges turns `a` into `b`. The beads of `a` are all different.
template <std::size_t Size>
bool is_odd_permutation(std::array<BeadId, Size> a, const std::array<BeadId, Size>& b) {
  bool is_odd = false;
  for (std::size_t i = 0; i < Size; ++i) {
    const std::size_t index = static_cast<std::size_t>(std::find(a.begin() + i, a.end(), b[i]) - a.begin());
    if (index == Size) return false;
    if (index == i) continue;
    std::swap(a[i], a[index]);
    is_odd = !is_odd;
  }
  return is_odd;
}

/// Keeps the largest item added so far.
template <class Item>
struct Largest {
  std::optional<Item> item;
  double size = 0;
  void offer(const Item& other, double other_size) {
    if (item && !(other_size > size)) return;
    item = other;
    size = other_size;
  }
};

template <int Dimension>
class RegularityProof {
  using Beads = CellBeads<Dimension>;
  using Face = std::array<BeadId, static_cast<std::size_t>(Dimension)>;
  using Point = std::array<TrackedDouble, static_cast<std::size_t>(Dimension)>;
  using Points = std::array<Point, Dimension + 1>;

 public:
  RegularityProof(const RegularTriangulation<Dimension>& triangulation,
                  const RoundedPositions<Dimension>& positions, const SignsOfFunctions<Dimension>* judge)
      : triangulation_(triangulation),
        positions_(positions),
        judge_(judge),
        is_vertex_(positions.size(), 0) {}

  [[nodiscard]] bool prove(std::span<const HiddenBead> hidden, std::span<const char> absent) {
    return cells_close_up() && is_hull_convex() && cells_and_facets_are_right() &&
           hidden_are_inside(hidden) && all_are_named(hidden, absent);
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

  [[nodiscard]] auto orientations(bool may_be_zero) const {
    return four_by_four<Dimension + 1>(&four_orientations<Dimension>, [this, may_be_zero](const Beads& v) {
      return judge_ != nullptr && judge_->of(Orientation<Dimension>(v, 1)) >= (may_be_zero ? 0 : 1);
    });
  }
  /// Returns a batch of power tests, each of a cell and the bead beyond one of its facets.
  [[nodiscard]] auto power_tests() const {
    return four_by_four<Dimension + 2>(
        &four_power_tests<Dimension>, [this](const std::array<BeadId, Dimension + 2>& beads) {
          Beads cell;
          std::copy(beads.begin(), beads.end() - 1, cell.begin());
          return judge_ != nullptr &&
                 with_facet_certificate(cell, beads.back(), [&](const auto& certificate) {
                   return judge_->of(certificate) >= 0;
                 });
        });
  }
  template <std::size_t Count, class Test, class Judge>
  [[nodiscard]] auto four_by_four(Test test, Judge judge) const {
    return FourByFour<Dimension, Count, Test, Judge>(positions_, test, judge);
  }

  /// Checks 2 and 4.
  [[nodiscard]] bool cells_and_facets_are_right() const {
    auto orientations = this->orientations(false);
    auto power_tests = this->power_tests();
    for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell) {
      if (!triangulation_.is_live(cell) || is_infinite(cell)) continue;
      const Beads& v = beads_of(cell);
      orientations.add(v);
      for (int i = 0; i <= Dimension; ++i) {
        const BeadId apex = triangulation_.apex_beyond(cell, i);
        if (apex != infinite_bead && cell_of(triangulation_.beyond(cell, i)) >= cell)
          power_tests.add(with(v, apex));
      }
      if (orientations.failed() || power_tests.failed()) return false;
    }
    return orientations.all_pass() && power_tests.all_pass();
  }

  /// Check 3. The point is a mean of the beads of one cell; the ray goes through the middle of one face.
  [[nodiscard]] bool is_hull_convex() const {
    std::vector<Face> faces;
    Largest<Beads> cell_in_the_middle;
    Largest<Face> face_met;
    for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell) {
      if (!triangulation_.is_live(cell)) continue;
      const auto face = hull_face<Dimension>(beads_of(cell));
      if (!face) {
        cell_in_the_middle.offer(beads_of(cell), volume(beads_of(cell)));
        continue;
      }
      face_met.offer(*face, area(*face));
      faces.push_back(*face);
      for (int i = 0; i <= Dimension; ++i) {
        const BeadId apex = triangulation_.apex_beyond(cell, i);
        const bool ridge = beads_of(cell)[static_cast<std::size_t>(i)] != infinite_bead;
        if (ridge && side(*face, apex) < 0) return false;
      }
    }
    if (!cell_in_the_middle.item || !face_met.item) return false;
    const Point inside = mean(*cell_in_the_middle.item);
    Point aim = mean(*face_met.item);
    for (TrackedDouble& x : aim) x.error = 0;  // any point will do
    return std::all_of(faces.begin(), faces.end(), [&](const Face& face) {
      return lies_inside(face, *cell_in_the_middle.item) &&
             (face == *face_met.item || meets_no_ray(face, inside, aim));
    });
  }

  /// Returns 1 if a bead is proved to lie strictly on the inner side of a face, 0 if it lies in the face's
  /// plane, -1 if neither is proved.
  [[nodiscard]] int side(const Face& face, BeadId bead) const {
    if (std::find(face.begin(), face.end(), bead) != face.end()) return 0;
    Beads cell{};
    std::copy(face.begin(), face.end(), cell.begin());
    cell.back() = bead;
    if (is_positive(-orientation(points(cell)))) return 1;
    return judge_ == nullptr ? -1 : judge_->of(Orientation<Dimension>(cell, -1));
  }

  /// Returns whether any mean of a cell's beads is proved to lie strictly on the inner side of a face.
  [[nodiscard]] bool lies_inside(const Face& face, const Beads& cell) const {
    bool is_strict = false;
    for (const BeadId bead : cell) {
      const int at = side(face, bead);
      if (at < 0) return false;
      is_strict |= at > 0;
    }
    return is_strict;
  }

  /// Returns whether the ray from `from` through `to` is proved to miss the face. `from` lies inside of the
  /// face.
  [[nodiscard]] bool meets_no_ray(const Face& face, const Point& from, const Point& to) const {
    Points points;
    points.back() = from;
    for (std::size_t out = 0; out < Dimension; ++out) {
      for (std::size_t i = 0; i < Dimension; ++i) points[i] = i == out ? to : point(face[i]);
      if (is_positive(orientation(points))) return true;
    }
    return false;
  }

  /// Check 5 for hidden beads.
  [[nodiscard]] bool hidden_are_inside(std::span<const HiddenBead> hidden) const {
    auto orientations = this->orientations(true);
    auto power_tests = this->power_tests();
    for (const auto& [bead, host] : hidden) {
      if (bead >= positions_.size() || host >= triangulation_.cells().size() ||
          !triangulation_.is_live(host) || is_infinite(host))
        return false;
      const Beads& v = beads_of(host);
      power_tests.add(with(v, bead));
      for (std::size_t i = 0; i <= Dimension; ++i) {
        Beads part = v;
        part[i] = bead;
        orientations.add(part);
      }
    }
    return orientations.all_pass() && power_tests.all_pass();
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
  [[nodiscard]] static std::array<BeadId, Dimension + 2> with(const Beads& cell, BeadId bead) {
    std::array<BeadId, Dimension + 2> beads;
    std::copy(cell.begin(), cell.end(), beads.begin());
    beads.back() = bead;
    return beads;
  }
  [[nodiscard]] Point point(BeadId bead) const {
    Point point;
    for (std::size_t axis = 0; axis < Dimension; ++axis) point[axis] = positions_.coordinate(bead, axis);
    return point;
  }
  [[nodiscard]] Points points(const Beads& beads) const {
    Points points;
    std::transform(beads.begin(), beads.end(), points.begin(), [&](BeadId bead) { return point(bead); });
    return points;
  }
  /// Returns a mean of the beads by positive weights that are powers of two.
  template <std::size_t Size>
  [[nodiscard]] Point mean(const std::array<BeadId, Size>& beads) const {
    Point mean{};
    double weight = Size == 4 ? 0.25 : 0.5;
    for (std::size_t i = 0; i < Size; ++i) {
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        mean[axis] += TrackedDouble{weight, 0} * positions_.coordinate(beads[i], axis);
      if (Size == 3) weight = 0.25;
    }
    return mean;
  }
  /// Returns twice the area, or six times the volume, rounded.
  [[nodiscard]] double volume(const Beads& cell) const { return orientation(points(cell)).value; }
  /// Returns the squared length, or four times the squared area, rounded.
  [[nodiscard]] double area(const Face& face) const {
    std::array<std::array<double, 3>, Dimension - 1> edge{};
    for (std::size_t i = 1; i < Dimension; ++i)
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        edge[i - 1][axis] = positions_.row(face[i])[axis] - positions_.row(face[0])[axis];
    const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto &a = edge.front(), &b = edge.back();
    return Dimension == 2 ? dot(a, a) : dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b);
  }
  [[nodiscard]] static TrackedDouble orientation(const Points& points) {
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
  const SignsOfFunctions<Dimension>* judge_;
  std::vector<char> is_vertex_;
};

}  // namespace

template <int Dimension>
bool is_proved_regular(const RegularTriangulation<Dimension>& triangulation,
                       std::span<const HiddenBead> hidden, const RoundedPositions<Dimension>& positions,
                       std::span<const char> absent, const SignsOfFunctions<Dimension>* judge) {
  return RegularityProof<Dimension>(triangulation, positions, judge).prove(hidden, absent);
}

template bool is_proved_regular(const RegularTriangulation<2>&, std::span<const HiddenBead>,
                                const RoundedPositions<2>&, std::span<const char>,
                                const SignsOfFunctions<2>*);
template bool is_proved_regular(const RegularTriangulation<3>&, std::span<const HiddenBead>,
                                const RoundedPositions<3>&, std::span<const char>,
                                const SignsOfFunctions<3>*);

}  // namespace kds
