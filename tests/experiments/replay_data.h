#pragma once
// Reads the data of a replay page, as docs/formats.md describes them, without the code that writes them.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace kds::test {

inline std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (digit < 0) throw std::runtime_error("no base64");
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count);
    bits &= (1U << count) - 1;
  }
  return bytes;
}

class ReplayData {
 public:
  using Json = nlohmann::json;
  using Ids = std::vector<std::uint32_t>;
  using State = std::set<Ids>;

  explicit ReplayData(const std::string& page) {
    const std::string meta_tag = "<script type=\"application/json\" id=\"kds-replay\">";
    meta = Json::parse(between(page, meta_tag, "</script>"));
    const std::string block_tag = "<script type=\"text/plain\" class=\"kds-block\" id=\"kds-block-";
    for (std::size_t at = 0; (at = page.find(block_tag, at)) != std::string::npos;) {
      at += block_tag.size();
      const std::size_t quote = page.find('"', at), begin = quote + 2, end = page.find('<', begin);
      texts_[page.substr(at, quote - at)] = page.substr(begin, end - begin);
      at = end;
    }
  }

  /// Returns a block's bytes after decompression. Checks the number of bytes that the page states.
  [[nodiscard]] std::string block(const std::string& name) const {
    const std::string packed = from_base64(texts_.at(name));
    std::string bytes(meta["blocks"].at(name).get<std::size_t>(), '\0');
    uLongf size = bytes.size();
    if (!bytes.empty() || !packed.empty()) {
      char none = 0;
      const int result = uncompress(reinterpret_cast<Bytef*>(bytes.empty() ? &none : bytes.data()), &size,
                                    reinterpret_cast<const Bytef*>(packed.data()), packed.size());
      if (result != Z_OK || size != bytes.size()) throw std::runtime_error("block " + name);
    }
    return bytes;
  }
  [[nodiscard]] Ids words(const std::string& name) const { return words_of(block(name), 0, SIZE_MAX); }
  [[nodiscard]] std::size_t block_count() const { return texts_.size(); }

  /// Returns positions by frame, bead and axis, in the unit of the file.
  [[nodiscard]] std::vector<std::vector<std::vector<double>>> positions() const {
    const std::size_t beads = meta["beads"], axes = meta["dimension"], per_block = meta["block_frames"];
    std::vector<std::vector<std::vector<double>>> frames;
    std::vector<std::int64_t> before(beads * axes);
    std::string bytes;
    std::size_t at = 0;
    for (std::size_t frame = 0; frame < meta["frames"].get<std::size_t>(); ++frame) {
      const bool begins = frame % per_block == 0;
      if (begins) {
        EXPECT_EQ(at, bytes.size());
        bytes = block("positions-" + std::to_string(frame / per_block));
        at = 0;
      }
      auto& positions = frames.emplace_back(beads, std::vector<double>(axes));
      for (std::size_t axis = 0; axis < axes; ++axis) {
        std::int64_t last = 0;
        for (std::size_t bead = 0; bead < beads; ++bead) {
          std::int64_t& number = before[axis * beads + bead];
          number = varint(bytes, at) + (begins ? last : number);
          last = number;
          positions[bead][axis] = place(number, axis);
        }
      }
      quanta_.push_back(before);
    }
    EXPECT_EQ(at, bytes.size());
    return frames;
  }
  /// Returns inner control points by step, number, bead and axis. Call `positions` before.
  [[nodiscard]] std::vector<std::vector<std::vector<std::vector<double>>>> controls() const {
    const std::size_t beads = meta["beads"], axes = meta["dimension"], per_block = meta["block_frames"];
    const std::size_t degree = meta["degree"];
    std::vector<std::vector<std::vector<std::vector<double>>>> steps;
    std::string bytes;
    std::size_t at = 0;
    for (std::size_t step = 0; step + 1 < meta["frames"].get<std::size_t>(); ++step) {
      if (step % per_block == 0) bytes = block("controls-" + std::to_string(step / per_block)), at = 0;
      auto& points = steps.emplace_back();
      for (std::size_t j = 1; j < degree; ++j) {
        auto& control = points.emplace_back(beads, std::vector<double>(axes));
        for (std::size_t axis = 0; axis < axes; ++axis)
          for (std::size_t bead = 0; bead < beads; ++bead) {
            const auto p = static_cast<double>(quanta_[step][axis * beads + bead]),
                       q = static_cast<double>(quanta_[step + 1][axis * beads + bead]);
            const double straight =
                std::floor((static_cast<double>(degree - j) * p + static_cast<double>(j) * q) /
                               static_cast<double>(degree) +
                           0.5);
            control[bead][axis] = place(varint(bytes, at) + static_cast<std::int64_t>(straight), axis);
          }
      }
    }
    EXPECT_EQ(at, bytes.size());
    return steps;
  }

