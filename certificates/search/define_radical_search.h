#pragma once
// Defines search_over for radical certificates. Only the file that instantiates it for a certificate type
// should include this header. The queries, answers and stages are those of polynomial certificates, one
// certificate at a time.

#include <algorithm>
#include <stdexcept>

#include "certificates/exact/exact_work.h"
#include "certificates/formulas/function_values.h"
#include "certificates/search/certificate_search.h"
#include "certificates/search/formula_checks.h"
#include "certificates/search/radical_stages.h"

namespace kds {

namespace detail {

template <class Certificate, int Dimension>
class RadicalSearch final : public CertificateSearch<Certificate> {
  using C = Curves<Dimension>;
  using InDouble = CertificateInDouble<Certificate, C>;

 public:
  explicit RadicalSearch(const MotionRef<Dimension>& motion) : motion_(motion) {
    int degree = degree_of_radical<typename Certificate::Radical, C>(motion.degree());
    if constexpr (ConditionalFor<Certificate, C>)
      degree = std::max(degree, degree_of_radical<typename Certificate::Condition, C>(motion.degree()));
    require_searchable(name_of_function<Certificate>(), degree, motion.degree());
  }

  void first_failures(Kernel kernel, std::span<const Certificate> certificates, const Instant& now,
                      std::span<const KnownAtStart> known, StageCounts& stages, TouchPolicy touches,
                      std::span<Failure> failures) const override {
    const C curves = motion_.curves();
    for (std::size_t i = 0; i < certificates.size(); ++i)
      failures[i] = first_failure(kernel, certificates[i], curves, now, known[i], stages, touches);
  }

  [[nodiscard]] int sign_now(Kernel kernel, const Certificate& certificate, const Instant& now,
                             StageCounts& stages) const override {
    return sign_around(kernel, certificate, now, stages, kds::sign_at);
  }
  [[nodiscard]] int sign_just_after(Kernel kernel, const Certificate& certificate, const Instant& now,
                                    StageCounts& stages) const override {
    return sign_around(kernel, certificate, now, stages, sign_after);
  }
  [[nodiscard]] bool all_positive_now(Kernel kernel, std::span<const Certificate> certificates,
                                      const Instant& now, StageCounts& stages) const override {
    return std::all_of(certificates.begin(), certificates.end(),
                       [&](const Certificate& c) { return sign_now(kernel, c, now, stages) > 0; });
  }
  [[nodiscard]] int sign_after_failure(const Certificate& certificate, const Certificate& failed,
                                       const Instant& now, StageCounts& stages) const override {
    if (!now.isolating()) return 0;
    const C curves = motion_.curves();
    const int norm = -InDouble(Errors::tracked, failed, curves).norm_while_it_holds(now.lower(), now.upper());
    const int sign =
        InDouble(Errors::tracked, certificate, curves).sign_by_norm(norm, now.lower(), now.upper());
    stages.signs_double += sign != 0 ? 1 : 0;
    return sign;
  }

  [[nodiscard]] int sign_at(const Certificate& certificate, const Dyadic& time) const override {
    ExactTime at(time);
    return exact(certificate, motion_.curves()).sign(at, kds::sign_at);
  }
  [[nodiscard]] ExactFunction exact_function(const Certificate& certificate) const override {
    return std::make_shared<const ExactPolynomial>(exact(certificate, motion_.curves()).candidates());
  }

 private:
  [[nodiscard]] static Failure first_failure(Kernel kernel, const Certificate& certificate, const C& curves,
                                             const Instant& now, KnownAtStart known, StageCounts& stages,
                                             TouchPolicy touches) {
    const ExactWork::About about(certificate);
    if (kernel == Kernel::filtered) {
      if (const auto failure =
              proved_failure(InDouble(Errors::own_filter, certificate, curves), now, known)) {
        ++stages.isolation;
        return decided(*failure, DecidedBy::isolation);
      }
      const InDouble tracked(Errors::tracked, certificate, curves);
      auto failure = proved_failure(tracked, now, known);
      // Next to a double root the present bracket is wide and hides failures that follow soon.
      if (!failure && now.narrow()) failure = proved_failure(tracked, now, known);
      if (failure) {
        ++stages.refined;
        return decided(*failure, DecidedBy::refined);
      }
    }
    return exact_first_failure(exact(certificate, curves), now, stages, touches);
  }

  [[nodiscard]] int sign_around(Kernel kernel, const Certificate& certificate, const Instant& now,
                                StageCounts& stages,
                                int (*exact_sign)(const ExactPolynomial&, ExactTime&)) const {
    const C curves = motion_.curves();
    if (kernel == Kernel::filtered) {
      const int sign =
          InDouble(Errors::tracked, certificate, curves).certain_sign_on(now.lower(), now.upper());
      if (sign != 0) {
        ++stages.signs_double;
        return sign;
      }
    }
    const ExactWork::About about(certificate);
    const ExactRadicalCertificate integers = exact(certificate, curves);
    ++stages.signs_exact;
    stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, integers.largest_bit_length());
    return integers.sign(now.exact(), exact_sign);
  }

  template <class Radical>
  [[nodiscard]] static ExactRadical exact_radical(const Certificate& certificate, const C& curves,
                                                  int root_sign) {
    const auto exact_part = [&]<class Part>(std::type_identity<Part>, int sign) {
      return FunctionValues<SignedPart<Part>, C>::exact(part_of<Part>(certificate, sign), curves);
    };
    return {exact_part(std::type_identity<typename Radical::Rational>{}, 1),
            exact_part(std::type_identity<typename Radical::Root>{}, root_sign),
            exact_part(std::type_identity<typename Radical::Norm>{}, 1)};
  }
  [[nodiscard]] static ExactRadicalCertificate exact(const Certificate& certificate, const C& curves) {
    ExactRadicalCertificate integers{
        exact_radical<typename Certificate::Radical>(certificate, curves, certificate.root_sign()),
        {},
        certificate.side()};
    if constexpr (ConditionalFor<Certificate, C>) {
      if (certificate.conditional(curves))
        integers.condition = exact_radical<typename Certificate::Condition>(certificate, curves, 1);
    }
    return integers;
  }

  MotionRef<Dimension> motion_;
};

}  // namespace detail

template <class Certificate, int Dimension>
requires RadicalCertificateFor<Certificate, Curves<Dimension>> std::unique_ptr<CertificateSearch<Certificate>>
radical_search_over(const MotionRef<Dimension>& motion) {
  if (motion.is_lifted()) throw std::invalid_argument("radii mean nothing in lifted motion");
  return std::make_unique<detail::RadicalSearch<Certificate, Dimension>>(motion);
}

}  // namespace kds
