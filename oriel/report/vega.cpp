#include "oriel/report/forms.h"

#include <nlohmann/json.hpp>

namespace oriel::report {

namespace {

using Json = nlohmann::ordered_json;

Json values_of(const ChartPanel& panel) {
  Json values = Json::array();
  for (const ChartPoint& point : panel.points) {
    Json value{{"x", point.x}, {"name", point.name}, {"run", point.series}, {"y", point.y}};
    if (point.interval) {
      value["low"] = point.interval->low;
      value["high"] = point.interval->high;
    }
    values.push_back(std::move(value));
  }
  return values;
}

Json reference_layer(double value, const char* channel) {
  return {{"mark", {{"type", "rule"}, {"strokeDash", {4, 3}}, {"color", "#888"}}},
          {"encoding", {{channel, {{"datum", value}}}}}};
}

Json axis(const char* field, const char* type, const std::string& title) {
  return {{"field", field}, {"type", type}, {"title", title}, {"scale", {{"zero", false}}}};
}

Json tooltip(const std::string& x_title, const std::string& y_title, bool is_of_lines) {
  Json shown = Json::array();
  if (is_of_lines)
    shown.push_back({{"field", "x"}, {"title", x_title}});
  else
    shown.push_back({{"field", "name"}});
  shown.push_back({{"field", "y"}, {"title", y_title}, {"format", ".4f"}});
  shown.push_back({{"field", "low"}, {"format", ".4f"}});
  shown.push_back({{"field", "high"}, {"format", ".4f"}});
  return shown;
}

Json lines_panel(const Chart& chart, const ChartPanel& panel) {
  const Json x = axis("x", "quantitative", panel.x_title);
  const Json y = axis("y", "quantitative", chart.y_title);
  Json band_low = y, layers = Json::array();
  band_low["field"] = "low";
  layers.push_back({{"mark", {{"type", "area"}, {"opacity", 0.2}}},
                    {"encoding", {{"x", x}, {"y", band_low}, {"y2", {{"field", "high"}}}}}});
  layers.push_back(
      {{"mark", {{"type", "line"}, {"point", true}}},
       {"encoding",
        {{"x", x}, {"y", y}, {"tooltip", tooltip(panel.x_title, chart.y_title, true)}}}});
  if (chart.reference) layers.push_back(reference_layer(*chart.reference, "y"));
  return {{"title", panel.title},
          {"width", 220},
          {"height", 140},
          {"data", {{"values", values_of(panel)}}},
          {"layer", std::move(layers)}};
}

Json dots_panel(const Chart& chart, const ChartPanel& panel) {
  Json y{{"field", "name"}, {"type", "nominal"}, {"title", nullptr}, {"sort", nullptr}};
  y["axis"] = {{"labelLimit", 400}};
  Json shared{{"y", y}};
  const bool has_series = !panel.points.empty() && !panel.points.front().series.empty();
  if (has_series) {
    shared["color"] = {{"field", "run"}, {"type", "nominal"}, {"sort", nullptr}};
    shared["yOffset"] = {{"field", "run"}, {"sort", nullptr}};
  }
  Json rule = shared, dot = shared, layers = Json::array();
  rule["x"] = axis("low", "quantitative", panel.x_title);
  rule["x2"] = {{"field", "high"}};
  dot["x"] = axis("y", "quantitative", panel.x_title);
  dot["tooltip"] = tooltip("", panel.x_title, false);
  layers.push_back({{"mark", "rule"}, {"encoding", std::move(rule)}});
  layers.push_back({{"mark", {{"type", "point"}, {"filled", true}}}, {"encoding", std::move(dot)}});
  if (chart.reference) layers.push_back(reference_layer(*chart.reference, "x"));
  return {{"width", 480},
          {"height", {{"step", has_series ? 10 : 18}}},
          {"data", {{"values", values_of(panel)}}},
          {"layer", std::move(layers)}};
}

}  // namespace

std::string vega_of(const Chart& chart) {
  Json spec{{"$schema", "https://vega.github.io/schema/vega-lite/v6.json"}, {"title", chart.title}};
  if (chart.kind == Chart::Kind::dots) {
    spec.update(dots_panel(chart, chart.panels.front()));
  } else {
    Json panels = Json::array();
    for (const ChartPanel& panel : chart.panels) panels.push_back(lines_panel(chart, panel));
    spec["columns"] = 3;
    spec["concat"] = std::move(panels);
    spec["resolve"] = {{"scale", {{"y", "shared"}}}};
  }
  return spec.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace oriel::report
