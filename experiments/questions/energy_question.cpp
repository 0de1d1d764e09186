#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "experiments/output/text.h"
#include "experiments/questions/question.h"
#include "motions/models/elementary.h"
#include "motions/models/shapes.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

using Vector = Eigen::Vector3d;

Vector bond_of(const Eigen::Matrix3Xd& chain, Eigen::Index bead) {
  return chain.col(bead + 1) - chain.col(bead);
}

std::optional<double> bending_angle(const Eigen::Matrix3Xd& chain, Eigen::Index bead) {
  const Vector a = -bond_of(chain, bead - 1), b = bond_of(chain, bead);
  if (a.isZero(0) || b.isZero(0)) return std::nullopt;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Returns the torsion angle of the bond from this bead to the next.
std::optional<double> torsion_angle(const Eigen::Matrix3Xd& chain, Eigen::Index bead) {
  const Vector a = bond_of(chain, bead - 1), b = bond_of(chain, bead), c = bond_of(chain, bead + 1);
  const Vector n = a.cross(b), m = b.cross(c);
  if (n.isZero(0) || m.isZero(0)) return std::nullopt;
  return std::atan2(b.norm() * a.dot(m), n.dot(m));
}

double half_square(const std::optional<double>& before, const std::optional<double>& after) {
  if (!before || !after) return 0;
  const double change = std::remainder(*after - *before, 2 * std::numbers::pi);
  return change * change / 2;
}

}  // namespace

Deformation deformation(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& after) {
  Deformation result;
  const Eigen::Index beads = before.cols();
  for (Eigen::Index bead = 1; bead + 1 < beads; ++bead)
    result.bending += half_square(bending_angle(before, bead), bending_angle(after, bead));
  for (Eigen::Index bead = 1; bead + 2 < beads; ++bead)
    result.torsion += half_square(torsion_angle(before, bead), torsion_angle(after, bead));
  return result;
}

namespace {

// A chain that grows bead by bead.
class GrowingChain {
 public:
  explicit GrowingChain(std::size_t beads, double bond)
      : bond_(bond), centers_(Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(beads))) {
    centers_.col(1) = bond * along_.back();
  }

  [[nodiscard]] std::size_t beads() const { return along_.size() + 1; }
  /// The torsion angle of the first bead added has no meaning.
  void add(double bending, double torsion) {
    Vector normal = normal_.back(), along = along_.back();
    if (beads() > 2) normal = Eigen::AngleAxisd(torsion, along) * normal;
    along = Eigen::AngleAxisd(std::numbers::pi - bending, normal) * along;
    along.normalize();
    normal = (normal - normal.dot(along) * along).normalized();
    const auto bead = static_cast<Eigen::Index>(beads());
    centers_.col(bead) = centers_.col(bead - 1) + bond_ * along;
    along_.push_back(along);
    normal_.push_back(normal);
  }
  void remove_last() {
    along_.pop_back();
    normal_.pop_back();
  }
  /// Returns whether the last bead overlaps another bead of radius 1 but the one before it.
  [[nodiscard]] bool overlaps() const {
    const auto last = static_cast<Eigen::Index>(beads()) - 1;
    for (Eigen::Index bead = 0; bead + 1 < last; ++bead)
      if ((centers_.col(last) - centers_.col(bead)).squaredNorm() <= 4) return true;
    return false;
  }
  [[nodiscard]] const Eigen::Matrix3Xd& centers() const { return centers_; }

 private:
  double bond_;
  Eigen::Matrix3Xd centers_;
  std::vector<Vector> along_{Vector::UnitX()}, normal_{Vector::UnitZ()};  // of each bond
};

}  // namespace

Eigen::Matrix3Xd chain_of(const ChainAngles& angles, double bond) {
  GrowingChain chain(angles.bending.size() + 2, bond);
  for (std::size_t k = 0; k < angles.bending.size(); ++k)
    chain.add(angles.bending[k], k == 0 ? 0 : angles.torsion[k - 1]);
  return chain.centers();
}

