#pragma once
// Defines search_over for polynomial certificates. Only the file that instantiates it for a certificate type
// should include this header, to keep compile times short. Certificates are processed in lanes of four if the
// type requests it (lanes_up_to_degree), otherwise one by one. Certificates that the first filter leaves
// undecided are then searched one by one.

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "certificates/exact/exact_work.h"
#include "certificates/filters/formula_lanes.h"
#include "certificates/filters/lanes_descent.h"
#include "certificates/formulas/function_values.h"
#include "certificates/search/certificate_search.h"
#include "certificates/search/define_anchored_search.h"
#include "certificates/search/exact_search.h"
#include "certificates/search/formula_checks.h"

namespace kds {

namespace detail {

/// The first filter, on four certificates at a time. `C`: FixedCurves or LiftedCurves.
template <class Certificate, class C>
class LanesFilter {
  using View = LanesView<C, bead_arity<Certificate>, channels_of<Certificate>>;
  static constexpr int degree =
      decltype(Certificate::formula(std::declval<const View&>(), Certificate{}.beads))::degree;
  using Tuples = typename LanesView<C, bead_arity<Certificate>>::Tuples;

 public:
  using Indices = std::array<std::size_t, Lanes::width>;

  explicit LanesFilter(const ErrorBound& bound) : bound_(bound) {}

  /// Searches up to four certificates, named by their indices, that differ only in their beads. Calls
  /// `alone(index)` for each certificate that it leaves undecided.
  template <class Alone>
  void first_failures(const C& curves, std::span<const Certificate> certificates,
                      std::span<const std::size_t> indices, const Instant& now,
                      std::span<const KnownAtStart> known, StageCounts& stages, std::span<Failure> failures,
                      Alone alone) const {
    const auto [tuples, sides] = in_lanes(certificates, indices);
    LanesNow lanes_now{now.lower(), now.upper(), now.isolating(), 0};
    for (std::size_t lane = 0; lane < indices.size(); ++lane) {
      if (known[indices[lane]] == KnownAtStart::at_own_root) lanes_now.at_own_root |= 1U << lane;
    }
    ScaledLanes<degree> functions;
    evaluate_lanes<Certificate>(curves, tuples, sides, bound_, functions, certificates[indices[0]].beads);
    if (Lanes::all(functions.positive)) {
      for (const std::size_t index : indices) failures[index] = {};
      stages.coefficients += indices.size();
      return;
    }
    LanesOutcome<degree> outcome;
    classify_lanes(functions, bound_.uniform, lanes_now, outcome);
    LanesDescent<degree>& descent = outcome.descent;
    LanesSearch search{outcome.positive | outcome.never, outcome.found, outcome.found};
    if (Lanes::any(outcome.unclear))
      isolate_lanes(descent, now.upper(), outcome.unclear, outcome.known, search);
    if (Lanes::any(search.found)) narrow_lanes(descent, search.found);
    for (std::size_t lane = 0; lane < indices.size(); ++lane) {
      const std::size_t index = indices[lane];
      if (search.never[lane] != 0) {
        ++(outcome.positive[lane] != 0 ? stages.coefficients : stages.isolation);
        failures[index] = {};
      } else if (search.found[lane] != 0) {
        ++stages.isolation;
        failures[index] = {Failure::Kind::later,
                           {descent.lower.v[lane], descent.upper.v[lane], 0, true, false,
                            search.last[lane] != 0, DecidedBy::isolation}};
      } else if (outcome.violated[lane] != 0) {
        ++stages.isolation;
        failures[index] = failed_at_birth(now);
      } else {
        failures[index] = alone(index);
      }
    }
  }

  /// Returns whether two certificates differ only in their beads, and not in other parameters of their
  /// formulas.
  [[nodiscard]] static bool of_one_formula(const Certificate& a, const Certificate& b) {
    if constexpr (std::is_same_v<BeadsOf<Certificate>, std::array<BeadId, bead_arity<Certificate>>>) {
      return true;
    } else {
      return argument_numbers<Certificate>(a.beads) == argument_numbers<Certificate>(b.beads);
    }
  }