  struct Events {
    Ids order, step;
    std::vector<double> lower, upper;  ///< equal if the time is exact
    std::vector<std::string> kind, stage;
    std::vector<Ids> ids;
  };
  [[nodiscard]] Events events(std::size_t structure) const {
    const Json& about = meta["structures"][structure];
    const std::size_t n = about["events"];
    const std::string bytes = block("events-" + std::to_string(structure));
    std::size_t at = 0;
    Events events{sums(bytes, at, n), sums(bytes, at, n), {}, {}, {}, {}, std::vector<Ids>(n)};
    std::vector<std::int64_t> middles;
    for (std::size_t e = 0; e < n; ++e) {
      const bool continues = e > 0 && events.step[e] == events.step[e - 1];
      middles.push_back(varint(bytes, at) + (continues ? middles.back() : 0));
    }
    const auto next_byte = [&] { return static_cast<std::uint8_t>(bytes.at(at++)); };
    for (std::size_t e = 0; e < n; ++e) {
      const std::uint8_t reach = next_byte();
      const double middle = static_cast<double>(middles[e]), away = reach == 0 ? 0 : std::ldexp(1, reach - 1);
      events.lower.push_back(std::max(0.0, std::ldexp(middle - away, -32)));
      events.upper.push_back(std::min(1.0, std::ldexp(middle + away, -32)));
    }
    for (std::size_t e = 0; e < n; ++e) events.kind.push_back(about["kinds"].at(next_byte())["name"]);
    for (std::size_t e = 0; e < n; ++e) events.stage.push_back(about["stages"].at(next_byte()));
    std::vector<std::uint8_t> sizes;
    for (std::size_t e = 0; e < n; ++e) sizes.push_back(next_byte());
    for (std::uint8_t k = 0; k < 255; ++k)
      for (std::size_t e = 0; e < n; ++e)
        if (k < sizes[e])
          events.ids[e].push_back(
              static_cast<std::uint32_t>(varint(bytes, at) + (k == 0 ? 0 : events.ids[e].back())));
    EXPECT_EQ(at, bytes.size());
    return events;
  }

