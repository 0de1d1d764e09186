#include "check_wrapped.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "exact_sphere.h"

namespace oracle {
namespace {

constexpr double tolerance = 1e-12;

std::string text(const Node& node) {
  std::string line = "node ";
  line += std::to_string(node.first) + "-" + std::to_string(node.last) + " basis";
  for (const unsigned bead : node.basis) line.append(" ").append(std::to_string(bead));
  return line;
}

std::vector<unsigned> beads_of(const Node& node) {
  std::vector<unsigned> beads;
  for (unsigned bead = node.first; bead <= node.last; ++bead) beads.push_back(bead);
  return beads;
}

std::vector<unsigned> without(std::vector<unsigned> beads, std::size_t i) {
  beads.erase(beads.begin() + static_cast<std::ptrdiff_t>(i));
  return beads;
}

// Walks the nodes in preorder, which equals the order by ascending first and then descending last bead.
class TreeWalk {
 public:
  TreeWalk(std::vector<Node> nodes, const std::string& where, Report& report)
      : nodes_(std::move(nodes)), where_(where), report_(report) {
    std::sort(nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) {
      return a.first != b.first ? a.first < b.first : a.last > b.last;
    });
  }

  void check(const std::vector<std::size_t>& ends) {
    unsigned first = 0;
    for (const std::size_t end : ends) {
      const unsigned last = static_cast<unsigned>(end - 1);
      const auto height = subtree(first, last);
      if (!height) return;
      if (*height > std::bit_width(end - first - 1) + 1u)
        complain(first, last, "heads a tree out of balance");
      first = last + 1;
    }
    if (next_ < nodes_.size()) complain(nodes_[next_].first, nodes_[next_].last, "is no part of the tree");
  }

 private:
  void complain(unsigned first, unsigned last, const std::string& what) {
    report_.mismatch(where_ + "range " + std::to_string(first) + "-" + std::to_string(last) + " " + what);
  }

  // Returns the height of the tree over the range, or reports a mismatch and returns nothing.
  std::optional<unsigned> subtree(unsigned first, unsigned last) {
    if (first == last) return 0;
    if (next_ == nodes_.size() || nodes_[next_].first != first || nodes_[next_].last != last) {
      complain(first, last, "should be a node");
      return std::nullopt;
    }
    ++next_;
    const bool inner = next_ < nodes_.size() && nodes_[next_].first == first && nodes_[next_].last < last;
    const unsigned split = inner ? nodes_[next_].last : first;
    const auto left = subtree(first, split);
    if (!left) return std::nullopt;
    const auto right = subtree(split + 1, last);
    if (!right) return std::nullopt;
    return 1 + std::max(*left, *right);
  }

