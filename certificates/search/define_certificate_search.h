#pragma once
// Definition of search_over for polynomial certificates: included by the one file that instantiates it for a
// certificate type, and by nobody else who wants short compile times. Certificates go in lanes of four where
// the motion's degree has been compiled, each alone elsewhere; what the first filter does not decide is
// looked at one by one.

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "certificates/search/careful_search.h"
#include "certificates/search/certificate_search.h"
#include "certificates/search/classify_lanes.h"
#include "certificates/search/define_function_values.h"
#include "certificates/search/exact_search.h"
#include "certificates/search/moment_lanes.h"

namespace kds {

namespace detail {

/// The first filter, four certificates at a time. `C`: FixedCurves or LiftedCurves.
template <class Certificate, class C>
class LanesFilter {
  using View = LanesView<C, bead_places<Certificate>, channels_of<Certificate>>;
  static constexpr int degree =
      decltype(Certificate::formula(std::declval<const View&>(), Certificate{}.beads))::degree;
  using Tuples = typename LanesView<C, bead_places<Certificate>>::Tuples;

 public:
  using Places = std::array<std::size_t, Lanes::width>;

  explicit LanesFilter(const ErrorBound& bound) : bound_(bound) {}

  /// Up to four certificates, named by their places. What it leaves open it asks `alone(place)` for.
  template <class Alone>
  void first_failures(Kernel kernel, const C& curves, std::span<const Certificate> certificates,
                      std::span<const std::size_t> places, const Instant& now,
                      std::span<const KnownAtStart> known, StageCounts& stages, std::span<Failure> failures,
                      Alone alone) const {
    const bool fast = kernel == Kernel::fast;
    const auto [tuples, sides] = in_lanes(certificates, places);
    LanesNow lanes_now{now.lower(), now.upper(), now.isolating() || fast, 0};
    for (std::size_t lane = 0; lane < places.size(); ++lane) {
      if (known[places[lane]] == KnownAtStart::at_own_root) lanes_now.at_own_root |= 1U << lane;
    }
    LanesOutcome<degree> outcome;
    classify_lanes<Certificate>(curves, tuples, sides, bound_, fast ? Rounding::ignored : Rounding::charged,
                                lanes_now, outcome);
    if (Lanes::all(outcome.positive)) {
      for (const std::size_t place : places) failures[place] = {};
      stages.coefficients += places.size();
      return;
    }
    LanesDescent<degree>& descent = outcome.descent;
    LanesSearch search{outcome.positive | outcome.never, outcome.found, outcome.found};
    if (Lanes::any(outcome.unclear))
      isolate_lanes(descent, now.upper(), outcome.unclear, outcome.known, search);
    if (Lanes::any(search.found)) narrow_lanes(descent, search.found);
    for (std::size_t lane = 0; lane < places.size(); ++lane) {
      const std::size_t place = places[lane];
      if (search.never[lane] != 0) {
        ++(outcome.positive[lane] != 0 ? stages.coefficients : stages.isolation);
        failures[place] = {};
      } else if (search.found[lane] != 0) {
        ++stages.isolation;
        const double lower = descent.lower.v[lane], upper = descent.upper.v[lane];
        const double middle = 0.5 * (lower + upper);
        failures[place] = {
            Failure::Kind::later,
            {fast ? middle : lower, fast ? middle : upper, 0, !fast, false, !fast && search.last[lane] != 0}};
      } else if (outcome.violated[lane] != 0) {
        ++stages.isolation;
        failures[place] = failed_at_birth(now);
      } else {
        failures[place] = alone(place);
      }
    }
  }

  /// Whether up to four are certainly positive all over [lower, upper].
  [[nodiscard]] static bool all_positive(const C& curves, std::span<const Certificate> some, double lower,
                                         double upper) {
    bool positive = false;
    if constexpr (!channels_of<Certificate>.weights && !channels_of<Certificate>.radii) {
      constexpr Places places{0, 1, 2, 3};
      const auto [tuples, sides] = in_lanes(some, std::span(places).first(some.size()));
      positive_at_moment<Certificate>(curves, tuples, sides, lower, upper, positive);
    }
    return positive;
  }

