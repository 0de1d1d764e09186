#include "experiments/questions/question.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "experiments/output/text.h"
#include "experiments/reproduce/measurements.h"
#include "motions/models/model.h"
#include "motions/models/shapes.h"
#include "structures/collision/closest_pair.h"
#include "structures/collision/sphere_tree.h"

namespace kds {

namespace {

constexpr std::array<std::size_t, 5> kBlocks{4, 8, 16, 32, 64};
constexpr std::size_t kSubjects = 7;

struct Chain {
  std::string name;
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;
};

Chain model_chain(std::string name, std::string_view model, std::uint64_t seed,
                  std::optional<double> fill = {}) {
  constexpr std::size_t beads = 1024;
  const models::Settings settings{
      .beads = beads, .seed = seed, .motion = models::ShapeMotion::rest, .fill = fill};
  return {std::move(name), models::generate(*models::find_model(model), settings).front().frames.front(),
          std::vector<double>(beads, models::radius)};
}

Chain protein_chain(std::string name, const std::filesystem::path& data, std::string_view file,
                    std::string_view topology) {
  Subject subject = protein(data, file, topology);
  return {std::move(name), std::move(subject.frames.front()), std::move(subject.radii)};
}

Chain chain(std::size_t which, const std::filesystem::path& data, std::uint64_t seed) {
  switch (which) {
    case 0:
      return model_chain("helix", "helix", seed);
    case 1:
      return model_chain("scaling helix", "scaling-helix", seed);
    case 2:
      return model_chain("random chain, fill 0.02", "random-chain", seed, 0.02);
    case 3:
      return model_chain("random chain, fill 0.2", "random-chain", seed, 0.2);
    case 4:
      return protein_chain("villin", data, "trajectories/villin_hp36_300K.dcd",
                           "trajectories/villin_hp36_300K.pdb");
    case 5:
      return protein_chain("random protein", data, "trajectories/random100_400K_first200.dcd",
                           "trajectories/random100_400K.pdb");
    default:
      return protein_chain("1a4y", data, "paper/1a4y_AB.pdb", "");
  }
}

// The search of the paper's figure 6 for contacts of a necklace with itself, with one change. Two blocks of
// beads whose spheres meet are left to another method if they are farther apart along the chain than a block
// is long.
class Search {
 public:
  Search(std::span<const TreeSphere<3>> spheres, std::size_t block)
      : spheres_(spheres), block_(block), left_((spheres.empty() ? 0 : spheres.back().last) + 1, false) {}

  void visit(std::uint32_t a) {
    const TreeSphere<3>& node = spheres_[a];
    if (node.is_bead()) return;
    visit(node.left);
    visit(node.right);
    visit(node.left, node.right);
  }
  [[nodiscard]] double pairs() const { return static_cast<double>(pairs_); }
  [[nodiscard]] const std::vector<bool>& left() const { return left_; }

 private:
  // `a` comes before `b` along the chain.
  void visit(std::uint32_t a, std::uint32_t b) {
    const TreeSphere<3>&s = spheres_[a], &t = spheres_[b];
    if (t.last - s.first < 2) return;  // neighbours
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      square += (s.center[axis] - t.center[axis]) * (s.center[axis] - t.center[axis]);
    const double reach = s.radius + t.radius;
    if (square > reach * reach || (s.is_bead() && t.is_bead())) {
      ++pairs_;
      return;
    }
    if (s.bead_count() <= block_ && t.bead_count() <= block_ && t.first - s.last > block_) {
      for (BeadId bead = s.first; bead <= s.last; ++bead) left_[bead] = true;
      for (BeadId bead = t.first; bead <= t.last; ++bead) left_[bead] = true;
      return;
    }
    if (s.bead_count() >= t.bead_count()) {
      visit(s.left, b);
      visit(s.right, b);
    } else {
      visit(a, t.left);
      visit(a, t.right);
    }
  }

