#pragma once
// Follows one certificate over a whole step. At each failure the opposite certificate takes over, as after a
// flip.

#include <memory>
#include <vector>

#include "certificates/search/certificate_search.h"

namespace kds {

/// Returns the certificate that holds exactly when `certificate` does not.
template <class C>
[[nodiscard]] C opposite_of(C certificate) {
  if constexpr (requires { certificate.inside; }) {
    certificate.inside = !certificate.inside;
  } else {
    certificate.sign = -certificate.sign;
  }
  return certificate;
}

/// The functions behind an instant: the function of the certificate (slot 0) and of its opposite (slot 1).
template <class C>
class BothSides final : public CertificateSource {
 public:
  BothSides(const C& certificate, const CertificateSearch<C>& search)
      : sides_{certificate, opposite_of(certificate)}, search_(search) {}

  [[nodiscard]] const C& side(std::uint32_t slot) const { return sides_[slot]; }
  [[nodiscard]] ExactFunction exact_function(std::uint32_t slot) const override {
    return search_.exact_function(sides_[slot]);
  }

 private:
  std::array<C, 2> sides_;
  const CertificateSearch<C>& search_;
};

/// One answer of a kernel.
struct Answer {
  Failure failure;
  bool opposite = false;  ///< whether the opposite certificate gave the answer
};

/// A bound that exceeds the number of roots of every function here.
inline constexpr std::size_t most_answers = 64;

/// Returns all answers in order, up to `never` or `zero`.
template <class C>
[[nodiscard]] std::vector<Answer> follow(Kernel kernel, const C& certificate,
                                         const CertificateSearch<C>& search, StageCounts& stages) {
  const BothSides<C> source(certificate, search);
  std::vector<Answer> answers;
  Instant now(0);
  KnownAtStart known = KnownAtStart::unknown;
  std::uint32_t slot = 0;
  while (answers.size() < most_answers) {
    Failure failure;
    search.first_failures(kernel, {&source.side(slot), 1}, now, {&known, 1}, stages, TouchPolicy::ignored,
                          {&failure, 1});
    answers.push_back({failure, slot == 1});
    if (failure.kind == Failure::Kind::never || failure.kind == Failure::Kind::zero) break;
    if (failure.kind == Failure::Kind::later) {
      now = Instant(failure.time, source, slot);
      // Both values must work.
      known = answers.size() % 3 == 0 ? KnownAtStart::unknown : KnownAtStart::at_own_root;
    }
    slot = 1 - slot;
  }
  return answers;
}

}  // namespace kds
