#include "tests/fuzz/small_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "motions/base/input_error.h"
#include "motions/readers/instance.h"
#include "motions/readers/read_trajectory.h"
#include "motions/readers/write_trajectory.h"

namespace kds::test {

namespace {

constexpr std::size_t most_beads = 8;

class Decoder {
 public:
  Decoder(std::string_view bytes, Values values) : bytes_(bytes), values_(values) {}

  [[nodiscard]] unsigned byte() {
    return next_ < bytes_.size() ? static_cast<unsigned char>(bytes_[next_++]) : 0U;
  }

  /// Returns a coordinate, which may depend on others: `bead` of the bead before, `row` and `row_before` of
  /// this bead one and two places before, `axis` of the axis before.
  [[nodiscard]] double number(double bead, double row, double row_before, double axis) {
    const unsigned kind = byte(), argument = byte();
    const auto whole = static_cast<double>(argument % 17) - 8;
    const auto some = static_cast<double>(static_cast<std::int8_t>(argument));
    switch (kind % 16) {
      case 0:
        return bead;
      case 1:
        return row;
      case 2:
        return axis;
      case 3:
        return limited(2 * row - row_before, row);
      case 4:
        return -bead;
      case 5:
        return limited(bead + (argument % 2 == 0 ? 1 : -1), bead);
      case 6:
        return limited(row + whole, row);
      default:
        break;
    }
    if (values_ == Values::whole) return whole;
    switch (kind % 16) {
      case 7:
        return some / 4;
      case 8:
        return std::nextafter(bead, argument % 2 == 0 ? 100 : -100);
      case 9:
        return limited(bead + std::ldexp(1, -20 - static_cast<int>(argument % 40)), bead);
      case 10:
        return std::sin(static_cast<double>(256 * kind + argument));  // 53 bits
      case 11:
        return values_ == Values::mild ? some / 64
                                       : std::ldexp(1 + (kind >> 4U) / 16.0, 8 * static_cast<int>(some) - 8);
      default:
        return whole;
    }
  }

 private:
  [[nodiscard]] double limited(double x, double otherwise) const {
    const double most = values_ == Values::whole  ? 8
                        : values_ == Values::mild ? 100
                                                  : std::numeric_limits<double>::max();
    return std::abs(x) <= most ? x : otherwise;
  }

