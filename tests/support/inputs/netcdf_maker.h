#pragma once
// Writes AMBER NetCDF files of every kind, by the specification of the classic formats.

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kds::test {

struct NetcdfMaker {
  int version = 1;                   ///< 1, 2 or 5
  bool doubles = false;              ///< coordinates are doubles
  bool restart = false;              ///< one frame without a dimension of frames
  bool fixed_frames = false;         ///< the dimension of frames has a fixed length
  bool streamed = false;             ///< the header does not know the number of frames
  std::int64_t frames_claimed = -1;  ///< -1: the true number
  std::string conventions = "AMBER";
  std::string units = "angstrom", time_units = "picosecond", angle_units = "degree";
  std::string velocity_units;  ///< empty: no velocities; otherwise they are the numbers of the coordinates
  std::optional<double> scale, time_scale, velocity_scale;
  bool with_time = true;
  std::optional<std::array<double, 6>> cell;  ///< lengths and angles of every frame
  std::vector<std::vector<std::array<double, 3>>> frames;
  std::vector<double> times;

  /// Returns atoms 1.5 apart along x. Each frame is 0.25 further along y, and one picosecond later.
  static NetcdfMaker chain(std::size_t atoms, std::size_t frame_count) {
    NetcdfMaker maker;
    for (std::size_t k = 0; k < frame_count; ++k) {
      auto& frame = maker.frames.emplace_back();
      for (std::size_t i = 0; i < atoms; ++i)
        frame.push_back({1.5 * static_cast<double>(i), 0.25 * static_cast<double>(k), 0.1});
      maker.times.push_back(static_cast<double>(k));
    }
    return maker;
  }

  [[nodiscard]] std::string bytes() const {
    std::uint64_t begin = header(0).size();
    std::string out = header(begin);
    if (restart || fixed_frames) {
      for (const Variable& variable : variables())
        for (std::size_t k = 0; k < frames.size(); ++k) put_values(out, variable, k);
      return out;
    }
    for (std::size_t k = 0; k < frames.size(); ++k)
      for (const Variable& variable : variables()) put_values(out, variable, k);
    return out;
  }
  [[nodiscard]] std::size_t frame_bytes() const {
    std::size_t bytes = 0;
    for (const Variable& variable : variables()) bytes += size_of(variable);
    return bytes;
  }

 private:
  enum class Name { time, coordinates, velocities, lengths, angles };
  struct Variable {
    Name name;
    std::string text;
    std::vector<std::uint64_t> dimensions;  // without that of the frames
    int type;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::optional<double> scale;
  };
  static constexpr int char_type = 2, float_type = 5, double_type = 6;

  [[nodiscard]] std::vector<Variable> variables() const {
    std::vector<Variable> all;
    if (with_time) all.push_back({Name::time, "time", {}, float_type, {{"units", time_units}}, time_scale});
    all.push_back({Name::coordinates, "coordinates", {1, 2}, doubles ? double_type : float_type, {}, scale});
    if (!units.empty()) all.back().attributes.emplace_back("units", units);
    if (!velocity_units.empty())
      all.push_back({Name::velocities,
                     "velocities",
                     {1, 2},
                     all.back().type,
                     {{"units", velocity_units}},
                     velocity_scale});
    if (cell) {
      all.push_back({Name::lengths, "cell_lengths", {2}, double_type, {{"units", units}}, {}});
      all.push_back({Name::angles, "cell_angles", {2}, double_type, {{"units", angle_units}}, {}});
    }
    return all;
  }

  [[nodiscard]] std::size_t size_of(const Variable& variable) const {
    std::size_t values = 1;
    for (const std::uint64_t dimension : variable.dimensions)
      values *= dimension == 1 ? frames.at(0).size() : 3;
    return values * (variable.type == float_type ? 4 : 8);
  }

  static void put(std::string& out, std::uint64_t number, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(number >> (8 * i) & 0xFFU);
  }
  void put_size(std::string& out, std::uint64_t number) const { put(out, number, version == 5 ? 8 : 4); }
  void put_name(std::string& out, const std::string& name) const {
    put_size(out, name.size());
    out += name;
    while (out.size() % 4 != 0) out += '\0';
  }
  void put_attribute(std::string& out, const std::string& name, const std::string& value) const {
    put_name(out, name);
    put(out, char_type, 4);
    put_name(out, value);
  }
  static void put_value(std::string& out, int type, double value) {
    if (type == float_type)
      put(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
    else
      put(out, std::bit_cast<std::uint64_t>(value), 8);
  }

  void put_values(std::string& out, const Variable& variable, std::size_t k) const {
    if (variable.name == Name::time) put_value(out, variable.type, times.at(k));
    if (variable.name == Name::coordinates || variable.name == Name::velocities)
      for (const auto& atom : frames[k])
        for (const double coordinate : atom) put_value(out, variable.type, coordinate);
    if (variable.name == Name::lengths || variable.name == Name::angles)
      for (std::size_t i = 0; i < 3; ++i)
        put_value(out, variable.type, (*cell)[i + (variable.name == Name::angles ? 3 : 0)]);
  }

  [[nodiscard]] std::string header(std::uint64_t begin) const {
    std::string out = "CDF";
    out += static_cast<char>(version);
    const bool records = !restart && !fixed_frames;
    const std::uint64_t claimed =
        frames_claimed < 0 ? frames.size() : static_cast<std::uint64_t>(frames_claimed);
    put_size(out, streamed ? ~std::uint64_t{0} : records ? claimed : 0);
    put(out, 10, 4);
    put_size(out, 3);
    put_name(out, "frame");
    put_size(out, records ? 0 : claimed);
    put_name(out, "atom");
    put_size(out, frames.at(0).size());
    put_name(out, "spatial");
    put_size(out, 3);
    put(out, 12, 4);
    put_size(out, 2);
    put_attribute(out, "Conventions", conventions);
    put_attribute(out, "title", "odd");
    put(out, 11, 4);
    put_size(out, variables().size());
    for (const Variable& variable : variables()) {
      put_name(out, variable.text);
      put_size(out, variable.dimensions.size() + (restart ? 0 : 1));
      if (!restart) put_size(out, 0);
      for (const std::uint64_t dimension : variable.dimensions) put_size(out, dimension);
      const std::size_t attributes = variable.attributes.size() + (variable.scale ? 1 : 0);
      put(out, attributes == 0 ? 0 : 12, 4);
      put_size(out, attributes);
      for (const auto& [name, value] : variable.attributes) put_attribute(out, name, value);
      if (variable.scale) {
        put_name(out, "scale_factor");
        put(out, double_type, 4);
        put_size(out, 1);
        put_value(out, double_type, *variable.scale);
      }
      put(out, static_cast<std::uint64_t>(variable.type), 4);
      put_size(out, size_of(variable) * (fixed_frames ? frames.size() : 1));
      put(out, begin, version == 1 ? 4 : 8);
      begin += size_of(variable) * (fixed_frames ? frames.size() : 1);
    }
    return out;
  }
};

}  // namespace kds::test
