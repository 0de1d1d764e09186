#pragma once
// One certificate over a whole step: at each failure its opposite takes over, as after a flip.

#include <vector>

#include "certificates/search/failure_search.h"
#include "certificates/search/radical_search.h"

namespace kds {

/// A certificate or its opposite.
template <class C>
struct Sided : C {
  bool opposite = false;

  [[nodiscard]] bool side() const { return C::side() != opposite; }
};

/// The functions behind an instant: of the certificate (slot 0) and its opposite (slot 1).
template <class C, Motion M>
class BothSides final : public CertificateSource {
 public:
  BothSides(Sided<C> certificate, const M& motion) : certificate_(certificate), motion_(motion) {}

  [[nodiscard]] ExactPolynomial exact_function(std::uint32_t slot) const override {
    Sided<C> certificate = certificate_;
    certificate.opposite = slot == 1;
    return kds::exact_function(certificate, motion_);
  }

 private:
  Sided<C> certificate_;
  const M& motion_;
};

/// One answer of a kernel.
struct Answer {
  Failure failure;
  bool opposite = false;  ///< of the opposite certificate
};

/// More than any function here has roots.
inline constexpr std::size_t most_answers = 64;

/// All answers in turn, up to `never` or `zero`.
template <Kernel K, class C, Motion M>
[[nodiscard]] std::vector<Answer> follow(Sided<C> certificate, const M& motion, StageCounts& stages) {
  const BothSides<C, M> source(certificate, motion);
  std::vector<Answer> answers;
  Instant now(0);
  KnownAtStart birth = KnownAtStart::unknown;
  while (answers.size() < most_answers) {
    const Failure failure = first_failure<K>(certificate, motion, now, birth, stages);
    answers.push_back({failure, certificate.opposite});
    if (failure.kind == Failure::Kind::never || failure.kind == Failure::Kind::zero) break;
    if (failure.kind == Failure::Kind::later) {
      now = Instant(failure.time, source, certificate.opposite ? 1 : 0);
      birth = answers.size() % 3 == 0 ? KnownAtStart::unknown : KnownAtStart::at_own_root;  // both must do
    }
    certificate.opposite = !certificate.opposite;
  }
  return answers;
}

}  // namespace kds
