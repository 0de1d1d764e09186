#include "structures/spanner/spanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "motions/base/input_error.h"
#include "motions/curves/positions.h"

namespace kds {

namespace {

constexpr std::array<IdRole, 2> edge_roles{{{"first"}, {"second"}}};
constexpr std::array<IdRole, 3> centre_roles{{{"bead"}, {"parent"}, {"level", 1, IdRole::Of::number}}};
constexpr std::array<IdRole, 3> scaled_edge_roles{{{"first"}, {"second"}, {"level", 1, IdRole::Of::number}}};
constexpr auto spanner_kinds = with_edits(
    std::array{EventKind{"join", true, false, edge_roles}, EventKind{"part", true, false, edge_roles},
               EventKind{"rise", true, false, centre_roles}, EventKind{"fall", true, false, centre_roles},
               EventKind{"adopt", true, false, centre_roles},
               EventKind{"rescale", false, false, scaled_edge_roles}},
    centre_roles);
static_assert(spanner_kinds.size() == Spanner<2>::changes + 1);

double reach_of(double stretch) {
  if (!(stretch > 1) || !std::isfinite(stretch))
    throw std::invalid_argument("spanner: the stretch must be a number above 1");
  return std::nextafter(4 + 16 / (stretch - 1), std::numeric_limits<double>::infinity());
}

}  // namespace

template <int D>
Spanner<D>::Spanner(Simulator& simulator, const MotionRef<D>& motion, double stretch)
    : EditableBase(simulator, motion.bead_count(), "spanner", spanner_kinds),
      motion_(motion),
      reach_(reach_of(stretch)),
      nodes_(motion.bead_count()),
      named_(motion.bead_count()) {}

template <int D>
std::vector<BeadPair> Spanner<D>::edges() const {
  std::vector<BeadPair> all;
  for (const auto& [key, pair] : pairs_)
    if (pair.is_joined()) all.push_back({pair.beads[0], pair.beads[1]});
  std::sort(all.begin(), all.end());
  return all;
}

template <int D>
std::vector<typename Spanner<D>::Centre> Spanner<D>::centres() const {
  std::vector<Centre> all;
  for (const BeadId bead : present().all())
    all.push_back({bead, nodes_[bead].parent, static_cast<BeadId>(nodes_[bead].top)});
  return all;
}

// Tables, signs and certificates.

template <int D>
typename Spanner<D>::Table& Spanner<D>::table(Length length, int level) {
  const auto number = 2 * static_cast<std::size_t>(level) + (length == Length::scale ? 1 : 0);
  if (number >= tables_.size() || !tables_[number]) {
    auto made = std::make_unique<Table>(simulator(), *this, index(), static_cast<unsigned>(number), motion_);
    tables_.resize(std::max(tables_.size(), number + 1));
    tables_[number] = std::move(made);
    set_constants(number);
  }
  return *tables_[number];
}

template <int D>
void Spanner<D>::set_constants(std::size_t table) {
  const double length = std::ldexp((table % 2 == 0 ? reach_ : 1) * unit_, static_cast<int>(table / 2));
  if (!std::isfinite(length))
    throw InputError("spanner: its lengths exceed the largest double; scale the coordinates down");
  tables_[table]->set_constants({.length = length});
}

template <int D>
int Spanner<D>::sign(Length length, int level, BeadId a, BeadId b) {
  const auto& search = table(length, level).search();
  const DistanceBeyond beyond({a, b}, 1);
  if (building_) return search.sign_now(simulator().kernel(), beyond, Instant(0.0), statistics.stages);
  return search.sign_just_after(simulator().kernel(), beyond, simulator().now(), statistics.stages);
}

template <int D>
bool Spanner<D>::hold(Guard& guard, Length length, int level, std::array<BeadId, 2> beads, int wanted) {
  if (guard.handle != none) return true;
  if (building_) return wanted * sign(length, level, beads[0], beads[1]) >= 0;
  if (gathering_) {
    const auto place = static_cast<std::uint32_t>(gathered_.size());
    table(length, level).one_of_many(place, KnownAtStart::unknown) = {beads, wanted};
    gathered_.push_back({&guard, {none, length, level}, beads});
    return true;
  }
  const bool is_negated = failed_ && *failed_ == Failed{length, level, key_of(beads[0], beads[1]), -wanted};
  const KnownAtStart birth = is_negated ? KnownAtStart::at_own_root : KnownAtStart::unknown;
  keep(guard, {table(length, level).watch({beads, wanted}, 0, birth), length, level}, beads);
  return guard.handle != none;
}

template <int D>
void Spanner<D>::keep(Guard& guard, const Guard& made, const std::array<BeadId, 2>& beads) {
  guard = made;
  if (guard.handle == none) return;
  std::uint64_t& most = statistics.certificates.per_bead_max;
  for (const BeadId bead : beads) most = std::max<std::uint64_t>(most, ++named_[bead]);
}

template <int D>
void Spanner<D>::drop(Guard& guard, const std::array<BeadId, 2>& beads) {
  if (guard.handle == none) return;
  table(guard.length, guard.level).drop(guard.handle);
  forget(guard, beads);
}

template <int D>
void Spanner<D>::forget(Guard& guard, const std::array<BeadId, 2>& beads) {
  guard.handle = none;
  for (const BeadId bead : beads) --named_[bead];
}

// The hierarchy.

template <int D>
typename Spanner<D>::Pair* Spanner<D>::find(BeadId a, BeadId b) {
  const auto found = pairs_.find(key_of(a, b));
  return found == pairs_.end() ? nullptr : &found->second;
}

template <int D>
BeadId Spanner<D>::ancestor(BeadId bead, int level) const {
  while (nodes_[bead].top < level) bead = nodes_[bead].parent;
  return bead;
}

template <int D>
std::vector<BeadId> Spanner<D>::joined_with(BeadId centre, int level) const {
  std::vector<BeadId> all{centre};
  for (const Pair* pair : nodes_[centre].pairs)
    if (pair->is_joined_at(level)) all.push_back(pair->other(centre));
  std::sort(all.begin(), all.end());
  return all;
}

template <int D>
std::vector<BeadId> Spanner<D>::children(BeadId centre, int level) const {
  std::vector<BeadId> all{centre};
  for (const BeadId child : nodes_[centre].children)
    if (nodes_[child].top == level - 1) all.push_back(child);
  return all;
}

template <int D>
bool Spanner<D>::are_cousins(BeadId a, BeadId b) {
  const int above = std::min(nodes_[a].top, nodes_[b].top) + 1;
  a = ancestor(a, above);
  b = ancestor(b, above);
  if (a == b) return true;
  const Pair* parents = find(a, b);
  return parents != nullptr && parents->is_joined_at(above);
}

// Pairs.

template <int D>
void Spanner<D>::remember(const Pair& pair) {
  if (!building_)
    before_.try_emplace(key_of(pair.beads[0], pair.beads[1]), Before{pair.is_joined(), pair.lowest});
}

template <int D>
void Spanner<D>::record_edges() {
  for (const auto& [key, before] : before_) {
    const auto first = static_cast<BeadId>(key >> 32U), second = static_cast<BeadId>(key);
    const Pair* pair = find(first, second);
    const bool is_joined = pair != nullptr && pair->is_joined();
    if (is_joined != before.was_joined)
      record(is_joined ? join : part, {first, second});
    else if (is_joined && pair->lowest != before.lowest)
      record(rescale, {first, second, static_cast<BeadId>(pair->lowest)});
  }
  before_.clear();
}

template <int D>
void Spanner<D>::track(BeadId a, BeadId b) {
  if (a == b || find(a, b) != nullptr) return;
  const int common = std::min(nodes_[a].top, nodes_[b].top);
  Pair& pair = pairs_[key_of(a, b)] = {{std::min(a, b), std::max(a, b)}, common, common + 1};
  remember(pair);
  for (const BeadId bead : pair.beads) nodes_[bead].pairs.push_back(&pair);
  certify(pair);
}

template <int D>
void Spanner<D>::untrack(Pair& pair) {
  remember(pair);
  for (Guard* guard : {&pair.near, &pair.far, &pair.apart}) drop(*guard, pair.beads);
  for (const BeadId bead : pair.beads) std::erase(nodes_[bead].pairs, &pair);
  pairs_.erase(key_of(pair.beads[0], pair.beads[1]));
}

template <int D>
void Spanner<D>::certify(Pair& pair) {
  for (;;) {
    if (pair.lowest > 0 && !hold(pair.far, Length::reach, pair.lowest - 1, pair.beads, 1))
      lower(pair);
    else if (pair.is_joined() && !hold(pair.near, Length::reach, pair.lowest, pair.beads, -1))
      lift(pair);
    else
      break;
  }
  certify_apart(pair);
}

template <int D>
void Spanner<D>::certify_apart(Pair& pair) {
  const bool is_far = pair.lowest > 0 && std::ldexp(reach_, pair.lowest - 1 - pair.common) >= 1;
  if (!pair.is_joined() || pair.common == 0 || is_far || pair.beads[0] == leaving_ ||
      pair.beads[1] == leaving_)
    drop(pair.apart, pair.beads);
  else if (!hold(pair.apart, Length::scale, pair.common, pair.beads, 1))
    broken_.push_back(pair.beads);
}

template <int D>
void Spanner<D>::lower(Pair& pair) {
  remember(pair);
  drop(pair.near, pair.beads);
  --pair.lowest;
  join_at(pair, pair.lowest);
}

template <int D>
void Spanner<D>::lift(Pair& pair) {
  remember(pair);
  drop(pair.far, pair.beads);
  const int level = pair.lowest++;
  if (level == 0) return;
  for (const BeadId a : children(pair.beads[0], level))
    for (const BeadId b : children(pair.beads[1], level))
      if (Pair* cousins = find(a, b); cousins != nullptr && cousins != &pair) untrack(*cousins);
}

template <int D>
void Spanner<D>::join_at(const Pair& pair, int level) {
  if (level == 0) return;
  for (const BeadId a : children(pair.beads[0], level))
    for (const BeadId b : children(pair.beads[1], level)) track(a, b);
}

template <int D>
void Spanner<D>::set_common(Pair& pair, int common) {
  const int before = pair.common;
  if (common == before) return;
  remember(pair);
  drop(pair.apart, pair.beads);
  const bool stays_joined = pair.is_joined() && pair.lowest <= common;
  pair.common = common;
  if (!stays_joined) {
    drop(pair.near, pair.beads);
    drop(pair.far, pair.beads);
    pair.lowest = common + 1;
  } else {
    for (int level = before + 1; level <= common; ++level) join_at(pair, level);
  }
}

// Finds the pairs of a bead anew, after another parent or level.
template <int D>
void Spanner<D>::settle(BeadId bead) {
  std::vector<std::pair<int, BeadId>> others;  // from the highest common level down
  for (const Pair* pair : nodes_[bead].pairs) {
    const BeadId other = pair->other(bead);
    others.emplace_back(-std::min(nodes_[bead].top, nodes_[other].top), other);
  }
  std::sort(others.begin(), others.end());
  for (const auto& [level, other] : others) {
    Pair* pair = find(bead, other);
    if (pair == nullptr) continue;
    if (!are_cousins(bead, other)) {
      untrack(*pair);
      continue;
    }
    set_common(*pair, -level);
    certify(*pair);
  }
  if (bead == root_) return;
  const int above = nodes_[bead].top + 1;
  for (const BeadId centre : joined_with(nodes_[bead].parent, above))
    for (const BeadId cousin : children(centre, above)) track(bead, cousin);
}

// Centres.

template <int D>
void Spanner<D>::record_centre(Kind kind, BeadId bead) {
  record(kind, {bead, nodes_[bead].parent, static_cast<BeadId>(nodes_[bead].top)});
}

template <int D>
void Spanner<D>::unlink(BeadId bead) {
  Node& node = nodes_[bead];
  drop(node.cover, {bead, node.parent});
  std::erase(nodes_[node.parent].children, bead);
}

template <int D>
void Spanner<D>::link(BeadId bead, BeadId parent, int top) {
  nodes_[bead].parent = parent;
  nodes_[bead].top = top;
  nodes_[parent].children.push_back(bead);
  settle(bead);
  cover(bead);
}

template <int D>
void Spanner<D>::cover(BeadId bead) {
  Node& node = nodes_[bead];
  if (!hold(node.cover, Length::scale, node.top + 1, {bead, node.parent}, -1))
    broken_.push_back({bead, node.parent});
}

// Gives a bead the lowest parent that covers it. `near` is a centre of the next level, within twice its
// scale.
template <int D>
void Spanner<D>::find_parent(BeadId bead, BeadId near) {
  const int before = nodes_[bead].top;
  for (int level = before + 1;; ++level) {
    near = ancestor(near, level);
    for (const BeadId centre : joined_with(near, level)) {
      if (centre == leaving_ || sign(Length::scale, level, bead, centre) > 0) continue;
      unlink(bead);
      link(bead, centre, level - 1);
      record_centre(level - 1 > before ? rise : adopt, bead);
      return;
    }
  }
}

// Takes a centre from its highest level. `parent` is a centre of that level that covers it.
template <int D>
void Spanner<D>::leave_level(BeadId centre, BeadId parent) {
  const int level = nodes_[centre].top;
  leaving_ = centre;
  for (const BeadId child : children(centre, level))
    if (child != centre) find_parent(child, centre);
  leaving_ = no_bead;
  unlink(centre);
  link(centre, parent, level - 1);
  record_centre(fall, centre);
}

// Repairs what does not hold just after the present time.
template <int D>
void Spanner<D>::resolve() {
  while (!broken_.empty()) {
    const auto [a, b] = broken_.back();
    broken_.pop_back();
    for (const auto& [child, parent] : {std::pair(a, b), std::pair(b, a)}) {
      Node& node = nodes_[child];
      if (node.parent != parent || node.cover.handle != none) continue;
      sign(Length::scale, node.top + 1, child, parent) > 0 ? find_parent(child, parent) : cover(child);
    }
    Pair* pair = find(a, b);
    if (pair == nullptr || pair->apart.handle != none || pair->common == 0) continue;
    if (sign(Length::scale, pair->common, a, b) >= 0)
      certify_apart(*pair);
    else if (nodes_[a].top < nodes_[b].top || (nodes_[a].top == nodes_[b].top && a > b))
      leave_level(a, b);
    else
      leave_level(b, a);
  }
  record_edges();
}

// Makes a child of the root the root, and the root its child.
template <int D>
void Spanner<D>::replace_root() {
  const BeadId old = root_;
  const std::vector<BeadId> children = nodes_[old].children;
  root_ = *std::min_element(children.begin(), children.end(), [&](BeadId a, BeadId b) {
    return std::pair(-nodes_[a].top, a) < std::pair(-nodes_[b].top, b);
  });
  const int top = nodes_[root_].top;
  unlink(root_);
  nodes_[root_].parent = no_bead;
  nodes_[root_].top = root_level;
  record_centre(rise, root_);
  nodes_[old].parent = root_;
  nodes_[old].top = top;
  nodes_[root_].children.push_back(old);
  record_centre(fall, old);
  for (const BeadId child : children)
    if (child != root_ && nodes_[child].top == top) find_parent(child, root_);
  settle(root_);
  settle(old);
  cover(old);
}

template <int D>
void Spanner<D>::put(BeadId bead) {
  if (root_ == no_bead) {
    root_ = bead;
    nodes_[bead].top = root_level;
    return;
  }
  int level = 1;  // at which the root is the only centre, and covers the bead
  for (const BeadId child : nodes_[root_].children) level = std::max(level, nodes_[child].top + 1);
  while (sign(Length::scale, level, bead, root_) > 0) ++level;
  // Centres within twice the scale; their children are the only ones of the level below that may be.
  std::vector<BeadId> near{root_};
  std::pair<BeadId, int> best{root_, level};
  while (--level > 0 && !near.empty()) {
    std::vector<BeadId> nearer;
    for (const BeadId centre : near)
      for (const BeadId child : children(centre, level + 1))
        if (sign(Length::scale, level + 1, bead, child) <= 0) nearer.push_back(child);
    near = std::move(nearer);
    std::sort(near.begin(), near.end());
    const auto covers = [&](BeadId centre) { return sign(Length::scale, level, bead, centre) <= 0; };
    if (const auto parent = std::find_if(near.begin(), near.end(), covers); parent != near.end())
      best = {*parent, level};
  }
  link(bead, best.first, best.second - 1);
}

template <int D>
void Spanner<D>::take_out(BeadId bead) {
  if (bead == root_ && !nodes_[bead].children.empty()) replace_root();
  if (bead == root_) {
    root_ = no_bead;
  } else {
    leaving_ = bead;
    std::vector<BeadId> children = nodes_[bead].children;
    std::sort(children.begin(), children.end(), [&](BeadId a, BeadId b) {
      return std::pair(-nodes_[a].top, a) < std::pair(-nodes_[b].top, b);
    });
    for (const BeadId child : children) find_parent(child, bead);
    leaving_ = no_bead;
    while (!nodes_[bead].pairs.empty()) untrack(*nodes_[bead].pairs.back());
    unlink(bead);
  }
  nodes_[bead] = {};
}

// The simulator's calls.

template <int D>
void Spanner<D>::build() {
  present().structure_is_built();
  const Eigen::Matrix3Xd centers = control_points(motion_.curves(), 0);
  const double extent =
      centers.cols() == 0 ? 0 : (centers.rowwise().maxCoeff() - centers.rowwise().minCoeff()).maxCoeff();
  unit_ = extent > 0 ? std::ldexp(1.0, std::max(std::ilogb(extent) - levels_below_extent, -1000)) : 1;
  root_ = no_bead;
  pairs_.clear();
  nodes_.assign(bead_count(), {});
  named_.assign(bead_count(), 0);
  before_.clear();
  broken_.clear();
  leaving_ = no_bead;
  editing_ = false;
  building_ = knows_pairs_ = true;
  for (std::size_t k = 0; k < tables_.size(); ++k)
    if (tables_[k]) set_constants(k);
  for (const BeadId bead : present().all()) put(bead);
  building_ = false;
}

template <int D>
void Spanner<D>::start_step() {
  for (std::size_t k = 0; k < tables_.size(); ++k)
    if (tables_[k]) set_constants(k);
  std::vector<Key> keys;
  for (auto& [key, pair] : pairs_) {
    keys.push_back(key);
    pair.near.handle = pair.far.handle = pair.apart.handle = none;
  }
  for (Node& node : nodes_) node.cover.handle = none;
  named_.assign(bead_count(), 0);
  std::sort(keys.begin(), keys.end());
  const auto certify_all = [&] {
    for (const Key key : keys)
      if (const auto pair = pairs_.find(key); pair != pairs_.end()) certify(pair->second);
    for (BeadId bead = 0; bead < bead_count(); ++bead)
      if (nodes_[bead].parent != no_bead) cover(bead);
  };
  gathering_ = true;
  certify_all();
  gathering_ = false;
  for (const std::unique_ptr<Table>& table : tables_) {
    if (!table) continue;
    table->watch_enqueued([&](std::uint32_t place, CertificateHandle handle) {
      Gathered& one = gathered_[place];
      one.made.handle = handle;
      keep(*one.guard, one.made, one.beads);
    });
  }
  gathered_.clear();
  certify_all();  // repairs what does not hold
  resolve();
}

template <int D>
void Spanner<D>::fail(unsigned table_number, std::uint32_t slot) {
  const DistanceBeyond failed = tables_[table_number]->certificate(slot);
  const auto [a, b] = failed.beads;
  const bool is_scale = table_number % 2 == 1;
  failed_ = Failed{is_scale ? Length::scale : Length::reach, static_cast<int>(table_number / 2), key_of(a, b),
                   failed.sign};
  if (is_scale && !failed.side()) {
    for (const BeadId bead : failed.beads)
      if (nodes_[bead].parent == (bead == a ? b : a)) forget(nodes_[bead].cover, failed.beads);
    broken_.push_back(failed.beads);
  } else {
    Pair& pair = *find(a, b);
    forget(is_scale ? pair.apart : failed.side() ? pair.far : pair.near, failed.beads);
    if (is_scale)
      broken_.push_back(failed.beads);
    else
      certify(pair);
  }
  resolve();
  failed_.reset();
}

template <int D>
void Spanner<D>::apply(const Change& change) {
  const BeadId bead = change.ids[0], other = change.ids[1];
  if (knows_pairs_) {  // from now on, only edges are known
    for (Node& node : nodes_) node.pairs.clear();
    std::erase_if(pairs_, [](const auto& known) { return !known.second.is_joined(); });
    knows_pairs_ = false;
  }
  if (change.kind == inserts || change.kind >= erases) static_cast<void>(apply_edit(change));
  if (bead >= bead_count())
    throw std::invalid_argument("a change of a spanner names a bead that does not exist");
  if (change.kind == join || change.kind == part || change.kind == rescale) {
    if (!(bead < other && other < bead_count()))
      throw std::invalid_argument("an edge of a spanner needs two beads in ascending order");
    const bool is_joined = find(bead, other) != nullptr;
    if (is_joined == (change.kind == join))
      throw std::invalid_argument(fmt::format("beads {} and {} are {}an edge of the spanner", bead, other,
                                              is_joined ? "already " : "not "));
    if (change.kind == join) pairs_[key_of(bead, other)].beads = {bead, other};
    if (change.kind == part) pairs_.erase(key_of(bead, other));
  } else if (change.kind <= inserts) {
    const BeadId level = change.ids[2];
    if (other == no_bead ? level != root_level : other >= bead_count() || level >= root_level)
      throw std::invalid_argument("a bead of a spanner has no such parent or level");
    nodes_[bead].parent = other;
    nodes_[bead].top = static_cast<int>(change.ids[2]);
  }
}

// Edits: beads are inserted, erased, or change course.

template <int D>
void Spanner<D>::edit(std::uint8_t kind, BeadId bead) {
  begin_edit();
  present().set_absent(bead, kind == erases);
  if (kind == inserts) {
    put(bead);
    record_centre(inserts, bead);
  } else {
    take_out(bead);
    record(kind, {bead});
  }
  resolve();
  editing_ = false;
}

template <int D>
void Spanner<D>::begin_edit() {
  if (editing_) throw std::logic_error("spanner: an exception ended an edit: nothing follows");
  editing_ = true;
}

template <int D>
void Spanner<D>::release(std::span<const BeadId> beads) {
  begin_edit();
  for (const BeadId bead : beads)
    if (!is_absent(bead)) take_out(bead);
}

template <int D>
void Spanner<D>::follow(std::span<const BeadId> beads) {
  for (const BeadId bead : beads) {
    if (is_absent(bead)) continue;
    put(bead);
    record_centre(rise, bead);
  }
  resolve();
  editing_ = false;
}

template <int D>
std::optional<std::string> Spanner<D>::audit(const Dyadic& time) {
  const Eigen::Matrix3Xd at = approximate_positions(motion_.curves(), time.round_down());
  const double error = 0x1p-40 * (at.size() == 0 ? 0 : at.cwiseAbs().maxCoeff());
  const auto exact_sign = [&](Length length, int level, BeadId a, BeadId b) {
    return table(length, level).search().sign_at({{a, b}, 1}, time);
  };
  const std::vector<BeadId> beads = present().all();
  for (const BeadId a : beads) {
    const Node& node = nodes_[a];
    if (node.top == root_level) {
      if (node.parent != no_bead) return fmt::format("the root {} has a parent", a);
    } else if (node.parent >= nodes_.size() || is_absent(node.parent) ||
               nodes_[node.parent].top <= node.top) {
      return fmt::format("bead {} has no parent in the next level", a);
    } else if (exact_sign(Length::scale, node.top + 1, a, node.parent) > 0) {
      return fmt::format("bead {} is not covered by its parent {}", a, node.parent);
    }
    for (const BeadId b : beads) {
      if (b <= a) continue;
      const int common = std::min(node.top, nodes_[b].top);
      const double distance = (at.col(a) - at.col(b)).norm();
      const Pair* pair = find(a, b);
      if (knows_pairs_) {
        if ((pair != nullptr) != are_cousins(a, b))
          return fmt::format("beads {} and {} are {}tracked", a, b, pair == nullptr ? "not " : "");
        if (pair != nullptr && pair->common != common)
          return fmt::format("beads {} and {} have another common level", a, b);
      }
      if (pair != nullptr && pair->is_joined()) {
        if (exact_sign(Length::reach, common, a, b) > 0)
          return fmt::format("beads {} and {} are joined, but are too far apart", a, b);
        if (knows_pairs_ && exact_sign(Length::reach, pair->lowest, a, b) > 0)
          return fmt::format("beads {} and {} are joined at too low a level", a, b);
      } else if (distance - error < 1.001 * std::ldexp(reach_ * unit_, common) &&
                 exact_sign(Length::reach, common, a, b) < 0) {
        return fmt::format("beads {} and {} are near, but are not joined", a, b);
      }
      if (knows_pairs_ && pair != nullptr && pair->lowest > 0 &&
          exact_sign(Length::reach, pair->lowest - 1, a, b) < 0)
        return fmt::format("beads {} and {} are joined at too high a level", a, b);
      if (common > 0 && distance - error < 1.001 * std::ldexp(unit_, common) &&
          exact_sign(Length::scale, common, a, b) < 0)
        return fmt::format("beads {} and {} are centres of level {}, but are too near", a, b, common);
    }
  }
  return std::nullopt;
}

template class Spanner<2>;
template class Spanner<3>;

}  // namespace kds
