#include "certificates/searches/relaxed_bead_in_sphere_search.h"

#include "certificates/search/define_certificate_search.h"

namespace kds {

namespace {

/// One at a time, in linear motion in doubles whose degrees are constants first.
template <class Certificate, int Dimension>
class RelaxedSearch final : public detail::SearchOneByOne<Certificate, Curves<Dimension>> {
  using Base = detail::SearchOneByOne<Certificate, Curves<Dimension>>;
  using Linear = FixedCurves<Dimension, 1>;

 public:
  using Base::Base;

  void first_failures(Kernel kernel, std::span<const Certificate> certificates, const Instant& now,
                      std::span<const KnownAtStart> known, StageCounts& stages, TouchPolicy touches,
                      std::span<Failure> failures) const override {
    if (kernel != Kernel::filtered || this->motion().degree() != 1)
      return Base::first_failures(kernel, certificates, now, known, stages, touches, failures);
    const Curves<Dimension> curves = this->motion().curves();
    const Linear linear(curves);
    const ErrorBound& bound = Base::Values::error_bound(1);
    for (std::size_t i = 0; i < certificates.size(); ++i) {
      const Certificate& certificate = certificates[i];
      const DoubleView<Linear> view(linear);
      const auto value = function_of(certificate, view);  // first: the view learns the lengths by it
      const BoundedFunction function = bounded_function(value.scaled, bound, view.largest_length());
      if (function.positive) {
        ++stages.coefficients;
        failures[i] = {};
      } else if (const auto failure = proved_failure(function, now, known[i])) {
        ++stages.isolation;
        failures[i] = *failure;
      } else {
        failures[i] =
            Base::careful_first_failure(kernel, certificate, curves, now, known[i], stages, touches);
      }
    }
  }
};

template <class Certificate, int Dimension>
std::unique_ptr<CertificateSearch<Certificate>> relaxed_search(const MotionRef<Dimension>& motion) {
  return std::make_unique<RelaxedSearch<Certificate, Dimension>>(motion);
}

}  // namespace

template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<2>& motion) {
  return relaxed_search<RelaxedBeadInSphere<2>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<2>& motion) {
  return relaxed_search<RelaxedBeadInSphere<3>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<3>& motion) {
  return relaxed_search<RelaxedBeadInSphere<2>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<3>& motion) {
  return relaxed_search<RelaxedBeadInSphere<3>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<4>>> search_over(const MotionRef<3>& motion) {
  return relaxed_search<RelaxedBeadInSphere<4>>(motion);
}

}  // namespace kds
