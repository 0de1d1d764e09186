#include "certificates/exact/modular_gcd.h"

#include <cstddef>
#include <mutex>
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

/// The fold of the largest primes below 2^61, one after the other, as many as are asked for. (If one were no
/// prime, which probability tests exclude, its images would be of no use, and no candidate would divide.)
std::uint64_t fold_of_prime(std::size_t number) {
  if (number < residue_folds.size()) return residue_folds[number];
  static std::mutex mutex;
  static std::vector<std::uint64_t> more;
  const std::lock_guard lock(mutex);
  while (residue_folds.size() + more.size() <= number) {
    std::uint64_t fold = (more.empty() ? residue_folds.back() : more.back()) + 2;
    while (mpz_probab_prime_p(Integer((1ULL << 61U) - fold).data(), 25) == 0) fold += 2;
    more.push_back(fold);
  }
  return more[number - residue_folds.size()];
}

std::uint64_t residue_of(const Integer& x, std::uint64_t fold) {
  return mpz_fdiv_ui(x.data(), Residue::modulus(fold));
}

Image image_of(const Integers& p, std::uint64_t fold) {
  Image image;
  image.reserve(p.size());
  for (const Integer& x : p) image.push_back({residue_of(x, fold), fold});
  return image;
}

/// A polynomial known modulo a product of primes, coefficients nearest to zero.
class Combined {
 public:
  [[nodiscard]] const Integers& polynomial() const { return polynomial_; }
  [[nodiscard]] std::size_t size() const { return polynomial_.size(); }
  /// Known no more.
  void forget() {
    polynomial_.clear();
    modulus_ = 1;
  }
  /// Knows it modulo one more prime; whether that changed nothing, as where all of it is known.
  bool add(const Image& image, std::uint64_t fold) {
    if (polynomial_.empty()) polynomial_.resize(image.size());
    ExactWork::spend(image.size() * mpz_size(modulus_.data()));
    const Residue inverse = Residue{residue_of(modulus_, fold), fold}.inverse();
    const Integer prime = Residue::modulus(fold);
    bool same = true;
    for (std::size_t i = 0; i < image.size(); ++i) {
      const Residue step = (image[i] - Residue{residue_of(polynomial_[i], fold), fold}) * inverse;
      if (step.value == 0) continue;
      same = false;
      Integer digit = step.value;
      if (2 * digit > prime) digit -= prime;
      polynomial_[i] += digit * modulus_;
    }
    modulus_ *= prime;
    return same;
  }

 private:
  Integers polynomial_;
  Integer modulus_ = 1;
};

}  // namespace

std::vector<Residue> image_of(const std::vector<Integer>& p) { return image_of(p, residue_folds[0]); }

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

void make_primitive(std::vector<Integer>& p) {
  Integer content = 0;
  for (const Integer& x : p) {
    content = gcd(content, x);
    if (content == 1) return;
  }
  if (content == 0) return;
  for (Integer& x : p) mpz_divexact(x.data(), x.data(), content.data());
}

std::optional<std::vector<Integer>> quotient(std::vector<Integer> a, const std::vector<Integer>& b) {
  if (a.size() < b.size()) return std::nullopt;
  Integers result(a.size() - b.size() + 1);
  ExactWork::spend(result.size() * b.size() * mpz_size(a.back().data()));
  for (std::size_t k = result.size(); k-- > 0;) {
    const Integer& lead = a[k + b.size() - 1];
    if (mpz_divisible_p(lead.data(), b.back().data()) == 0) return std::nullopt;
    mpz_divexact(result[k].data(), lead.data(), b.back().data());
    for (std::size_t i = 0; i < b.size(); ++i) mpz_submul(a[k + i].data(), result[k].data(), b[i].data());
  }
  for (std::size_t i = 0; i + 1 < b.size(); ++i)
    if (a[i] != 0) return std::nullopt;
  return result;
}

std::vector<Integer> polynomial_gcd(std::vector<Integer> a, std::vector<Integer> b) {
  make_primitive(a);
  make_primitive(b);
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  // The gcd's leading coefficient divides this; images are made monic and then multiplied by it.
  const Integer lead = gcd(a.back(), b.back());
  Combined known;
  for (std::size_t number = 0;; ++number) {
    const std::uint64_t fold = fold_of_prime(number);
    if (residue_of(lead, fold) == 0) continue;
    Image fa = image_of(a, fold), fb = image_of(b, fold);
    if (fa.back().value == 0 || fb.back().value == 0) continue;
    Image image = gcd_of_images(std::move(fa), std::move(fb));
    if (image.size() == 1) return {Integer(1)};
    const Residue factor = image.back().inverse() * Residue{residue_of(lead, fold), fold};
    for (Residue& x : image) x *= factor;
    if (known.size() != 0 && image.size() > known.size()) continue;  // a prime that shows too much in common
    if (known.size() != image.size()) known.forget();
    if (!known.add(image, fold)) continue;
    Integers candidate = known.polynomial();
    make_primitive(candidate);
    if (quotient(a, candidate) && quotient(b, candidate)) return candidate;
  }
}

}  // namespace kds
