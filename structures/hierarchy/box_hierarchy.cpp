#include "structures/hierarchy/box_hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <stdexcept>
#include <utility>

#include "kds/simulator.h"
#include "motions/base/require_index.h"
#include "structures/enclosing_sphere/integer_balls.h"
#include "structures/hierarchy/support_tables.h"
#include "structures/tournament/tournament.h"

namespace kds {

namespace {

/// The trees of all necklaces as the tree of a tournament: internal nodes with their numbers, then the beads.
class NodesAndBeads {
 public:
  static constexpr std::uint32_t none = 0xffffffffU;

  NodesAndBeads(const NecklaceTree& tree, const BottomUpOrder& order, std::span<const std::uint32_t> parents)
      : tree_(tree), order_(order), parents_(parents) {}

  [[nodiscard]] std::size_t end() const { return parents_.size(); }
  [[nodiscard]] std::uint32_t inner_end() const { return static_cast<std::uint32_t>(tree_.node_count()); }
  [[nodiscard]] std::ranges::iota_view<std::uint32_t, std::uint32_t> inner_nodes() const {
    return {0, inner_end()};
  }
  [[nodiscard]] std::uint32_t leaf(BeadId bead) const { return inner_end() + bead; }
  [[nodiscard]] std::uint32_t parent(std::uint32_t node) const { return parents_[node]; }
  [[nodiscard]] std::uint32_t left(std::uint32_t node) const {
    const NodeId child = tree_.left(node);
    return child == NecklaceTree::leaf ? leaf(tree_.range(node).first) : child;
  }
  [[nodiscard]] std::uint32_t right(std::uint32_t node) const {
    const NodeId child = tree_.right(node);
    return child == NecklaceTree::leaf ? leaf(tree_.range(node).last) : child;
  }
  template <class Visit>
  void each_level(Visit visit) const {
    for (const BottomUpOrder::Run& run : order_.runs())
      for (const BottomUpOrder::Group& group : order_.groups(run)) visit(order_.nodes(group));
  }

 private:
  const NecklaceTree& tree_;
  const BottomUpOrder& order_;
  std::span<const std::uint32_t> parents_;
};

struct ReachesAlong {
  SlabDirection direction;
  Reach operator()(BeadId ahead, BeadId behind) const { return {ahead, behind, direction}; }
};

constexpr std::array<IdRole, 4> node_side_was_is{
    {{"node", 2, IdRole::Of::node}, {"side", 1, IdRole::Of::number}, {"was"}, {"is"}}};
constexpr auto support_kinds = with_edits(std::array{EventKind{"support", true, false, node_side_was_is}});

/// All directions in the order of box_directions.
constexpr std::array<SlabDirection, 13> space_directions{{{{1, 0, 0}},
                                                          {{0, 1, 0}},
                                                          {{0, 0, 1}},
                                                          {{1, 1, 1}},
                                                          {{1, 1, -1}},
                                                          {{1, -1, 1}},
                                                          {{1, -1, -1}},
                                                          {{1, 1, 0}},
                                                          {{1, -1, 0}},
                                                          {{1, 0, 1}},
                                                          {{1, 0, -1}},
                                                          {{0, 1, 1}},
                                                          {{0, 1, -1}}}};
constexpr std::array<SlabDirection, 4> plane_directions{
    {{{1, 0, 0}}, {{0, 1, 0}}, {{1, 1, 0}}, {{1, -1, 0}}}};
constexpr std::array counts_in_space{3, 7, 13};
constexpr std::array counts_in_plane{2, 4};

/// The reach of a ball along a direction, in integers: along + radius |d|.
struct IntegerReach {
  Integer along, radius;
};

/// Compares two reaches along a direction with the given |d|^2: 1 if the first is further.
int compare_reaches(const IntegerReach& one, const IntegerReach& other, int square) {
  const Integer along = one.along - other.along, radius = one.radius - other.radius;
  const Integer norm = along * along - square * radius * radius;
  return sign_of_radical(sgn(along), sgn(radius), sgn(norm));
}

}  // namespace

template <int Dimension>
std::span<const int> box_direction_counts() {
  if constexpr (Dimension == 2) return counts_in_plane;
  return counts_in_space;
}
template std::span<const int> box_direction_counts<2>();
template std::span<const int> box_direction_counts<3>();

template <int Dimension>
std::vector<SlabDirection> box_directions(int count) {
  const std::span<const int> counts = box_direction_counts<Dimension>();
  if (std::find(counts.begin(), counts.end(), count) == counts.end())
    throw std::invalid_argument(fmt::format("boxes: {} directions; expected {} in {}", count,
                                            fmt::join(counts, " or "),
                                            Dimension == 2 ? "the plane" : "space"));
  const SlabDirection* const first = Dimension == 2 ? plane_directions.data() : space_directions.data();
  return {first, first + count};
}
template std::vector<SlabDirection> box_directions<2>(int);
template std::vector<SlabDirection> box_directions<3>(int);

/// The tournaments, one for each side. Places of certificates are node * sides + side.
template <int Dimension>
class BoxHierarchy<Dimension>::Contests {
 public:
  using OfSide = Tournament<ReachesAlong, NodesAndBeads, SupportTables<Dimension>>;

