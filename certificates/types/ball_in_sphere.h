#pragma once
// A ball in the minimum enclosing sphere of a basis of balls of any radii, for bases of 1 to 3 balls in the
// plane and of 1 to 4 in space. The formula is that of Fischer & Gaertner, The smallest enclosing ball of
// balls (2004), section 3. With the basis' first ball as base, let
//
//   d_i = c_i - c_0, s_i = r_i - r_0, E_i = |d_i|^2 - s_i^2 (twice e_i),
//   Q = [d_1 .. d_m], G = Q^T Q, g = det G, A = adj G.
//
// A sphere of radius R touches the basis from outside iff rho = R - r_0 solves a rho^2 + 2 b rho + c = 0 with
// a = s.As - g, b = e.As, c = e.Ae. The smallest solution is rho = c / (sqrt(b^2 - ac) - b). With F =
// d_j.QAe - g e_j and W = d_j.QAs - g s_j, ball j is inside iff F + W rho >= 0 and rho >= s_j, that is iff F
// sqrt(b^2 - ac) + (W c - F b) >= 0 and so on.
//
// Without common factors, squares and positive numbers, this is A + B sqrt(D) with
//
//   basis    A                                       B                D                degrees of A, B, norm
//   1        -|d|^2                                  -s_j             |d|^2            2k   k   2k
//   2        F                                       e_j s - s_j e    g                4k  3k   6k
//   3, space x (e_1 p_2 - e_2 p_1) - s_j c + e_j b   F                (c - x^2) / g    7k  6k  12k
//   3, plane x (eps x d_j) - s_j c + e_j b           sgn(q) F / q     c - x^2          7k  4k   8k
//   4        -d_j.(eps x Qx) - s_j c + e_j b         sgn(q) F / q     c - |Qx|^2       9k  5k  10k
//
// where p_i = d_i.d_j, q = det Q, x = e x s (also in the plane of indices). For a full basis, b and c are
// taken as eps.sig and |eps|^2 with eps = q Q^-T e, sig = q Q^-T s. The factors are taken out by Lagrange's
// identity, b^2 - ac = g (c - x.Gx).
//
// The norm A^2 - B^2 D is c times the result of Cramer's rule for the tangency of all balls: d_i.z - s_i
// rho = e_i for i = 1 .. m, j is linear in z = Qy and rho, (y, rho) = (Y, R) / W, and |z|^2 = rho^2 where
// Y.GY = R^2. For a full basis z is the unknown instead of y: |Z|^2 - R^2. For a basis of two, a factor e is
// taken out, and the remaining factor is e, not c. For a basis of one the remaining factor is |d|^2.
//
// The radius condition rho >= s_j is the sign of (c + s_j b) - s_j sqrt(b^2 - ac), with norm c + 2 b s_j + a
// s_j^2. The condition is implied while any ball of the basis is at least as large as ball j. At times when
// the function is positive, the condition can change only where ball j and the sphere coincide, and there the
// function vanishes.
//
// Requirements on the basis at all times: its centres span a simplex (and a full basis keeps its
// orientation), none of its balls contains another, and some sphere touches all of them from outside. A basis
// without a redundant ball meets them, and so does such a basis without one of its balls. Then g and c are
// positive. With y = A (e + s rho) / g at that sphere's rho, a rho^2 + 2 b rho + c = g (|Qy|^2 - rho^2) <= 0,
// since Qy is the sphere's centre projected to the span of the basis. Hence b^2 - ac >= 0 and sqrt(b^2 - ac)
// - b > 0. The sign of D is therefore never needed.
//
// `inside` certificates guard a ball that must stay inside. The others guard a basis ball that must stay
// outside of the sphere of the other basis balls; if it enters, it leaves the basis. Exact.

#include <array>
#include <tuple>
#include <type_traits>
#include <utility>

#include "certificates/base/determinant.h"
#include "certificates/base/radical.h"

namespace kds {

namespace detail {

/// The balls relative to the first ball.
template <int Size, MotionView View>
struct BallsFromBase {
  using Number = typename View::Number;
  static constexpr int k = View::degree;

  std::array<BernsteinVector<Number, k, View::dimension>, Size> d;  ///< the last one belongs to ball j
  std::array<Bernstein<Number, k>, Size> s;
  std::array<Bernstein<Number, 2 * k>, Size> e;  ///< twice e_i; all formulas below use these

