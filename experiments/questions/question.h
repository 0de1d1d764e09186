#pragma once
// The open questions of the paper with their measured answers: a table, the fits to it, and the conclusions.
// Each question has a function that measures it, and one that returns how often `step_done` is called.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/program/input_options.h"
#include "experiments/program/power_fit.h"
#include "experiments/reproduce/measurements.h"

namespace kds {

struct QuestionColumn {
  std::string name;  ///< name in CSV and JSON
  std::string title;
};

struct QuestionRow {
  std::string subject;
  std::vector<std::optional<double>> values;  ///< in the order of the columns
};

/// A power law that is fitted to a part of a curve.
struct CurveFit {
  std::string part;         ///< "", or which points: "the 4 least amplitudes"
  double from = 0, to = 0;  ///< least and largest x of the points
  PowerFit fit;
};

/// A curve of a plot with two logarithmic axes. A power law is fitted to the curve if it has enough points.
struct QuestionCurve {
  std::string plot;  ///< name of the plot; curves with one name share a plot
  std::string name;
  std::vector<std::pair<double, double>> points;
  /// Each element has the points as they are without one of several equal shares of the measurements. Empty
  /// if there are no shares.
  std::vector<std::vector<std::pair<double, double>>> without;
  /// Whether the exponent changes along the curve, so that one power law does not describe it.
  bool crossover = false;

  /// Returns a fit to all points. For a crossover of at least eight points, returns fits to the four least,
  /// to the four before the last two, and to the three largest. Intervals come from `without`; if it is
  /// empty, there are none.
  [[nodiscard]] std::vector<CurveFit> fits() const;
};

struct Question {
  std::string name;    ///< name of its file, such as energy
  std::string title;   ///< the question itself
  std::string words;   ///< what is measured, and how
  std::string answer;  ///< the main result in a sentence
  std::vector<QuestionColumn> columns;
  std::vector<QuestionRow> rows;
  std::string x_label, y_label;  ///< labels of the plots' axes
  std::vector<QuestionCurve> curves;
  std::vector<std::string> findings;  ///< sentences
};

/// A moving chain that several questions use.
struct NamedSubject {
  std::string name;
  Subject subject;
};

using MovingSubjects = std::vector<NamedSubject>;
/// Returns the subjects if the user gives none, with 200 frames each: two trajectories in the folder `data`,
/// and a random chain that moves slowly.
[[nodiscard]] MovingSubjects usual_subjects(const std::filesystem::path& data, std::uint64_t seed);
/// Reads each input as a subject. Throws InputError for an input of several necklaces, of fewer than four
/// beads or of fewer than three frames.
[[nodiscard]] MovingSubjects subjects_of(const InputOptions& options,
                                         const std::function<void(const std::string&)>& warn);

/// "What properties of a physical model can be exploited to make hierarchy updates faster?" Measures how
/// rarely near pairs, found within a skin, must be found again, depending on the known bound on the motion.
[[nodiscard]] Question ask_about_bounds(const MovingSubjects& subjects,
                                        const std::function<void()>& step_done);
/// Asks the question of ask_about_bounds too. Measures the work saved by trusting the bases of the wrapped
/// hierarchy for several frames, and how far beads may then stick out.
[[nodiscard]] Question ask_about_trust(const MovingSubjects& subjects, std::size_t rounds,
                                       const std::function<void()>& step_done);
[[nodiscard]] std::size_t bounds_steps(const MovingSubjects& subjects);
[[nodiscard]] std::size_t trust_steps(const MovingSubjects& subjects);

/// "How can we best integrate the power diagram and the sphere hierarchy so as to get the advantages of
/// each?" Measures one way: the hierarchy settles as much as it can down to blocks of beads, and a diagram of
/// the remaining beads settles the rest.
[[nodiscard]] Question ask_about_combination(const std::filesystem::path& data, std::uint64_t seed,
                                             const std::function<void()>& step_done);
[[nodiscard]] std::size_t combination_steps();

/// The energy of deforming a chain in the simplest model: springs of stiffness 1 at its angles. From one
/// conformation to the next, the energy is half the sum of the squared changes, in radians, of all bending
/// and torsion angles. A bending angle lies at a bead, between its two bonds. A torsion angle lies at a bond,
/// between the bonds before and after it. Bond lengths do not count, and rigid motions take no energy.
struct Deformation {
  double bending = 0, torsion = 0;
  [[nodiscard]] double energy() const { return bending + torsion; }
};

/// Compares two conformations of one chain. An angle that is undefined, because three beads are collinear or
/// a bond has zero length, counts as unchanged.
[[nodiscard]] Deformation deformation(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& after);

/// A chain given by its angles: n beads, n - 2 bending angles (pi is straight), n - 3 torsion angles.
struct ChainAngles {
  std::vector<double> bending, torsion;
};
[[nodiscard]] Eigen::Matrix3Xd chain_of(const ChainAngles& angles, double bond);

/// Draws the angles of bead `bead` >= 2: the bending angle at the bead before it, and, from bead 3 on, the
/// torsion angle of the bond to that bead.
using DrawAngles = std::function<std::pair<double, double>(std::size_t bead)>;
/// Grows a chain of beads of radius 1 bead by bead. No two beads overlap but consecutive ones. Angles are
/// drawn again where beads would overlap, and the chain is shortened at dead ends. Throws std::runtime_error
/// if it finds no room.
[[nodiscard]] ChainAngles self_avoiding_angles(std::size_t beads, double bond, const DrawAngles& draw);

/// "Can we prove bounds on the number of combinatorial changes in the wrapped hierarchy, assuming a physical
/// model of deformation and a given deformation energy budget?" Measures the number of changes as a function
/// of the energy of deformation, of the subjects and of random chains of `seeds` seeds from `seed` on.
/// Without `random_chains` only the subjects are measured.
struct RandomChains {
  std::uint64_t seed = 1;
  std::size_t seeds = 1;
};
[[nodiscard]] Question ask_about_energy(const MovingSubjects& subjects,
                                        const std::optional<RandomChains>& random_chains,
                                        const std::function<void()>& step_done);
[[nodiscard]] std::size_t energy_steps(const MovingSubjects& subjects, bool random_chains);

}  // namespace kds
