#pragma once
// Tests one certificate type on one extreme of `kds stability`: follows each certificate over a whole step
// with the kernels `filtered` and `exact`, and compares the answers. At each failure the opposite
// certificate takes over, as after a flip.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "certificates/exact/exact_polynomial.h"
#include "certificates/search/certificate_search.h"
#include "certificates/types/orientation.h"
#include "experiments/program/timing.h"
#include "experiments/stability/compare_answers.h"
#include "experiments/stability/stability.h"
#include "experiments/stability/stability_scenes.h"
#include "kds/stopwatch.h"
#include "motions/base/input_error.h"
#include "motions/curves/bezier_motion.h"
#include "motions/scene/scene.h"

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
      // The search must give the same answers without and with this knowledge.
      known = answers.size() % 3 == 0 ? KnownAtStart::unknown : KnownAtStart::at_own_root;
    }
    slot = 1 - slot;
  }
  return answers;
}

/// The bead data (channels) that a certificate type needs, over all of its polynomials.
template <class C>
inline constexpr Channels channels_asked = [] {
  if constexpr (requires { typename C::Radical; }) {
    return channels_of<typename C::Radical::Norm>;
  } else {
    return channels_of<C>;
  }
}();

template <class C>
inline constexpr std::size_t beads_named = std::tuple_size_v<decltype(C{}.beads)>;

/// Returns the degree of the polynomial whose roots are the certificate's failures.
template <class C, int Dimension>
[[nodiscard]] int function_degree(int motion_degree) {
  AnyDegreeMotion<Dimension> motion(beads_named<C>, motion_degree);
  for (BeadId b = 0; b < beads_named<C>; ++b) motion.set_coordinate(b, 0, 0, b);
  C certificate;
  std::iota(certificate.beads.begin(), certificate.beads.end(), BeadId{0});
  const auto search = search_over<C>(MotionRef<Dimension>(motion));
  return static_cast<int>(search->exact_function(certificate)->scaled().size()) - 1;
}

/// Returns by which factor the exact stage of a case is slower than usual, at least 1.
template <class C>
[[nodiscard]] double case_cost(int function_degree) {
  const double longer = std::max(1.0, function_degree / 6.0);
  constexpr bool radical = requires { typename C::Radical; };
  return radical ? 4 * longer * longer * longer : longer * longer;
}

template <class C, int Dimension>
class CertificateTrial {
 public:
  CertificateTrial(const Extreme& extreme, const StabilityCases& cases, int motion_degree,
                   int function_degree)
      : extreme_(extreme) {
    const auto count =
        static_cast<std::size_t>(std::ceil(static_cast<double>(cases.cases) / case_cost<C>(function_degree)));
    for (std::size_t number = 0; number < count; ++number) {
      SceneRandom random = scene_random(cases.seed, extreme.name, number);
      BeadCurves curves = extreme.make({Dimension, motion_degree, beads}, random);
      if constexpr (channels_asked<C>.radii) give_radii(curves, random);
      auto made = std::make_unique<Case>(curves.instance(std::string(extreme.name)));
      made->number = number;
      std::iota(made->certificate.beads.begin(), made->certificate.beads.end(), BeadId{0});
      const bool opposite = random() % 2 == 1;
      for (double& u : made->times) u = static_cast<double>(random() >> 11U) * 0x1p-53;
      try {
        static_cast<void>(Scene(made->instance));
      } catch (const InputError& refusal) {
        if (refused_++ == 0) reason_ = refusal.what();
        continue;
      }
      made->motion = curves.motion<Dimension>();
      made->search = search_over<C>(MotionRef<Dimension>(made->motion));
      orient(*made);
      if (opposite) made->certificate = opposite_of(made->certificate);
      cases_.push_back(std::move(made));
    }
  }

  [[nodiscard]] StabilityRow run() {
    StabilityRow row;
    row.must_refuse = extreme_.refused;
    row.extreme = extreme_.name;
    row.cases = cases_.size() + refused_;
    row.refused = refused_;
    row.reason = reason_;
    StageCounts uncounted;
    const auto filtered = follow_all(Kernel::filtered, row.stages, row.seconds.filtered);
    const auto exact = follow_all(Kernel::exact, uncounted, row.seconds.exact);
    for (std::size_t i = 0; i < cases_.size(); ++i) compare(row, *cases_[i], filtered[i], exact[i]);
    return row;
  }

 private:
  static constexpr std::size_t beads = beads_named<C>;

