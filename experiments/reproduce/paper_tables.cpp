#include "experiments/reproduce/paper_tables.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "experiments/reproduce/measurements.h"

namespace kds {

namespace {

using Cells = std::vector<std::optional<double>>;  // the paper's values
using Measured = std::vector<PaperValue>;
using Shared = std::shared_ptr<const Subject>;

// Conformations of a model that several tables share.
struct Subjects {
  std::string name;
  Shared subject;
  std::size_t frame = 0;
  std::string at = {}, note = {};
};

std::optional<double> ratio(double a, double b) { return b > 0 ? std::optional(a / b) : std::nullopt; }

class Planner {
 public:
  Planner(std::filesystem::path data, std::size_t rounds) : data_(std::move(data)), rounds_(rounds) {}

  [[nodiscard]] PaperTablePlan construction() const;
  [[nodiscard]] PaperTablePlan verification() const;
  [[nodiscard]] PaperTablePlan self_collision() const;
  [[nodiscard]] PaperTablePlan self_collision_of_conformations() const;
  [[nodiscard]] PaperTablePlan maintenance() const;
  [[nodiscard]] PaperTablePlan stability() const;
  [[nodiscard]] PaperTablePlan two_spirals() const;

 private:
  [[nodiscard]] Subjects model(std::string name, std::string_view model, std::size_t beads) const {
    return {std::move(name), std::make_shared<Subject>(model_subject(model, beads))};
  }
  [[nodiscard]] Subjects grill() const { return model("grill", "grill", 89); }
  [[nodiscard]] Subjects inhibitor() const {
    return {"1a4yA0", std::make_shared<Subject>(protein(data_, "paper/1a4y_AB.pdb"))};
  }
  [[nodiscard]] Subjects other_protein() const {
    return {"1cem00", std::make_shared<Subject>(protein(data_, "paper/5h73.pdb")), 0, "",
            "5h73, another protein of 1089 beads, in place of 1cem"};
  }
  [[nodiscard]] Subjects helix(std::size_t beads) const {
    Subjects helix = model("static helix", "helix", beads);
    if (beads < 315) helix.note = "10 turns take 315 beads: these overlap";
    return helix;
  }
  [[nodiscard]] Shared villin() const {
    return std::make_shared<Subject>(
        protein(data_, "trajectories/villin_hp36_300K.dcd", "trajectories/villin_hp36_300K.pdb"));
  }
  [[nodiscard]] Shared random_protein() const {
    return std::make_shared<Subject>(
        protein(data_, "trajectories/random100_400K_first200.dcd", "trajectories/random100_400K.pdb"));
  }
  /// Returns the conformations of tables 1 and 4.
  [[nodiscard]] std::vector<Subjects> conformations() const {
    const Shared spiral = std::make_shared<Subject>(rolling_spiral(1000, 50));
    const Shared extended = std::make_shared<Subject>(protein(data_, "paper/villin_hp36_collapse.pdb"));
    const Shared folded = villin(), random = random_protein();
    const std::string spiral_note = "9 turns: 18 of 1000 beads would overlap";
    return {{"spiral", spiral, 0, "straight", "exactly straight, and so is its diagram"},
            {"spiral", spiral, 25, "half rolled", spiral_note},
            {"spiral", spiral, 49, "rolled", spiral_note},
            {"villin", extended, 0, "extended"},
            {"villin", folded, 0, "folded, frame 0"},
            {"villin", folded, 999, "folded, frame 999"},
            {"random protein", random, 0, "frame 0", "another random sequence"},
            {"random protein", random, 100, "frame 100", "another random sequence"},
            {"random protein", random, 199, "frame 199", "another random sequence"}};
  }

  template <class Measure>
  static void add(PaperTablePlan& plan, const Subjects& s, Cells paper, const Measure& measure) {
    plan.rows.emplace_back([s, paper = std::move(paper), measure]() -> PaperRow {
      return {s.name, s.subject->beads(), s.at, measure(s), paper, s.note};
    });
  }

