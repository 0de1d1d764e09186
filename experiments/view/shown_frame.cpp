#include "experiments/view/shown_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "experiments/output/page_data.h"
#include "experiments/view/replay_blocks.h"
#include "motions/base/input_error.h"
#include "motions/numbers/exact_number.h"

namespace kds {

namespace {

/// Returns a data array of a VTK file: the number of bytes, then the bytes, in base64.
template <class Number>
std::string data_array(std::string_view name, std::string_view type, std::span<const Number> numbers,
                       int components = 1) {
  BlockBytes bytes;
  bytes.add_word(static_cast<std::uint32_t>(numbers.size() * sizeof(Number)));
  for (const Number number : numbers) {
    if constexpr (sizeof(Number) == 8) {
      bytes.add_double(number);
    } else if constexpr (sizeof(Number) == 4) {
      bytes.add_word(number);
    } else {
      bytes.add_byte(number);
    }
  }
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n", type,
      name, components, base64(bytes.bytes()));
}

std::string double_array(std::string_view name, std::span<const double> numbers, int components = 1) {
  return data_array(name, "Float64", numbers, components);
}
std::string word_array(std::string_view name, const std::vector<std::uint32_t>& numbers) {
  return data_array(name, "UInt32", std::span<const std::uint32_t>(numbers));
}

/// Returns cells of `size` points each. `points` lists the points of all cells.
std::string cells(std::string_view element, const std::vector<std::uint32_t>& points, std::uint32_t size) {
  std::vector<std::uint32_t> offsets;
  for (std::uint32_t end = size; end <= points.size(); end += size) offsets.push_back(end);
  return fmt::format("<{0}>\n{1}{2}</{0}>\n", element, word_array("connectivity", points),
                     word_array("offsets", offsets));
}

std::string poly_data(std::size_t points, std::size_t lines, const std::string& content) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt32\">\n<PolyData>\n<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" "
      "NumberOfLines=\"{1}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n{2}</Piece>\n</PolyData>\n"
      "</VTKFile>\n",
      points, lines, content);
}

std::vector<std::uint32_t> counted_up(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i);
  return numbers;
}

std::string beads_of(const ShownFrame& frame) {
  const std::size_t beads = frame.radii.size();
  std::vector<std::uint32_t> ends;
  std::vector<std::uint8_t> kinds(beads, 0), hidden;
  std::uint8_t kind = 0;
  for (const ShownFrame::Pairs* pairs : {&frame.bonds, &frame.edges, &frame.contacts}) {
    ++kind;
    for (const auto& pair : *pairs) {
      ends.insert(ends.end(), pair.begin(), pair.end());
      kinds.push_back(kind);
    }
  }
  for (const bool is_hidden : frame.hidden) hidden.push_back(is_hidden ? 1 : 0);
  return poly_data(
      beads, ends.size() / 2,
      fmt::format("<PointData>\n{}{}{}{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n{}{}",
                  double_array("radius", frame.radii), word_array("bead", counted_up(beads)),
                  word_array("chain", frame.chains),
                  data_array("hidden", "UInt8", std::span<const std::uint8_t>(hidden)),
                  data_array("kind", "UInt8", std::span<const std::uint8_t>(kinds)),
                  double_array("Points", {frame.centers.data(), 3 * beads}, 3),
                  cells("Verts", counted_up(beads), 1), cells("Lines", ends, 2)));
}

std::string cages_of(const ShownFrame& frame) {
  std::vector<double> points, radii;
  std::vector<std::uint32_t> levels, firsts, lasts;
  for (const ShownFrame::Cage& cage : frame.cages) {
    points.insert(points.end(), cage.center.data(), cage.center.data() + 3);
    radii.push_back(cage.radius);
    levels.push_back(cage.level);
    firsts.push_back(cage.beads.first);
    lasts.push_back(cage.beads.last);
  }
  return poly_data(
      frame.cages.size(), 0,
      fmt::format("<PointData>\n{}{}{}{}</PointData>\n<Points>\n{}</Points>\n{}",
                  double_array("radius", radii), word_array("level", levels), word_array("first", firsts),
                  word_array("last", lasts), double_array("Points", points, 3),
                  cells("Verts", counted_up(radii.size()), 1)));
}

