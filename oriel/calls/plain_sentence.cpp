#include "oriel/explain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace oriel {

namespace {

/// What slopes so is called a wall, whatever the pack's `hosts:` say.
constexpr double kSteepestRoof_deg = 75;
constexpr double kLeastOverhang_deg = 105;
/// Shorter lengths are said in centimetres.
constexpr double kLeastMetres = 0.095;
/// What is as deep counts as flat.
constexpr double kFlat_m = 0.005;

class SentenceOfFeature {
 public:
  SentenceOfFeature(const PipelineResult& result, const Interpretation& interpretation,
                    FeatureId feature)
      : result_(result),
        interpretation_(interpretation),
        table_(result_.description.table),
        feature_(feature),
        what_(result_.segmentation->features[feature.index()]) {}

  [[nodiscard]] std::string text() const {
    const std::string& label = label_of(feature_);
    std::string text = fmt::format("{}: {} {} {}", label.empty() ? "unknown" : label, size(),
                                   kind_word(what_.sense), place());
    for (const std::string& part : {depth(), height(), company()})
      if (!part.empty()) text += ", " + part;
    return text;
  }

 private:
  [[nodiscard]] const std::string& label_of(FeatureId feature) const {
    return interpretation_.verdicts[feature.index()].label.text();
  }

  [[nodiscard]] std::optional<double> number(Attribute attribute) const {
    return table_.number(feature_, attribute);
  }

  static std::string length(double metres) {
    if (std::abs(metres) < kLeastMetres) return fmt::format("{:.0f} cm", 100 * metres);
    return fmt::format("{:.1f} m", metres);
  }

  /// "1.1 × 1.4 m", in metres or in centimetres both.
  static std::string area(double across, double high) {
    if (std::max(across, high) < kLeastMetres)
      return fmt::format("{:.0f} × {:.0f} cm", 100 * across, 100 * high);
    const auto metres = [](double value) {
      return fmt::format("{:.{}f}", value, value < kLeastMetres ? 2 : 1);
    };
    return fmt::format("{} × {} m", metres(across), metres(high));
  }

  [[nodiscard]] bool is_on_wall() const {
    const double slope = number(Attribute::host_inclination).value_or(0);
    return slope >= kSteepestRoof_deg && slope <= kLeastOverhang_deg;
  }

  /// "a 1.1 × 1.4 m": as seen from in front of a wall, else from above.
  [[nodiscard]] std::string size() const {
    const auto width = number(Attribute::width);
    const auto across = is_on_wall() ? number(Attribute::height) : number(Attribute::depth);
    if (width && is_on_wall() && across) return article(area(*width, *across));
    const Vec3 extent = what_.box.max - what_.box.min;
    return article(area(std::max(extent.x, extent.y), std::min(extent.x, extent.y)));
  }

  /// "an 8 …", "an 11.0 …".
  static std::string article(const std::string& size) {
    const bool has_vowel = size.starts_with('8') || size.starts_with("11.") ||
                           size.starts_with("18.") || size.starts_with("11 ") ||
                           size.starts_with("18 ");
    return (has_vowel ? "an " : "a ") + size;
  }

  [[nodiscard]] std::string place() const {
    const auto slope = number(Attribute::host_inclination);
    if (!slope || what_.sense == Sense::cavity) return "inside the building";
    const bool is_in = what_.sense == Sense::hole;
    if (is_on_wall()) return is_in ? "in a wall" : "on a wall";
    if (*slope > kLeastOverhang_deg) return is_in ? "in an underside" : "on an underside";
    return is_in ? "in a roof" : "on a roof";
  }

  [[nodiscard]] std::string depth() const {
    const auto depth = number(Attribute::depth);
    if (!depth || *depth < kFlat_m || what_.sense == Sense::imprint) return "";
    if (what_.sense != Sense::protrusion) return length(*depth) + " deep";
    if (is_on_wall()) return "sticking out " + length(*depth);
    const auto high = number(Attribute::height);
    return high ? length(*high) + " high" : "";
  }

  [[nodiscard]] std::string height() const {
    const auto base = number(Attribute::base_height);
    if (!base || !is_on_wall()) return "";
    if (std::abs(*base) < kFlat_m) return "from the ground up";
    return *base > 0 ? length(*base) + " above the ground" : length(-*base) + " below the ground";
  }

  /// "one of a row of four": those with the same label in the same storey of the same facade.
  [[nodiscard]] std::string company() const {
    const FeatureGraph& graph = result_.description.graph;
    const auto beside = graph.others("same_facade", feature_);
    std::size_t count = 1;
    for (const FeatureId other : graph.others("same_storey", feature_))
      if (std::ranges::binary_search(beside, other) && label_of(other) == label_of(feature_))
        ++count;
    if (count < 2) return "";
    static constexpr std::array<const char*, 13> kWords{"",     "",       "two",   "three", "four",
                                                        "five", "six",    "seven", "eight", "nine",
                                                        "ten",  "eleven", "twelve"};
    return "one of a row of " +
           (count < kWords.size() ? std::string(kWords[count]) : std::to_string(count));
  }

  const PipelineResult& result_;
  const Interpretation& interpretation_;
  const FeatureTable& table_;
  FeatureId feature_;
  const Feature& what_;
};

}  // namespace

std::string_view kind_word(Sense sense) {
  switch (sense) {
    case Sense::protrusion:
      return "protrusion";
    case Sense::hole:
      return "hole";
    case Sense::cavity:
      return "cavity";
    case Sense::imprint:
      return "panel";
  }
  return {};
}

std::string plain_sentence(const PipelineResult& result, const Interpretation& interpretation,
                           FeatureId feature) {
  return SentenceOfFeature(result, interpretation, feature).text();
}

}  // namespace oriel
