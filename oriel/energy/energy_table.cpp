#include "io/cityjson/cityjson_source.h"
#include "io/json/raw_json.h"
#include "io/records/feature_records.h"
#include "kernel/base/text/json_text.h"
#include "oriel/energy.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// A table's row while it is made: names are taken along, so that both are in one place.
class EnergyRow {
 public:
  void text(std::string name, std::string_view value) {
    names_.push_back(std::move(name));
    cells_.emplace_back(value);
    is_text_.push_back(true);
  }
  void number(std::string name, std::optional<double> value) {
    names_.push_back(std::move(name));
    cells_.push_back(value ? shortest(*value) : std::string());
    is_text_.push_back(false);
  }

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// As CSV has them; empty: missing.
  [[nodiscard]] const std::vector<std::string>& cells() const { return cells_; }

  void append_object(std::string& out) const {
    out += '{';
    for (std::size_t i = 0; i < names_.size(); ++i) {
      append_json_key(out, names_[i]);
      if (cells_[i].empty())
        out += "null";
      else if (is_text_[i])
        append_json(out, std::string_view(cells_[i]));
      else
        out += cells_[i];
    }
    out += '}';
  }

 private:
  std::vector<std::string> names_, cells_;
  std::vector<bool> is_text_;
};

/// Sums over faces of an envelope; missing if nothing is known of the building.
class EnvelopeSums {
 public:
  explicit EnvelopeSums(const BuildingEnergy& of) : of_(of) {}

  using Which = std::function<bool(const EnvelopeFace&)>;
  using Amount = std::function<double(const EnvelopeFace&)>;

  [[nodiscard]] std::optional<double> sum(const Which& which, const Amount& amount) const {
    if (!of_.is_known) return std::nullopt;
    double total = 0;
    for (const EnvelopeFace& face : of_.faces)
      if (which(face)) total += amount(face);
    return total;
  }

 private:
  const BuildingEnergy& of_;
};

double exposed(const EnvelopeFace& face) { return face.exposed_m2(); }

/// Counts (0) or sums the areas (1) of the windows or doors of a face.
EnvelopeSums::Amount openings(bool is_door, bool is_area) {
  return [=](const EnvelopeFace& face) {
    double total = 0;
    for (const EnvelopeOpening& opening : face.openings)
      if (opening.is_door == is_door) total += is_area ? opening.area_m2 : 1;
    return total;
  };
}

EnvelopeSums::Which of_kind(EnvelopeKind kind) {
  return [=](const EnvelopeFace& face) { return face.kind == kind; };
}

std::optional<double> ratio(std::optional<double> part, std::optional<double> whole) {
  if (!part || !whole || *whole <= 0) return std::nullopt;
  return *part / *whole;
}

bool faces_way(const EnvelopeFace& face, std::size_t direction) {
  return face.azimuth_deg && direction_of(*face.azimuth_deg) == static_cast<Direction>(direction);
}

void add_walls(const EnvelopeSums& sums, EnergyRow& row) {
  for (std::size_t d = 0; d < kDirections; ++d) {
    const auto name = to_string(static_cast<Direction>(d));
    const auto which = [=](const EnvelopeFace& face) {
      return face.kind == EnvelopeKind::wall && faces_way(face, d);
    };
    const auto wall = sums.sum(which, exposed), window = sums.sum(which, openings(false, true));
    row.number(fmt::format("wall_{}_m2", name), wall);
    row.number(fmt::format("windows_{}", name), sums.sum(which, openings(false, false)));
    row.number(fmt::format("window_{}_m2", name), window);
    row.number(fmt::format("window_to_wall_{}", name), ratio(window, wall));
  }
}

std::size_t slope_class(double inclination_deg) {
  const auto above = std::ranges::upper_bound(kSlopeClasses_deg, inclination_deg);
  return static_cast<std::size_t>(above - kSlopeClasses_deg.begin()) - 1;
}

void add_roofs(const EnvelopeSums& sums, EnergyRow& row) {
  for (std::size_t s = 0; s < kSlopeClasses_deg.size(); ++s) {
    const double to = s + 1 < kSlopeClasses_deg.size() ? kSlopeClasses_deg[s + 1] : 90;
    const std::string slopes = fmt::format("roof_{:.0f}_{:.0f}deg", kSlopeClasses_deg[s], to);
    const auto is_so_steep = [=](const EnvelopeFace& face) {
      return face.kind == EnvelopeKind::roof && slope_class(face.inclination_deg) == s;
    };
    if (s == 0) {
      row.number(slopes + "_m2", sums.sum(is_so_steep, exposed));
      continue;
    }
    for (std::size_t d = 0; d < kDirections; ++d)
      row.number(fmt::format("{}_{}_m2", slopes, to_string(static_cast<Direction>(d))),
                 sums.sum([=](const EnvelopeFace& f) { return is_so_steep(f) && faces_way(f, d); },
                          exposed));
  }
}

bool knows_neighbours(const BuildingEnergy& of) {
  return std::ranges::any_of(of.faces,
                             [](const EnvelopeFace& face) { return face.party_m2.has_value(); });
}

