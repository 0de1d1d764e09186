#pragma once
// Exact tests of a point and a triangle, or of two segments, in motion: whether they meet at a time, and all
// times at which they begin to meet. Everything is closed: ends of edges, corners of triangles, and the ends
// of the step.
//
// The features meet only while their four points are coplanar. Their orientation is a polynomial of degree
// 3k, whose roots are found one after the other. At each root, signs of polynomials of degree 2k decide
// whether the features meet (segments.h): seen along an axis on which their plane does not stand upright, the
// problem is one in the plane; if the triangle is flat or the segments are parallel, it is one on a line.
//
// If the points stay coplanar for the whole step, contact lasts. It can begin and end only where an end of
// one edge meets the other edge, or the point an edge of the triangle. These times are roots of the
// polynomials above. All these times are examined, and one time between each two.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "certificates/base/kernel.h"
#include "certificates/exact/instant.h"
#include "certificates/search/certificate_search.h"
#include "certificates/search/moment.h"
#include "certificates/types/segments.h"
#include "motions/curves/motion_ref.h"

namespace kds {

enum class ImpactKind : std::uint8_t {
  vertex_face,  ///< the points are the vertex and the corners of the triangle
  edge_edge,    ///< the points are the ends of the first edge and those of the second
};

/// Two features, of which the second is moved by a shift.
struct FeaturePair {
  /// An edge of one feature and a point of the other, by their indices in `points`.
  struct EdgeAndPoint {
    unsigned a, b, point;
  };

  ImpactKind kind{};
  std::array<BeadId, 4> points{};
  std::array<BeadId, 2> shift{};  ///< the points `to` and `from`, equal if there is no shift

  [[nodiscard]] SegmentsOrientation orientation(int sign = 1) const {
    return {{points[0], points[1], points[2], points[3], shift[0], shift[1]}, sign};
  }
  /// Returns each edge with the points that meet it where contact in a plane begins and ends.
  [[nodiscard]] std::span<const EdgeAndPoint> edges_and_points() const;
  /// Returns a component of (b - a) x (d - c), where a, b, c and d are indices in `points`.
  template <int Axis>
  [[nodiscard]] CrossComponent<Axis> cross(std::array<unsigned, 4> indices) const {
    const auto [a, b, c, d] = indices;
    const auto [to, from] = shift_between(d, c);
    return {{points[a], points[b], points[c], points[d], to, from}};
  }
  [[nodiscard]] BeyondEnds beyond(const EdgeAndPoint& of) const {
    const auto [to, from] = shift_between(of.a, of.point);
    return {{points[of.a], points[of.b], points[of.point], to, from}};
  }

 private:
  /// Returns the shift of one point relative to another.
  [[nodiscard]] std::array<BeadId, 2> shift_between(unsigned to, unsigned from) const {
    const unsigned second = kind == ImpactKind::vertex_face ? 1 : 2;  // its first point
    if ((to >= second) == (from >= second)) return {shift[0], shift[0]};
    return to >= second ? shift : std::array{shift[1], shift[0]};
  }
};

/// Tests pairs of features in the present step of one motion. All answers are exact. May be used by one
/// thread at a time.
class FeaturePairTest {
 public:
  /// Counts the stages that decide in `stages`. The motion and `stages` must outlive the test.
  FeaturePairTest(const MotionRef<3>& motion, Kernel kernel, StageCounts& stages);

  /// Returns whether the features meet at the moment. Their points must be coplanar then.
  [[nodiscard]] bool meet(const FeaturePair& pair, const Instant& time, Moment moment = Moment::now) const;
  /// Returns whether an end of one edge is on the other edge, or the vertex on an edge of the triangle.
  [[nodiscard]] bool meet_at_end(const FeaturePair& pair, const Instant& time,
                                 Moment moment = Moment::now) const;

  /// Receives a time at which the features begin to meet, and whether their orientation changes its sign
  /// there. Returns false to end the search.
  using Found = std::function<bool(const Instant& time, bool passes)>;
  /// Calls found(time, passes) for each time in [0,1] at which the features begin to meet, ascending, until
  /// it returns false.
  void each_impact(const FeaturePair& pair, const Found& found) const;

 private:
  /// Visits the roots of the certificate's function in [0,1], ascending, until `visit` returns false. Returns
  /// false if the function is zero on the whole step.
  template <class Certificate, class Visit>
  bool each_root(const CertificateSearch<Certificate>& search, Certificate certificate,
                 const Visit& visit) const;
  void each_impact_in_plane(const FeaturePair& pair, const Found& found) const;

  [[nodiscard]] bool is_in_triangle(const FeaturePair& pair, const Instant& time, Moment moment) const;
  [[nodiscard]] bool edges_meet(const FeaturePair& pair, const Instant& time, Moment moment) const;
  [[nodiscard]] bool is_on_segment(const FeaturePair& pair, const FeaturePair::EdgeAndPoint& end,
                                   const Instant& time, Moment moment) const;
  /// Returns the sign of a component of (b - a) x (d - c), where a, b, c and d are indices in `points`.
  [[nodiscard]] int cross(int axis, const FeaturePair& pair, std::array<unsigned, 4> indices,
                          const Instant& time, Moment moment) const;
  /// Returns the side of a line on which a point lies, seen along an axis.
  [[nodiscard]] int side(int axis, const FeaturePair& pair, const FeaturePair::EdgeAndPoint& of,
                         const Instant& time, Moment moment) const {
    return cross(axis, pair, {of.a, of.b, of.a, of.point}, time, moment);
  }

  Kernel kernel_;
  StageCounts& stages_;
  std::unique_ptr<CertificateSearch<SegmentsOrientation>> orientation_;
  std::unique_ptr<CertificateSearch<CrossComponent<0>>> cross_x_;
  std::unique_ptr<CertificateSearch<CrossComponent<1>>> cross_y_;
  std::unique_ptr<CertificateSearch<CrossComponent<2>>> cross_z_;
  std::unique_ptr<CertificateSearch<BeyondEnds>> beyond_;
};

}  // namespace kds
