#pragma once
// One certificate type in one extreme: `filtered` and `fast` against `exact`.

#include <chrono>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/compare_answers.h"
#include "experiments/stability_subjects.h"
#include "motions/input_error.h"
#include "motions/scene.h"

namespace kds {

template <class C, Motion M>
inline constexpr int function_degree =
    decltype(function_of(C{}, DoubleView<M>(std::declval<const M&>())))::degree;

template <class C, Motion M>
class CertificateTrial {
 public:
  CertificateTrial(const Extreme& extreme, const StabilityCases& cases) : extreme_(extreme) {
    // Fewer where the exact stage is slow.
    constexpr std::size_t slow = function_degree < C,
                          M >> 6 ? function_degree<C, M> * function_degree<C, M> : 36;
    const std::size_t count = (cases.cases * 36 + slow - 1) / slow;
    for (std::size_t number = 0; number < count; ++number) {
      SceneRandom random = scene_random(cases.seed, extreme.name, number);
      const BeadCurves curves = extreme.make({M::dimension, M::degree, beads}, random);
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
    note_trouble(row, c.number, *trouble, instance_text(c.instance));
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
[[nodiscard]] StabilitySubject certificate_subject(std::string name, bool weighted = false) {
  StabilitySubject subject{std::move(name), false, M::dimension, M::degree, function_degree<C, M>,
                           weighted,        {}};
  subject.run = [](const Extreme& extreme, const StabilityCases& cases) {
    return CertificateTrial<C, M>(extreme, cases).run();
  };
  return subject;
}

}  // namespace kds
