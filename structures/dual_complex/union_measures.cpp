#include "structures/dual_complex/union_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "motions/base/floating_point_scope.h"
#include "motions/numbers/exact_number.h"

namespace kds {

namespace ball_terms {
namespace {

constexpr double pi = std::numbers::pi;

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
Vector<Number> minus(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double to_double(double number) { return number; }
double to_double(const Rational& number) { return number.get_d(); }
double root(double number) { return std::sqrt(std::max(0.0, number)); }

/// The balls of a simplex, relative to its bead 0.
template <class Number, std::size_t N>
struct Balls {
  std::array<Vector<Number>, N> a;  ///< bead i minus bead 0
  std::array<Number, N> b;          ///< |a[i]|^2 - r_i^2 + r_0^2
  Number weight;                    ///< r_0^2
};

/// The radical plane of two balls, which cuts the line through the centres.
struct EdgeTerms {
  double length = 0;
  std::array<double, 2> distance{};  ///< signed, from each centre to the plane, towards the other centre
  double squared_radius = 0;         ///< of the circle in which the spheres meet
};

template <class Number>
EdgeTerms terms_of(const Balls<Number, 2>& balls) {
  const Number squared = dot(balls.a[1], balls.a[1]), other = 2 * squared - balls.b[1];
  const Number radius = balls.weight - balls.b[1] * balls.b[1] / (4 * squared);
  const double length = root(to_double(squared));
  return {length,
          {to_double(balls.b[1]) / (2 * length), to_double(other) / (2 * length)},
          std::max(0.0, to_double(radius))};
}

struct TriangleTerms {
  double half_chord = 0;  ///< half the distance of the two points in which the spheres meet
  /// In the triangle's plane: signed distance of the triangle's centre from the edge opposite to bead i,
  /// towards bead i.
  std::array<double, 3> inward{};
  /// Length of the edge opposite to bead i; product of the vectors from bead i to the others.
  std::array<double, 3> length{}, product{};
  double doubled_area = 0;
};

template <class Number>
TriangleTerms terms_of(const Balls<Number, 3>& balls) {
  const auto& [a, b, weight] = balls;
  const Vector<Number> normal = cross(a[1], a[2]);
  const Number a11 = dot(a[1], a[1]), a12 = dot(a[1], a[2]), a22 = dot(a[2], a[2]),
               squared = dot(normal, normal);
  const Vector<Number> third = minus(a[2], a[1]);
  TriangleTerms terms;
  terms.length = {root(to_double(dot(third, third))), root(to_double(a22)), root(to_double(a11))};
  terms.product = {to_double(a12), to_double(Number(a11 - a12)), to_double(Number(a22 - a12))};
  terms.doubled_area = root(to_double(squared));
  if (squared == 0) {  // the radical planes are equal, so each line through the circle's centre is a chord
    terms.half_chord = root(to_double(Number(weight - b[1] * b[1] / (4 * a11))));
    return terms;
  }
  const Number m1 = b[1] * a22 - b[2] * a12, m2 = b[2] * a11 - b[1] * a12;
  const std::array<Number, 3> barycentric{2 * squared - m1 - m2, m1, m2};  // of the centre, times 2 `squared`
  for (std::size_t i = 0; i < 3; ++i)
    terms.inward[i] = to_double(barycentric[i]) / (2 * terms.doubled_area * terms.length[i]);
  const Number chord = weight - (b[1] * m1 + b[2] * m2) / (4 * squared);
  terms.half_chord = root(to_double(chord));
  return terms;
}

struct TetrahedronTerms {
  double volume = 0;
  std::array<double, 6> dihedral{};  ///< at each edge
  /// Signed distance of the orthogonal sphere's centre from the plane opposite to bead i, towards bead i.
  std::array<double, 4> inward{};
};

template <class Number>
TetrahedronTerms terms_of(const Balls<Number, 4>& balls) {
  const auto& [a, b, weight] = balls;
  std::array<Vector<Number>, 4> normal{cross(minus(a[3], a[1]), minus(a[2], a[1])), cross(a[2], a[3]),
                                       cross(a[3], a[1]), cross(a[1], a[2])};
  const Number determinant = dot(a[1], normal[1]);
  const double six_volumes = std::abs(to_double(determinant));
  TetrahedronTerms terms{six_volumes / 6, {}, {}};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = tetrahedron_edges[e];
    const auto [k, l] = tetrahedron_edges[5 - e];
    const Vector<Number> edge = minus(a[j], a[i]);
    const Number squared = dot(edge, edge), cosine = dot(normal[k], normal[l]);
    terms.dihedral[e] = std::atan2(six_volumes * root(to_double(squared)), -to_double(cosine));
  }
  if (determinant == 0)
    return terms;         // the centres of all faces are one point of the line that has the centre
  Vector<Number> center;  // minus bead 0, times 2 `determinant`
  for (std::size_t x = 0; x < 3; ++x)
    center[x] = b[1] * normal[1][x] + b[2] * normal[2][x] + b[3] * normal[3][x];
  std::array<Number, 4> barycentric;  // of the centre, times 2 `determinant`^2
  barycentric[0] = 2 * determinant * determinant;
  for (std::size_t i = 1; i < 4; ++i) {
    barycentric[i] = dot(center, normal[i]);
    barycentric[0] -= barycentric[i];
  }
  for (std::size_t i = 0; i < 4; ++i)
    terms.inward[i] =
        to_double(barycentric[i]) / (2 * six_volumes * root(to_double(dot(normal[i], normal[i]))));
  return terms;
}

/// Whether doubles suffice: the vectors are far from dependent.
bool is_plump(const Balls<double, 2>&) { return true; }
bool is_plump(const Balls<double, 3>& balls) {
  const auto normal = cross(balls.a[1], balls.a[2]);
  return dot(normal, normal) > 1e-6 * dot(balls.a[1], balls.a[1]) * dot(balls.a[2], balls.a[2]);
}
bool is_plump(const Balls<double, 4>& balls) {
  const auto& a = balls.a;
  const double determinant = dot(a[1], cross(a[2], a[3]));
  return determinant * determinant > 1e-6 * dot(a[1], a[1]) * dot(a[2], a[2]) * dot(a[3], a[3]);
}

/// The balls, scaled by a power of two so that the largest radius is about 1.
class ScaledBalls {
 public:
  template <class Vertices>
  ScaledBalls(const Eigen::Matrix3Xd& centers, std::span<const double> radii, const Vertices& vertices)
      : centers_(centers) {
    if (static_cast<std::size_t>(centers.cols()) != radii.size())
      throw std::invalid_argument("the balls have " + std::to_string(centers.cols()) + " centres and " +
                                  std::to_string(radii.size()) + " radii");
    double largest = 0;
    for (const BeadId bead : vertices) {
      if (!(radii[bead] >= 0) || !std::isfinite(radii[bead]))
        throw std::invalid_argument("a ball of the complex has a radius that is negative or not finite");
      largest = std::max(largest, radii[bead]);
    }
    std::frexp(largest, &exponent_);
    scale_ = std::ldexp(1.0, -exponent_);
    radii_.assign(radii.begin(), radii.end());
    for (double& radius : radii_) radius *= scale_;
  }

