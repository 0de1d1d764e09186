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

/// A curve of a plot with two logarithmic axes. A power law is fitted to the curve if it has enough points.
struct QuestionCurve {
  std::string plot;  ///< name of the plot; curves with one name share a plot
  std::string name;
  std::vector<std::pair<double, double>> points;
  /// Each element has the points as they are without one of several equal shares of the measurements. Empty
  /// if there are no shares.
  std::vector<std::vector<std::pair<double, double>>> without;
  [[nodiscard]] std::optional<PowerFit> fit() const {
    return without.empty() ? fit_power(points) : fit_power(points, without);
  }
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

inline constexpr std::size_t moving_subject_count = 3;
/// Returns one of three subjects with 200 frames each: two trajectories, and a random chain that moves
/// slowly.
[[nodiscard]] NamedSubject moving_subject(std::size_t which, const std::filesystem::path& data,
                                          std::uint64_t seed);

/// "What properties of a physical model can be exploited to make hierarchy updates faster?" Measures how
/// rarely near pairs, found within a skin, must be found again, depending on the known bound on the motion.
[[nodiscard]] Question ask_about_bounds(const std::filesystem::path& data, std::uint64_t seed,
                                        const std::function<void()>& step_done);
/// Asks the question of ask_about_bounds too. Measures the work saved by trusting the bases of the wrapped
/// hierarchy for several frames, and how far beads may then stick out.
[[nodiscard]] Question ask_about_trust(const std::filesystem::path& data, std::uint64_t seed,
                                       std::size_t rounds, const std::function<void()>& step_done);
[[nodiscard]] std::size_t bounds_steps();
[[nodiscard]] std::size_t trust_steps();

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

/// "Can we prove bounds on the number of combinatorial changes in the wrapped hierarchy, assuming a physical
/// model of deformation and a given deformation energy budget?" Measures the number of changes as a function
/// of the energy of deformation. `data` is the data folder with the trajectories.
[[nodiscard]] Question ask_about_energy(const std::filesystem::path& data, std::uint64_t seed,
                                        const std::function<void()>& step_done);
[[nodiscard]] std::size_t energy_steps();

}  // namespace kds
