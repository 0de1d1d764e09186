// Beads that come, go and change course while the power diagram runs. After each edit, and between all
// events, audits compare with CGAL over the rationals and with the definition.

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "structures/power_diagram.h"
#include "tests/support/moving_beads.h"
#include "tests/support/random_motion.h"

namespace kds {
namespace {

using namespace test;
using testing::HasSubstr;

template <class M>
using Diagram = PowerDiagram<M, Filtered>;

enum class Scene { generic, weighted, grid, grid_at_rest, line };
constexpr std::array all_scenes{Scene::generic, Scene::weighted, Scene::grid, Scene::grid_at_rest,
                                Scene::line};

/// A curve whose numbers are short, so that it can be bent without rounding.
template <class M>
void set_curve(M& motion, BeadId b, Random& random, Scene scene) {
  const bool grid = scene == Scene::grid || scene == Scene::grid_at_rest;
  for (int axis = 0; axis < M::dimension; ++axis) {
    for (int k = 0; k <= M::degree; ++k) {
      double x = grid ? pick(random, -2, 2) : 0x1p-20 * pick(random, -(1 << 20), 1 << 20);
      if (k > 0 && scene == Scene::grid_at_rest) x = motion.coordinate(b, 0, axis);
      if (k > 0 && scene == Scene::weighted) x = motion.coordinate(b, 0, axis) + 0.25 * x;
      if (scene == Scene::line && axis > 0 && k == 0) x = 0;  // at the start only
      motion.set_coordinate(b, k, axis, x);
    }
  }
  for (int k = 0; k <= M::degree; ++k) {
    double w = 0;
    if (scene == Scene::weighted) w = 0x1p-20 * (random() % (random() % 4 == 0 ? 1U << 21U : 1U << 18U));
    motion.set_weight(b, k, w);
  }
}

/// Turns the bead's linear course at u, where it stays as it is.
template <class M>
void bend(M& motion, BeadId b, double u, Random& random) {
  for (int axis = 0; axis < M::dimension; ++axis) {
    const double d = 0x1p-10 * pick(random, -512, 512);
    motion.set_coordinate(b, 0, axis, motion.coordinate(b, 0, axis) + u * d);
    motion.set_coordinate(b, 1, axis, motion.coordinate(b, 1, axis) - (1 - u) * d);
  }
}

struct Totals {
  std::uint64_t inserts = 0, erases = 0, changes = 0, rebuilds = 0, hidden = 0, events = 0;
};

/// Edits at 16 times of each of two steps, one or a few at a time.
template <class M>
void run(unsigned seed, Scene scene, Totals& totals) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", scene " << static_cast<int>(scene));
  Random random(1000 * seed + static_cast<unsigned>(scene));
  const auto beads = static_cast<BeadId>(M::dimension + 8 + random() % 12);
  M motion(beads);
  for (BeadId b = 0; b < beads; ++b) set_curve(motion, b, random, scene);
  Simulator simulator(AuditMode::events);
  Diagram<M> diagram(simulator, motion);
  for (BeadId b = 0; b + M::dimension + 4 < beads; b += 2) diagram.leave_out(b);
  std::vector<BeadId> present;
  const auto count_present = [&] {
    present.clear();
    for (BeadId b = 0; b < beads; ++b) {
      if (!diagram.is_absent(b)) present.push_back(b);
    }
  };
  simulator.build();
  for (int step = 0; step < 2; ++step) {
    if (step == 1) {
      for (BeadId b = 0; b < beads; ++b) {
        for (int axis = 0; axis < M::dimension; ++axis) {
          const double x = motion.coordinate(b, 1, axis);
          motion.set_coordinate(b, 0, axis, x);
          motion.set_coordinate(
              b, 1, axis, x + (scene == Scene::grid ? pick(random, -1, 1) : 0x1p-8 * pick(random, -64, 64)));
        }
        motion.set_weight(b, 0, motion.weight(b, 1));
      }
    }
    simulator.enter_step();
    for (int sixteenth = 1; sixteenth < 16; ++sixteenth) {
      const double u = sixteenth / 16.0;
      for (unsigned k = 0; k < 1 + random() % 3; ++k) {
        simulator.run_until(Dyadic(u + 0x1p-12 * k));  // looks at the edit before
        count_present();
        const auto b = static_cast<BeadId>(random() % beads);
        if (diagram.is_absent(b)) {
          if (random() % 3 == 0) set_curve(motion, b, random, scene);
          diagram.insert(b, random() % 2 == 0 ? no_bead : present[random() % present.size()]);
        } else if (random() % 2 == 0 && present.size() > M::dimension + 3) {
          diagram.erase(b);
        } else if (k == 0 && random() % 2 == 0) {
          diagram.change_motion(b, [&] { bend(motion, b, u, random); });
        } else {
          diagram.change_motion(b, [&] { set_curve(motion, b, random, scene); });
        }
      }
    }
    simulator.leave_step(step == 1);
  }
  EXPECT_TRUE(books_balance(diagram.statistics));
  const auto& kinds = diagram.statistics.events_by_kind;
  totals.inserts += kinds[Diagram<M>::inserts];
  totals.erases += kinds[Diagram<M>::erases];
  totals.changes += kinds[Diagram<M>::changes];
  totals.hidden += kinds[Diagram<M>::hides] + kinds[Diagram<M>::shows];
  totals.rebuilds += diagram.statistics.rebuilds;
  for (const std::uint64_t events : diagram.statistics.events_per_step) totals.events += events;
}

template <class M>
void run_all(unsigned seeds) {
  for (const Scene scene : all_scenes) {
    Totals totals;
    for (unsigned seed = 0; seed < seeds && !testing::Test::HasFailure(); ++seed) {
      try {
        run<M>(seed, scene, totals);
      } catch (const InputError&) {  // all left in one plane, or on one line
        EXPECT_TRUE(scene == Scene::grid || scene == Scene::grid_at_rest);
      } catch (const std::exception& error) {
        FAIL() << "seed " << seed << ", scene " << static_cast<int>(scene) << ": " << error.what();
      }
    }
    std::cerr << static_cast<int>(scene) << ": " << totals.inserts << ' ' << totals.erases << ' '
              << totals.changes << ' ' << totals.rebuilds << ' ' << totals.hidden << ' ' << totals.events
              << '\n';
    EXPECT_GT(totals.inserts, 10 * seeds);
    EXPECT_GT(totals.erases, 10 * seeds);
    EXPECT_GT(totals.changes, 5 * seeds);
    if (scene == Scene::generic || scene == Scene::weighted) {
      EXPECT_EQ(totals.rebuilds, 0U);
    }
    if (scene == Scene::weighted) {
      EXPECT_GT(totals.hidden, seeds);
    }
  }
}

TEST(PowerDiagramEdits, InSpace) { run_all<Space>(12); }
TEST(PowerDiagramEdits, InThePlane) { run_all<BezierMotion<2, 1>>(12); }

}  // namespace
}  // namespace kds
