#include "dump.h"

#include <charconv>
#include <fstream>
#include <string_view>

#include "scene.h"

namespace oracle {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0;;) {
    const std::size_t end = text.find(separator, start);
    parts.push_back(text.substr(start, end - start));
    if (end == std::string_view::npos) return parts;
    start = end + 1;
  }
}

template <class Number>
Number number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw FormError("'" + std::string(text) + "' is no number of the kind expected");
  }
  return value;
}

// Calls use(fields) for every line after the header.
template <class Use>
void for_each_line(const std::filesystem::path& path, std::string_view header, const Use& use) {
  const std::string text = read_text(path);
  if (text.empty() || text.back() != '\n') throw FormError("the last line is cut off");
  const auto lines = split(std::string_view(text).substr(0, text.size() - 1), '\n');
  if (lines[0] != header) throw FormError("header '" + std::string(header) + "' expected");
  const std::size_t width = split(header, ',').size();
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto fields = split(lines[i], ',');
    try {
      if (fields.size() != width) throw FormError(std::to_string(width) + " fields expected");
      use(fields);
    } catch (const FormError& error) {
      throw FormError("line " + std::to_string(i + 1) + ": " + error.what());
    }
  }
}

std::string shortest(double value) {
  std::array<char, 40> text{};
  return std::string(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

constexpr std::string_view cell_header(int space) { return space == 2 ? "a,b,c" : "a,b,c,d"; }
constexpr std::string_view hidden_header = "bead";
constexpr std::string_view node_header = "first,last,basis,x,y,z,radius";

}  // namespace

std::filesystem::path dump_file(const std::filesystem::path& dir, std::size_t frame,
                                const std::string& what) {
  return dir / ("frame-" + std::to_string(frame) + "." + what + ".csv");
}

std::vector<Cell> read_cells(const std::filesystem::path& path, int space) {
  std::vector<Cell> cells;
  for_each_line(path, cell_header(space), [&](const auto& fields) {
    Cell cell;
    for (const auto field : fields) cell.push_back(number<unsigned>(field));
    cells.push_back(std::move(cell));
  });
  return cells;
}

std::vector<unsigned> read_hidden(const std::filesystem::path& path) {
  std::vector<unsigned> hidden;
  for_each_line(path, hidden_header,
                [&](const auto& fields) { hidden.push_back(number<unsigned>(fields[0])); });
  return hidden;
}

std::vector<Node> read_nodes(const std::filesystem::path& path) {
  std::vector<Node> nodes;
  for_each_line(path, node_header, [&](const auto& fields) {
    Node node;
    node.first = number<unsigned>(fields[0]);
    node.last = number<unsigned>(fields[1]);
    for (const auto id : split(fields[2], ' ')) node.basis.push_back(number<unsigned>(id));
    for (std::size_t c = 0; c < 3; ++c) node.centre[c] = number<double>(fields[3 + c]);
    node.radius = number<double>(fields[6]);
    nodes.push_back(std::move(node));
  });
  return nodes;
}

void write_cells(const std::filesystem::path& path, const std::vector<Cell>& cells, int space) {
  std::ofstream out(path);
  out << cell_header(space) << '\n';
  for (const Cell& cell : cells) {
    for (std::size_t i = 0; i < cell.size(); ++i) out << (i ? "," : "") << cell[i];
    out << '\n';
  }
}

void write_hidden(const std::filesystem::path& path, const std::vector<unsigned>& hidden) {
  std::ofstream out(path);
  out << hidden_header << '\n';
  for (const unsigned bead : hidden) out << bead << '\n';
}

void write_nodes(const std::filesystem::path& path, const std::vector<Node>& nodes) {
  std::ofstream out(path);
  out << node_header << '\n';
  for (const Node& node : nodes) {
    out << node.first << ',' << node.last << ',';
    for (std::size_t i = 0; i < node.basis.size(); ++i) out << (i ? " " : "") << node.basis[i];
    for (const double x : node.centre) out << ',' << shortest(x);
    out << ',' << shortest(node.radius) << '\n';
  }
}

}  // namespace oracle
