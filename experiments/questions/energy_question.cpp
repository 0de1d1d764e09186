#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
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

Eigen::Matrix3Xd chain_of(const ChainAngles& angles, double bond) {
  const auto beads = static_cast<Eigen::Index>(angles.bending.size()) + 2;
  Eigen::Matrix3Xd chain = Eigen::Matrix3Xd::Zero(3, beads);
  Vector along = Vector::UnitX(), normal = Vector::UnitZ();
  chain.col(1) = bond * along;
  for (Eigen::Index bead = 2; bead < beads; ++bead) {
    const auto k = static_cast<std::size_t>(bead - 2);
    if (k > 0) normal = Eigen::AngleAxisd(angles.torsion[k - 1], along) * normal;
    along = Eigen::AngleAxisd(std::numbers::pi - angles.bending[k], normal) * along;
    along.normalize();
    normal = (normal - normal.dot(along) * along).normalized();
    chain.col(bead) = chain.col(bead - 1) + bond * along;
  }
  return chain;
}

namespace {

constexpr std::array<std::size_t, 6> kStrides{1, 2, 4, 8, 16, 32};
constexpr int kAmplitudes = 9;  // 2^-10 ... 2^-2 radians
constexpr std::size_t kChainBeads = 128;
// Number of conformations at the largest amplitude. Each smaller amplitude has twice as many, up to the
// maximum, because its steps have fewer changes.
constexpr std::size_t kLeastConformations = 32, kMostConformations = 256;
constexpr std::size_t kShares = 16;  // shares of an amplitude's conformations, for the jackknife interval
// Least distance of a bending angle from 0 and pi. At 0 or pi both adjacent torsion angles would jump by pi.
constexpr double kLeastBending = 0.05 * std::numbers::pi;

constexpr std::size_t kProteins = 2;  // the first of the moving subjects

constexpr const char *kBases = "basis changes", *kFlips = "flips";

enum class Angles { bending, torsion, both };
constexpr std::array kAngles{Angles::bending, Angles::torsion, Angles::both};
constexpr std::array<std::string_view, 3> kAngleNames{"bending", "torsion", "both"};

// One step between frames.
struct Step {
  Deformation deformation;
  double bases = 0, flips = 0;  ///< numbers of events
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

// Returns a sample of the standard normal distribution.
double normal(models::Random& random) {
  const double u = 1 - random.uniform(), v = random.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

ChainAngles random_angles(models::Random& random) {
  ChainAngles angles;
  for (std::size_t k = 0; k < kChainBeads - 2; ++k)
    angles.bending.push_back(std::numbers::pi * (0.4 + 0.4 * random.uniform()));
  for (std::size_t k = 0; k < kChainBeads - 3; ++k)
    angles.torsion.push_back(2 * std::numbers::pi * random.uniform());
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

class Measurement {
 public:
  Measurement(const std::filesystem::path& data, std::uint64_t seed, const std::function<void()>& step_done)
      : data_(data), seed_(seed), step_done_(step_done) {}

  Question ask() {
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
        "are events of the wrapped hierarchy and flips are events of the power diagram, all exact, under "
        "linear motion. Trajectories are examined frame by frame and over strides up to {}. The steps at "
        "stride 1 are also sorted by energy into eight groups of equal size. Random chains have {} beads, "
        "bending angles between 0.4 and 0.8 pi, any torsion; in a step all angles of one kind, or of both, "
        "change by normal random amounts of the given amplitude. An amount is drawn again if a bending angle "
        "would come within 0.05 pi of 0 or pi. Each amplitude has its own random conformations, from {} at "
        "the largest to {} at the small amplitudes. The intervals of exponents of random chains come from a "
        "jackknife over {} equal shares of the conformations. The intervals of trajectories come from a line "
        "through few points, which share frames.",
        kStrides.back(), kChainBeads, kLeastConformations, kMostConformations, kShares);
    for (std::size_t which = 0; which < kProteins; ++which) ask(moving_subject(which, data_, seed_));
    for (const Angles angles : kAngles) ask(angles);
    question_.answer = answer();
    return std::move(question_);
  }

 private:
  // Returns the answer for chains in which all angles change. These chains have the last two curves.
  [[nodiscard]] std::string answer() const {
    const std::size_t count = question_.curves.size();
    const auto bases = question_.curves[count - 2].fit(), flips = question_.curves[count - 1].fit();
    if (!bases || !flips) return "";
    return fmt::format(
        "On random chains basis changes grow as energy^{} and flips as energy^{}: an exponent of 0.5 "
        "is growth in proportion to how far angles change.",
        exponent_text(*bases), exponent_text(*flips));
  }

  void add(const std::string& subject, double step, std::span<const Step> steps, QuestionCurve& bases,
           QuestionCurve& flips) {
    const Step mean = mean_of(steps);
    question_.rows.push_back({subject,
                              {step, static_cast<double>(steps.size()), mean.deformation.bending,
                               mean.deformation.torsion, mean.bases, mean.flips}});
    bases.points.emplace_back(mean.deformation.energy(), mean.bases);
    flips.points.emplace_back(mean.deformation.energy(), mean.flips);
  }

  void keep(QuestionCurve bases, QuestionCurve flips, std::string_view over) {
    for (QuestionCurve* curve : {&bases, &flips}) {
      if (const auto fit = curve->fit())
        question_.findings.push_back(fmt::format("{}, {}: grow as energy^{} over {}.", curve->name,
                                                 curve->plot, exponent_text(*fit), over));
      question_.curves.push_back(std::move(*curve));
    }
  }

  void ask(const NamedSubject& one) {
    const auto& [name, subject] = one;
    QuestionCurve bases{kBases, name, {}, {}}, flips{kFlips, name, {}, {}};
    std::vector<Step> finest;
    for (const std::size_t stride : kStrides) {
      std::vector<Eigen::Matrix3Xd> frames;
      for (std::size_t k = 0; k < subject.frames.size(); k += stride) frames.push_back(subject.frames[k]);
      const std::vector<Step> steps = steps_of(std::move(frames), subject.radii);
      add(name, static_cast<double>(stride), steps, bases, flips);
      if (stride == 1) finest = steps;
      step_done_();
    }
    keep(std::move(bases), std::move(flips), "strides");
    in_groups(name, std::move(finest));
  }

  // Groups the steps of one trajectory by energy, to see whether a step with more energy has more changes.
  void in_groups(const std::string& name, std::vector<Step> steps) {
    constexpr std::size_t groups = 8;
    std::ranges::sort(steps, {}, [](const Step& step) { return step.deformation.energy(); });
    QuestionCurve bases{kBases, name + " by step", {}, {}}, flips{kFlips, name + " by step", {}, {}};
    for (std::size_t g = 0; g < groups; ++g) {
      const std::size_t first = g * steps.size() / groups, end = (g + 1) * steps.size() / groups;
      const Step mean = mean_of(std::span(steps).subspan(first, end - first));
      bases.points.emplace_back(mean.deformation.energy(), mean.bases);
      flips.points.emplace_back(mean.deformation.energy(), mean.flips);
    }
    keep(std::move(bases), std::move(flips), "steps at stride 1");
  }

  void ask(Angles angles) {
    const std::string name = fmt::format("random chain, {}", kAngleNames[static_cast<std::size_t>(angles)]);
    QuestionCurve bases{kBases, name, {}, {}}, flips{kFlips, name, {}, {}};
    models::Random random(seed_ * kAngles.size() + static_cast<std::uint64_t>(angles));
    for (int a = 0; a < kAmplitudes; ++a) {
      const double amplitude = std::ldexp(1, a - kAmplitudes - 1);
      std::vector<Step> steps;
      for (std::size_t c = 0; c < conformations_at(a); ++c)
        steps.push_back(random_step(angles, amplitude, random));
      add(name, amplitude, steps, bases, flips);
      add_shares(steps, bases, flips);
      step_done_();
    }
    keep(std::move(bases), std::move(flips), "amplitudes");
  }

  static Step random_step(Angles angles, double amplitude, models::Random& random) {
    static const std::vector<double> radii(kChainBeads, models::radius);
    const ChainAngles from = random_angles(random);
    ChainAngles to = from;
    if (angles != Angles::torsion)
      for (double& angle : to.bending) angle = changed_bending(angle, amplitude, random);
    if (angles != Angles::bending)
      for (double& angle : to.torsion) angle += amplitude * normal(random);
    return steps_of({chain_of(from, 2 * models::usual_bond), chain_of(to, 2 * models::usual_bond)}, radii)
        .front();
  }

  // Adds to each curve, for each share, the point just added as it is without that share.
  static void add_shares(const std::vector<Step>& steps, QuestionCurve& bases, QuestionCurve& flips) {
    bases.without.resize(kShares);
    flips.without.resize(kShares);
    for (std::size_t share = 0; share < kShares; ++share) {
      std::vector<Step> others;
      for (std::size_t c = 0; c < steps.size(); ++c)
        if (c % kShares != share) others.push_back(steps[c]);
      const Step mean = mean_of(others);
      bases.without[share].emplace_back(mean.deformation.energy(), mean.bases);
      flips.without[share].emplace_back(mean.deformation.energy(), mean.flips);
    }
  }

  const std::filesystem::path& data_;
  std::uint64_t seed_;
  const std::function<void()>& step_done_;
  Question question_;
};

}  // namespace

std::size_t energy_steps() {
  return kProteins * kStrides.size() + kAngles.size() * static_cast<std::size_t>(kAmplitudes);
}

Question ask_about_energy(const std::filesystem::path& data, std::uint64_t seed,
                          const std::function<void()>& step_done) {
  return Measurement(data, seed, step_done).ask();
}

}  // namespace kds