EnergyRow building_row(const BuildingEnergy& of) {
  const EnvelopeSums sums(of);
  const auto any = [](const EnvelopeFace&) { return true; };
  const auto wall = of_kind(EnvelopeKind::wall), roof = of_kind(EnvelopeKind::roof);
  const auto known = [&](double value) {
    return of.is_known ? std::optional(value) : std::nullopt;
  };
  EnergyRow row;
  row.text("building", of.building);
  row.text("lod", of.lod);
  row.number("closed", known(of.is_closed ? 1 : 0));
  row.number("not_separated", known(of.not_separated));
  row.number("volume_m3", known(of.volume_m3));
  row.number("height_m", known(of.height_m));
  row.number("storeys", of.storeys ? std::optional<double>(*of.storeys) : std::nullopt);
  row.text("storeys_source", of.storeys_source);
  const auto envelope = sums.sum(any, exposed);
  row.number("envelope_m2", envelope);
  row.number("envelope_to_volume_per_m", ratio(envelope, known(of.volume_m3)));
  row.number("wall_m2", sums.sum(wall, exposed));
  row.number("party_wall_m2",
             knows_neighbours(of)
                 ? sums.sum(wall, [](const EnvelopeFace& f) { return f.party_m2.value_or(0); })
                 : std::nullopt);
  row.number("roof_m2", sums.sum(roof, exposed));
  row.number("ground_m2", sums.sum(of_kind(EnvelopeKind::ground), exposed));
  row.number("ceiling_m2", sums.sum(of_kind(EnvelopeKind::ceiling), exposed));
  row.number("floor_m2", sums.sum(of_kind(EnvelopeKind::floor), exposed));
  row.number("windows", sums.sum(wall, openings(false, false)));
  row.number("window_m2", sums.sum(wall, openings(false, true)));
  row.number("window_to_wall",
             ratio(sums.sum(wall, openings(false, true)), sums.sum(wall, exposed)));
  row.number("doors", sums.sum(any, openings(true, false)));
  row.number("door_m2", sums.sum(any, openings(true, true)));
  row.number("roof_windows", sums.sum(roof, openings(false, false)));
  row.number("roof_window_m2", sums.sum(roof, openings(false, true)));
  add_walls(sums, row);
  row.text("roof_form", to_string(of.roof_form));
  add_roofs(sums, row);
  return row;
}

EnergyRow face_row(const BuildingEnergy& of, const EnvelopeFace& face, std::size_t number) {
  EnergyRow row;
  row.text("building", of.building);
  row.number("face", static_cast<double>(number));
  row.text("kind", to_string(face.kind));
  row.number("inclination_deg", face.inclination_deg);
  row.number("azimuth_deg", face.azimuth_deg);
  row.text("direction", face.azimuth_deg ? to_string(direction_of(*face.azimuth_deg)) : "");
  row.number("area_m2", face.area_m2);
  row.number("party_wall_m2", face.party_m2);
  row.number("windows", openings(false, false)(face));
  const double window = openings(false, true)(face);
  row.number("window_m2", window);
  row.number("window_share", ratio(window, face.exposed_m2()));
  row.number("doors", openings(true, false)(face));
  row.number("door_m2", openings(true, true)(face));
  return row;
}

std::vector<EnergyRow> rows_of(EnergyTable table, const BuildingEnergy& of) {
  std::vector<EnergyRow> rows;
  if (table == EnergyTable::buildings) {
    rows.push_back(building_row(of));
    return rows;
  }
  for (std::size_t i = 0; i < of.faces.size(); ++i)
    rows.push_back(face_row(of, of.faces[i], i + 1));
  return rows;
}

}  // namespace

std::string_view to_string(EnergyTable table) {
  return table == EnergyTable::buildings ? "energy" : "envelope";
}

std::vector<std::string> energy_columns(EnergyTable table) {
  BuildingEnergy empty;
  empty.faces.emplace_back();
  return rows_of(table, empty).front().names();
}

std::string energy_rows(EnergyTable table, TableFormat format, const BuildingEnergy& of) {
  std::string out;
  for (const EnergyRow& row : rows_of(table, of)) {
    if (format == TableFormat::csv) {
      append_csv_line(out, row.cells());
      continue;
    }
    if (format == TableFormat::json && !out.empty()) out += ",\n";
    row.append_object(out);
    if (format == TableFormat::jsonl) out += '\n';
  }
  return out;
}

std::vector<std::optional<int>> stated_storeys(const Document& document) {
  std::vector<std::optional<int>> stated(document.buildings.size());
  if (!document.source) return stated;
  const CityJsonSource& source = *document.source;
  const std::string_view text = source.text;
  const std::size_t start = text.find('{');
  if (start == std::string_view::npos) return stated;
  const RawNode root(text.substr(start, text.rfind('}') + 1 - start));
  const std::string_view objects_text = root.value_of("CityObjects");
  if (!RawNode::is_object(objects_text)) return stated;
  const RawNode objects(objects_text);
  for (std::size_t i = 0; i < stated.size() && i < source.places.size(); ++i) {
    const std::string_view object = objects.value(source.places[i].object);
    if (!RawNode::is_object(object)) continue;
    const std::string_view attributes = RawNode(object).value_of("attributes");
    if (!RawNode::is_object(attributes)) continue;
    const std::string value(RawNode(attributes).value_of("storeysAboveGround"));
    int storeys = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), storeys);
    if (error == std::errc() && end == value.data() + value.size() && storeys >= 0)
      stated[i] = storeys;
  }
  return stated;
}

}  // namespace oriel
