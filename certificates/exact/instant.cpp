#include "certificates/exact/instant.h"

#include <algorithm>
#include <stdexcept>

#include "certificates/exact/exact_time.h"
#include "certificates/exact/wide_polynomial.h"
#include "certificates/exact/wide_roots.h"

namespace kds {

ExactTime exact_time(const ExactPolynomial& function, const FailureTime& time) {
  const Dyadic lower(time.lower);
  if (time.lower == time.upper) return ExactTime(lower);
  if (time.isolating) {
    const Dyadic upper(time.upper);
    if (function.wide() != nullptr) return {function, known_root(*function.wide(), lower, upper)};
    return {function, {lower, upper}};
  }
  ExactPolynomial simple = function.square_free();
  auto roots = isolate_roots(simple, lower, Dyadic(time.upper));
  if (time.ordinal >= roots.size()) throw std::logic_error("a failure time's bracket holds too few roots");
  return {std::move(simple), std::move(roots[time.ordinal])};
}

void narrow(FailureTime& time, const ExactTime& exact) {
  if (!time.isolating || exact.is_dyadic()) return;
  time.lower = std::max(time.lower, exact.lower().round_down());
  time.upper = std::min(time.upper, exact.upper().round_up());
}

Instant::Instant(const Dyadic& u) : time_{u.round_down(), u.round_up(), 0, false}, exact_(new ExactTime(u)) {}

void Instant::Delete::operator()(ExactTime* time) const { delete time; }

ExactTime& Instant::exact() const {
  if (!exact_) {
    if (source_ == nullptr && time_.lower != time_.upper)
      throw std::logic_error("a replayed time is known by its bracket alone: nothing can be decided at it");
    exact_.reset(new ExactTime(source_ == nullptr ? ExactTime(Dyadic(time_.lower))
                                                  : exact_time(*source_->exact_function(slot_), time_)));
  }
  return *exact_;
}

std::optional<ExactTime> Instant::exact_apart() const {
  if (source_ != nullptr) return exact_time(*source_->exact_function(slot_), time_);
  if (exact_) return *exact_;
  if (time_.lower != time_.upper) return std::nullopt;
  return ExactTime(Dyadic(time_.lower));
}

bool Instant::narrow() const {
  if (narrowed_ || source_ == nullptr || time_.upper - time_.lower <= 0x1p-45) return false;
  narrowed_ = true;
  exact().narrow_for_doubles();
  kds::narrow(time_, exact());
  return true;
}

}  // namespace kds