  std::span<const TreeSphere<3>> spheres_;
  std::size_t block_;
  std::uint64_t pairs_ = 0;
  std::vector<bool> left_;
};

// The numbers of pairs that decide whether some of these beads collide: edges of their diagram, and pairs of
// beads with a common neighbour along the chain. closest_pair.h proves that these pairs are necessary and
// sufficient. A pair that is named by a bead's centre, or found by a grid, stands for these pairs.
struct Named {
  double edges = 0, others = 0;
  [[nodiscard]] double sum() const { return edges + others; }
};

Named pairs_named(const Chain& chain, const std::vector<bool>& some) {
  std::vector<Eigen::Index> beads;
  std::vector<double> radii;
  std::vector<BeadId> of_chain;
  for (std::size_t bead = 0; bead < some.size(); ++bead) {
    if (!some[bead]) continue;
    beads.push_back(static_cast<Eigen::Index>(bead));
    radii.push_back(chain.radii[bead]);
    of_chain.push_back(static_cast<BeadId>(bead));
  }
  if (beads.size() < 2) return {};
  // Consecutive beads of this subset are neighbours only if they are neighbours in the chain.
  std::vector<BeadRange> pieces{{0, 0}};
  for (BeadId k = 1; k < of_chain.size(); ++k) {
    if (of_chain[k] == of_chain[k - 1] + 1)
      pieces.back().last = k;
    else
      pieces.push_back({k, k});
  }
  const PairsLookedAt pairs = closest_pair<3>(Eigen::Matrix3Xd(chain.centers(Eigen::all, beads)), radii,
                                              BeadPairs::along(beads.size(), pieces))
                                  .looked_at;
  return {static_cast<double>(pairs.edges),
          static_cast<double>(pairs.common_neighbors + pairs.centers + pairs.near)};
}

}  // namespace

std::size_t combination_steps() { return kSubjects; }

Question ask_about_combination(const std::filesystem::path& data, std::uint64_t seed,
                               const std::function<void()>& step_done) {
  Question question;
  question.name = "combination";
  question.title = "Are diagram and hierarchy together better than each alone?";
  question.columns = {{"block", "block, beads"},
                      {"left", "beads left, %"},
                      {"pairs", "pairs of spheres"},
                      {"edges", "edges of their diagram"},
                      {"others", "with a common neighbour"},
                      {"together", "together"},
                      {"hierarchy", "hierarchy alone"},
                      {"diagram", "diagram alone"},
                      {"gain", "better alone / together"}};
  question.x_label = "block, beads";
  question.y_label = "better alone / together";
  question.words =
      "The figures count the pairs that must be examined to decide whether a chain collides with itself. "
      "Hierarchy alone: the separating family of the wrapped hierarchy. Diagram alone: the edges of the "
      "power diagram of all beads that do not join neighbours along the chain, and the pairs of beads with a "
      "common neighbour, without which the edges do not decide (Theorem 3.5, which holds for any set of "
      "balls). A few pairs of a bead and the bead whose cell contains its centre are also counted. Together: "
      "the hierarchy is searched down to blocks of the given number of beads, and down to beads if two "
      "blocks are near along the chain. Beads in blocks that still meet other blocks are left to a power "
      "diagram of these beads alone. Above 1 the two together examine fewer pairs than the better of both "
      "alone.";
  std::vector<double> costs;
  for (std::size_t which = 0; which < kSubjects; ++which) {
    const Chain one = chain(which, data, seed);
    const std::vector<BeadRange> necklaces{{0, static_cast<BeadId>(one.radii.size() - 1)}};
    SphereTree<3> tree(Hierarchy::wrapped, necklaces);
    tree.build(Balls<3>(one.centers, one.radii));
    Search whole(tree.spheres(), 0);
    whole.visit(tree.roots().front());
    const double diagram = pairs_named(one, std::vector<bool>(one.radii.size(), true)).sum();
    const double alone = std::min(whole.pairs(), diagram);
    QuestionCurve gains{"", one.name, {}, {}};
    for (const std::size_t block : kBlocks) {
      Search search(tree.spheres(), block);
      search.visit(tree.roots().front());
      const auto left = static_cast<double>(std::count(search.left().begin(), search.left().end(), true));
      const Named named = pairs_named(one, search.left());
      const double together = search.pairs() + named.sum();
      question.rows.push_back(
          {one.name,
           {static_cast<double>(block), 100 * left / static_cast<double>(one.radii.size()), search.pairs(),
            named.edges, named.others, together, whole.pairs(), diagram, alone / together}});
      gains.points.emplace_back(static_cast<double>(block), alone / together);
    }
    const auto best =
        *std::ranges::max_element(gains.points, {}, [](const auto& point) { return point.second; });
    costs.push_back(1 / best.second);
    question.findings.push_back(fmt::format(
        "{}: hierarchy {}, diagram {} pairs; together at best {} times as many as the better of both alone "
        "(blocks of {}).",
        one.name, with_thousands(static_cast<std::uint64_t>(whole.pairs())),
        with_thousands(static_cast<std::uint64_t>(diagram)), short_decimal(1 / best.second), best.first));
    question.curves.push_back(std::move(gains));
    step_done();
  }
  const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
  question.answer = fmt::format(
      "Hierarchy and diagram together examine {} to {} times as many pairs as the better of both alone.",
      short_decimal(*least), short_decimal(*most));
  return question;
}

}  // namespace kds
