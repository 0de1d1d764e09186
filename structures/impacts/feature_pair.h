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
// polynomials above; all of them are examined, and one time between each two.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "certificates/base/kernel.h"
#include "certificates/exact/instant.h"
#include "certificates/search/certificate_search.h"
#include "certificates/types/segments.h"
#include "motions/curves/motion_ref.h"

namespace kds {

enum class ImpactKind : std::uint8_t {
  vertex_face,  ///< the points are the vertex and the corners of the triangle
  edge_edge,    ///< the points are the ends of the first edge and those of the second
};

/// Two features, of which the second is moved by a shift.
struct FeaturePair {
  ImpactKind kind{};
  std::array<BeadId, 4> points{};
  std::array<BeadId, 2> shift{};  ///< the points `to` and `from`; one bead twice: no shift

  [[nodiscard]] SegmentsOrientation orientation(int sign) const {
    return {{points[0], points[1], points[2], points[3], shift[0], shift[1]}, sign};
  }
};

/// Tests pairs of features over one motion. All answers are exact. May be used by one thread at a time.
class FeaturePairTest {
 public:
  /// Counts the stages that decide in `stages`, which outlives the test.
  FeaturePairTest(const MotionRef<3>& motion, Kernel kernel, StageCounts& stages);

  /// Returns whether the features meet at a time at which their points are coplanar.
  [[nodiscard]] bool meet(const FeaturePair& pair, const Instant& time) const;
  /// Returns whether an end of one edge is on the other edge, or the vertex on an edge of the triangle.
  [[nodiscard]] bool meet_at_end(const FeaturePair& pair, const Instant& time) const;
  /// Returns whether the features meet during the whole step, in which their points stay coplanar.
  [[nodiscard]] bool meet_throughout(const FeaturePair& pair) const;

  /// Called with a time at which the features begin to meet, and whether their orientation changes its sign
  /// there. Returns false to end the search.
  using Found = std::function<bool(const Instant& time, bool passes)>;
  /// Calls found(time, passes) for all such times, ascending.
  void each_impact(const FeaturePair& pair, const Found& found) const;

 private:
  struct Candidate;

  /// Visits the roots of the certificate's function in [0,1], ascending, until `visit` returns false. Returns
  /// false if the function is zero on the whole step.
  template <class Certificate, class Visit>
  bool each_root(const CertificateSearch<Certificate>& search, Certificate certificate,
                 const Visit& visit) const;
  /// Returns the times at which an answer of `meet` may change, ascending, from 0 to 1, while the points stay
  /// coplanar.
  [[nodiscard]] std::vector<std::unique_ptr<Candidate>> candidates_in_plane(const FeaturePair& pair) const;
  /// Returns whether the features meet between two candidates. Narrows their times.
  [[nodiscard]] bool meet_between(const FeaturePair& pair, Candidate& one, Candidate& next) const;

  [[nodiscard]] bool is_in_triangle(const FeaturePair& pair, const Instant& time) const;
  [[nodiscard]] bool edges_meet(const FeaturePair& pair, const Instant& time) const;
  [[nodiscard]] bool is_on_segment(const FeaturePair& pair, unsigned a, unsigned b, unsigned point,
                                   const Instant& time) const;
  // Points of a pair are named by their index in FeaturePair::points.
  /// Returns a component of (b - a) x (d - c).
  template <int Axis>
  [[nodiscard]] static CrossComponent<Axis> component(const FeaturePair& pair,
                                                      std::array<unsigned, 4> points);
  [[nodiscard]] static BeyondEnds beyond(const FeaturePair& pair, unsigned a, unsigned b, unsigned point);
  [[nodiscard]] int cross(int axis, const FeaturePair& pair, std::array<unsigned, 4> points,
                          const Instant& time) const;
  /// Returns the side of a line on which a point lies, seen along an axis.
  [[nodiscard]] int side(int axis, const FeaturePair& pair, unsigned a, unsigned b, unsigned point,
                         const Instant& time) const {
    return cross(axis, pair, {a, b, a, point}, time);
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
