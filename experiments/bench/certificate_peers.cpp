#include "experiments/bench/certificate_peers.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#ifdef CGAL_USE_MPFI
#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpz.h>
#endif

#include <benchmark/benchmark.h>

#include <algorithm>
#include <iterator>

namespace kds::bench {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct StaticPredicates::Points {
  std::vector<Kernel::Point_3> centers;
  std::vector<Kernel::Weighted_point_3> weighted;
};

StaticPredicates::StaticPredicates(const Eigen::Matrix3Xd& centers, std::span<const double> weights)
    : points_(std::make_unique<Points>()) {
  for (Eigen::Index i = 0; i < centers.cols(); ++i) {
    points_->centers.emplace_back(centers(0, i), centers(1, i), centers(2, i));
    points_->weighted.emplace_back(points_->centers.back(), weights[static_cast<std::size_t>(i)]);
  }
}

StaticPredicates::~StaticPredicates() = default;

namespace {

template <class Tuples, class Predicate>
void for_all(const Tuples& tuples, const Predicate& predicate) {
  int sum = 0;
  for (const auto& t : tuples) sum += static_cast<int>(predicate(t));
  benchmark::DoNotOptimize(sum);
}

}  // namespace

void StaticPredicates::test(std::span<const std::array<BeadId, 5>> beads) const {
  const auto& p = points_->weighted;
  const auto test = Kernel().power_side_of_oriented_power_sphere_3_object();
  for_all(beads, [&](const auto& t) { return test(p[t[0]], p[t[1]], p[t[2]], p[t[3]], p[t[4]]); });
}

void StaticPredicates::test(std::span<const std::array<BeadId, 4>> beads) const {
  const auto& p = points_->centers;
  const auto test = Kernel().side_of_bounded_sphere_3_object();
  for_all(beads, [&](const auto& t) { return test(p[t[0]], p[t[1]], p[t[2]], p[t[3]]); });
}

void StaticPredicates::test(std::span<const std::array<BeadId, 3>> beads) const {
  const auto& p = points_->centers;
  const auto test = Kernel().side_of_bounded_sphere_3_object();
  for_all(beads, [&](const auto& t) { return test(p[t[0]], p[t[1]], p[t[2]]); });
}

#ifdef CGAL_USE_MPFI

using Algebraic = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;

struct AlgebraicKernel::Polynomials {
  Algebraic kernel;
  std::vector<Algebraic::Polynomial_1> all;
  std::vector<Algebraic::Algebraic_real_1> first_roots;
};

namespace {

// Expands sum_k scaled[k] u^k (1-u)^(n-k) into powers of u by Horner's scheme.
Algebraic::Polynomial_1 power_form(const ExactPolynomial& p) {
  std::vector<Integer> sum{p.scaled().back()};
  std::vector<Integer> power{1};  // powers of 1-u
  for (std::size_t k = p.scaled().size() - 1; k-- > 0;) {
    power.push_back(0);
    for (std::size_t i = power.size() - 1; i > 0; --i) power[i] -= power[i - 1];
    sum.insert(sum.begin(), 0);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += p.scaled()[k] * power[i];
  }
  std::vector<CGAL::Gmpz> coefficients;
  for (const Integer& x : sum) coefficients.emplace_back(x.get_mpz_t());
  return {coefficients.begin(), coefficients.end()};
}

}  // namespace

AlgebraicKernel::AlgebraicKernel(std::span<const ExactPolynomial> polynomials)
    : polynomials_(std::make_unique<Polynomials>()) {
  for (const ExactPolynomial& p : polynomials) polynomials_->all.push_back(power_form(p));
}

const bool AlgebraicKernel::available = true;

void AlgebraicKernel::isolate() const {
  const auto solve = polynomials_->kernel.solve_1_object();
  std::vector<Algebraic::Algebraic_real_1> roots;
  for (const auto& p : polynomials_->all) {
    roots.clear();
    solve(p, true, std::back_inserter(roots));
    benchmark::DoNotOptimize(roots.data());
  }
}

void AlgebraicKernel::compare(std::span<const std::pair<std::size_t, std::size_t>> pairs) {
  auto& first = polynomials_->first_roots;
  const auto compare = polynomials_->kernel.compare_1_object();
  if (first.empty()) {
    std::vector<Algebraic::Algebraic_real_1> roots;
    for (const auto& p : polynomials_->all) {
      roots.clear();
      polynomials_->kernel.solve_1_object()(p, true, std::back_inserter(roots));
      const auto is_positive = [&](const auto& x) { return compare(x, Algebraic::Bound(0)) == CGAL::LARGER; };
      first.push_back(*std::find_if(roots.begin(), roots.end(), is_positive));
    }
  }
  for_all(pairs, [&](const auto& pair) { return compare(first[pair.first], first[pair.second]); });
}

#else

struct AlgebraicKernel::Polynomials {};

const bool AlgebraicKernel::available = false;

AlgebraicKernel::AlgebraicKernel(std::span<const ExactPolynomial>) {}

void AlgebraicKernel::isolate() const {}
void AlgebraicKernel::compare(std::span<const std::pair<std::size_t, std::size_t>>) {}

#endif

AlgebraicKernel::~AlgebraicKernel() = default;

}  // namespace kds::bench
