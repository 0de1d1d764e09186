#include "structures/session/own_structures.h"

#include <fmt/format.h>
#include <string_view>

namespace kds {

std::string bead_lines(std::span<const BeadId> beads) {
  std::string text = "bead\n";
  for (const BeadId b : beads) text += fmt::format("{}\n", b);
  return text;
}

namespace {

template <class Cell>
std::string cell_lines(std::string_view header, std::span<const Cell> cells) {
  std::string text = fmt::format("{}\n", header);
  for (const Cell& c : cells) text += fmt::format("{}\n", fmt::join(c, ","));
  return text;
}

}  // namespace

DumpFile dump_wrapped(std::span<const WrappedNode> nodes) {
  std::string text = "first,last,basis,x,y,z,radius\n";
  for (const WrappedNode& node : nodes) {
    const auto& c = node.sphere.center;
    text += fmt::format("{},{},{},{},{},{},{}\n", node.range.first, node.range.last,
                        fmt::join(node.basis.begin(), node.basis.end(), " "), c.x(), c.y(), c.z(),
                        node.sphere.radius);
  }
  return {"wrapped.csv", std::move(text)};
}

DumpFile dump_boxes(std::span<const BoxesNode> nodes) {
  std::string text = "first,last,supports,ends\n";
  for (const BoxesNode& node : nodes)
    text += fmt::format("{},{},{},{}\n", node.range.first, node.range.last, fmt::join(node.supports, " "),
                        fmt::join(node.ends, " "));
  return {"boxes.csv", std::move(text)};
}

DumpFile dump_layered(std::span<const NodeSphere> nodes) {
  std::string text = "first,last,x,y,z,radius\n";
  for (const NodeSphere& node : nodes) {
    const auto& c = node.sphere.center;
    text += fmt::format("{},{},{},{},{},{}\n", node.range.first, node.range.last, c.x(), c.y(), c.z(),
                        node.sphere.radius);
  }
  return {"layered.csv", std::move(text)};
}

DumpFile dump_cells(std::span<const CellBeads<2>> cells) { return {"power.csv", cell_lines("a,b,c", cells)}; }
DumpFile dump_cells(std::span<const CellBeads<3>> cells) {
  return {"power.csv", cell_lines("a,b,c,d", cells)};
}

}  // namespace kds
