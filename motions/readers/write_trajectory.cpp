#include "motions/readers/write_trajectory.h"

#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <string>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

constexpr std::size_t kMostNumbered = 9999;  // four columns, for the numbers of residues and models

void put(std::ostream& stream, const std::string& text) {
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void check_counts(const Trajectory& trajectory, std::string_view file) {
  const auto check = [&](std::size_t count, std::string_view noun) {
    if (count > kMostNumbered)
      throw InputError(fmt::format("{}: {}, but a PDB file numbers at most {}; write XYZ (.xyz) instead",
                                   file, counted(count, noun), kMostNumbered));
  };
  check(trajectory.bead_count(), "bead");
  check(trajectory.frames.size(), "frame");
}

// Rounds to eight columns with three decimals.
double in_thousandths(double x, std::string_view file, std::size_t frame, Eigen::Index bead, char axis) {
  const double rounded = std::nearbyint(x * 1000);
  if (!(rounded >= -999999 && rounded <= 9999999))
    throw InputError(
        fmt::format("{}: frame {}, bead {}: {} = {} does not fit the columns of a PDB file, -999.999 to "
                    "9999.999; write XYZ (.xyz) instead",
                    file, frame, bead, axis, x));
  return rounded == 0 ? 0 : rounded / 1000;
}

}  // namespace

void write_xyz(std::ostream& stream, const Trajectory& trajectory, std::string_view about) {
  std::string text;
  for (const Eigen::Matrix3Xd& frame : trajectory.frames) {
    text = fmt::format("{}\n{}\n", frame.cols(), about);
    for (Eigen::Index bead = 0; bead < frame.cols(); ++bead)
      text += fmt::format("X {} {} {}\n", frame(0, bead), frame(1, bead), frame(2, bead));
    put(stream, text);
  }
}

void write_pdb(std::ostream& stream, const Trajectory& trajectory, std::string_view about) {
  constexpr std::size_t width = 70;  // width of a title line; the second and later lines are numbered
  for (std::size_t line = 0; line * width < about.size(); ++line)
    put(stream, fmt::format("TITLE   {:>2}{}\n", line == 0 ? "" : std::to_string(line + 1),
                            about.substr(line * width, width)));
  std::string text;
  for (std::size_t k = 0; k < trajectory.frames.size(); ++k) {
    const Eigen::Matrix3Xd& frame = trajectory.frames[k];
    text = fmt::format("MODEL     {:4}\n", k + 1);
    for (Eigen::Index bead = 0; bead < frame.cols(); ++bead)
      text += fmt::format("ATOM  {0:5}  CA  UNK A{0:4}    {1:8.3f}{2:8.3f}{3:8.3f}  1.00  0.00           C\n",
                          bead + 1, frame(0, bead), frame(1, bead), frame(2, bead));
    text += "TER\nENDMDL\n";
    put(stream, text);
  }
  put(stream, "END\n");
}

Trajectory as_in_pdb(const Trajectory& trajectory, std::string_view file) {
  check_counts(trajectory, file);
  Trajectory rounded = trajectory;
  for (std::size_t k = 0; k < rounded.frames.size(); ++k)
    for (Eigen::Index bead = 0; bead < rounded.frames[k].cols(); ++bead)
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        double& x = rounded.frames[k](axis, bead);
        x = in_thousandths(x, file, k, bead, "xyz"[axis]);
      }
  return rounded;
}

}  // namespace kds
