#pragma once
// Judges when a point meets a triangle, and two segments each other: polynomials with whole coefficients and
// their roots by Sturm sequences. Membership is decided by barycentric coordinates and by lengths along
// segments. The judge uses nothing of certificates/ or structures/impacts.

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "structures/impacts/impact_search.h"
#include "tests/support/judges/sturm.h"

namespace kds::test {

/// A time at which a polynomial has its only root in a part of the step.
struct JudgedTime {
  std::shared_ptr<const sturm::Sequence> sequence;
  sturm::Root root;
};

class ImpactJudge {
 public:
  using Polynomial = sturm::Polynomial;
  using Point = std::array<Polynomial, 3>;

  /// `points`: whole coordinates of the control points, as ImpactSearch takes them.
  ImpactJudge(ImpactKind kind, int degree, const std::vector<int>& points) : kind_(kind) {
    const auto row = static_cast<std::size_t>(degree) + 1;
    for (std::size_t point = 0; point < 4; ++point) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<Integer> scaled;
        Integer binomial = 1;
        for (std::size_t k = 0; k < row; ++k) {
          scaled.push_back(binomial * points[(point * row + k) * 3 + axis]);
          binomial = binomial * (degree - static_cast<int>(k)) / (static_cast<int>(k) + 1);
        }
        points_[point][axis] = sturm::from_scaled(scaled);
      }
    }
  }

  /// Returns the times at which the features begin to meet, ascending.
  [[nodiscard]] std::vector<JudgedTime> impacts() const {
    const Polynomial coplanar = orientation();
    std::vector<JudgedTime> critical;
    if (coplanar.empty()) {
      critical = critical_in_plane();
    } else {
      add_roots(coplanar, critical);
    }
    std::vector<JudgedTime> times;
    bool before = false;
    for (std::size_t k = 0; k < critical.size(); ++k) {
      const JudgedTime& time = critical[k];
      const bool now = meet(time);
      if (now && !before) times.push_back(time);
      before = now;
      if (k + 1 == critical.size()) break;
      const JudgedTime& next = critical[k + 1];
      if (!are_equal(time, next)) before = coplanar.empty() && meet(between(time, next));
    }
    return times;
  }

  /// Returns the orientation of the four points.
  [[nodiscard]] Polynomial orientation() const { return dot(cross(from(0, 1), from(0, 2)), from(0, 3)); }
  [[nodiscard]] bool meet(const JudgedTime& at) const {
    const Shares found = shares();
    if (sign(found.whole, at) != 0) {
      for (const Polynomial& share : found.shares)
        if (sign(share, at) < 0 || sign(sum(found.whole, share, -1), at) < 0) return false;
      return true;
    }
    return meet_at_end(at);
  }
  /// Returns whether an end of one edge is on the other, or the point on an edge of the triangle.
  [[nodiscard]] bool meet_at_end(const JudgedTime& at) const {
    for (const auto& [a, b, point] : ends_on_edges())
      if (is_on_segment(a, b, point, at)) return true;
    return false;
  }
  /// Returns the ends of the step, and all times at which an answer of `meet` may change, ascending.
  [[nodiscard]] std::vector<JudgedTime> critical_in_plane() const {
    std::vector<JudgedTime> critical;
    add_roots({0, -1, 1}, critical);
    for (const Polynomial& p : all_compared()) add_roots(p, critical);
    std::sort(critical.begin(), critical.end(), [](const JudgedTime& a, const JudgedTime& b) {
      return sturm::compare(*a.sequence, a.root, *b.sequence, b.root) < 0;
    });
    return critical;
  }
  [[nodiscard]] static JudgedTime number(const Rational& x) {
    return {std::make_shared<const sturm::Sequence>(sturm::with_root(x)), {x, x}};
  }
  [[nodiscard]] static bool are_equal(const JudgedTime& a, const JudgedTime& b) {
    return sturm::compare(*a.sequence, a.root, *b.sequence, b.root) == 0;
  }
  static void add_roots(const Polynomial& f, std::vector<JudgedTime>& times) {
    if (f.size() < 2) return;
    const auto sequence = std::make_shared<const sturm::Sequence>(f);
    for (const sturm::Root& root : sturm::roots_on(*sequence, 0, 1)) times.push_back({sequence, root});
  }
  [[nodiscard]] static JudgedTime between(JudgedTime a, JudgedTime b) {
    while (!(a.root.upper < b.root.lower)) {
      sturm::halve(*a.sequence, a.root);
      sturm::halve(*b.sequence, b.root);
    }
    const Rational x = (a.root.upper + b.root.lower) / 2;
    return number(x);
  }

 private:
  [[nodiscard]] static Polynomial sum(Polynomial a, const Polynomial& b, int sign = 1) {
    a.resize(std::max(a.size(), b.size()));
    for (std::size_t k = 0; k < b.size(); ++k) a[k] += sign * b[k];
    sturm::trim(a);
    return a;
  }
  [[nodiscard]] static Polynomial product(const Polynomial& a, const Polynomial& b) {
    if (a.empty() || b.empty()) return {};
    Polynomial c(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
    return c;
  }
  [[nodiscard]] static Polynomial dot(const Point& a, const Point& b) {
    return sum(sum(product(a[0], b[0]), product(a[1], b[1])), product(a[2], b[2]));
  }
  [[nodiscard]] static Point cross(const Point& a, const Point& b) {
    Point c;
    for (std::size_t x = 0; x < 3; ++x) {
      const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
      c[x] = sum(product(a[y], b[z]), product(a[z], b[y]), -1);
    }
    return c;
  }
  [[nodiscard]] Point from(std::size_t a, std::size_t b) const {
    Point d;
    for (std::size_t x = 0; x < 3; ++x) d[x] = sum(points_[b][x], points_[a][x], -1);
    return d;
  }
  [[nodiscard]] static int sign(const Polynomial& f, JudgedTime at) {
    if (f.empty() || sturm::shares(*at.sequence, at.root, f)) return 0;
    if (f.size() == 1) return sturm::sign(f[0]);
    const sturm::Sequence own(f);
    while (!at.root.is_number() && own.roots_on(at.root.lower, at.root.upper) > 0)
      sturm::halve(*at.sequence, at.root);
    return sturm::sign_at(f, at.root.upper);
  }

  /// A point is on a segment if its distance from the line is zero and its place along it within the length.
  struct OnSegment {
    Polynomial off, along, length, beyond;  // squares of lengths
  };
  [[nodiscard]] OnSegment on_segment(std::size_t a, std::size_t b, std::size_t point) const {
    const Point edge = from(a, b), to = from(a, point);
    OnSegment s;
    s.along = dot(to, edge);
    s.length = dot(edge, edge);
    s.off = sum(product(dot(to, to), s.length), product(s.along, s.along), -1);
    s.beyond = sum(s.length, s.along, -1);
    if (s.length.empty()) s.off = dot(to, to);
    return s;
  }
  [[nodiscard]] bool is_on_segment(std::size_t a, std::size_t b, std::size_t point,
                                   const JudgedTime& at) const {
    const OnSegment s = on_segment(a, b, point);
    if (sign(s.length, at) == 0) {
      const Point to = from(a, point);
      return sign(dot(to, to), at) == 0;
    }
    return sign(s.off, at) == 0 && sign(s.along, at) >= 0 && sign(s.beyond, at) >= 0;
  }
  /// Numbers between 0 and `whole` if the features meet and are not degenerate.
  struct Shares {
    Polynomial whole;
    std::vector<Polynomial> shares;
  };
  [[nodiscard]] Shares shares() const {
    if (kind_ == ImpactKind::vertex_face) {
      const Point normal = cross(from(1, 2), from(1, 3));
      const auto area = [&](std::size_t b, std::size_t c) {
        return dot(cross(from(0, b), from(0, c)), normal);
      };
      return {dot(normal, normal), {area(1, 2), area(2, 3), area(3, 1)}};
    }
    const Point u = from(0, 1), v = from(2, 3), apart = from(0, 2), normal = cross(u, v);
    return {dot(normal, normal), {dot(cross(apart, v), normal), dot(cross(apart, u), normal)}};
  }
  [[nodiscard]] std::vector<std::array<std::size_t, 3>> ends_on_edges() const {
    if (kind_ == ImpactKind::vertex_face) return {{1, 2, 0}, {2, 3, 0}, {3, 1, 0}};
    return {{0, 1, 2}, {0, 1, 3}, {2, 3, 0}, {2, 3, 1}};
  }
  [[nodiscard]] std::vector<Polynomial> all_compared() const {
    const Shares found = shares();
    std::vector<Polynomial> all{found.whole};
    for (const Polynomial& share : found.shares) {
      all.push_back(share);
      all.push_back(sum(found.whole, share, -1));
    }
    for (const auto& [a, b, point] : ends_on_edges()) {
      const OnSegment s = on_segment(a, b, point);
      for (const Polynomial& p : {s.off, s.along, s.length, s.beyond}) all.push_back(p);
    }
    return all;
  }

  ImpactKind kind_;
  std::array<Point, 4> points_;
};

}  // namespace kds::test
