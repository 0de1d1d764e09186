#pragma once
// `kds stability`: certificate types, structures and changes of their motion in extreme scenes. The result is
// a table with a row for each subject in each extreme.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/base/kernel.h"
#include "experiments/output/table.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option.h"
#include "experiments/stability/stability_scenes.h"

namespace kds {

struct KernelSeconds {
  double filtered = 0, exact = 0;
};

struct StabilityRow {
  std::string subject;
  bool structure = false;  ///< a structure rather than a certificate type
  int dimension = 0;
  int degree = 0;           ///< the motion's degree
  int function_degree = 0;  ///< the certificate's degree; 0 for a structure, which has several functions
  std::string extreme;
  bool must_refuse = false;  ///< the extreme has numbers without an exact value

  std::uint64_t cases = 0;
  std::uint64_t events = 0;         ///< exact events over all cases
  std::uint64_t signs = 0;          ///< signs compared; certificates only
  std::uint64_t disagreements = 0;  ///< cases in which `filtered` differs from `exact`
  std::uint64_t refused = 0;        ///< cases that both kernels refuse
  std::uint64_t failed = 0;         ///< cases that end in an internal error or a failed audit
  std::string reason;               ///< description of the first refusal, failure or disagreement
  std::string motion;               ///< instance file of the first failure or disagreement

  StageCounts stages;          ///< of `filtered`
  std::uint64_t rebuilds = 0;  ///< of `filtered`
  std::uint64_t audits_run = 0, audits_failed = 0;
  KernelSeconds seconds;  ///< medians over cases: search of a certificate, run of a structure

  [[nodiscard]] bool holds() const {
    return disagreements == 0 && failed == 0 && audits_failed == 0 && (!must_refuse || refused == cases);
  }
};

/// Returns a name such as "power_test 3D degree 1, scale:2^300".
[[nodiscard]] std::string name_of(const StabilityRow& row);

/// Keeps the first problem of a row: its description, and the data to reproduce it.
void note_trouble(StabilityRow& row, std::size_t number, const std::string& reason,
                  const std::string& motion);

struct StabilityCases {
  std::uint64_t seed = 1;
  std::size_t cases = 0;
};

struct StabilitySubject {
  std::string name;
  bool structure = false;         ///< a structure or a change of its motion rather than a certificate type
  int dimension = 0, degree = 0;  ///< for the motion
  int function_degree = 0;        ///< for a certificate
  bool weighted = false;  ///< uses weights or radii; other subjects skip the extremes of unequal radii
  std::function<StabilityRow(const Extreme&, const StabilityCases&)> run;

  [[nodiscard]] bool meets(const Extreme& extreme) const {
    return extreme.applies(dimension, degree) && (weighted || !extreme.unequal_radii);
  }
};

/// Returns certificate types, then structures. Subjects with one name are adjacent.
[[nodiscard]] std::vector<StabilitySubject> all_subjects();

/// The parts of all_subjects(): certificate types of beads and of balls under motions of a degree,
/// structures, and tolerances and strides.
[[nodiscard]] std::vector<StabilitySubject> bead_certificates(int degree);
[[nodiscard]] std::vector<StabilitySubject> ball_certificates(int degree);
[[nodiscard]] std::vector<StabilitySubject> kinetic_structures();
[[nodiscard]] std::vector<StabilitySubject> motion_levers();

struct StabilityOptions : Destinations {  // results: stability.json, stability.csv
  std::vector<std::string> subjects;      ///< names; empty for all
  std::vector<std::string> extremes;      ///< names or families; empty for all
  StabilityCases cases{1, 200};

  [[nodiscard]] bool wants(const StabilitySubject& subject) const;
  [[nodiscard]] bool wants(const Extreme& extreme) const;
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help.
[[nodiscard]] StabilityOptions parse_stability_options(const Arguments& arguments);

/// `progress` gets the number of rows done and of all rows. Throws InputError if no extreme applies to any
/// subject.
[[nodiscard]] std::vector<StabilityRow> run_stability(
    const StabilityOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

[[nodiscard]] const Table<StabilityRow>& stability_columns();

/// Returns the error message if some row does not hold. The program then exits with code 1.
[[nodiscard]] std::optional<std::string> complaint_about(std::span<const StabilityRow> rows);

}  // namespace kds
