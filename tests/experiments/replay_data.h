#pragma once
// Reads the data of a replay page, as docs/formats.md describes them, without the code that writes them.

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
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

  /// Returns a block's bytes after decompression. Checks that the page tells their number.
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
    std::vector<double> lower, upper;
    std::vector<std::string> kind;
    std::vector<Ids> ids;
  };
  [[nodiscard]] Events events(std::size_t structure) const {
    const Json& about = meta["structures"][structure];
    const std::size_t n = about["events"];
    const std::string bytes = block("events-" + std::to_string(structure));
    Events events{words_of(bytes, 0, n), words_of(bytes, 4 * n, n), {}, {}, {}, {}};
    std::size_t ids = 27 * n;
    for (std::size_t e = 0; e < n; ++e) {
      events.lower.push_back(number(bytes, 8 * n + 8 * e));
      events.upper.push_back(number(bytes, 16 * n + 8 * e));
      events.kind.push_back(about["kinds"].at(static_cast<std::uint8_t>(bytes.at(24 * n + e)))["name"]);
      EXPECT_EQ(static_cast<std::uint8_t>(bytes.at(25 * n + e)), 255);
      const auto size = static_cast<std::uint8_t>(bytes.at(26 * n + e));
      events.ids.push_back(words_of(bytes, ids, size));
      ids += 4U * size;
    }
    EXPECT_EQ(ids, bytes.size());
    return events;
  }

  /// Returns the elements of a layer when all events of the steps before `step` are applied.
  [[nodiscard]] State state(const std::string& layer_name, std::size_t step) const {
    for (std::size_t s = 0; s < meta["structures"].size(); ++s) {
      const Json& layers = meta["structures"][s]["layers"];
      for (std::size_t l = 0; l < layers.size(); ++l) {
        if (layers[l]["name"] != layer_name) continue;
        const std::string suffix = "-" + std::to_string(s) + "-" + std::to_string(l);
        const std::size_t arity = layers[l]["arity"];
        const Ids initial = words("initial" + suffix), changes = words("changes" + suffix);
        const Ids steps = events(s).step;
        State state;
        for (std::size_t i = 0; i < initial.size(); i += arity)
          state.insert(Ids(initial.begin() + static_cast<std::ptrdiff_t>(i),
                           initial.begin() + static_cast<std::ptrdiff_t>(i + arity)));
        EXPECT_EQ(state.size(), layers[l]["initial"]);
        for (std::size_t at = 0; at < changes.size() && steps.at(changes[at]) < step;) {
          const std::size_t gone = changes.at(at + 1), all = gone + changes.at(at + 2);
          at += 3;
          for (std::size_t k = 0; k < all; ++k, at += arity) {
            const Ids ids(changes.begin() + static_cast<std::ptrdiff_t>(at),
                          changes.begin() + static_cast<std::ptrdiff_t>(at + arity));
            EXPECT_TRUE(k < gone ? state.erase(ids) == 1 : state.insert(ids).second);
          }
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
  static double number(const std::string& bytes, std::size_t at) {
    std::uint64_t bits = 0;
    for (std::size_t k = 8; k-- > 0;) bits = bits << 8U | static_cast<std::uint8_t>(bytes.at(at + k));
    return std::bit_cast<double>(bits);
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