  /// Returns whether up to four certificates are certainly positive on all of [lower, upper].
  [[nodiscard]] static bool all_positive(const C& curves, std::span<const Certificate> some, double lower,
                                         double upper) {
    bool positive = false;
    if constexpr (!channels_of<Certificate>.weights && !channels_of<Certificate>.radii) {
      for (const Certificate& one : some)
        if (!of_one_formula(one, some.front())) return false;
      constexpr Indices indices{0, 1, 2, 3};
      const auto [tuples, sides] = in_lanes(some, std::span(indices).first(some.size()));
      positive_at_moment<Certificate>(curves, tuples, sides, lower, upper, positive, some.front().beads);
    }
    return positive;
  }

 private:
  /// Gathers the certificates at these indices; the last one fills the remaining lanes.
  [[nodiscard]] static auto in_lanes(std::span<const Certificate> certificates,
                                     std::span<const std::size_t> indices) {
    constexpr std::array<double, 2> signs{-1, 1};  // no branch, because sides are unpredictable
    std::pair<Tuples, Lanes> lanes;
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
      const Certificate& certificate = certificates[indices[std::min(lane, indices.size() - 1)]];
      lanes.first[lane] = certificate.beads;
      lanes.second.v[lane] = signs[certificate.side() ? 1 : 0];
    }
    return lanes;
  }

  LanesBound<degree> bound_;
};

/// Everything except lanes: certificates one at a time. `C`: Curves or LiftedCurves.
template <class Certificate, class C>
class SearchOneByOne : public CertificateSearch<Certificate> {
 protected:
  using Values = FunctionValues<Certificate, C>;
  static constexpr int dimension = C::dimension;

 public:
  explicit SearchOneByOne(const MotionRef<dimension>& motion) : motion_(motion) {
    require_searchable(name_of_function<Certificate>(), degree_of_function<Certificate, C>(motion.degree()),
                       motion.degree());
    static_cast<void>(Values::error_bound(motion.degree()));  // throws if unlike powers of length are added
  }

  void first_failures(Kernel kernel, std::span<const Certificate> certificates, const Instant& now,
                      std::span<const KnownAtStart> known, StageCounts& stages, TouchPolicy touches,
                      std::span<Failure> failures) const override {
    const C curves = curves_now();
    SharedFailure shared;
    for (std::size_t i = 0; i < certificates.size(); ++i) {
      if (!shared.is_to_search(kernel, i, known[i], now, stages, failures)) continue;
      failures[i] = careful_first_failure(kernel, certificates[i], curves, now, known[i], stages, touches);
    }
    shared.share(known, stages, failures);
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

  [[nodiscard]] int sign_at(const Certificate& certificate, const Dyadic& time) const override {
    return Values::sign_at(certificate, curves_now(), time);
  }
  [[nodiscard]] ExactFunction exact_function(const Certificate& certificate) const override {
    return std::make_shared<const ExactPolynomial>(Values::exact(certificate, curves_now()));
  }

 protected:
  /// Shares one search among certificates born at their own root: they have one function, so only the first
  /// is searched.
  class SharedFailure {
   public:
    [[nodiscard]] bool is_to_search(Kernel kernel, std::size_t i, KnownAtStart known, const Instant& now,
                                    StageCounts& stages, std::span<Failure> failures) {
      if (known != KnownAtStart::at_own_root) return true;
      if (first_) return false;
      first_ = i;
      if (kernel == Kernel::exact || !now.last()) return true;
      failures[i] = {};  // it has no later root
      ++stages.isolation;
      return false;
    }
    void share(std::span<const KnownAtStart> known, StageCounts& stages, std::span<Failure> failures) const {
      for (std::size_t i = first_.value_or(known.size()) + 1; i < known.size(); ++i) {
        if (known[i] != KnownAtStart::at_own_root) continue;
        failures[i] = failures[*first_];
        ++stages.shared;
      }
    }

   private:
    std::optional<std::size_t> first_;
  };

  [[nodiscard]] const MotionRef<dimension>& motion() const { return motion_; }

  /// Runs the stages after the first filter.
  [[nodiscard, gnu::noinline]] static Failure careful_first_failure(Kernel kernel,
                                                                    const Certificate& certificate,
                                                                    const C& curves, const Instant& now,
                                                                    KnownAtStart known, StageCounts& stages,
                                                                    TouchPolicy touches) {
    const ExactWork::About about(certificate);
    if (kernel == Kernel::filtered) {
      const BoundedFunction tracked = Values::tracked(certificate, curves);
      auto failure = proved_failure(tracked, now, known);
      // Next to a double root the present bracket is wide and hides failures that follow soon.
      if (!failure && now.narrow()) failure = proved_failure(tracked, now, known);
      if (failure) {
        ++stages.refined;
        return decided(*failure, DecidedBy::refined);
      }
    }
    // Functions that touch zero reach this point: doubles prove only nonzero signs.
    const ExactPolynomial exact = Values::exact(certificate, curves);
    if (kernel == Kernel::filtered) return rounded_first_failure(exact, now, known, stages, touches);
    return exact_first_failure(exact, now, stages, touches);
  }

 private:
  [[nodiscard]] C curves_now() const {
    if constexpr (lifted<C>) {
      return motion_.lifted_curves();
    } else {
      return motion_.curves();
    }
  }

  /// Returns the sign if doubles find it constant on the present bracket, else the one that `exact_sign`
  /// computes with integers.
  [[nodiscard, gnu::noinline]] int sign_around(Kernel kernel, const Certificate& certificate,
                                               const Instant& now, StageCounts& stages,
                                               int (*exact_sign)(const ExactPolynomial&, ExactTime&)) const {
    const C curves = curves_now();
    if (kernel == Kernel::filtered) {
      int sign = Values::sign_during(certificate, curves, now.lower(), now.upper());
      if (sign == 0)
        sign = Values::tracked(certificate, curves).polynomial.certain_sign_on(now.lower(), now.upper());
      if (sign != 0) {
        ++stages.signs_double;
        return sign;
      }
    }
    const ExactWork::About about(certificate);
    const ExactPolynomial exact = Values::exact(certificate, curves);
    ++stages.signs_exact;
    stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, exact.largest_bit_length());
    return kernel == Kernel::filtered ? rounded_sign(exact, now, exact_sign) : exact_sign(exact, now.exact());
  }