  BallsFromBase(const View& view, const std::array<BeadId, Size + 1>& beads) {
    for (std::size_t i = 0; i < Size; ++i) {
      d[i] = view.difference(beads[i + 1], beads[0]);
      s[i] = view.radius_difference(beads[i + 1], beads[0]);
      e[i] = dot(d[i], d[i]) - s[i] * s[i];
    }
  }
};

/// Returns the sum of v_i w_i.
template <class P, class Q, std::size_t N, std::size_t M>
[[nodiscard]] constexpr auto combination(const std::array<P, N>& p, const std::array<Q, M>& vectors) {
  auto scaled = [&](std::size_t i) {
    std::array<decltype(p[0] * vectors[0][0]), std::tuple_size_v<Q>> v;
    for (std::size_t axis = 0; axis < v.size(); ++axis) v[axis] = p[i] * vectors[i][axis];
    return v;
  };
  auto sum = scaled(0);
  for (std::size_t i = 1; i < M; ++i) {
    const auto next = scaled(i);
    for (std::size_t axis = 0; axis < sum.size(); ++axis) sum[axis] += next[axis];
  }
  return sum;
}

/// G, A e and quantities derived from them, for a basis of three in space.
template <MotionView View>
struct TriangleSphere : BallsFromBase<3, View> {
  using Base = BallsFromBase<3, View>;
  static constexpr int k = View::degree;
  template <int Degree>
  using P = Bernstein<typename View::Number, Degree>;

  P<2 * k> g11, g12, g22;
  P<4 * k> g;
  std::array<P<4 * k>, 2> ae;

  TriangleSphere(const View& view, const std::array<BeadId, 4>& beads)
      : Base(view, beads),
        g11(dot(this->d[0], this->d[0])),
        g12(dot(this->d[0], this->d[1])),
        g22(dot(this->d[1], this->d[1])),
        g(g11 * g22 - g12 * g12),
        ae{g22 * this->e[0] - g12 * this->e[1], g11 * this->e[1] - g12 * this->e[0]} {}

  [[nodiscard]] auto a() const {
    const auto& [s1, s2, sj] = this->s;
    return s1 * (g22 * s1 - g12 * s2) + s2 * (g11 * s2 - g12 * s1) - g;
  }
  [[nodiscard]] auto b() const { return this->s[0] * ae[0] + this->s[1] * ae[1]; }
  [[nodiscard]] auto c() const { return this->e[0] * ae[0] + this->e[1] * ae[1]; }
  [[nodiscard]] auto excess() const {  // F
    const auto& [d1, d2, dj] = this->d;
    return dot(d1, dj) * ae[0] + dot(d2, dj) * ae[1] - g * this->e[2];
  }
};

/// q, eps and sig of a full basis.
template <int Dimension, MotionView View>
struct SimplexSphere : BallsFromBase<Dimension + 1, View> {
  using Base = BallsFromBase<Dimension + 1, View>;
  static constexpr int k = View::degree;
  using Normal = BernsteinVector<typename View::Number, (Dimension - 1) * k, Dimension>;

  std::array<Normal, Dimension> normals;  ///< columns of q Q^-T
  Bernstein<typename View::Number, Dimension * k> q;
  BernsteinVector<typename View::Number, (Dimension + 1) * k, Dimension> eps;
  BernsteinVector<typename View::Number, Dimension * k, Dimension> sig;

  SimplexSphere(const View& view, const std::array<BeadId, Dimension + 2>& beads)
      : Base(view, beads),
        normals(normals_of(this->d)),
        q(dot(this->d[0], normals[0])),
        eps(combination(this->e, normals)),
        sig(combination(this->s, normals)) {}

  [[nodiscard]] auto b() const { return dot(eps, sig); }
  [[nodiscard]] auto c() const { return dot(eps, eps); }
  [[nodiscard]] auto a() const { return dot(sig, sig) - q * q; }
  [[nodiscard]] auto excess() const {  // F / q
    return dot(this->d[Dimension], eps) - q * this->e[Dimension];
  }

 private:
  template <class Vectors>
  static std::array<Normal, Dimension> normals_of(const Vectors& d) {
    if constexpr (Dimension == 2) {
      return {Normal{d[1][1], -d[1][0]}, Normal{-d[0][1], d[0][0]}};
    } else {
      return {cross(d[1], d[2]), cross(d[2], d[0]), cross(d[0], d[1])};
    }
  }
};

}  // namespace detail

template <int Dimension, int Size>
struct BallInSphere {
  static_assert((Dimension == 2 || Dimension == 3) && Size >= 1 && Size <= Dimension + 1);
  static constexpr CertificateType type{5, "ball_in_sphere"};
  static constexpr bool full = Size == Dimension + 1;

  using Beads = std::array<BeadId, Size + 1>;

