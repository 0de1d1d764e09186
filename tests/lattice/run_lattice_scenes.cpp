#include "tests/lattice/run_lattice_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "motions/base/input_error.h"
#include "motions/curves/positions.h"
#include "structures/power_diagram/power_diagram.h"
#include "tests/support/inputs/lattice_scenes.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::test {

namespace {

/// Computes a determinant by cofactors: slow, and shares no code with the product.
template <std::size_t N>
Rational determinant(const std::array<std::array<Rational, N>, N>& rows) {
  if constexpr (N == 1) {
    return rows[0][0];
  } else {
    Rational sum = 0;
    for (std::size_t column = 0; column < N; ++column) {
      std::array<std::array<Rational, N - 1>, N - 1> minor;
      for (std::size_t r = 1; r < N; ++r) {
        for (std::size_t c = 0, to = 0; c < N; ++c)
          if (c != column) minor[r - 1][to++] = rows[r][c];
      }
      const Rational term = rows[0][column] * determinant<N - 1>(minor);
      sum = column % 2 == 0 ? Rational(sum + term) : Rational(sum - term);
    }
    return sum;
  }
}

/// Coordinates, then the height over the paraboloid: squared length minus weight.
template <int Dimension>
using Lifted = std::array<Rational, Dimension + 1>;

/// Explains what is wrong with the cells of a plane diagram by the definition, or returns nothing: no bead
/// lies inside a cell's power circle, and three beads are a cell if all others are strictly outside their
/// power circle.
std::optional<std::string> not_the_regular_one(const std::vector<Lifted<2>>& points,
                                               const std::vector<CellBeads<2>>& cells) {
  const auto beads = static_cast<BeadId>(points.size());
  const auto minus = [](const Lifted<2>& a, const Lifted<2>& b) {
    return std::array<Rational, 3>{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  for (BeadId a = 0; a < beads; ++a) {
    for (BeadId b = a + 1; b < beads; ++b) {
      for (BeadId c = b + 1; c < beads; ++c) {
        const auto ab = minus(points[b], points[a]), ac = minus(points[c], points[a]);
        const Rational turn = ab[0] * ac[1] - ab[1] * ac[0];
        const bool is_cell = std::find(cells.begin(), cells.end(), CellBeads<2>{a, b, c}) != cells.end();
        if (turn == 0) {
          if (is_cell) return fmt::format("cell {} {} {} is flat", a, b, c);
          continue;
        }
        bool all_outside = true, none_inside = true;
        for (BeadId d = 0; d < beads; ++d) {
          if (d == a || d == b || d == c) continue;
          const Rational above = determinant<3>({ab, ac, minus(points[d], points[a])}) * turn;
          all_outside = all_outside && above > 0;
          none_inside = none_inside && above >= 0;
        }
        if (is_cell && !none_inside) return fmt::format("cell {} {} {} is not regular", a, b, c);
        if (!is_cell && all_outside) return fmt::format("cell {} {} {} is missing", a, b, c);
      }
    }
  }
  return std::nullopt;
}

/// Returns a moment later than `time`. Cells may be flat at a single moment without an event.
Dyadic just_after(const Dyadic& time) { return {(time.numerator() << 100U) + 1, time.exponent() + 100}; }

template <int Dimension, int Degree>
class LatticeRun {
 public:
  using Motion = BezierMotion<Dimension, Degree>;

  LatticeRun(std::uint32_t seed, LatticeScene kind)
      : random_(seed), motion_(lattice_scene<Dimension, Degree>(random_, kind)) {}

  void run(LatticeCounts& counts) {
    const bool edits = detail::whole_number(random_, 0, 3) == 0;
    Simulator simulator(AuditMode::events);
    PowerDiagram<Dimension> diagram(simulator, motion_);
    Witness witness(simulator, [&](const Dyadic& time) { return look(diagram, time, edits); });
    ++counts.scenes;
    try {
      simulator.build();
      if (edits) {
        simulator.enter_step();
        while (simulator.run_next()) edit(simulator, diagram);
        simulator.leave_step();
        ++counts.edited;
      } else {
        simulator.run_step();
      }
      simulator.finish();
    } catch (const InputError& error) {
      if (std::string(error.what()).find("stay") == std::string::npos) throw;
      ++counts.refused;
    }
    for (const std::uint64_t events : diagram.statistics.events_per_step) counts.events += events;
    if (diagram.statistics.rebuilds > 0) ++counts.rebuilt;
  }

 private:
  std::optional<std::string> look(const PowerDiagram<Dimension>& diagram, const Dyadic& time,
                                  bool edits) const {
    if constexpr (Dimension == 2) {
      if (edits || time == Dyadic(0.0) || time == Dyadic(1.0) || motion_.bead_count() > 7)
        return std::nullopt;
      const Dyadic later = just_after(time);
      std::vector<Lifted<2>> points;
      for (BeadId b = 0; b < motion_.bead_count(); ++b) {
        const auto p = exact_position(motion_, b, later);
        points.push_back({p[0], p[1], Rational(p[0] * p[0] + p[1] * p[1] - p[2])});
      }
      return not_the_regular_one(points, diagram.at_frame(false).cells);
    } else {
      return std::nullopt;
    }
  }

  void edit(Simulator& simulator, PowerDiagram<Dimension>& diagram) {
    const auto bead = static_cast<BeadId>(random_() % motion_.bead_count());
    const unsigned what = random_() % 4;
    try {
      if (what == 0 && !diagram.is_absent(bead)) {
        diagram.erase(bead);
      } else if (what == 1 && diagram.is_absent(bead)) {
        diagram.insert(bead);
      } else if (what == 2) {
        simulator.change_motion(std::array{bead}, [&] { bend(bead); });
      } else if (what == 3) {
        const auto other = static_cast<BeadId>(random_() % motion_.bead_count());
        if (other == bead) return;
        simulator.change_motion(std::array{bead, other}, [&] {
          bend(bead);
          bend(other);
        });
      }
    } catch (const std::invalid_argument&) {  // too few beads would remain, or they would all stay flat
    }
  }

  /// Gives the bead another course through the same point. The point is that of u = 1/2, so at other times
  /// the bead jumps.
  void bend(BeadId bead) {
    for (int axis = 0; axis < Dimension; ++axis) {
      const int by = detail::whole_number(random_, -1, 1);
      for (int k = 0; k <= Degree; ++k)
        motion_.set_coordinate(bead, k, axis,
                               motion_.coordinate(bead, k, axis) + ((Degree - k) % 2 == 0 ? by : -by));
    }
  }

  std::mt19937 random_;
  Motion motion_;
};

template <int Dimension, int Degree>
std::optional<std::string> run_one(std::uint32_t seed, LatticeScene kind, LatticeCounts& counts) {
  try {
    LatticeRun<Dimension, Degree>(seed, kind).run(counts);
  } catch (const std::exception& error) {
    return fmt::format("dimension {}, degree {}, kind {}, seed {}: {}", Dimension, Degree,
                       static_cast<int>(kind), seed, error.what());
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> run_lattice_scenes(std::uint32_t seed, LatticeCounts& counts) {
  for (int kind = 0; kind < lattice_scene_kinds; ++kind) {
    const auto scene = static_cast<LatticeScene>(kind);
    for (const auto run :
         {run_one<2, 1>, run_one<2, 2>, run_one<2, 3>, run_one<3, 1>, run_one<3, 2>, run_one<3, 3>}) {
      if (auto failure = run(seed, scene, counts)) return failure;
    }
  }
  return std::nullopt;
}

}  // namespace kds::test