// Colours for all colour vision (Okabe and Ito): red, green, blue from 0 to 1.
constexpr std::array<double, 3> kBead{0.60, 0.60, 0.60}, kBond{0.20, 0.20, 0.20}, kEdge{0.34, 0.71, 0.91},
    kContact{0.84, 0.37, 0.00}, kCage{0.00, 0.62, 0.45};

double bond_width(const ShownFrame& frame) {
  const double least = *std::min_element(frame.radii.begin(), frame.radii.end());
  if (least > 0) return least / 8;
  const Eigen::Vector3d extent = frame.centers.rowwise().maxCoeff() - frame.centers.rowwise().minCoeff();
  return std::max(extent.maxCoeff() / 500, 1e-6);
}
double bead_size(const ShownFrame& frame, std::size_t bead) {
  return frame.radii[bead] > 0 ? frame.radii[bead] : 3 * bond_width(frame);
}

std::string pymol_script(const ShownFrame& frame) {
  std::string text = fmt::format(
      "# kds: frame {}. Run it in PyMOL: @FILE\npython\nfrom pymol import cmd\n"
      "from pymol.cgo import ALPHA, COLOR, CYLINDER, SPHERE\n",
      frame.stamp.number);
  const auto begin = [&](const std::string& name, const std::array<double, 3>& color, double alpha) {
    text +=
        fmt::format("kds_{} = [ALPHA, {}, COLOR, {}, {}, {},\n", name, alpha, color[0], color[1], color[2]);
  };
  const auto end = [&](const std::string& name, bool shown) {
    text += fmt::format("]\ncmd.load_cgo(kds_{0}, \"kds_{0}\")\n", name);
    if (!shown) text += fmt::format("cmd.disable(\"kds_{}\")\n", name);
  };
  const auto sphere = [&](const Eigen::Vector3d& c, double radius) {
    text += fmt::format("SPHERE, {}, {}, {}, {},\n", c[0], c[1], c[2], radius);
  };
  const auto pairs = [&](const std::string& name, const ShownFrame::Pairs& all,
                         const std::array<double, 3>& color) {
    if (all.empty()) return;
    begin(name, color, 1);
    for (const auto& [i, j] : all) {
      const Eigen::Vector3d a = frame.centers.col(i), b = frame.centers.col(j);
      text += fmt::format("CYLINDER, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {},\n", a[0], a[1], a[2],
                          b[0], b[1], b[2], bond_width(frame), color[0], color[1], color[2], color[0],
                          color[1], color[2]);
    }
    end(name, true);
  };
  begin("beads", kBead, 1);
  for (std::size_t bead = 0; bead < frame.radii.size(); ++bead)
    sphere(frame.centers.col(static_cast<Eigen::Index>(bead)), bead_size(frame, bead));
  end("beads", true);
  pairs("bonds", frame.bonds, kBond);
  pairs("edges", frame.edges, kEdge);
  pairs("contacts", frame.contacts, kContact);
  std::map<std::uint32_t, std::vector<const ShownFrame::Cage*>> levels;
  for (const ShownFrame::Cage& cage : frame.cages) levels[cage.level].push_back(&cage);
  constexpr std::uint32_t levels_shown = 3;
  for (const auto& [level, cages] : levels) {
    const std::string name = fmt::format("cages_{}", level);
    begin(name, kCage, 0.2);
    for (const ShownFrame::Cage* cage : cages) sphere(cage->center, cage->radius);
    end(name, level < levels_shown);
  }
  return text + "python end\nzoom\n";
}