  std::vector<Node> nodes_;
  const std::string& where_;
  Report& report_;
  std::size_t next_ = 0;
};

bool agrees(const Node& node, const ExactSphere& sphere) {
  double size = sphere.radius;
  for (const double x : sphere.centre) size = std::max(size, std::abs(x));
  // Written so that NaN counts as different.
  bool same = std::abs(node.radius - sphere.radius) <= tolerance * sphere.radius;
  for (std::size_t c = 0; c < 3; ++c) {
    same = same && std::abs(node.centre[c] - sphere.centre[c]) <= tolerance * size;
  }
  return same;
}

bool well_formed(const Node& node, std::size_t beads, const std::string& where, Report& report) {
  const std::size_t before = report.mismatch_count;
  const std::string name = where + text(node) + ": ";
  if (node.first >= node.last || node.last >= beads) report.mismatch(name + "bad range");
  if (node.basis.size() > 4) report.mismatch(name + "more than four basis beads");
  for (std::size_t i = 0; i < node.basis.size(); ++i) {
    if (node.basis[i] < node.first || node.basis[i] > node.last)
      report.mismatch(name + "basis outside the range");
    if (i > 0 && node.basis[i - 1] >= node.basis[i]) report.mismatch(name + "basis ids do not ascend");
  }
  return report.mismatch_count == before;
}

// Returns the basis without superfluous beads.
std::vector<unsigned> proper_part(const Frame& frame, std::vector<unsigned> basis) {
  const RootNumber radius = cgal_sphere(frame, basis).exact_radius;
  for (std::size_t i = 0; basis.size() > 1 && i < basis.size();) {
    std::vector<unsigned> fewer = without(basis, i);
    if (compare(cgal_sphere(frame, fewer).exact_radius, radius) == CGAL::ZERO) {
      basis = std::move(fewer);
    } else {
      ++i;
    }
  }
  return basis;
}

// In a degenerate frame a basis may have superfluous beads, but all of them must touch the sphere.
std::optional<std::string> objection_to_members(const Frame& frame, const Node& node,
                                                const ExactSphere& own) {
  for (const unsigned bead : node.basis) {
    if (!touches(own, frame[bead]))
      return "bead " + std::to_string(bead) + " of the basis does not touch the basis sphere";
  }
  return std::nullopt;
}

// Radii are compared as exact numbers, so the basis sphere either is the node's sphere or is not.
std::optional<std::string> objection_by_cgal(const Frame& frame, const Node& node,
                                             const ExactSphere& smallest) {
  const ExactSphere own = cgal_sphere(frame, node.basis);
  if (compare(own.exact_radius, smallest.exact_radius) != CGAL::ZERO) {
    return "the basis sphere is smaller than the node's, radius " + std::to_string(own.radius) + " against " +
           std::to_string(smallest.radius);
  }
  return objection_to_members(frame, node, own);
}

// Proves a node with beads of equal radii. If the basis has superfluous beads, proves its proper part.
Proof prove_node(const Frame& frame, const Node& node) {
  Proof proof = prove_sphere(frame, node);
  if (!proof.objection) return proof;
  Node proper = node;
  proper.basis = proper_part(frame, node.basis);
  if (proper.basis == node.basis) return proof;
  proof = prove_sphere(frame, proper);
  if (!proof.objection) proof.objection = objection_to_members(frame, node, cgal_sphere(frame, proper.basis));
  return proof;
}

void check_node(const Frame& frame, const Node& node, bool equal_radii, bool cross_check,
                const std::string& where, Report& report) {
  std::optional<std::string> objection;
  if (equal_radii) {
    const Proof proof = prove_node(frame, node);
    objection = proof.objection;
    if (!objection && !agrees(node, proof.sphere)) objection = "centre or radius is not the basis sphere's";
  }
  if (!objection && (cross_check || !equal_radii)) {
    ++report.cross_checked;
    const ExactSphere smallest = cgal_sphere(frame, beads_of(node));
    if (!agrees(node, smallest)) objection = "centre or radius is not that of CGAL's sphere";
    if (!objection) objection = objection_by_cgal(frame, node, smallest);
  }
  if (objection) report.mismatch(where + text(node) + ": " + *objection);
}

}  // namespace

std::vector<Node> static_hierarchy(const Frame& frame, const std::vector<std::size_t>& ends) {
  std::vector<Node> nodes;
  const std::function<void(unsigned, unsigned)> build = [&](unsigned first, unsigned last) {
    if (first == last) return;
    Node node;
    node.first = first;
    node.last = last;
    const ExactSphere sphere = cgal_sphere(frame, beads_of(node));
    node.basis = proper_part(frame, sphere.support);  // CGAL's support set need not be minimal
    node.centre = sphere.centre;
    node.radius = sphere.radius;
    nodes.push_back(node);
    build(first, first + (last - first) / 2);
    build(first + (last - first) / 2 + 1, last);
  };
  unsigned first = 0;
  for (const std::size_t end : ends) {
    build(first, static_cast<unsigned>(end - 1));
    first = static_cast<unsigned>(end);
  }
  return nodes;
}

void check_wrapped(const Frame& frame, const std::vector<std::size_t>& ends, const std::vector<Node>& nodes,
                   std::size_t every, const std::string& where, Report& report) {
  for (const Ball& ball : frame) {
    if (!(ball.radius >= 0)) {
      report.mismatch(where + "spheres of beads with imaginary radii cannot be checked");
      return;
    }
  }
  const bool equal_radii =
      std::all_of(frame.begin(), frame.end(), [&](const Ball& b) { return b.radius == frame[0].radius; });
  TreeWalk(nodes, where, report).check(ends);
  for (const Node& node : nodes) {
    const bool cross_check = every > 0 && report.nodes % every == 0;
    ++report.nodes;
    if (well_formed(node, frame.size(), where, report)) {
      check_node(frame, node, equal_radii, cross_check, where, report);
    }
  }
}

}  // namespace oracle
