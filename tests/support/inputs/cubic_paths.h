#pragma once
// A chain whose beads move on cubic paths, as a LAMMPS dump with velocities.

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

namespace kds::test {

struct CubicPaths {
  std::size_t beads = 7;
  std::vector<double> times{0, 0.25, 1, 1.125, 1.5, 2, 2.5};  ///< in picoseconds
  double cell = 1e6;                                          ///< positions are wrapped into it
  double velocity_factor = 1;
  bool has_times = true;

  /// Returns the position of a bead, or its velocity (derivative 1).
  [[nodiscard]] Eigen::Vector3d position(std::size_t bead, double t, int derivative = 0) const {
    const double phase = 0.7 * static_cast<double>(bead);
    const Eigen::Vector3d a(1.5 * static_cast<double>(bead), std::cos(phase), std::sin(phase)), b(2, -1, 1),
        c(0.3 * std::sin(phase), 0.2, -0.4), d(0.1, -0.2 * std::cos(phase), 0.1);
    if (derivative == 0) return a + t * (b + t * (c + t * d));
    return b + t * (2 * c + 3 * t * d);
  }

  [[nodiscard]] std::string dump() const {
    std::string text;
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (k == 0) text += "ITEM: UNITS\nmetal\n";
      if (has_times) text += fmt::format("ITEM: TIME\n{}\n", times[k]);
      text += fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}\n", k, beads,
                          cell < 1e6 ? "pp pp pp" : "ff ff ff");
      for (int axis = 0; axis < 3; ++axis) text += fmt::format("0 {}\n", cell);
      text += "ITEM: ATOMS id x y z vx vy vz\n";
      for (std::size_t bead = 0; bead < beads; ++bead) {
        const Eigen::Vector3d at = position(bead, times[k]),
                              v = velocity_factor * position(bead, times[k], 1);
        text += fmt::format("{}", bead + 1);
        for (const double x : at)
          text += fmt::format(" {}", cell < 1e6 ? x - cell * std::floor(x / cell) : x);
        for (const double x : v) text += fmt::format(" {}", x);
        text += '\n';
      }
    }
    return text;
  }
};

}  // namespace kds::test
