#include "motions/readers/dcd_cell.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "motions/base/text_input.h"

namespace kds {

namespace {

using Numbers = DcdCellForm::Numbers;

constexpr double least_angle = 20;  // degrees; no program simulates cells with sharper angles

Eigen::Vector3d lengths_of(const Numbers& v) { return {v[0], v[2], v[5]}; }
// Returns alpha, beta and gamma.
Eigen::Vector3d angles_of(const Numbers& v) { return {v[4], v[3], v[1]}; }

CellRead read_matrix(const Numbers& v) {
  Eigen::Matrix3d matrix;
  matrix << v[0], v[1], v[3],  //
      v[1], v[2], v[4],        //
      v[3], v[4], v[5];
  if (matrix.allFinite() && matrix.llt().info() != Eigen::Success)
    return {std::nullopt, fmt::format("expected a shape matrix that is positive definite, found {:.6g}",
                                      fmt::join(v, ", "))};
  return read_cell(matrix);
}

CellRead read_cosines(const Numbers& v) { return read_cell_from_lengths(lengths_of(v), angles_of(v)); }

CellRead read_degrees(const Numbers& v) {
  const Eigen::Vector3d angles = angles_of(v);
  if (!(angles.minCoeff() > 0 && angles.maxCoeff() < 180))
    return {std::nullopt, fmt::format("expected angles from 0 to 180 degrees, found {:.6g}, {:.6g}, {:.6g}",
                                      angles[0], angles[1], angles[2])};
  return read_cell_from_angles(lengths_of(v), angles);
}

bool tells_nothing(const Numbers& v) {
  const Eigen::Vector3d lengths = lengths_of(v);
  return !std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); }) ||
         lengths.minCoeff() <= 1;
}

bool is_upright(const Numbers& v) {
  return angles_of(v).cwiseAbs().maxCoeff() <= 1e-6 * lengths_of(v).minCoeff();
}

bool names_any(std::string_view title, std::initializer_list<std::string_view> programs) {
  const std::string lower = lower_case(title);
  return std::any_of(programs.begin(), programs.end(),
                     [&](std::string_view program) { return lower.find(program) != std::string::npos; });
}

}  // namespace

DcdCellForm::DcdCellForm(int version, std::string_view title)
    : version_(version),
      by_charmm_(title.starts_with('*')),
      by_others_(names_any(title, {"namd", "lammps", "dcd plugin", "openmm", "mdtraj", "mdanalysis"})) {}

void DcdCellForm::look_at(const Numbers& v) {
  if (tells_nothing(v)) return;
  const Eigen::Vector3d angles = angles_of(v);
  const double largest = angles.cwiseAbs().maxCoeff();
  for (const double exact : {60.0, 90.0, 120.0})
    if ((angles.array() == exact).any() && read_degrees(v).cell) exact_angle_ = true;
  const bool as_written = angles.minCoeff() >= least_angle && angles.maxCoeff() <= 180 - least_angle;
  degrees_ = degrees_ && as_written && read_degrees(v).cell;
  if (is_upright(v)) return;
  cosines_ = cosines_ && largest < 1 && read_cosines(v).cell;
  matrix_ = matrix_ && read_matrix(v).cell;
}

CellRead DcdCellForm::read(const Numbers& v) const {
  const bool as_degrees = degrees_ && exact_angle_;
  const bool for_matrix = version_ >= 25 || (by_charmm_ && version_ >= 22);
  const bool no_matrix = !for_matrix && (by_others_ || version_ < 22);
  if (as_degrees) return read_degrees(v);
  if (matrix_ && for_matrix) return read_matrix(v);
  if (cosines_) return read_cosines(v);
  if (degrees_ && (!matrix_ || no_matrix)) return read_degrees(v);
  if (matrix_ && !degrees_ && !no_matrix) return read_matrix(v);
  if (lengths_of(v).allFinite() && lengths_of(v).minCoeff() >= 0 && lengths_of(v).maxCoeff() <= 1) return {};
  if (matrix_ && degrees_)
    return {std::nullopt, fmt::format("{:.6g} may be lengths and angles or a CHARMM shape matrix, and "
                                      "neither title nor version ({}) decides",
                                      fmt::join(v, ", "), version_)};
  return {
      std::nullopt,
      fmt::format("expected lengths and angles or, by version and title, a CHARMM shape matrix, found {:.6g} "
                  "(version {})",
                  fmt::join(v, ", "), version_)};
}

}  // namespace kds