  MotionRef<dimension> motion_;
};

/// Searches four certificates at a time through the first filter. `C`: FixedCurves or LiftedCurves.
template <class Certificate, class C>
class SearchInLanes final : public SearchOneByOne<Certificate, CurvesOf<C>> {
  using Base = SearchOneByOne<Certificate, CurvesOf<C>>;
  using Filter = LanesFilter<Certificate, C>;

 public:
  explicit SearchInLanes(const MotionRef<C::dimension>& motion)
      : Base(motion), filter_(Base::Values::error_bound(C::degree)) {}

  void first_failures(Kernel kernel, std::span<const Certificate> certificates, const Instant& now,
                      std::span<const KnownAtStart> known, StageCounts& stages, TouchPolicy touches,
                      std::span<Failure> failures) const override {
    if (kernel == Kernel::exact)
      return Base::first_failures(kernel, certificates, now, known, stages, touches, failures);
    const C curves = curves_now();
    typename Filter::Indices indices{};
    std::size_t count = 0;
    const auto alone = [&](std::size_t index) {
      return Base::careful_first_failure(kernel, certificates[index], CurvesOf<C>(curves), now, known[index],
                                         stages, touches);
    };
    const auto search = [&] {
      filter_.first_failures(curves, certificates, std::span(indices).first(count), now, known, stages,
                             failures, alone);
      count = 0;
    };
    typename Base::SharedFailure shared;
    for (std::size_t i = 0; i < certificates.size(); ++i) {
      if (i + Lanes::width < certificates.size()) fetch_early(certificates[i + Lanes::width], curves);
      if (!shared.is_to_search(kernel, i, known[i], now, stages, failures)) continue;
      if (count > 0 && !Filter::of_one_formula(certificates[i], certificates[indices[0]])) search();
      indices[count++] = i;
      if (count == Lanes::width) search();
    }
    if (count > 0) search();
    shared.share(known, stages, failures);
  }