  struct Change {
    std::uint32_t event = 0;
    std::vector<Ids> removed, added;
  };
  /// Returns the changes of layer `l` of structure `s`.
  [[nodiscard]] std::vector<Change> changes(std::size_t s, std::size_t l) const {
    const Json& layer = meta["structures"][s]["layers"][l];
    const std::size_t n = layer["changes"], arity = layer["arity"];
    const std::vector<Ids> event_ids = events(s).ids;
    const std::string bytes = block("changes-" + std::to_string(s) + "-" + std::to_string(l));
    std::size_t at = 0;
    const Ids of_events = sums(bytes, at, n);
    std::vector<Change> changes(n);
    for (std::size_t c = 0; c < n; ++c) changes[c].event = of_events[c];
    for (Change& change : changes) change.removed.resize(static_cast<std::size_t>(varint(bytes, at)));
    for (Change& change : changes) change.added.resize(static_cast<std::size_t>(varint(bytes, at)));
    std::size_t others = at;
    for (const Change& change : changes) others += arity * (change.removed.size() + change.added.size());
    for (Change& change : changes) {
      std::int64_t other = 0;
      for (auto* const elements : {&change.removed, &change.added}) {
        for (Ids& element : *elements) {
          for (std::size_t k = 0; k < arity; ++k) {
            const auto place = static_cast<std::uint8_t>(bytes.at(at++));
            if (place == 254) other += varint(bytes, others);
            element.push_back(place == 255   ? 0xffffffffU
                              : place == 254 ? static_cast<std::uint32_t>(other)
                                             : event_ids.at(change.event).at(place));
          }
        }
      }
    }
    EXPECT_EQ(others, bytes.size());
    return changes;
  }

  /// Returns the elements of a layer when all events of the steps before `step` are applied.
  [[nodiscard]] State state(const std::string& layer_name, std::size_t step) const {
    for (std::size_t s = 0; s < meta["structures"].size(); ++s) {
      const Json& layers = meta["structures"][s]["layers"];
      for (std::size_t l = 0; l < layers.size(); ++l) {
        if (layers[l]["name"] != layer_name) continue;
        const std::size_t arity = layers[l]["arity"];
        const Ids initial = words("initial-" + std::to_string(s) + "-" + std::to_string(l));
        const Ids steps = events(s).step;
        State state;
        for (std::size_t i = 0; i < initial.size(); i += arity)
          state.insert(Ids(initial.begin() + static_cast<std::ptrdiff_t>(i),
                           initial.begin() + static_cast<std::ptrdiff_t>(i + arity)));
        EXPECT_EQ(state.size(), layers[l]["initial"]);
        for (const Change& change : changes(s, l)) {
          if (steps.at(change.event) >= step) break;
          for (const Ids& ids : change.removed) EXPECT_EQ(state.erase(ids), 1U);
          for (const Ids& ids : change.added) EXPECT_TRUE(state.insert(ids).second);
        }
        return state;
      }
    }
    throw std::runtime_error("no layer " + layer_name);
  }

  Json meta;

 private:
  static std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t at = text.rfind(begin) + begin.size();
    return text.substr(at, text.find(end, at) - at);
  }
  static Ids words_of(const std::string& bytes, std::size_t begin, std::size_t count) {
    Ids words;
    for (std::size_t at = begin; words.size() < count && at < bytes.size(); at += 4) {
      std::uint32_t word = 0;
      for (std::size_t k = 4; k-- > 0;) word = word << 8U | static_cast<std::uint8_t>(bytes.at(at + k));
      words.push_back(word);
    }
    return words;
  }
  /// Returns words that are stored as differences from the word before.
  static Ids sums(const std::string& bytes, std::size_t& at, std::size_t count) {
    Ids words;
    while (words.size() < count)
      words.push_back(static_cast<std::uint32_t>(varint(bytes, at) + (words.empty() ? 0 : words.back())));
    return words;
  }
  static std::int64_t varint(const std::string& bytes, std::size_t& at) {
    std::uint64_t zigzag = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<std::uint8_t>(bytes.at(at++));
      zigzag |= std::uint64_t{byte & 127U} << shift;
      if (byte < 128) break;
    }
    return zigzag % 2 == 0 ? static_cast<std::int64_t>(zigzag / 2)
                           : -static_cast<std::int64_t>(zigzag / 2) - 1;
  }
  [[nodiscard]] double place(std::int64_t number, std::size_t axis) const {
    return meta["origin"][axis].get<double>() + static_cast<double>(number) * meta["quantum"].get<double>();
  }

  std::map<std::string, std::string> texts_;
  mutable std::vector<std::vector<std::int64_t>> quanta_;
};

}  // namespace kds::test