  Beads beads{};  ///< the basis, ascending, then the ball
  bool inside = true;
  int orientation = 1;  ///< orientation of a full basis (orientation.h): the sign of q

  /// Returns the identity. A full basis of negative orientation has a different function, so its name begins
  /// with the first two beads exchanged.
  [[nodiscard]] Identity identity() const {
    Beads named = beads;
    if (full && orientation < 0) std::swap(named[0], named[1]);
    return identity_of(type, named);
  }

  [[nodiscard]] bool side() const { return inside; }
  [[nodiscard]] int root_sign() const { return full ? orientation : 1; }

  /// Returns whether the condition rho >= s_j must be checked.
  template <Motion M>
  [[nodiscard]] bool conditional(const M& motion) const {
    if constexpr (Size == 1) return false;  // A and B imply the condition
    for (std::size_t i = 0; i < Size; ++i) {
      bool smaller = false;
      for (int k = 0; k <= degree_of(motion); ++k)
        smaller |= motion.radius(beads[i], k) < motion.radius(beads[Size], k);
      if (!smaller) return false;
    }
    return true;
  }

  /// Returns whether D and all factors omitted from A, B, D and the norm are certainly positive. `sign_of`
  /// returns the certain sign of a number, or 0 if unknown. If a < 0, some sphere touches any such balls, so
  /// b^2 - ac > 0.
  template <MotionView View, class SignOf>
  [[nodiscard]] static bool is_usable(const View& view, const Beads& beads, SignOf sign_of) {
    const auto positive = [&](const auto& moment) { return sign_of(moment.scaled[0]) > 0; };
    if constexpr (Size == 1) {
      return true;
    } else if constexpr (Size == 2) {
      return positive(detail::BallsFromBase<2, View>(view, beads).e[0]);
    } else {
      const Sphere<View> balls(view, beads);
      if constexpr (full) {
        if (sign_of(balls.q.scaled[0]) == 0) return false;
      } else if (!positive(balls.g)) {
        return false;
      }
      const auto a = balls.a(), b = balls.b(), c = balls.c();
      return positive(c) && (positive(-a) || (positive(-b) && positive(b * b - a * c)));
    }
  }

  /// One polynomial of the radical.
  struct RadicalPolynomial {
    static constexpr bool uses_radii = true;
    Beads beads{};
  };

  struct Radical {
    struct Rational : RadicalPolynomial {
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const Beads& beads) {
        if constexpr (Size == 1) {
          const auto d = detail::BallsFromBase<1, View>(view, beads).d[0];
          return -dot(d, d);
        } else if constexpr (Size == 2) {
          const detail::BallsFromBase<2, View> balls(view, beads);
          const auto& [d, dj] = balls.d;
          return dot(d, dj) * balls.e[0] - dot(d, d) * balls.e[1];
        } else if constexpr (!full) {
          const detail::TriangleSphere<View> balls(view, beads);
          const auto& [d1, d2, dj] = balls.d;
          const auto& [s1, s2, sj] = balls.s;
          const auto& [e1, e2, ej] = balls.e;
          const auto x = e1 * s2 - e2 * s1;
          return x * (e1 * dot(d2, dj) - e2 * dot(d1, dj)) - sj * balls.c() + ej * balls.b();
        } else if constexpr (Dimension == 2) {
          const detail::SimplexSphere<2, View> balls(view, beads);
          const auto& [s1, s2, sj] = balls.s;
          const auto& [e1, e2, ej] = balls.e;
          const auto& dj = balls.d[2];
          const auto x = e1 * s2 - e2 * s1;
          return x * (balls.eps[0] * dj[1] - balls.eps[1] * dj[0]) - sj * balls.c() + ej * balls.b();
        } else {
          const detail::SimplexSphere<3, View> balls(view, beads);
          const auto& [s1, s2, s3, sj] = balls.s;
          const auto& [e1, e2, e3, ej] = balls.e;
          const std::array x{e2 * s3 - e3 * s2, e3 * s1 - e1 * s3, e1 * s2 - e2 * s1};
          const std::array basis{balls.d[0], balls.d[1], balls.d[2]};
          return ej * balls.b() - sj * balls.c() -
                 dot(balls.d[3], cross(balls.eps, detail::combination(x, basis)));
        }
      }
    };