ChainAngles self_avoiding_angles(std::size_t beads, double bond, const DrawAngles& draw) {
  constexpr int tries_of_a_bead = 50, most_dead_ends = 10'000;
  constexpr std::size_t least_shortened = 8;
  GrowingChain chain(beads, bond);
  std::vector<std::pair<double, double>> drawn;
  for (int dead_ends = 0; chain.beads() < beads;) {
    bool found = false;
    for (int tries = 0; tries < tries_of_a_bead && !found; ++tries) {
      drawn.push_back(draw(chain.beads()));
      chain.add(drawn.back().first, drawn.back().second);
      found = !chain.overlaps();
      if (found) break;
      chain.remove_last();
      drawn.pop_back();
    }
    if (found) continue;
    if (++dead_ends > most_dead_ends) throw std::runtime_error("a self-avoiding chain finds no room");
    // A dead end may come from far back, so each of six shortens the chain twice as much as the one before.
    const std::size_t shortened = least_shortened << static_cast<unsigned>(dead_ends % 6);
    for (std::size_t k = 0; k < shortened && !drawn.empty(); ++k) {
      chain.remove_last();
      drawn.pop_back();
    }
  }
  ChainAngles angles;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    angles.bending.push_back(drawn[k].first);
    if (k > 0) angles.torsion.push_back(drawn[k].second);
  }
  return angles;
}