  [[nodiscard]] double radius(BeadId bead) const { return radii_[bead]; }
  [[nodiscard]] double unscaled(double value, int power) const {
    return std::ldexp(value, power * exponent_);
  }
  template <std::size_t N>
  [[nodiscard]] auto terms(const std::array<BeadId, N>& beads) const {
    const auto [least, largest] = std::minmax_element(
        beads.begin(), beads.end(), [this](BeadId i, BeadId j) { return radii_[i] < radii_[j]; });
    const auto balls = relative<double>(beads);
    if (radii_[*largest] <= 100 * radii_[*least] && is_plump(balls)) return terms_of(balls);
    return terms_of(relative<Rational>(beads));
  }

 private:
  template <class Number, std::size_t N>
  [[nodiscard]] Balls<Number, N> relative(const std::array<BeadId, N>& beads) const {
    Balls<Number, N> balls;
    const Number radius = radii_[beads[0]];
    balls.weight = radius * radius;
    for (std::size_t i = 0; i < N; ++i) {
      for (int x = 0; x < 3; ++x)
        balls.a[i][static_cast<std::size_t>(x)] =
            (Number(centers_(x, beads[i])) - Number(centers_(x, beads[0]))) * Number(scale_);
      const Number other = radii_[beads[i]];
      balls.b[i] = dot(balls.a[i], balls.a[i]) + (radius - other) * (radius + other);
    }
    return balls;
  }

