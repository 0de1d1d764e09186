#include "certificates/exact/polynomial_gcd.h"

#include <flint/flint.h>
#include <flint/fmpz.h>
#include <flint/fmpz_poly.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "certificates/exact/exact_work.h"

namespace kds {

namespace {

using Integers = std::vector<Integer>;
using Image = std::vector<Residue>;

void drop_zeros(Image& p) {
  while (!p.empty() && p.back().value == 0) p.pop_back();
}

/// The gcd up to a constant factor, by Euclid's algorithm; multiples of the remainders will do. Leading
/// coefficients not zero.
Image gcd_of_images(Image f, Image g) {
  ExactWork::spend(f.size() * g.size());
  if (f.size() < g.size()) std::swap(f, g);
  while (!g.empty()) {
    const Residue lead = g.back();
    while (f.size() >= g.size()) {
      const Residue factor = -f.back();
      const std::size_t shift = f.size() - g.size();
      for (std::size_t i = 0; i < shift; ++i) f[i] *= lead;
      for (std::size_t i = 0; i < g.size(); ++i) {
        SumOfProducts<Residue> sum(f[i + shift], lead);
        sum.add(factor, g[i]);
        f[i + shift] = std::move(sum).value();
      }
      drop_zeros(f);
    }
    std::swap(f, g);
  }
  return f;
}

/// FLINT keeps memory for each thread until it is told that the thread has ended.
void free_when_thread_ends() {
  struct Cleanup {
    ~Cleanup() { flint_cleanup(); }
  };
  thread_local const Cleanup cleanup;
  static_cast<void>(cleanup);
}

/// A polynomial of FLINT's, as a value.
class FlintPolynomial {
 public:
  FlintPolynomial() {
    free_when_thread_ends();
    fmpz_poly_init(value_);
  }
  explicit FlintPolynomial(const Integers& p) : FlintPolynomial() {
    fmpz_t coefficient;
    fmpz_init(coefficient);
    for (std::size_t k = p.size(); k-- > 0;) {
      fmpz_set_mpz(coefficient, p[k].get_mpz_t());
      fmpz_poly_set_coeff_fmpz(value_, static_cast<slong>(k), coefficient);
    }
    fmpz_clear(coefficient);
  }
  FlintPolynomial(const FlintPolynomial&) = delete;
  FlintPolynomial& operator=(const FlintPolynomial&) = delete;
  ~FlintPolynomial() { fmpz_poly_clear(value_); }

  [[nodiscard]] fmpz_poly_struct* data() { return value_; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(fmpz_poly_length(value_)); }
  [[nodiscard]] Integers coefficients() const {
    Integers result(size());
    for (std::size_t k = 0; k < result.size(); ++k)
      fmpz_get_mpz(result[k].get_mpz_t(), fmpz_poly_get_coeff_ptr(value_, static_cast<slong>(k)));
    return result;
  }
  /// Sets this to the primitive gcd of two others.
  void set_to_gcd(const FlintPolynomial& a, const FlintPolynomial& b) {
    // Brown's modular gcd: Euclid's algorithm modulo as many primes as the shorter coefficients have words.
    const auto words = [](const FlintPolynomial& p) {
      return static_cast<std::size_t>(std::abs(fmpz_poly_max_bits(p.value_)) / FLINT_BITS + 1);
    };
    ExactWork::spend(a.size() * b.size() * std::min(words(a), words(b)));
    fmpz_poly_gcd(value_, a.value_, b.value_);
    fmpz_poly_primitive_part(value_, value_);
  }

 private:
  fmpz_poly_t value_;
};

}  // namespace

std::vector<Residue> image_of(const std::vector<Integer>& p) {
  constexpr std::uint64_t fold = residue_folds[0];
  Image image;
  image.reserve(p.size());
  for (const Integer& x : p) image.push_back({mpz_fdiv_ui(x.get_mpz_t(), Residue::modulus(fold)), fold});
  return image;
}

bool certainly_coprime(const std::vector<Integer>& a, const std::vector<Integer>& b) {
  return certainly_coprime(image_of(a), image_of(b));
}

bool certainly_coprime(std::vector<Residue> a, std::vector<Residue> b) {
  if (a.empty() || b.empty() || (a.back().value == 0 && b.back().value == 0)) return false;
  drop_zeros(a);
  drop_zeros(b);
  return gcd_of_images(std::move(a), std::move(b)).size() == 1;
}

bool certainly_square_free(const std::vector<Integer>& p) { return certainly_square_free(image_of(p)); }

bool certainly_square_free(std::vector<Residue> p) {
  if (p.size() < 2 || p.back().value == 0) return false;
  Image derivative(p.begin() + 1, p.end());
  for (std::size_t k = 0; k < derivative.size(); ++k) derivative[k] *= static_cast<long long>(k + 1);
  drop_zeros(derivative);
  return gcd_of_images(std::move(p), std::move(derivative)).size() == 1;
}

std::vector<Integer> polynomial_gcd(const std::vector<Integer>& a, const std::vector<Integer>& b) {
  FlintPolynomial gcd;
  gcd.set_to_gcd(FlintPolynomial(a), FlintPolynomial(b));
  return gcd.coefficients();
}

std::vector<Integer> without_repeated_factors(const std::vector<Integer>& p) {
  FlintPolynomial polynomial(p), derivative, repeated;
  fmpz_poly_primitive_part(polynomial.data(), polynomial.data());
  fmpz_poly_derivative(derivative.data(), polynomial.data());
  repeated.set_to_gcd(polynomial, derivative);
  fmpz_poly_divides(polynomial.data(), polynomial.data(), repeated.data());
  Integers result = polynomial.coefficients();
  // FLINT makes the leading coefficient of a primitive part positive.
  if (p.back() < 0)
    for (Integer& x : result) x = -std::move(x);
  return result;
}

}  // namespace kds