 private:
  /// Named by their places; the last one fills what is left.
  [[nodiscard]] static auto in_lanes(std::span<const Certificate> certificates,
                                     std::span<const std::size_t> places) {
    constexpr std::array<double, 2> signs{-1, 1};  // no branch: no one foretells a side
    std::pair<Tuples, Lanes> lanes;
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
      const Certificate& certificate = certificates[places[std::min(lane, places.size() - 1)]];
      lanes.first[lane] = certificate.beads;
      lanes.second.v[lane] = signs[certificate.side() ? 1 : 0];
    }
    return lanes;
  }

  LanesBound<degree> bound_;
};

/// `C`: Curves, where nothing is compiled for the degree; FixedCurves; LiftedCurves.
template <class Certificate, class C>
class SearchOver final : public CertificateSearch<Certificate> {
  using Values = FunctionValues<Certificate, CurvesOf<C>>;
  static constexpr int dimension = C::dimension;
  static constexpr bool in_lanes = C::degree >= 0;

 public:
  explicit SearchOver(const MotionRef<dimension>& motion) : motion_(motion), filter_(make_filter(motion)) {}

  void first_failures(Kernel kernel, std::span<const Certificate> certificates, const Instant& now,
                      std::span<const KnownAtStart> known, StageCounts& stages, TouchPolicy touches,
                      std::span<Failure> failures) const override {
    const C curves = curves_now();
    const bool exact = kernel == Kernel::exact;
    const std::size_t at_once = in_lanes && !exact ? Lanes::width : 1;
    typename Lanes4::Places places{};
    std::size_t count = 0;
    const auto alone = [&](std::size_t place) {
      return careful_first_failure(kernel, certificates[place], curves, now, known[place], stages, touches);
    };
    const auto search = [&] {
      if constexpr (in_lanes) {
        if (!exact) {
          filter_.first_failures(kernel, curves, certificates, std::span(places).first(count), now, known,
                                 stages, failures, alone);
          count = 0;
          return;
        }
      }
      failures[places[0]] = alone(places[0]);
      count = 0;
    };
    std::optional<std::size_t> at_own_root;
    for (std::size_t i = 0; i < certificates.size(); ++i) {
      if (i + at_once < certificates.size()) fetch_early(certificates[i + at_once], curves);
      if (known[i] == KnownAtStart::at_own_root) {
        if (at_own_root) continue;
        at_own_root = i;
        if (kernel == Kernel::filtered && now.last()) {  // it has none after that
          failures[i] = {};
          ++stages.isolation;
          continue;
        }
      }
      places[count++] = i;
      if (count == at_once) search();
    }
    if (count > 0) search();
    for (std::size_t i = at_own_root.value_or(certificates.size()) + 1; i < certificates.size(); ++i) {
      if (known[i] != KnownAtStart::at_own_root) continue;
      failures[i] = failures[*at_own_root];
      ++stages.shared;
    }
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
    const C curves = curves_now();
    for (std::size_t i = 0; i < certificates.size(); i += Lanes::width) {
      const auto some = certificates.subspan(i, std::min(Lanes::width, certificates.size() - i));
      if constexpr (in_lanes) {
        if (kernel != Kernel::exact && Lanes4::all_positive(curves, some, now.lower(), now.upper())) {
          stages.signs_double += some.size();
          continue;
        }
      }
      for (const Certificate& c : some) {
        if (sign_now(kernel, c, now, stages) <= 0) return false;
      }
    }
    return true;
  }

  [[nodiscard]] int sign_at(const Certificate& certificate, const Dyadic& time) const override {
    return Values::sign_at(certificate, curves_now(), time);
  }
  [[nodiscard]] ExactFunction exact_function(const Certificate& certificate) const override {
    return std::make_shared<const ExactPolynomial>(Values::exact(certificate, curves_now()));
  }

 private:
  struct NoLanes {
    using Places = std::array<std::size_t, 1>;
  };
  template <bool some>
  static auto lanes_type() {
    if constexpr (some) {
      return std::type_identity<LanesFilter<Certificate, C>>{};
    } else {
      return std::type_identity<NoLanes>{};
    }
  }
  using Lanes4 = typename decltype(lanes_type<in_lanes>())::type;

