#include "certificates/exact/halves.h"

#include <algorithm>
#include <utility>

namespace kds {

namespace {

using Integers = std::vector<Integer>;

// Returns C(degree, k) for all k. Products of functions have higher degrees than binomial() supports.
Integers binomials(std::size_t degree) {
  Integers row(degree + 1, Integer(1));
  for (std::size_t k = 1; k < degree; ++k) row[k] = row[k - 1] * (degree - k + 1) / k;
  return row;
}

void shift_up(Integer& to, const Integer& from, std::size_t bits) {
  mpz_mul_2exp(to.get_mpz_t(), from.get_mpz_t(), bits);
}

bool is_certain(const Integer& x, const Integer& error) {
  return error == 0 || mpz_cmpabs(x.get_mpz_t(), error.get_mpz_t()) > 0;
}

}  // namespace

Unscaled unscaled(const Integers& scaled) {
  const Integers choose = binomials(scaled.size() - 1);
  Unscaled result{scaled, 1};
  for (const Integer& c : choose) result.multiple = lcm(result.multiple, c);
  for (std::size_t k = 0; k < scaled.size(); ++k) result.coefficients[k] *= result.multiple / choose[k];
  return result;
}

void halve(Integers& local, Integers& left) {
  const std::size_t degree = local.size() - 1;
  ExactWork::spend(local.size() * local.size() * detail::limbs_of(local.back()));
  for (std::size_t round = 0; round <= degree; ++round) {
    shift_up(left[round], local[0], degree - round);
    for (std::size_t i = 0; i + round < degree; ++i) local[i] += local[i + 1];
  }
  for (std::size_t i = 1; i <= degree; ++i) shift_up(local[i], local[i], i);
}

Halves::Halves(const Integers& scaled, const Integer& error) {
  Unscaled whole = unscaled(scaled);
  c_ = std::move(whole.coefficients);
  error_ = error * whole.multiple;
}

Variations Halves::variations(int sign_at_lower, int sign_at_upper) const {
  detail::VariationCount count;
  count.add(sign_at_lower);
  for (std::size_t k = 1; k + 1 < c_.size(); ++k) {
    if (is_certain(c_[k], error_)) {
      count.add(sgn(c_[k]));
    } else {
      count.add_unknown();
    }
  }
  count.add(sign_at_upper);
  return count.value();
}

std::optional<int> Halves::sign_of(const Integer& x) const {
  return is_certain(x, error_) ? std::optional(sgn(x)) : std::nullopt;
}

std::optional<Halves::Cells> Halves::cells_of_cluster(int multiplicity, unsigned digits) const {
  // Neighbouring coefficients differ by the slope divided by the degree.
  const auto steps = [&](const Integer& value, const Integer& next) -> std::optional<Integer> {
    const Integer fall = (value - next) * static_cast<long>(c_.size() - 1);
    if (value == 0 || sgn(fall) != sgn(value)) return std::nullopt;
    return Integer(((value * multiplicity) << digits) / fall);
  };
  const std::optional<Integer> from_lower = steps(c_.front(), c_[1]);
  const std::optional<Integer> from_upper = steps(c_.back(), c_[c_.size() - 2]);
  if (!from_lower || !from_upper) return std::nullopt;
  const Integer end = (Integer(1) << digits) - 1, other = end - *from_upper;
  Cells cells{std::min(*from_lower, other) - 1, std::max(*from_lower, other) + 1};
  constexpr int most = 8;
  if (cells.last - cells.first >= most || cells.first > end || cells.last < 0) return std::nullopt;
  if (cells.first < 0) cells.first = 0;
  if (cells.last > end) cells.last = end;
  return cells;
}

Halves Halves::halve() {
  Halves left;
  left.c_.resize(c_.size());
  kds::halve(c_, left.c_);
  if (error_ != 0) {  // round to the previous unit, which adds less than 1 to each error
    const std::size_t degree = c_.size() - 1;
    for (Integers* half : {&c_, &left.c_})
      for (Integer& x : *half) mpz_fdiv_q_2exp(x.get_mpz_t(), x.get_mpz_t(), degree);
    ++error_;
  }
  left.error_ = error_;
  left.depth_ = ++depth_;
  return left;
}

}  // namespace kds