std::string bild_scene(const ShownFrame& frame) {
  std::string text =
      fmt::format(".comment kds: frame {}. Open it in ChimeraX: open FILE\n", frame.stamp.number);
  const auto color = [&](const std::array<double, 3>& rgb, double transparency) {
    text += fmt::format(".color {} {} {}\n.transparency {}\n", rgb[0], rgb[1], rgb[2], transparency);
  };
  const auto sphere = [&](const Eigen::Vector3d& c, double radius) {
    text += fmt::format(".sphere {} {} {} {}\n", c[0], c[1], c[2], radius);
  };
  color(kBead, 0);
  for (std::size_t bead = 0; bead < frame.radii.size(); ++bead)
    sphere(frame.centers.col(static_cast<Eigen::Index>(bead)), bead_size(frame, bead));
  for (const auto& [pairs, rgb] : {std::pair(&frame.bonds, kBond), std::pair(&frame.edges, kEdge),
                                   std::pair(&frame.contacts, kContact)}) {
    color(rgb, 0);
    for (const auto& [i, j] : *pairs) {
      const Eigen::Vector3d a = frame.centers.col(i), b = frame.centers.col(j);
      text += fmt::format(".cylinder {} {} {} {} {} {} {}\n", a[0], a[1], a[2], b[0], b[1], b[2],
                          bond_width(frame));
    }
  }
  color(kCage, 0.8);
  for (const ShownFrame::Cage& cage : frame.cages) sphere(cage.center, cage.radius);
  return text;
}

}  // namespace

ShownFrame shown_frame(std::size_t frame, const Scene& scene, const KineticRun& run,
                       const ReplayRecorder& recorder) {
  ShownFrame shown;
  shown.stamp = scene.stamp(frame);
  shown.centers = scene.centers(frame);
  for (Eigen::Index bead = 0; bead < shown.centers.cols(); ++bead)
    shown.centers.col(bead) = scene.in_input(shown.centers.col(bead));
  shown.radii = scene.has_radii() ? scene.radii() : std::vector<double>(scene.bead_count(), 0);
  shown.hidden.assign(scene.bead_count(), false);
  for (std::uint32_t k = 0; k < scene.necklaces().size(); ++k) {
    const BeadRange& necklace = scene.necklaces()[k];
    shown.chains.insert(shown.chains.end(), necklace.last - necklace.first + 1, k);
    for (BeadId bead = necklace.first; bead < necklace.last && scene.has_radii(); ++bead)
      shown.bonds.push_back({bead, bead + 1});
  }
  for (std::size_t s = 0; s < recorder.structures().size(); ++s) {
    const ReplayRecorder::Structure& structure = recorder.structures()[s];
    for (std::size_t l = 0; l < structure.layers.size(); ++l) {
      const std::string_view name = structure.layers[l].layer.name;
      const std::vector<ReplayElement> elements = recorder.elements(s, l);
      if (name == "cages") {
        const std::vector<NodeSphere> spheres = run.spheres_at(s, Dyadic(frame == 0 ? 0.0 : 1.0));
        for (std::size_t k = 0; k < spheres.size(); ++k)
          shown.cages.push_back({spheres[k].range, structure.nodes[elements[k][0]].level,
                                 scene.in_input(spheres[k].sphere.center), spheres[k].sphere.radius});
        continue;
      }
      for (const ReplayElement& element : elements) {
        if (name == "hidden") shown.hidden[element[0]] = true;
        if (name == "edges") shown.edges.push_back({element[0], element[1]});
        if (name == "contacts") shown.contacts.push_back({element[0], element[1]});
      }
    }
  }
  return shown;
}

VtkFrames::VtkFrames(const std::filesystem::path& directory, bool replace)
    : files_(directory, "--vtk", replace) {}

void VtkFrames::add(const ShownFrame& frame) {
  const double time = frame.stamp.picoseconds.value_or(static_cast<double>(frame.stamp.number));
  const auto write = [&](const char* what, int part, const std::string& text) {
    const std::string name = fmt::format("{}-{}.vtp", what, frame.stamp.number);
    files_.write(name, text);
    collection_ += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", time, part, name);
  };
  write("beads", 0, beads_of(frame));
  if (!frame.cages.empty()) write("cages", 1, cages_of(frame));
}

void VtkFrames::finish() {
  files_.write("replay.pvd",
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" +
                   collection_ + "</Collection>\n</VTKFile>\n");
}

std::string scene_script(const std::filesystem::path& file, const ShownFrame& frame) {
  check_script_ending(file);
  return file.extension() == ".pml" ? pymol_script(frame) : bild_scene(frame);
}

void check_script_ending(const std::filesystem::path& file) {
  if (file.extension() != ".pml" && file.extension() != ".bild")
    throw InputError(fmt::format(
        "--script {}: expected a file name that ends in .pml (PyMOL) or .bild (ChimeraX)", file.string()));
}

}  // namespace kds