  const Eigen::Matrix3Xd& centers_;
  std::vector<double> radii_;
  int exponent_ = 0;
  double scale_ = 1;
};

/// The area of the sphere within the other ball of an edge.
double cap(double radius, double distance) { return 2 * pi * radius * (radius - distance); }
/// The volume of the ball beyond the plane of an edge.
double cap_volume(double radius, double distance) {
  const double height = radius - distance;
  return pi / 3 * height * height * (2 * radius + distance);
}

/// Areas and angles of three balls that meet.
struct Meeting {
  std::array<double, 3>
      half_angle;              ///< half the angle of the circle opposite to bead i that is within ball i
  std::array<double, 3> lens;  ///< area of sphere i within the two other balls
};

/// `edges[i]` is opposite to bead i; `distance(i, j)` is the distance of edge j's plane from bead i.
template <class Distance>
Meeting meet(const TriangleTerms& t, const std::array<double, 3>& radii, Distance distance) {
  Meeting m{};
  for (std::size_t i = 0; i < 3; ++i) m.half_angle[i] = std::atan2(t.half_chord, t.inward[i]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double r = radii[i], to_j = distance(i, k), to_k = distance(i, j);
    if (r == 0) continue;
    const double sides = t.length[j] * t.length[k];
    const double corner = std::atan2(t.half_chord * t.doubled_area / (sides * r),
                                     to_j / r * (to_k / r) - t.product[i] / sides);  // of the lens
    // The corner's angle is uncertain if a circle is tiny, but then its cap is tiny too.
    m.lens[i] = std::clamp(2 * r * (r * corner - m.half_angle[k] * to_j - m.half_angle[j] * to_k), 0.0,
                           std::max(0.0, cap(r, std::max(to_j, to_k))));
  }
  return m;
}

}  // namespace
}  // namespace ball_terms

UnionMeasures measure_union(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                            const ComplexSimplices& complex) {
  using namespace ball_terms;
  const FloatingPointScope to_nearest;
  const ScaledBalls balls(centers, radii, complex.vertices);
  UnionMeasures measures{std::vector<double>(radii.size()), std::vector<double>(radii.size()), {}};
  std::vector<double>& areas = measures.areas;
  for (const BeadId bead : complex.vertices) areas[bead] = 4 * pi * balls.radius(bead) * balls.radius(bead);

  struct Edge : EdgeTerms {
    double dihedrals = 0;    ///< sum over tetrahedra
    double half_angles = 0;  ///< sum over the sides of triangles that have no tetrahedron
    double moments = 0;      ///< sum over the facet's sides: length times distance from the facet's centre
  };
  struct Side {
    int tetrahedra = 0;
    double length = 0;  ///< of the part of the diagram's edge that ends within the balls
  };
  std::vector<Edge> edges;
  edges.reserve(complex.edges.size());
  for (const auto& beads : complex.edges) edges.push_back({balls.terms(beads)});
  std::vector<Side> sides(complex.triangles.size());

  for (const auto& tetrahedron : complex.tetrahedra) {
    const TetrahedronTerms terms = balls.terms(tetrahedron.beads);
    std::array<double, 4> solid_angle;
    solid_angle.fill(-pi);
    for (std::size_t e = 0; e < 6; ++e) {
      edges[tetrahedron.edges[e]].dihedrals += terms.dihedral[e];
      for (const std::size_t i : tetrahedron_edges[e]) solid_angle[i] += terms.dihedral[e];
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const double radius = balls.radius(tetrahedron.beads[i]);
      areas[tetrahedron.beads[i]] -= radius * radius * solid_angle[i];
      Side& side = sides[tetrahedron.triangles[i]];
      ++side.tetrahedra;
      side.length += terms.inward[i];
    }
  }

  for (std::size_t t = 0; t < sides.size(); ++t) {
    const std::array<BeadId, 3>& beads = complex.triangles[t].beads;
    const std::array<std::uint32_t, 3>& of = complex.triangles[t].edges;
    const TriangleTerms terms = balls.terms(beads);
    const double open = 2 - sides[t].tetrahedra, length = sides[t].length + open * terms.half_chord;
    for (std::size_t i = 0; i < 3; ++i) edges[of[i]].moments += terms.inward[i] * length;
    if (open == 0) continue;
    const Meeting meeting =
        meet(terms, {balls.radius(beads[0]), balls.radius(beads[1]), balls.radius(beads[2])},
             [&](std::size_t i, std::size_t j) {
               return edges[of[j]].distance[complex.edges[of[j]][0] == beads[i] ? 0 : 1];
             });
    for (std::size_t i = 0; i < 3; ++i) {
      edges[of[i]].half_angles += open * meeting.half_angle[i];
      areas[beads[i]] += open / 2 * meeting.lens[i];
    }
  }

  measures.contacts.reserve(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = edges[e];
    const double exposed = 2 * pi - edge.dihedrals - edge.half_angles;
    const double contact = std::max(0.0, (edge.squared_radius * exposed + edge.moments) / 2);
    measures.contacts.push_back(balls.unscaled(contact, 2));
    for (std::size_t i = 0; i < 2; ++i) {
      const BeadId bead = complex.edges[e][i];
      areas[bead] -= cap(balls.radius(bead), edge.distance[i]) * (1 - edge.dihedrals / (2 * pi));
      measures.volumes[bead] += edge.distance[i] * contact / 3;
    }
  }
  for (const BeadId bead : complex.vertices) {
    const double area = std::max(0.0, areas[bead]);
    areas[bead] = balls.unscaled(area, 2);
    double& volume = measures.volumes[bead];
    volume = balls.unscaled(std::max(0.0, volume + balls.radius(bead) * area / 3), 3);
  }
  return measures;
}

ComplementMeasures measure_complement(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                      std::span<const ComplementCell> cells) {
  using namespace ball_terms;
  const FloatingPointScope to_nearest;
  std::vector<BeadId> beads;
  for (const ComplementCell& cell : cells)
    for (std::size_t i = 0; i < 4; ++i)
      if ((cell.vertices >> i & 1) != 0) beads.push_back(cell.beads[i]);
  std::sort(beads.begin(), beads.end());
  beads.erase(std::unique(beads.begin(), beads.end()), beads.end());
  const ScaledBalls balls(centers, radii, beads);
  std::vector<double> areas(beads.size());
  const auto area_of = [&](BeadId bead) -> double& {
    return areas[static_cast<std::size_t>(std::lower_bound(beads.begin(), beads.end(), bead) -
                                          beads.begin())];
  };
  double volume = 0;
  for (const ComplementCell& cell : cells) {
    const TetrahedronTerms terms = balls.terms(cell.beads);
    volume += terms.volume;
    std::array<double, 4> solid_angle;
    solid_angle.fill(-pi);
    std::array<EdgeTerms, 6> edges;
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = tetrahedron_edges[e];
      solid_angle[i] += terms.dihedral[e];
      solid_angle[j] += terms.dihedral[e];
      if ((cell.edges >> e & 1) == 0) continue;
      edges[e] = balls.terms(std::array{cell.beads[i], cell.beads[j]});
      const double share = terms.dihedral[e] / (2 * pi);
      for (std::size_t end = 0; end < 2; ++end) {
        const BeadId bead = cell.beads[tetrahedron_edges[e][end]];
        area_of(bead) -= share * cap(balls.radius(bead), edges[e].distance[end]);
        volume += share * cap_volume(balls.radius(bead), edges[e].distance[end]);
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if ((cell.vertices >> i & 1) == 0) continue;
      const double radius = balls.radius(cell.beads[i]), area = radius * radius * solid_angle[i];
      area_of(cell.beads[i]) += area;
      volume -= radius * area / 3;
    }
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      if ((cell.triangles >> opposite & 1) == 0) continue;
      std::array<std::size_t, 3> corners{};
      for (std::size_t i = 0, c = 0; i < 4; ++i)
        if (i != opposite) corners[c++] = i;
      std::array<BeadId, 3> corner_beads{};
      std::array<double, 3> corner_radii{};
      for (std::size_t c = 0; c < 3; ++c) {
        corner_beads[c] = cell.beads[corners[c]];
        corner_radii[c] = balls.radius(corner_beads[c]);
      }
      // The edge opposite to corner c joins the two other corners, which are in ascending order.
      const auto edge_opposite = [&](std::size_t c) -> const EdgeTerms& {
        const std::array<std::size_t, 2> ends{corners[c == 0 ? 1 : 0], corners[c == 2 ? 1 : 2]};
        return edges[static_cast<std::size_t>(
            std::find(tetrahedron_edges.begin(), tetrahedron_edges.end(), ends) - tetrahedron_edges.begin())];
      };
      const TriangleTerms triangle = balls.terms(corner_beads);
      const Meeting meeting = meet(triangle, corner_radii, [&](std::size_t i, std::size_t j) {
        return edge_opposite(j).distance[i == (j == 0 ? 1U : 0U) ? 0 : 1];
      });
      double common = 0;  // three times the volume in which the three balls meet
      for (std::size_t c = 0; c < 3; ++c) {
        const EdgeTerms& edge = edge_opposite(c);
        area_of(corner_beads[c]) += meeting.lens[c] / 2;
        common +=
            corner_radii[c] * meeting.lens[c] - edge.length * (edge.squared_radius * meeting.half_angle[c] -
                                                               triangle.inward[c] * triangle.half_chord);
      }
      volume -= common / 6;
    }
  }
  ComplementMeasures measures{balls.unscaled(volume, 3), {}};
  for (std::size_t b = 0; b < beads.size(); ++b)
    measures.areas.emplace_back(beads[b], balls.unscaled(areas[b], 2));
  return measures;
}

}  // namespace kds