  std::filesystem::path data_;
  std::size_t rounds_;
};

PaperTablePlan Planner::construction() const {
  PaperTablePlan plan;
  plan.table = {1,
                "Construction, and how tight cages are",
                {{"layered_per_wrapped", "layered / wrapped time", true},
                 {"power_per_wrapped", "diagram / wrapped time", true},
                 {"rho_avg", "average rho"},
                 {"rho_min", "least rho"}},
                {},
                "Times to build each structure once from scratch, the power diagram with CGAL. rho is the "
                "radius of the wrapped cage divided by that of the layered cage at a node. kds starts a node "
                "with the bases of its children, whereas the paper takes CGAL's sphere for each node. So the "
                "time of the diagram is a larger multiple of the wrapped hierarchy's time, and the time of "
                "the layered hierarchy, which uses vector lanes, a smaller one."};
  const auto row = [&](const Subjects& s, double wrapped, double layered, double rho_avg, double rho_min,
                       double power) {
    add(plan, s,
        {ratio(layered, wrapped), power > 0 ? ratio(power, wrapped) : std::nullopt, rho_avg, rho_min},
        [rounds = rounds_](const Subjects& of) -> Measured {
          const Construction c = construction_of(*of.subject, of.frame, rounds);
          return {c.layered_per_wrapped, c.power_per_wrapped, c.tightness.average, c.tightness.least};
        });
  };
  row(grill(), 0.24, 0.08, 0.98, 0.80, 3.2);
  row(inhibitor(), 5.00, 1.40, 0.92, 0.56, 270);
  row(other_protein(), 2.80, 1.10, 0.92, 0.54, 210);
  row(model("spline", "spline", 10), 0.02, 0.01, 0.97, 0.86, 0.1);
  row(model("spline", "spline", 50), 0.12, 0.05, 0.99, 0.81, 2.4);
  row(model("spline", "spline", 100), 0.25, 0.09, 1.00, 0.80, 9.3);
  row(helix(10), 0.03, 0.01, 0.89, 0.70, 0);
  row(helix(640), 2.00, 0.60, 0.98, 0.46, 310);
  row(helix(10240), 35.00, 9.10, 1.00, 0.45, 8.8e4);
  row(model("scaling helix", "scaling-helix", 10), 0.03, 0.01, 0.93, 0.61, 0.1);
  row(model("scaling helix", "scaling-helix", 640), 2.10, 0.60, 0.98, 0.46, 220);
  row(model("scaling helix", "scaling-helix", 10240), 38.00, 9.00, 0.99, 0.45, 1.8e4);
  const std::vector<Subjects> c = conformations();
  row(c[0], 2.80, 1.00, 1.00, 1.00, 2.6);
  row(c[1], 3.00, 1.00, 0.99, 0.50, 350);
  row(c[2], 2.90, 0.90, 1.00, 0.50, 243);
  row(c[3], 0.27, 0.10, 0.97, 0.83, 9.8);
  row(c[4], 0.29, 0.10, 0.93, 0.63, 9.0);
  row(c[5], 0.31, 0.10, 0.93, 0.63, 10.1);
  row(c[6], 0.81, 0.27, 0.97, 0.83, 41);
  row(c[7], 0.83, 0.27, 0.95, 0.70, 29);
  row(c[8], 0.85, 0.27, 0.94, 0.68, 41);
  return plan;
}

PaperTablePlan Planner::verification() const {
  PaperTablePlan plan;
  plan.table = {2,
                "Verifying the wrapped hierarchy",
                {{"lazy_per_naive", "lazy / naive time", true},
                 {"cascade_per_naive", "cascade / naive time", true},
                 {"cascade_tests_per_naive", "cascade / naive tests"},
                 {"frontier", "average frontier"}},
                {},
                "Each model at rest. Naive tests every bead of every node, eight at a time in vector lanes; "
                "the paper tests beads one by one, so a ratio to naive is larger here. The cascade tests "
                "cages first and starts from its last frontier: the cages and beads at which it ended, "
                "without those of the basis. Lazy trusts the old bases."};
  const auto row = [&](const Subjects& s, double lazy, double cascade, double naive, double frontier) {
    add(plan, s, {ratio(lazy, naive), ratio(cascade, naive), std::nullopt, frontier},
        [rounds = rounds_](const Subjects& of) -> Measured {
          const Step step = step_of(*of.subject, of.frame, of.frame, rounds);
          return {step.lazy_per_naive, step.cascade_per_naive, step.cascade_tests / step.naive_tests,
                  step.frontier};
        });
  };
  row(model("spline", "spline", 10), 0.005, 0.031, 0.028, 1.5);
  row(model("spline", "spline", 100), 0.04, 0.31, 0.34, 3.0);
  Subjects long_spline = model("spline", "spline", 1000);
  long_spline.note = "the paper's 4.00 ms of lazy is as long as that of 10,240 beads, and perhaps 0.40";
  row(long_spline, 4.00, 3.10, 4.60, 2.0);
  row(helix(10), 0.01, 0.03, 0.03, 2.0);
  row(helix(10240), 4.00, 54.00, 51.00, 4.0);
  row(inhibitor(), 0.61, 6.00, 6.40, 2.8);
  row(other_protein(), 0.53, 4.60, 4.90, 2.7);
  row(grill(), 0.04, 0.31, 0.33, 2.5);
  return plan;
}

std::vector<PaperColumn> collision_columns() {
  return {{"quadratic_per_wrapped", "quadratic / wrapped time", true},
          {"layered_per_wrapped", "layered / wrapped time", true},
          {"wrapped_pairs", "wrapped separating set"},
          {"layered_pairs", "layered separating set"},
          {"edges", "diagram edges"}};
}

constexpr const char* kCollisionWords =
    "Collisions of beads that are not neighbours along the chain. Quadratic tests all pairs, eight at a time "
    "in vector lanes; the paper tests pairs one by one. The searches split the node with more beads, and "
    "their hierarchies are already built. The separating sets of kds have each pair of beads in exactly one "
    "pair of nodes, also pairs at a distance of two along the chain. The paper does not say which pairs its "
    "sets leave out (for its proteins, a set has twice as many pairs as there are beads, less one).";

// Returns the cells of tables 3 and 4 from the paper's microseconds and counts.
Cells collision_cells(double quadratic, double wrapped, double wrapped_pairs, double layered,
                      double layered_pairs, double edges) {
  return {ratio(quadratic, wrapped), ratio(layered, wrapped), wrapped_pairs, layered_pairs, edges};
}

Measured measured_collision(const Subjects& of, std::size_t rounds) {
  const SelfCollision s = self_collision_of(*of.subject, of.frame, rounds);
  return {s.quadratic_per_wrapped, s.layered_per_wrapped, static_cast<double>(s.wrapped_pairs),
          static_cast<double>(s.layered_pairs), static_cast<double>(s.edges)};
}

PaperTablePlan Planner::self_collision() const {
  PaperTablePlan plan;
  plan.table = {3, "Detecting self-collision", collision_columns(), {}, kCollisionWords};
  const auto row = [&](const Subjects& s, const Cells& paper) {
    add(plan, s, paper, [rounds = rounds_](const Subjects& of) { return measured_collision(of, rounds); });
  };
  row(grill(), collision_cells(410, 70, 293, 71, 291, 264));
  Subjects first = inhibitor();
  first.note = "the paper's 6300 us of all pairs is a tenth of its own for fewer beads, and perhaps 63000";
  row(first, collision_cells(6300, 770, 2759, 950, 2759, 8500));
  row(other_protein(), collision_cells(63000, 530, 2177, 700, 2177, 8600));
  row(model("spline", "spline", 10), collision_cells(10, 2, 9, 2, 9, 27));
  row(model("spline", "spline", 50), collision_cells(130, 13, 52, 13, 52, 147));
  row(model("spline", "spline", 100), collision_cells(540, 26, 103, 26, 101, 297));
  row(helix(10), collision_cells(10, 7, 27, 7, 27, 40));
  row(helix(640), collision_cells(21000, 360, 1500, 360, 1500, 57000));
  row(helix(10240), collision_cells(5.6e6, 3000, 11000, 3000, 11000, 2.0e6));
  row(model("scaling helix", "scaling-helix", 10), collision_cells(100, 3, 11, 3, 11, 55));
  row(model("scaling helix", "scaling-helix", 640), collision_cells(3.1e5, 450, 1500, 450, 1500, 45000));
  row(model("scaling helix", "scaling-helix", 10240),
      collision_cells(5.6e6, 11000, 4.7e4, 11000, 4.7e4, 5.6e5));
  return plan;
}

PaperTablePlan Planner::self_collision_of_conformations() const {
  PaperTablePlan plan;
  plan.table = {
      4, "Detecting self-collision while the necklace deforms", collision_columns(), {}, kCollisionWords};
  const std::vector<Subjects> c = conformations();
  const std::vector<Cells> paper{
      collision_cells(53000, 240, 1000, 250, 1000, 3000), collision_cells(53000, 720, 2400, 740, 2400, 3000),
      collision_cells(53000, 280, 6400, 270, 7200, 3000), collision_cells(610, 28, 110, 28, 110, 731),
      collision_cells(620, 31, 120, 38, 150, 719),        collision_cells(620, 35, 140, 38, 150, 708),
      collision_cells(480, 76, 310, 78, 315, 2200),       collision_cells(470, 83, 600, 100, 600, 2100),
      collision_cells(490, 93, 380, 106, 420, 2000)};
  for (std::size_t i = 0; i < paper.size(); ++i)
    add(plan, c[i], paper[i],
        [rounds = rounds_](const Subjects& of) { return measured_collision(of, rounds); });
  return plan;
}

PaperTablePlan Planner::maintenance() const {
  PaperTablePlan plan;
  plan.table = {
      5,
      "Changes from frame to frame, and updating the wrapped hierarchy",
      {{"cells_changed", "cells changed"},
       {"bases_changed", "bases changed"},
       {"lazy_per_naive", "lazy / naive time", true},
       {"cascade_per_naive", "cascade / naive time", true},
       {"cascade_tests_per_naive", "cascade / naive tests"}},
      {},
      "Between two consecutive frames: cells of the later diagram that are not in the earlier one, and nodes "
      "with another basis. The paper does not say which frames its rows show, nor whether cells that vanish "
      "are counted. Naive uses vector lanes here, so ratios to naive are larger."};
  const auto row = [&](const Subjects& s, double cells, double bases, double lazy, double cascade,
                       double naive) {
    add(plan, s, {cells, bases, ratio(lazy, naive), ratio(cascade, naive), std::nullopt},
        [rounds = rounds_](const Subjects& of) -> Measured {
          const Step step = step_of(*of.subject, of.frame, of.frame + 1, rounds);
          return {static_cast<double>(step.cells_changed), static_cast<double>(step.bases_changed),
                  step.lazy_per_naive, step.cascade_per_naive, step.cascade_tests / step.naive_tests};
        });
  };
  const auto at = [](std::string name, const Shared& subject, std::size_t frame, std::string note = "") {
    return Subjects{std::move(name), subject, frame, fmt::format("frame {}", frame), std::move(note)};
  };
  const Shared spiral = std::make_shared<Subject>(rolling_spiral(1000, 50));
  const std::string nine = "9 turns, not 16; in the plane";
  row(at("spiral", spiral, 0, nine), 16, 0, 0.69, 1.7, 2.0);
  row(at("spiral", spiral, 12, nine), 1100, 9, 0.73, 2.0, 2.3);
  row(at("spiral", spiral, 24, nine), 1400, 16, 0.72, 2.0, 2.2);
  row(at("spiral", spiral, 36, nine), 1614, 26, 0.72, 2.0, 2.1);
  row(at("spiral", spiral, 48, nine), 1800, 43, 0.73, 2.1, 2.2);
  const Shared folded = villin();
  row(at("villin", folded, 0), 172, 0, 0.08, 0.20, 0.2);
  row(at("villin", folded, 200), 125, 4, 0.08, 0.21, 0.2);
  row(at("villin", folded, 400), 135, 4, 0.08, 0.21, 0.2);
  row(at("villin", folded, 600), 130, 4, 0.08, 0.23, 0.2);
  row(at("villin", folded, 800), 155, 4, 0.08, 0.22, 0.2);
  row(at("villin", folded, 998), 136, 6, 0.08, 0.24, 0.2);
  const Shared random = random_protein();
  const std::string other = "another random sequence";
  row(at("random protein", random, 0, other), 611, 0, 0.22, 0.60, 0.6);
  row(at("random protein", random, 40, other), 428, 4, 0.21, 0.66, 0.6);
  row(at("random protein", random, 80, other), 461, 11, 0.22, 0.66, 0.6);
  row(at("random protein", random, 120, other), 436, 7, 0.22, 0.63, 0.6);
  row(at("random protein", random, 160, other), 438, 11, 0.22, 0.66, 0.6);
  row(at("random protein", random, 198, other), 480, 11, 0.22, 0.63, 0.6);
  return plan;
}

PaperTablePlan Planner::stability() const {
  PaperTablePlan plan;
  plan.table = {6,
                "Changes over several frames",
                {{"bases_changed", "bases changed"},
                 {"cells_changed", "cells changed"},
                 {"lazy_per_naive", "lazy / naive time", true},
                 {"cascade_per_naive", "cascade / naive time", true},
                 {"cascade_tests_per_naive", "cascade / naive tests"}},
                {},
                "The random protein from frame 900 on, counted as in table 5, at frames that are the given "
                "number apart."};
  const Shared random = std::make_shared<Subject>(
      protein(data_, "paper/random100_400K_900to932.dcd", "trajectories/random100_400K.pdb"));
  const auto row = [&](std::size_t frames, double bases, double lazy, double cascade, double naive,
                       double cells) {
    const Subjects s{"random protein", random, frames, fmt::format("{} frames", frames),
                     "another random sequence"};
    add(plan, s, {bases, cells, ratio(lazy, naive), ratio(cascade, naive), std::nullopt},
        [rounds = rounds_](const Subjects& of) -> Measured {
          const Step step = step_of(*of.subject, 0, of.frame, rounds);
          return {static_cast<double>(step.bases_changed), static_cast<double>(step.cells_changed),
                  step.lazy_per_naive, step.cascade_per_naive, step.cascade_tests / step.naive_tests};
        });
  };
  row(2, 15, 0.22, 0.66, 0.62, 608);
  row(4, 12, 0.22, 0.63, 0.61, 869);
  row(8, 16, 0.22, 0.66, 0.63, 974);
  row(16, 15, 0.22, 0.65, 0.63, 1090);
  row(32, 14, 0.22, 0.66, 0.63, 1238);
  return plan;
}

PaperTablePlan Planner::two_spirals() const {
  PaperTablePlan plan;
  plan.table = {7,
                "Collision between two rolling spirals",
                {{"layered_pairs", "layered separating set"},
                 {"wrapped_pairs", "wrapped separating set"},
                 {"lazy_per_full", "lazy / full time", true},
                 {"layered_per_full", "layered / full time", true},
                 {"frontier", "average frontier"}},
                {},
                "Two chains of 1000 beads roll up in 1000 frames, one above the other, while the distance of "
                "their planes falls from 1.5 chain lengths to 1.05 diameters. The paper does not say how its "
                "chains lie. Each time is that of an update of the hierarchy from the previous frame and a "
                "search: full verifies all nodes by the cascade, lazy recomputes the cages that the search "
                "visits, layered builds all cages anew."};
  constexpr std::size_t frames = 1001;
  const Shared spirals = std::make_shared<Subject>(two_rolling_spirals(1000, frames));
  const auto row = [&](std::size_t frame, std::string at, double layered_pairs, double layered,
                       double wrapped_pairs, double lazy, double full, double frontier) {
    const Subjects s{"two spirals", spirals, frame, std::move(at), "9 turns each"};
    add(plan, s, {layered_pairs, wrapped_pairs, ratio(lazy, full), ratio(layered, full), frontier},
        [rounds = rounds_](const Subjects& of) -> Measured {
          const CollisionBetween c = collision_between(*of.subject, of.frame - 1, of.frame, rounds);
          return {static_cast<double>(c.layered_pairs), static_cast<double>(c.wrapped_pairs), c.lazy_per_full,
                  c.layered_per_full, c.frontier};
        });
  };
  row(1, "straight", 6, 0.9, 6, 0.006, 0.7, 1.7);
  row(500, "half rolled", 6, 1.0, 5, 0.006, 0.6, 2.1);
  row(900, "nine tenths", 6, 1.0, 6, 0.01, 0.7, 2.3);
  row(992, "rolled, near", 2400, 2.0, 1600, 1.0, 2.0, 2.7);
  row(1000, "almost touching", 3700, 2.1, 2300, 2.0, 2.0, 3.0);
  return plan;
}

}  // namespace

PaperTablePlan plan_paper_table(int number, const std::filesystem::path& data, std::size_t rounds) {
  const Planner planner(data, rounds);
  switch (number) {
    case 1:
      return planner.construction();
    case 2:
      return planner.verification();
    case 3:
      return planner.self_collision();
    case 4:
      return planner.self_collision_of_conformations();
    case 5:
      return planner.maintenance();
    case 6:
      return planner.stability();
    case 7:
      return planner.two_spirals();
    default:
      throw std::invalid_argument(fmt::format("the paper has no table {}", number));
  }
}

}  // namespace kds