  explicit Contests(BoxHierarchy& boxes) {
    const NodesAndBeads tree(boxes.tree_, boxes.order_, boxes.parents_);
    const std::uint32_t sides = boxes.side_count();
    of_side.reserve(sides);
    for (std::uint32_t side = 0; side < sides; ++side)
      of_side.emplace_back(*boxes.tables_, ReachesAlong{boxes.outward(side)}, side, sides, tree);
  }

  std::vector<OfSide> of_side;
};

template <int Dimension>
BoxHierarchy<Dimension>::BoxHierarchy(Simulator& simulator, const MotionRef<Dimension>& motion,
                                      std::span<const BeadRange> necklaces, Radii radii, int directions,
                                      const NodeSelection& selection)
    : EditableBase(simulator, motion.bead_count(), "boxes", support_kinds),
      motion_(motion),
      radii_(radii),
      directions_(box_directions<Dimension>(directions)),
      tree_(necklaces),
      order_(tree_),
      keeps_(select_nodes(tree_, selection)),
      parents_(tree_.node_count() + motion.bead_count(), NodesAndBeads::none),
      tables_(std::make_unique<SupportTables<Dimension>>(simulator, *this, index(), motion, radii)),
      supports_(tree_.node_count() * side_count(), no_bead) {
  const NodesAndBeads tree(tree_, order_, parents_);
  for (NodeId node = 0; node < tree_.node_count(); ++node)
    parents_[tree.left(node)] = parents_[tree.right(node)] = node;
  contests_ = std::make_unique<Contests>(*this);
}

template <int Dimension>
BoxHierarchy<Dimension>::~BoxHierarchy() = default;

template <int Dimension>
bool BoxHierarchy<Dimension>::keeps(NodeId node) const {
  require_index("node", node, tree_.node_count());
  return keeps_[node] != 0;
}

template <int Dimension>
std::span<const BeadId> BoxHierarchy<Dimension>::supports(NodeId node) const {
  require_index("node", node, tree_.node_count());
  return std::span(supports_).subspan(std::size_t{node} * side_count(), side_count());
}

template <int Dimension>
SlabDirection BoxHierarchy<Dimension>::outward(std::uint32_t side) const {
  const SlabDirection& direction = directions_[side / 2];
  return side % 2 == 1 ? direction : direction.opposite();
}

template <int Dimension>
void BoxHierarchy<Dimension>::build() {
  present().structure_is_built();
  const NodesAndBeads tree(tree_, order_, parents_);
  std::vector<BeadId> further(tree.end());
  for (BeadId bead = 0; bead < bead_count(); ++bead)
    further[tree.leaf(bead)] = is_absent(bead) ? no_bead : bead;
  for (std::uint32_t side = 0; side < side_count(); ++side) {
    for (NodeId node = tree.inner_end(); node-- > 0;) {  // children before their parents
      const BeadId left = further[tree.left(node)], right = further[tree.right(node)];
      const auto is_right_further = [&] {  // beads on the left are less than those on the right
        return left == no_bead ||
               (right != no_bead && tables_->sign_at_start({right, left, outward(side)}) > 0);
      };
      further[node] = is_right_further() ? right : left;
      supports_[node * side_count() + side] = further[node];
    }
  }
}

template <int Dimension>
void BoxHierarchy<Dimension>::start_step() {
  CertificatesPerBead per_bead(statistics.certificates, bead_count());
  changed_.clear();
  risen_.clear();
  for (std::uint32_t side = 0; side < side_count(); ++side) {
    auto& contests = contests_->of_side[side];
    contests.start(static_cast<std::uint32_t>(bead_count()), present().absent());
    contests.each_contest([&](BeadId a, BeadId b) {
      per_bead.add(a);
      per_bead.add(b);
    });
    for (NodeId node = 0; node < tree_.node_count(); ++node) {
      const std::uint32_t place = node * side_count() + side;
      if (contests.winner(node) != supports_[place]) changed_.push_back(place);
    }
  }
  needs_after_batch = true;
}

// A bead takes part in the contests of the nodes above it, up to the first that it loses.
template <int Dimension>
std::uint64_t BoxHierarchy<Dimension>::certificates_of(BeadId bead) const {
  std::uint64_t named = 0;
  for (const auto& contests : contests_->of_side) {
    std::uint32_t child = static_cast<std::uint32_t>(tree_.node_count()) + bead;
    for (std::uint32_t node = parents_[child]; node != NodesAndBeads::none; node = parents_[child]) {
      if (contests.is_contested(node)) ++named;
      if (contests.winner(node) != bead) break;
      child = node;
    }
  }
  return named;
}

template <int Dimension>
void BoxHierarchy<Dimension>::count_certificates() {
  auto& most = statistics.certificates.per_bead_max;
  for (const BeadId bead : risen_) most = std::max(most, certificates_of(bead));
  risen_.clear();
}

template <int Dimension>
void BoxHierarchy<Dimension>::fail(unsigned table, std::uint32_t slot) {
  const std::uint32_t place = tables_->place_in_structure(table, slot), side = place % side_count();
  contests_->of_side[side].fail(place);
  look_from(place / side_count(), side);
  needs_after_batch = true;
}

template <int Dimension>
void BoxHierarchy<Dimension>::after_batch() {
  std::erase_if(changed_, [this](std::uint32_t place) {
    return contests_->of_side[place % side_count()].winner(place / side_count()) == supports_[place];
  });
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  for (const std::uint32_t place : changed_) {
    const NodeId node = place / side_count();
    const std::uint32_t side = place % side_count();
    const BeadId now = contests_->of_side[side].winner(node);
    const auto [first, last] = tree_.range(node);
    if (keeps_[node] != 0) record(support_changes, {first, last, side, supports_[place], now});
    supports_[place] = now;
    // Only a bead that becomes a support of a node enters another contest.
    if (follows_certificates_ && now != no_bead) risen_.push_back(now);
  }
  changed_.clear();
}

template <int Dimension>
void BoxHierarchy<Dimension>::apply(const Change& change) {
  if (apply_edit(change)) return;
  const auto [first, last, side, was, is] =
      std::array{change.ids[0], change.ids[1], change.ids[2], change.ids[3], change.ids[4]};
  const std::optional<NodeId> node = tree_.find({first, last});
  if (!node || side >= side_count()) throw std::invalid_argument("boxes: there is no such node or side");
  BeadId& support = supports_[std::size_t{*node} * side_count() + side];
  if (support != was) throw std::invalid_argument("boxes: the first bead is not the node's support");
  if (is != no_bead) {
    present().require(is, false);
    if (is < first || last < is) throw std::invalid_argument("boxes: the second bead is not below the node");
  }
  support = is;
}

// Edits: beads are inserted, erased, or change course.

template <int Dimension>
void BoxHierarchy<Dimension>::edit(std::uint8_t kind, BeadId bead) {
  record(kind, {bead});
  release({&bead, 1});
  present().set_absent(bead, kind == erases);
  for (auto& contests : contests_->of_side) contests.set_present(bead, kind == inserts);
  follow({&bead, 1});
}

template <int Dimension>
void BoxHierarchy<Dimension>::release(std::span<const BeadId> beads) {
  for (auto& contests : contests_->of_side)
    for (const BeadId bead : beads) contests.give_up(bead);
}

template <int Dimension>
void BoxHierarchy<Dimension>::follow(std::span<const BeadId> beads) {
  for (std::uint32_t side = 0; side < side_count(); ++side) {
    contests_->of_side[side].hold_again();
    for (const BeadId bead : beads) look_from(parents_[tree_.node_count() + bead], side);
  }
  if (follows_certificates_)
    for (BeadId bead = 0; bead < bead_count(); ++bead)
      if (!is_absent(bead)) risen_.push_back(bead);
  after_batch();
}

template <int Dimension>
void BoxHierarchy<Dimension>::look_from(std::uint32_t node, std::uint32_t side) {
  for (; node != NodesAndBeads::none; node = parents_[node]) changed_.push_back(node * side_count() + side);
}

template <int Dimension>
std::optional<std::string> BoxHierarchy<Dimension>::audit(const Dyadic& time) {
  const IntegerBalls<Dimension> whole = integer_balls_at(motion_.curves(), time);
  const NodesAndBeads tree(tree_, order_, parents_);
  std::vector<IntegerReach> reaches(bead_count());
  std::vector<BeadId> further(tree.end(), no_bead);
  for (std::uint32_t side = 0; side < side_count(); ++side) {
    const SlabDirection direction = outward(side);
    for (BeadId bead = 0; bead < bead_count(); ++bead) {
      if (is_absent(bead)) continue;
      IntegerReach& reach = reaches[bead];
      reach.along = 0;
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        reach.along += direction.steps[axis] * whole.balls[bead].center[axis];
      if (radii_ == Radii::any) reach.radius = whole.balls[bead].radius;
      further[tree.leaf(bead)] = bead;
    }
    for (NodeId node = tree.inner_end(); node-- > 0;) {
      const BeadId left = further[tree.left(node)], right = further[tree.right(node)];
      const bool is_right_further =
          left == no_bead ||
          (right != no_bead && compare_reaches(reaches[right], reaches[left], direction.square()) > 0);
      const BeadId furthest = further[node] = is_right_further ? right : left;
      if (keeps_[node] == 0) continue;
      const BeadId support = supports_[std::size_t{node} * side_count() + side];
      const auto [first, last] = tree_.range(node);
      if (support == no_bead ? furthest != no_bead : support < first || last < support || is_absent(support))
        return fmt::format("no bead of the node of beads {} to {} is its support at side {}", first, last,
                           side);
      if (furthest != no_bead && compare_reaches(reaches[furthest], reaches[support], direction.square()) > 0)
        return fmt::format(
            "bead {} reaches further than bead {}, the support at side {} of the node of beads {} to {}",
            furthest, support, side, first, last);
    }
  }
  return std::nullopt;
}

template class BoxHierarchy<2>;
template class BoxHierarchy<3>;

}  // namespace kds
