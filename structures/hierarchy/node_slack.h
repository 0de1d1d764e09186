#pragma once
// Nodes of a wrapped hierarchy that rest in a step: their beads stray less, from where they were at some
// earlier frame, than their sphere's slack (sphere_slack.h), drift common to all left out. They need no
// certificate. All slack is found at one reference frame, which is moved up when too much of it is used up.
// Where motion is fast, none is: a sample tells.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/base/back_off.h"
#include "structures/moving_sphere/bead_paths.h"
#include "structures/moving_sphere/sphere_slack.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

template <int Dimension>
class NodeSlack {
 public:
  explicit NodeSlack(const NecklaceTree& tree);

  /// At the start of a step. Takes out of `nodes` those that rest in it; `bases` are those of all nodes.
  void take_out_resting(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                        std::vector<NodeId>& nodes);
  /// The node has got another basis.
  void forget(NodeId node) { slack_[node] = none; }

 private:
  static constexpr double none = -1;
  static constexpr std::size_t sample_size = 16;
  /// Of all nodes asked about: finding slack costs nearly as much as what it saves in a step. A
  /// reference must also last for another step.
  static constexpr double least_share = 0.7;
  /// Of the share that rested at the reference frame.
  static constexpr double still_worth = 0.72;
  /// No slack is larger than a node strays in so many steps.
  static constexpr double steps_ahead = 16;

  void set_reference(const BeadPaths<Dimension>& paths);
  /// How far beads and nodes stray in the step from the reference.
  void look_at(const BeadPaths<Dimension>& paths);
  void forget_all();
  /// Motion is too fast for now.
  void give_up();
  [[nodiscard]] bool rests(NodeId node) const { return stray_[node] <= slack_[node]; }
  /// The share of some nodes.
  [[nodiscard]] double resting(std::span<const NodeId> nodes) const;
  void take_out(std::vector<NodeId>& nodes) const;

  void take_slack(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                  std::span<const NodeId> nodes);

  /// Nodes with bases of one size.
  struct Waiting {
    static constexpr std::size_t at_once = 4;
    std::array<NodeId, at_once> nodes;
    std::array<BeadRange, at_once> ranges;
    std::array<Basis, at_once> bases;
    std::array<double, at_once> wanted;
    std::size_t count = 0;
  };
  void add(const BeadPaths<Dimension>& paths, NodeId node, const Basis& basis);
  void find(const BeadPaths<Dimension>& paths, Waiting& some);

  const NecklaceTree& tree_;
  /// Where the halves of each node are in stray_.
  std::vector<std::array<std::uint32_t, 2>> halves_;
  std::vector<double> stray_;  ///< the most of any bead of each node; then of each bead
  std::vector<double> slack_;  ///< of each node, or `none`
  std::array<std::vector<double>, Dimension + 1> reference_;  ///< where beads were, and their radii
  std::array<Waiting, Basis::max_size> waiting_;
  bool has_reference_ = false, lasted_ = false;
  double worth_keeping_ = 0;
  BackOff samples_{0, 31};
};

}  // namespace kds