  [[nodiscard]] static Lanes4 make_filter([[maybe_unused]] const MotionRef<dimension>& motion) {
    if constexpr (in_lanes) {
      return Lanes4(Values::error_bound(motion.degree()));
    } else {
      return {};
    }
  }
  [[nodiscard]] C curves_now() const {
    if constexpr (lifted<C>) {
      return motion_.lifted_curves();
    } else {
      return C(motion_.curves());
    }
  }

  /// Beads lie anywhere in memory: those of the next certificates are fetched while these are worked on.
  static void fetch_early(const Certificate& certificate, const C& curves) {
    for (const BeadId bead : certificate.beads) __builtin_prefetch(curves.control_point(bead, 0));
  }

  /// The stages after the first filter.
  [[nodiscard]] static Failure careful_first_failure(Kernel kernel, const Certificate& certificate,
                                                     const CurvesOf<C>& curves, const Instant& now,
                                                     KnownAtStart known, StageCounts& stages,
                                                     TouchPolicy touches) {
    if (kernel == Kernel::fast)
      return fast_first_failure(Values::bounded(certificate, curves).polynomial, now, known, stages);
    if (kernel == Kernel::filtered) {
      const BoundedFunction tracked = Values::tracked(certificate, curves);
      auto failure = proved_failure(tracked, now, known);
      // Next to a double root the present bracket is wide, and what fails soon after lies in its shadow.
      if (!failure && now.narrow()) failure = proved_failure(tracked, now, known);
      if (failure) {
        ++stages.refined;
        return *failure;
      }
    }
    // Whatever touches zero comes here: doubles prove signs, and a zero has none.
    return exact_first_failure(Values::exact(certificate, curves), now, stages, touches);
  }

  /// A sign that doubles find alike all around now, else the one that `exact_sign` finds in integers.
  [[nodiscard]] int sign_around(Kernel kernel, const Certificate& certificate, const Instant& now,
                                StageCounts& stages,
                                int (*exact_sign)(const ExactPolynomial&, ExactTime&)) const {
    const CurvesOf<C> curves(curves_now());
    if (kernel == Kernel::fast) {
      const double value = Values::bounded(certificate, curves).polynomial.value_at(now.upper());
      return value > 0 ? 1 : value < 0 ? -1 : 0;
    }
    if (kernel == Kernel::filtered) {
      int sign = Values::sign_during(certificate, curves, now.lower(), now.upper());
      if (sign == 0)
        sign = Values::tracked(certificate, curves).polynomial.certain_sign_on(now.lower(), now.upper());
      if (sign != 0) {
        ++stages.signs_double;
        return sign;
      }
    }
    const ExactPolynomial exact = Values::exact(certificate, curves);
    ++stages.signs_exact;
    stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, exact.largest_bit_length());
    return exact_sign(exact, now.exact());
  }

  MotionRef<dimension> motion_;
  Lanes4 filter_;
};

/// One certificate at a time, which is shorter to compile: for types that are rare.
template <class Certificate, int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<Certificate>> search_one_by_one(
    const MotionRef<Dimension>& motion) {
  return std::make_unique<SearchOver<Certificate, Curves<Dimension>>>(motion);
}

}  // namespace detail

/// In lanes for degrees 1 to 3 and lifted motion.
template <class Certificate, int Dimension>
std::unique_ptr<CertificateSearch<Certificate>> search_over(const MotionRef<Dimension>& motion) {
  const auto over = [&]<class C>(std::type_identity<C>) -> std::unique_ptr<CertificateSearch<Certificate>> {
    return std::make_unique<detail::SearchOver<Certificate, C>>(motion);
  };
  if constexpr (Dimension > 1 && !channels_of<Certificate>.radii) {
    if (motion.is_lifted()) return over(std::type_identity<LiftedCurves<Dimension>>{});
  } else {
    if (motion.is_lifted()) throw std::invalid_argument("radii mean nothing in lifted motion");
  }
  switch (motion.degree()) {
    case 1:
      return over(std::type_identity<FixedCurves<Dimension, 1>>{});
    case 2:
      return over(std::type_identity<FixedCurves<Dimension, 2>>{});
    case 3:
      return over(std::type_identity<FixedCurves<Dimension, 3>>{});
    default:
      return over(std::type_identity<Curves<Dimension>>{});
  }
}

}  // namespace kds