  [[nodiscard]] bool all_positive_now(Kernel kernel, std::span<const Certificate> certificates,
                                      const Instant& now, StageCounts& stages) const override {
    const C curves = curves_now();
    for (std::size_t i = 0; i < certificates.size(); i += Lanes::width) {
      const auto some = certificates.subspan(i, std::min(Lanes::width, certificates.size() - i));
      if (kernel == Kernel::exact || !Filter::all_positive(curves, some, now.lower(), now.upper())) {
        if (!Base::all_positive_now(kernel, some, now, stages)) return false;
      } else {
        stages.signs_double += some.size();
      }
    }
    return true;
  }

 private:
  [[nodiscard]] C curves_now() const {
    if constexpr (lifted<C>) {
      return this->motion().lifted_curves();
    } else {
      return C(this->motion().curves());
    }
  }
  /// Prefetches the beads of the next certificates during the present ones, since beads lie anywhere in
  /// memory.
  static void fetch_early(const Certificate& certificate, const C& curves) {
    for (const BeadId bead : certificate.beads) __builtin_prefetch(curves.control_point(bead, 0));
  }

  Filter filter_;
};

/// Returns a search of one certificate at a time. This search is faster to compile, for rare types.
template <class Certificate, int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<Certificate>> search_one_by_one(
    const MotionRef<Dimension>& motion) {
  return std::make_unique<SearchOneByOne<Certificate, Curves<Dimension>>>(motion);
}

/// Returns a search in lanes, for lifted motion and the degrees that the type requests.
template <class Certificate, int Dimension>
std::unique_ptr<CertificateSearch<Certificate>> filtered_search(const MotionRef<Dimension>& motion) {
  constexpr int most = lanes_up_to_degree<Certificate>;
  static_assert(0 <= most && most <= 3, "lanes_up_to_degree is 0 to 3");
  const auto in_lanes =
      [&]<class C>(std::type_identity<C>) -> std::unique_ptr<CertificateSearch<Certificate>> {
    return std::make_unique<SearchInLanes<Certificate, C>>(motion);
  };
  if constexpr (Dimension > 1 && channels_of<Certificate>.weights && suits_lifted_motion<Certificate>) {
    if (motion.is_lifted()) return in_lanes(std::type_identity<LiftedCurves<Dimension>>{});
  }
  const int degree = motion.degree();  // 1 for lifted motion, whose centres move linearly
  if constexpr (most >= 1) {
    if (degree == 1) return in_lanes(std::type_identity<FixedCurves<Dimension, 1>>{});
  }
  if constexpr (most >= 2) {
    if (degree == 2) return in_lanes(std::type_identity<FixedCurves<Dimension, 2>>{});
  }
  if constexpr (most >= 3) {
    if (degree == 3) return in_lanes(std::type_identity<FixedCurves<Dimension, 3>>{});
  }
  return search_one_by_one<Certificate>(motion);
}

}  // namespace detail

template <class Certificate, int Dimension>
std::unique_ptr<CertificateSearch<Certificate>> search_over(const MotionRef<Dimension>& motion) {
  static_assert(NamedCertificate<Certificate>,
                "a certificate needs `static constexpr kds::CertificateType type`, `kds::Identity identity() "
                "const` and `bool side() const`");
  static_assert(HasStaticFormula<Certificate, Dimension>,
                "a certificate needs `template <kds::MotionView View> static auto formula(const View& view, "
                "const std::array<kds::BeadId, N>& beads)`");
  static_assert(DeclaresItsConstants<Certificate>,
                "a member of a certificate's `struct Constants` needs a declared power of length: it is a "
                "kds::Constant<1>, a kds::ConstantVector, ..., not a number");
  static_assert(!AddsUnlikePowers<Certificate, Dimension>,
                "the formula adds unlike powers of length: all terms of a sum need the same");
  if (motion.is_lifted() && !suits_lifted_motion<Certificate>)
    throw std::invalid_argument("radii and single weights mean nothing in lifted motion");
  if constexpr (NeedsAnchors<Certificate>) {
    return std::make_unique<detail::AnchoredSearch<Certificate, Dimension>>(motion);
  } else {
    return detail::filtered_search<Certificate>(motion);
  }
}

}  // namespace kds