  struct Case {
    explicit Case(Instance made) : instance(std::move(made)) {}

    std::size_t number = 0;
    C certificate;
    AnyDegreeMotion<Dimension> motion{0, 0};
    std::unique_ptr<CertificateSearch<C>> search;
    std::array<double, 2> times{};  // times at which signs are compared, in addition to 0 and the failures
    Instance instance;
  };

  /// A certificate of a full basis stores the orientation of the basis. Sets it from the start of the step.
  static void orient(Case& made) {
    if constexpr (requires { requires C::full; }) {
      Orientation<Dimension> basis;
      std::copy_n(made.certificate.beads.begin(), basis.beads.size(), basis.beads.begin());
      StageCounts uncounted;
      made.certificate.orientation =
          search_over<Orientation<Dimension>>(MotionRef<Dimension>(made.motion))
                      ->sign_just_after(Kernel::exact, basis, Instant(0), uncounted) < 0
              ? -1
              : 1;
    }
  }

  [[nodiscard]] std::vector<std::vector<Answer>> follow_all(Kernel kernel, StageCounts& stages,
                                                            double& seconds) const {
    std::vector<std::vector<Answer>> answers;
    std::vector<double> spent;
    for (const auto& c : cases_) {
      const double time = seconds_of<WallClock>(
          [&] { answers.push_back(follow(kernel, c->certificate, *c->search, stages)); });
      spent.push_back(time / static_cast<double>(answers.back().size()));
    }
    seconds = median_of(std::move(spent));
    return answers;
  }

  static void compare(StabilityRow& row, const Case& c, const std::vector<Answer>& filtered,
                      const std::vector<Answer>& exact) {
    const BothSides<C> functions(c.certificate, *c.search);
    const FunctionOfSide function = [&](bool opposite) {
      return *functions.exact_function(opposite ? 1 : 0);
    };
    std::optional<std::string> trouble = disagreement(filtered, exact, function);
    row.events += count_of_events(exact);

    std::vector<Instant> times;
    times.emplace_back(0.0);
    for (const double u : c.times) times.emplace_back(u);
    for (const Answer& answer : exact) {
      if (answer.failure.kind == Failure::Kind::later)
        times.emplace_back(answer.failure.time, functions, answer.opposite ? 1 : 0);
    }
    for (const Instant& now : times) {
      if (const auto wrong = compare_signs(row, c, now); wrong && !trouble) trouble = wrong;
    }
    if (!trouble) return;
    ++row.disagreements;
    if constexpr (channels_asked<C>.radii) *trouble += radii_text(c.motion);
    note_trouble(row, c.number, *trouble, instance_text(c.instance));
  }

  /// Returns the radii, which an instance file cannot hold.
  static std::string radii_text(const AnyDegreeMotion<Dimension>& motion) {
    std::string text = "; radii";
    for (BeadId b = 0; b < beads; ++b)
      for (int k = 0; k <= motion.own_degree(); ++k)
        text += fmt::format("{}{}", k == 0 ? "; " : " ", motion.radius(b, k));
    return text;
  }

  static std::optional<std::string> compare_signs(StabilityRow& row, const Case& c, const Instant& now) {
    StageCounts uncounted;
    const int exact = c.search->sign_just_after(Kernel::exact, c.certificate, now, uncounted);
    const int filtered = c.search->sign_just_after(Kernel::filtered, c.certificate, now, row.stages);
    ++row.signs;
    if (filtered == exact) return std::nullopt;
    return "sign just after " + std::to_string(now.lower()) + ": filtered " + std::to_string(filtered) +
           ", exact " + std::to_string(exact);
  }

  const Extreme& extreme_;
  std::vector<std::unique_ptr<Case>> cases_;  // pointers, since searches refer to motions
  std::size_t refused_ = 0;
  std::string reason_;
};

/// Makes a certificate type a subject.
template <class C, int Dimension>
[[nodiscard]] StabilitySubject certificate_subject(std::string name, int motion_degree) {
  constexpr bool weighted = channels_asked<C>.weights || channels_asked<C>.radii;
  const int degree = function_degree<C, Dimension>(motion_degree);
  StabilitySubject subject{std::move(name), false, Dimension, motion_degree, degree, weighted, {}};
  subject.run = [motion_degree, degree](const Extreme& extreme, const StabilityCases& cases) {
    return CertificateTrial<C, Dimension>(extreme, cases, motion_degree, degree).run();
  };
  return subject;
}

}  // namespace kds