  std::string_view bytes_;
  std::size_t next_ = 0;
  Values values_;
};

void write_numbers(std::ofstream& file, const std::vector<double>& numbers) {
  for (const double x : numbers) file << fmt::format("{} ", x);
  file << '\n';
}

std::vector<Trajectory> necklaces_of(const SmallScene& small) {
  std::vector<std::vector<SmallScene::Bead>> parts;
  for (const auto& bead : small.beads) {
    if (parts.empty() || bead.begins) parts.emplace_back();
    parts.back().push_back(bead);
  }
  std::vector<Trajectory> necklaces;
  for (const auto& beads : parts) {
    Trajectory& necklace = necklaces.emplace_back();
    for (std::size_t k = 0; k < small.place_count(); ++k) {
      auto& frame = necklace.frames.emplace_back(3, static_cast<Eigen::Index>(beads.size()));
      for (std::size_t b = 0; b < beads.size(); ++b)
        frame.col(static_cast<Eigen::Index>(b)) =
            Eigen::Map<const Eigen::Vector3d>(beads[b].places[k].data());
    }
  }
  return necklaces;
}

Instance instance_of(const SmallScene& small) {
  Instance instance{
      "scene", static_cast<int>(small.columns()), static_cast<int>(small.place_count()) - 1, {}};
  for (const auto& bead : small.beads)
    for (std::size_t column = 0; column < small.columns(); ++column)
      for (const auto& place : bead.places) instance.control_points.push_back(place[column]);
  return instance;
}

}  // namespace

SmallScene scene_of_bytes(std::string_view bytes, Values values, std::string_view structure) {
  Decoder decoder(bytes, values);
  SmallScene small{.structure = law_structures()[decoder.byte() % law_structures().size()]};
  const bool only_lines = !structure.empty();
  if (only_lines) small.structure = {.name = std::string(structure)};
  const unsigned shape = decoder.byte();
  small.of_frames = only_lines || shape % 2 == 1;
  small.hermite = !only_lines && (shape >> 1U) % 4 == 1;
  const std::size_t rows = 2 + (shape >> 3U) % 4;
  const std::size_t columns = small.of_frames ? 3 : 1 + (shape >> 5U) % 4;
  small.beads.resize(1 + decoder.byte() % most_beads);
  std::vector<std::vector<double>> before(rows, std::vector<double>(columns));  // of the bead before
  for (auto& bead : small.beads) {
    const unsigned radius = decoder.byte();
    bead.begins = radius >= 192;
    bead.radius = values == Values::whole ? radius % 4 : (radius % 64) / 8.0;
    for (std::size_t k = 0; k < rows; ++k) {
      auto& place = bead.places.emplace_back();
      for (std::size_t axis = 0; axis < columns; ++axis)
        place.push_back(decoder.number(before[k][axis], k > 0 ? bead.places[k - 1][axis] : 0,
                                       k > 1 ? bead.places[k - 2][axis] : 0, axis > 0 ? place[axis - 1] : 0));
    }
    before = bead.places;
  }
  return small;
}

SmallScene read_scene(const std::filesystem::path& path, double radius) {
  SmallScene small;
  if (is_instance_file(path)) {
    const Instance instance = read_instance(path);
    for (std::size_t b = 0; b < instance.point_count(); ++b) {
      auto& places = small.beads.emplace_back().places;
      for (int k = 0; k <= instance.degree; ++k)
        for (int column = 0; column < instance.columns; ++column)
          (column == 0 ? places.emplace_back() : places.back())
              .push_back(instance.control_point(b, column, k));
    }
    return small;
  }
  small.of_frames = true;
  const Trajectory trajectory = read_trajectory(path);
  for (Eigen::Index b = 0; b < trajectory.frames.front().cols(); ++b) {
    auto& bead = small.beads.emplace_back(SmallScene::Bead{.radius = radius});
    for (const auto& frame : trajectory.frames)
      bead.places.push_back({frame(0, b), frame(1, b), frame(2, b)});
  }
  return small;
}

Scene make_scene(const SmallScene& small) {
  if (!small.of_frames) return Scene(instance_of(small));
  std::vector<double> radii;
  for (const auto& bead : small.beads) radii.push_back(bead.radius);
  return {necklaces_of(small), radii, small.hermite ? FrameMotion::hermite : FrameMotion::linear};
}

std::vector<std::string> write_scene(const SmallScene& small, const std::string& prefix) {
  std::vector<std::string> arguments{"run"};
  const auto add = [&](const std::string& ending) {
    std::ofstream file(prefix + ending);
    if (!file) throw InputError(prefix + ending + ": cannot be written");
    return file;
  };
  if (small.of_frames) {
    const auto necklaces = necklaces_of(small);
    for (std::size_t i = 0; i < necklaces.size(); ++i) {
      const std::string ending = fmt::format(".{}.xyz", i);
      std::ofstream file = add(ending);
      write_xyz(file, necklaces[i], "a minimized scene");
      arguments.push_back(prefix + ending);
    }
    std::ofstream file = add(".radii");
    for (const auto& bead : small.beads) write_numbers(file, {bead.radius});
    arguments.insert(arguments.end(), {"--radius", "file:" + prefix + ".radii", "--motion",
                                       small.hermite ? "hermite" : "linear"});
  } else {
    std::ofstream file = add(".txt");
    file << fmt::format("{} {} {}\n", small.beads.size(), small.columns(), small.place_count() - 1);
    const Instance instance = instance_of(small);
    const std::size_t numbers = small.columns() * small.place_count();
    for (std::size_t at = 0; at < instance.control_points.size(); at += numbers)
      write_numbers(file, {instance.control_points.begin() + static_cast<std::ptrdiff_t>(at),
                           instance.control_points.begin() + static_cast<std::ptrdiff_t>(at + numbers)});
    arguments.push_back(prefix + ".txt");
  }
  const StructureSettings& settings = small.structure.settings;
  arguments.insert(arguments.end(), {"--structures", small.structure.name});
  if (settings.directions)
    arguments.insert(arguments.end(), {"--directions", fmt::to_string(*settings.directions)});
  if (settings.between == Between::chord) arguments.insert(arguments.end(), {"--between", "chord"});
  if (settings.stretch != StructureSettings{}.stretch)
    arguments.insert(arguments.end(), {"--stretch", fmt::to_string(settings.stretch)});
  return arguments;
}

}  // namespace kds::test