namespace {

constexpr std::array<std::size_t, 6> kStrides{1, 2, 4, 8, 16, 32};
constexpr int kAmplitudes = 11;  // 2^-10 ... 1 radian
constexpr std::size_t kChainBeads = 128;
// Number of conformations at the largest amplitude. Each smaller amplitude has twice as many, up to the
// maximum, because its steps have fewer changes.
constexpr std::size_t kLeastConformations = 16, kMostConformations = 128;
constexpr std::size_t kShares = 16;  // shares of an amplitude's conformations, for the jackknife interval
// Least distance of a bending angle from 0 and pi. At 0 or pi both adjacent torsion angles would jump by pi.
constexpr double kLeastBending = 0.05 * std::numbers::pi;

constexpr std::size_t kTimeBlocks = 8;  // of neighbouring frames of a trajectory, for the jackknife interval

constexpr const char *kBases = "basis changes", *kFlips = "flips";

/// Which angles of a random chain change. Self-avoiding chains change both kinds.
enum class Angles { bending, torsion, both, self_avoiding };
constexpr std::array kAngles{Angles::bending, Angles::torsion, Angles::both, Angles::self_avoiding};
constexpr std::array<std::string_view, 4> kAngleNames{"random chain, bending", "random chain, torsion",
                                                      "random chain, both", "self-avoiding chain, both"};

// One step between frames.
struct Step {
  Deformation deformation;
  double bases = 0, flips = 0;  ///< numbers of events
  std::size_t share = 0;        ///< the share of the measurements to which the step belongs
};

std::vector<Step> steps_of(std::vector<Eigen::Matrix3Xd> frames, const std::vector<double>& radii) {
  std::vector<Step> steps(frames.size() - 1);
  for (std::size_t k = 0; k < steps.size(); ++k) steps[k].deformation = deformation(frames[k], frames[k + 1]);
  Trajectory chain;
  chain.file = "chain";
  chain.frames = std::move(frames);
  const Scene scene(std::span(&chain, 1), radii);
  KineticRun run(scene, {.structures = {"wrapped", "power"}});
  run.finish();
  const auto events = [&](std::size_t structure, std::size_t k) {
    return static_cast<double>(run.structures()[structure]->statistics.events_per_step[k]);
  };
  for (std::size_t k = 0; k < steps.size(); ++k) {
    steps[k].bases = events(0, k);
    steps[k].flips = events(1, k);
  }
  return steps;
}

Step mean_of(std::span<const Step> steps) {
  Step mean;
  const auto count = static_cast<double>(steps.size());
  for (const Step& step : steps) {
    mean.deformation.bending += step.deformation.bending / count;
    mean.deformation.torsion += step.deformation.torsion / count;
    mean.bases += step.bases / count;
    mean.flips += step.flips / count;
  }
  return mean;
}

std::vector<Step> without_share(std::span<const Step> steps, std::size_t share) {
  std::vector<Step> others;
  for (const Step& step : steps)
    if (step.share != share) others.push_back(step);
  return others;
}

// Returns the strides that leave at least two steps.
std::vector<std::size_t> strides_of(const Subject& subject) {
  std::vector<std::size_t> strides(kStrides.begin(), kStrides.end());
  std::erase_if(strides, [&](std::size_t stride) { return 2 * stride >= subject.frames.size(); });
  return strides;
}

// Returns a sample of the standard normal distribution.
double normal(models::Random& random) {
  const double u = 1 - random.uniform(), v = random.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

double random_bending(models::Random& random) { return std::numbers::pi * (0.4 + 0.4 * random.uniform()); }
double random_torsion(models::Random& random) { return 2 * std::numbers::pi * random.uniform(); }

ChainAngles random_angles(models::Random& random) {
  ChainAngles angles;
  for (std::size_t k = 0; k < kChainBeads - 2; ++k) angles.bending.push_back(random_bending(random));
  for (std::size_t k = 0; k < kChainBeads - 3; ++k) angles.torsion.push_back(random_torsion(random));
  return angles;
}

// Draws again if the chain would fold or straighten.
double changed_bending(double angle, double amplitude, models::Random& random) {
  for (;;) {
    const double changed = angle + amplitude * normal(random);
    if (changed > kLeastBending && changed < std::numbers::pi - kLeastBending) return changed;
  }
}

std::size_t conformations_at(int amplitude) {
  return std::min(kMostConformations, kLeastConformations << (kAmplitudes - 1 - amplitude));
}

constexpr double kBond = 2 * models::usual_bond;

class Measurement {
 public:
  explicit Measurement(const std::function<void()>& step_done) : step_done_(step_done) {}

  Question ask(const MovingSubjects& subjects, const std::optional<RandomChains>& chains) {
    question_.name = "energy";
    question_.title = "How does the number of changes grow with the deformation energy?";
    question_.columns = {{"step", "stride or amplitude"},
                         {"steps", "steps"},
                         {"bending", "bending energy per step"},
                         {"torsion", "torsion energy per step"},
                         {"basis_changes", "basis changes per step"},
                         {"flips", "flips per step"}};
    question_.x_label = "deformation energy per step, rad²";
    question_.y_label = "changes per step";
    question_.words = fmt::format(
        "The energy of a step is half the sum of the squared changes of all bending angles and of all "
        "torsion angles of the chain, in radians, between two frames: springs of stiffness 1. Basis changes "
        "are events of the wrapped hierarchy, flips those of the power diagram, under linear motion, all "
        "exact. Trajectories are measured frame by frame and over strides to {}; the steps at stride 1 are "
        "also grouped by energy, in eight groups of equal size. The intervals of trajectories leave out one "
        "of {} "
        "blocks of neighbouring frames at a time (block jackknife). Random chains have {} beads, bending "
        "angles "
        "between 0.4 and 0.8 pi and any torsion. In a step all angles of one kind, or of both, change by "
        "normal "
        "random amounts of the amplitude given, drawn again where a bending angle would come within 0.05 pi "
        "of "
        "0 or pi. Self-avoiding chains are grown bead by bead, at both ends of a step. Conformations are "
        "drawn "
        "anew for each amplitude, {} for each seed at the largest amplitude to {} at small ones; their "
        "intervals leave out one of {} equal shares at a time.",
        kStrides.back(), kTimeBlocks, kChainBeads, kLeastConformations, kMostConformations, kShares);
    for (const NamedSubject& subject : subjects) ask_about(subject);
    if (chains) {
      for (const Angles angles : kAngles) ask_about(angles, *chains);
      question_.answer = answer();
    } else {
      question_.answer =
          "See the exponents over strides and by step below; energies near 0 make every number of "
          "changes linear in the amplitude, which is an exponent of 0.5.";
    }
    return std::move(question_);
  }

 private:
  // Returns the answer for random chains in which all angles change.
  [[nodiscard]] std::string answer() const {
    const auto of = [&](std::string_view plot, std::string_view name) -> std::string {
      for (const QuestionCurve& curve : question_.curves) {
        if (curve.plot != plot || curve.name != name) continue;
        const auto fits = curve.fits();
        if (fits.size() == 3)
          return fmt::format(
              "as energy^{} at the least amplitudes, as energy^{} at larger ones, and as energy^{} "
              "at the largest",
              exponent_text(fits[0].fit), exponent_text(fits[1].fit), exponent_text(fits[2].fit));
      }
      return "in no measured way";
    };
    const std::string_view both = kAngleNames[static_cast<std::size_t>(Angles::both)];
    return fmt::format(
        "On random chains basis changes grow {}, flips {}. An exponent of 0.5 is growth in proportion to how "
        "far "
        "angles change, which small steps always show.",
        of(kBases, both), of(kFlips, both));
  }

  void add(const std::string& subject, double step, std::span<const Step> steps) {
    const Step mean = mean_of(steps);
    question_.rows.push_back({subject,
                              {step, static_cast<double>(steps.size()), mean.deformation.bending,
                               mean.deformation.torsion, mean.bases, mean.flips}});
  }

  // Adds a point to each curve, and for each share the point without it. A share without steps changes
  // nothing.
  static void add_points(std::span<const Step> steps, std::size_t shares, QuestionCurve& bases,
                         QuestionCurve& flips) {
    const auto add = [&](std::span<const Step> some, auto& of_bases, auto& of_flips) {
      const Step mean = mean_of(some);
      of_bases.emplace_back(mean.deformation.energy(), mean.bases);
      of_flips.emplace_back(mean.deformation.energy(), mean.flips);
    };
    add(steps, bases.points, flips.points);
    bases.without.resize(shares);
    flips.without.resize(shares);
    for (std::size_t share = 0; share < shares; ++share) {
      const std::vector<Step> others = without_share(steps, share);
      add(others.empty() ? steps : others, bases.without[share], flips.without[share]);
    }
  }

  void keep(QuestionCurve bases, QuestionCurve flips, std::string_view over) {
    for (QuestionCurve* curve : {&bases, &flips}) {
      for (const CurveFit& fitted : curve->fits())
        question_.findings.push_back(
            fmt::format("{}, {}: grow as energy^{} over {}, energies from {} to {} rad².", curve->name,
                        curve->plot, exponent_text(fitted.fit), fitted.part.empty() ? over : fitted.part,
                        short_decimal(fitted.from), short_decimal(fitted.to)));
      question_.curves.push_back(std::move(*curve));
    }
  }

  void ask_about(const NamedSubject& one) {
    const auto& [name, subject] = one;
    QuestionCurve bases{kBases, name, {}, {}}, flips{kFlips, name, {}, {}};
    std::vector<Step> finest;
    for (const std::size_t stride : strides_of(subject)) {
      std::vector<Eigen::Matrix3Xd> frames;
      for (std::size_t k = 0; k < subject.frames.size(); k += stride) frames.push_back(subject.frames[k]);
      std::vector<Step> steps = steps_of(std::move(frames), subject.radii);
      for (std::size_t k = 0; k < steps.size(); ++k)
        steps[k].share = k * stride * kTimeBlocks / subject.frames.size();
      add(name, static_cast<double>(stride), steps);
      add_points(steps, kTimeBlocks, bases, flips);
      if (stride == 1) finest = std::move(steps);
      step_done_();
    }
    keep(std::move(bases), std::move(flips), "strides");
    in_groups(name, std::move(finest));
  }

  // Returns the means of eight groups of steps of like energy.
  static std::vector<Step> groups_of(std::vector<Step> steps) {
    constexpr std::size_t groups = 8;
    std::ranges::stable_sort(steps, {}, [](const Step& step) { return step.deformation.energy(); });
    std::vector<Step> means;
    for (std::size_t g = 0; g < groups; ++g) {
      const std::size_t first = g * steps.size() / groups, end = (g + 1) * steps.size() / groups;
      if (first < end) means.push_back(mean_of(std::span(steps).subspan(first, end - first)));
    }
    return means;
  }

  // Groups the steps of one trajectory by energy, to see whether a step with more energy has more changes.
  void in_groups(const std::string& name, std::vector<Step> steps) {
    QuestionCurve bases{kBases, name + " by step", {}, {}}, flips{kFlips, name + " by step", {}, {}};
    const auto add = [](const std::vector<Step>& means, auto& of_bases, auto& of_flips) {
      for (const Step& mean : means) {
        of_bases.emplace_back(mean.deformation.energy(), mean.bases);
        of_flips.emplace_back(mean.deformation.energy(), mean.flips);
      }
    };
    add(groups_of(steps), bases.points, flips.points);
    bases.without.resize(kTimeBlocks);
    flips.without.resize(kTimeBlocks);
    for (std::size_t block = 0; block < kTimeBlocks; ++block)
      add(groups_of(without_share(steps, block)), bases.without[block], flips.without[block]);
    keep(std::move(bases), std::move(flips), "steps at stride 1");
  }

  void ask_about(Angles angles, const RandomChains& chains) {
    const std::string name(kAngleNames[static_cast<std::size_t>(angles)]);
    QuestionCurve bases{kBases, name, {}, {}, true}, flips{kFlips, name, {}, {}, true};
    std::vector<models::Random> randoms;
    for (std::size_t s = 0; s < chains.seeds; ++s)
      randoms.emplace_back((chains.seed + s) * kAngles.size() + static_cast<std::uint64_t>(angles));
    for (int a = 0; a < kAmplitudes; ++a) {
      const double amplitude = std::ldexp(1, a - kAmplitudes + 1);
      std::vector<Step> steps;
      for (models::Random& random : randoms)
        for (std::size_t c = 0; c < conformations_at(a); ++c) {
          steps.push_back(random_step(angles, amplitude, random));
          steps.back().share = c % kShares;
        }
      add(name, amplitude, steps);
      add_points(steps, kShares, bases, flips);
      step_done_();
    }
    keep(std::move(bases), std::move(flips), "amplitudes");
  }

  static Step random_step(Angles angles, double amplitude, models::Random& random) {
    static const std::vector<double> radii(kChainBeads, models::radius);
    ChainAngles from, to;
    if (angles == Angles::self_avoiding) {
      from = self_avoiding_angles(kChainBeads, kBond, [&](std::size_t) {
        const double bending = random_bending(random);
        return std::pair(bending, random_torsion(random));
      });
      to = self_avoiding_angles(kChainBeads, kBond, [&](std::size_t bead) {
        const double bending = changed_bending(from.bending[bead - 2], amplitude, random);
        return std::pair(bending, bead < 3 ? 0 : from.torsion[bead - 3] + amplitude * normal(random));
      });
    } else {
      from = random_angles(random);
      to = from;
      if (angles != Angles::torsion)
        for (double& angle : to.bending) angle = changed_bending(angle, amplitude, random);
      if (angles != Angles::bending)
        for (double& angle : to.torsion) angle += amplitude * normal(random);
    }
    return steps_of({chain_of(from, kBond), chain_of(to, kBond)}, radii).front();
  }

  const std::function<void()>& step_done_;
  Question question_;
};

}  // namespace

std::size_t energy_steps(const MovingSubjects& subjects, bool random_chains) {
  std::size_t steps = random_chains ? kAngles.size() * static_cast<std::size_t>(kAmplitudes) : 0;
  for (const NamedSubject& subject : subjects) steps += strides_of(subject.subject).size();
  return steps;
}

Question ask_about_energy(const MovingSubjects& subjects, const std::optional<RandomChains>& random_chains,
                          const std::function<void()>& step_done) {
  return Measurement(step_done).ask(subjects, random_chains);
}

}  // namespace kds
