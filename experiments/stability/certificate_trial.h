#pragma once
// One certificate type in one extreme: `filtered` and `fast` against `exact`.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "certificates/search/radical_search.h"
#include "certificates/types/orientation.h"
#include "experiments/stability/compare_answers.h"
#include "experiments/stability/stability_radii.h"
#include "experiments/stability/stability_subjects.h"
#include "motions/base/input_error.h"
#include "motions/scene/scene.h"

namespace kds {

/// The polynomial whose roots are failures.
template <class C, Motion M>
struct RootsOf {
  using Function = C;
};
template <class C, Motion M>
requires RadicalCertificateFor<C, M>
struct RootsOf<C, M> {
  using Function = typename C::Radical::Norm;
};

template <class C, Motion M>
inline constexpr int function_degree = decltype(function_of(typename RootsOf<C, M>::Function{},
                                                            DoubleView<M>(std::declval<const M&>())))::degree;

/// How many times longer than usual the exact stage takes for a case; less than that is not counted.
template <class C, Motion M>
inline constexpr double case_cost = [] {
  constexpr double longer = std::max(1.0, function_degree<C, M> / 6.0);
  return RadicalCertificateFor<C, M> ? 4 * longer * longer * longer : longer * longer;
}();

template <class C, Motion M>
inline constexpr Channels channels_asked = channels_of<typename RootsOf<C, M>::Function>;

template <class C, Motion M>
class CertificateTrial {
 public:
  CertificateTrial(const Extreme& extreme, const StabilityCases& cases) : extreme_(extreme) {
    const auto count =
        static_cast<std::size_t>(std::ceil(static_cast<double>(cases.cases) / case_cost<C, M>));
    for (std::size_t number = 0; number < count; ++number) {
      SceneRandom random = scene_random(cases.seed, extreme.name, number);
      BeadCurves curves = extreme.make({M::dimension, M::degree, beads}, random);
      if constexpr (channels_asked<C, M>.radii) give_radii(curves, random);
      Case made{number, {}, M(0), {}, curves.instance(std::string(extreme.name))};
      std::iota(made.certificate.beads.begin(), made.certificate.beads.end(), BeadId{0});
      made.certificate.opposite = random() % 2 == 1;
      for (double& u : made.times) u = static_cast<double>(random() >> 11U) * 0x1p-53;
      try {
        static_cast<void>(Scene(made.instance));
      } catch (const InputError& refusal) {
        if (refused_++ == 0) reason_ = refusal.what();
        continue;
      }
      made.motion = curves.motion<M>();
      orient(made);
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
    const auto fast = follow_all<Fast>(uncounted, row.seconds.fast);
    const auto filtered = follow_all<Filtered>(row.stages, row.seconds.filtered);
    const auto exact = follow_all<Exact>(uncounted, row.seconds.exact);
    for (std::size_t i = 0; i < cases_.size(); ++i) compare(row, cases_[i], fast[i], filtered[i], exact[i]);
    return row;
  }

 private:
  static constexpr std::size_t beads = bead_places<C>;

  struct Case {
    std::size_t number = 0;
    Sided<C> certificate;
    M motion;
    std::array<double, 2> times{};  // at which signs are compared, besides 0 and the failures
    Instance instance;
  };

  /// Certificates of full bases are told how these turn, at the start.
  static void orient(Case& made) {
    if constexpr (requires { made.certificate.orientation; }) {
      Orientation<M::dimension> basis;
      std::copy_n(made.certificate.beads.begin(), basis.beads.size(), basis.beads.begin());
      StageCounts uncounted;
      made.certificate.orientation =
          sign_just_after<Exact>(basis, made.motion, Instant(0), uncounted) < 0 ? -1 : 1;
    }
  }

  template <Kernel K>
  [[nodiscard]] std::vector<std::vector<Answer>> follow_all(StageCounts& stages, double& seconds) const {
    std::vector<std::vector<Answer>> answers;
    std::vector<double> spent;
    for (const Case& c : cases_) {
      const auto start = std::chrono::steady_clock::now();
      answers.push_back(follow<K>(c.certificate, c.motion, stages));
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      spent.push_back(time.count() / static_cast<double>(answers.back().size()));
    }
    seconds = median(std::move(spent));
    return answers;
  }

  static void compare(StabilityRow& row, const Case& c, const std::vector<Answer>& fast,
                      const std::vector<Answer>& filtered, const std::vector<Answer>& exact) {
    const BothSides<C, M> functions(c.certificate, c.motion);
    const FunctionOfSide function = [&](bool opposite) { return functions.exact_function(opposite ? 1 : 0); };
    std::optional<std::string> trouble = disagreement(filtered, exact, function);
    const std::vector<TimedChange> failures = sharp_failures_of(exact, function);
    row.events += failures.size();
    add(row.fast, event_difference(failures, failures_of(fast)));

    std::vector<Instant> times{Instant(0)};
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
    if constexpr (channels_asked<C, M>.radii) *trouble += radii_text(c.motion);
    note_trouble(row, c.number, *trouble, instance_text(c.instance));
  }

  /// What an instance file does not hold.
  static std::string radii_text(const M& motion) {
    std::string text = "; radii";
    for (BeadId b = 0; b < beads; ++b)
      for (int k = 0; k <= M::degree; ++k)
        text += fmt::format("{}{}", k == 0 ? "; " : " ", motion.radius(b, k));
    return text;
  }

  static std::optional<std::string> compare_signs(StabilityRow& row, const Case& c, const Instant& now) {
    StageCounts uncounted;
    const int exact = sign_just_after<Exact>(c.certificate, c.motion, now, uncounted);
    const int filtered = sign_just_after<Filtered>(c.certificate, c.motion, now, row.stages);
    const int fast = sign_just_after<Fast>(c.certificate, c.motion, now, uncounted);
    ++row.signs;
    row.wrong_signs += fast != exact ? 1 : 0;
    if (filtered == exact) return std::nullopt;
    return "sign just after " + std::to_string(now.lower()) + ": filtered " + std::to_string(filtered) +
           ", exact " + std::to_string(exact);
  }

  const Extreme& extreme_;
  std::vector<Case> cases_;
  std::size_t refused_ = 0;
  std::string reason_;
};

/// A certificate type as a subject.
template <class C, Motion M>
[[nodiscard]] StabilitySubject certificate_subject(std::string name) {
  constexpr bool weighted = channels_asked<C, M>.weights || channels_asked<C, M>.radii;
  StabilitySubject subject{std::move(name), false, M::dimension, M::degree, function_degree<C, M>,
                           weighted,        {}};
  subject.run = [](const Extreme& extreme, const StabilityCases& cases) {
    return CertificateTrial<C, M>(extreme, cases).run();
  };
  return subject;
}

}  // namespace kds
