#pragma once
// CGAL's operations for the questions that certificates answer: static predicates of doubles, and algebraic
// numbers.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "certificates/exact/exact_polynomial.h"
#include "motions/base/bead.h"

namespace kds::bench {

/// Predicates of Exact_predicates_inexact_constructions_kernel at one moment.
class StaticPredicates {
 public:
  StaticPredicates(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  ~StaticPredicates();

  /// Each makes all tests: power tests of five beads, or whether the last of three or four beads is in the
  /// smallest sphere through the others.
  void test(std::span<const std::array<BeadId, 5>> beads) const;
  void test(std::span<const std::array<BeadId, 4>> beads) const;
  void test(std::span<const std::array<BeadId, 3>> beads) const;

 private:
  struct Points;
  std::unique_ptr<Points> points_;
};

/// Algebraic_kernel_d_1<Gmpz>. Does nothing if kds was built without MPFI.
class AlgebraicKernel {
 public:
  static const bool available;

  explicit AlgebraicKernel(std::span<const ExactPolynomial> polynomials);
  ~AlgebraicKernel();

  /// Isolates all real roots of every polynomial. The polynomials must be square-free.
  void isolate() const;
  /// Compares the first positive roots of pairs of polynomials. The first call isolates them.
  void compare(std::span<const std::pair<std::size_t, std::size_t>> pairs);

 private:
  struct Polynomials;
  std::unique_ptr<Polynomials> polynomials_;
};

}  // namespace kds::bench