    struct Root : RadicalPolynomial {
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const Beads& beads) {
        if constexpr (Size == 1) {
          return -detail::BallsFromBase<1, View>(view, beads).s[0];
        } else if constexpr (Size == 2) {
          const detail::BallsFromBase<2, View> balls(view, beads);
          return balls.e[1] * balls.s[0] - balls.s[1] * balls.e[0];
        } else if constexpr (!full) {
          return detail::TriangleSphere<View>(view, beads).excess();
        } else {
          return detail::SimplexSphere<Dimension, View>(view, beads).excess();
        }
      }
    };

    struct Norm : RadicalPolynomial {
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const Beads& beads) {
        const detail::BallsFromBase<Size, View> balls(view, beads);
        if constexpr (Size == 1) {
          return balls.e[0];
        } else if constexpr (Size == 2) {
          const auto& [d, dj] = balls.d;
          const auto& [s, sj] = balls.s;
          const auto& [e, ej] = balls.e;
          const auto g = dot(d, d);
          const auto p = dot(d, dj);
          const auto gej = g * ej;
          const auto bend = gej * (p - s * sj);
          return e * (p * p - g * (sj * sj)) - bend - bend + gej * ej;
        } else if constexpr (!full) {
          const detail::TriangleSphere<View> sphere(view, beads);
          const auto& [d1, d2, dj] = balls.d;
          const auto& [s1, s2, sj] = balls.s;
          const auto& [e1, e2, ej] = balls.e;
          const auto p1 = dot(d1, dj);
          const auto p2 = dot(d2, dj);
          const auto column = [](const auto& x, const auto& y, const auto& z) { return std::array{x, y, z}; };
          const std::array y{
              tangency(column(sphere.g12, sphere.g22, p2), column(s1, s2, sj), column(e1, e2, ej)),
              -tangency(column(sphere.g11, sphere.g12, p1), column(s1, s2, sj), column(e1, e2, ej))};
          const auto z = detail::combination(y, std::array{d1, d2});
          const auto r = sphere.excess();
          return dot(z, z) - r * r;
        } else {
          // Squared determinant of the columns d, s except one, with the column e.
          const auto without = [&](int column) {
            std::array<BernsteinVector<typename View::Number, View::degree, Dimension>, Size> rows;
            for (std::size_t i = 0; i < Size; ++i) {
              std::size_t index = 0;
              for (int axis = 0; axis < Dimension; ++axis) {
                if (axis != column) rows[i][index++] = balls.d[i][static_cast<std::size_t>(axis)];
              }
              if (column < Dimension) rows[i][index] = balls.s[i];
            }
            const auto minor_of_all = determinant(rows, balls.e);
            return minor_of_all * minor_of_all;
          };
          auto sum = without(0) - without(Dimension);
          for (int axis = 1; axis < Dimension; ++axis) sum += without(axis);
          return sum;
        }
      }

     private:
      /// Returns det [a s e] of three columns of length three.
      template <class A, class S, class E>
      static auto tangency(const A& a, const S& s, const E& e) {
        return minor(a[0], s[0], a[1], s[1]) * e[2] - minor(a[0], s[0], a[2], s[2]) * e[1] +
               minor(a[1], s[1], a[2], s[2]) * e[0];
      }
    };
  };

  /// The condition rho > s_j. For a basis of one, A and B imply it.
  struct RadiusCondition {
    struct Rational : RadicalPolynomial {
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const Beads& beads) {
        const Sphere<View> balls(view, beads);
        const auto& sj = balls.s[Size - 1];
        if constexpr (Size == 2) {  // a = -2e, b = es, c = e^2, without the factor e
          const auto bs = balls.s[0] * sj;
          return balls.e[0] + bs + bs;
        } else {
          const auto bs = balls.b() * sj;
          return balls.c() + bs + bs;
        }
      }
    };
    struct Root : RadicalPolynomial {
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const Beads& beads) {
        return view.radius_difference(beads[0], beads[Size]);
      }
    };
    struct Norm : RadicalPolynomial {
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const Beads& beads) {
        const Sphere<View> balls(view, beads);
        const auto twice = balls.s[Size - 1] + balls.s[Size - 1];
        if constexpr (Size == 2) {
          const auto bs = balls.s[0] * twice;
          return balls.e[0] + bs + bs - twice * twice;
        } else {
          const auto bs = balls.b() * twice;
          return balls.c() + bs + bs + balls.a() * (twice * twice);
        }
      }
    };
  };
  using Condition = std::conditional_t<(Size > 1), RadiusCondition, void>;

 private:
  template <MotionView View>
  using Sphere = std::conditional_t<
      Size <= 2, detail::BallsFromBase<Size, View>,
      std::conditional_t<full, detail::SimplexSphere<Size - 1, View>, detail::TriangleSphere<View>>>;
};

}  // namespace kds
