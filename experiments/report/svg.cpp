#include "experiments/report/forms.h"
#include "kernel/base/text/printable.h"
#include "kernel/base/text/xml.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace oriel::report {

namespace {

/// A straight scale of values with round numbers along it.
class Axis {
 public:
  /// Reaches from `low` to `high` and a little beyond, on a drawing from `from` to `to`; with about
  /// `ticks` round numbers. A range without width gets one.
  Axis(double low, double high, double from, double to, int ticks);

  /// Where a value is drawn.
  [[nodiscard]] double at(double value) const;
  [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }
  /// "0.85", with as many decimals as the distance of the numbers needs.
  [[nodiscard]] std::string text(double tick) const;

 private:
  double low_, high_, from_, to_;
  int decimals_ = 0;
  std::vector<double> ticks_;
};

/// So much of the range stays free at each end.
constexpr double kFree = 0.04;
/// Half the width of a range that has none, as a share of its value, and at least.
constexpr double kShareAround = 0.05;
constexpr double kLeastAround = 0.01;

struct TickStep {
  double width = 1;
  int decimals = 0;
};

/// The smallest of 1, 2 and 5 times a power of ten that is at least `least`.
TickStep step_of(double least) {
  const int power = static_cast<int>(std::floor(std::log10(least)));
  for (const int factor : {1, 2, 5}) {
    const double width = factor * std::pow(10, power);
    if (width >= least) return {width, std::max(0, -power)};
  }
  return {std::pow(10, power + 1), std::max(0, -power - 1)};
}

Axis::Axis(double low, double high, double from, double to, int ticks)
    : low_(low), high_(high), from_(from), to_(to) {
  if (!(high_ > low_)) {
    const double around = std::max(kLeastAround, kShareAround * std::abs(low));
    low_ -= around;
    high_ += around;
  }
  const double free = kFree * (high_ - low_);
  low_ -= free;
  high_ += free;
  const TickStep step = step_of((high_ - low_) / ticks);
  decimals_ = step.decimals;
  const auto first = static_cast<long>(std::ceil(low_ / step.width));
  const auto last = static_cast<long>(std::floor(high_ / step.width));
  for (long i = first; i <= last; ++i) ticks_.push_back(static_cast<double>(i) * step.width);
}

double Axis::at(double value) const {
  return from_ + (value - low_) / (high_ - low_) * (to_ - from_);
}

std::string Axis::text(double tick) const { return fmt::format("{:.{}f}", tick, decimals_); }

/// Sizes of a figure, in pixels.
constexpr double kPanelWidth = 270, kPanelHeight = 190, kColumns = 3;
constexpr double kLeft = 52, kRight = 12, kTop = 30, kBottom = 40, kTitle = 34;
constexpr double kPlotWidth = 470, kLetterWidth = 6.2, kRowHeight = 16, kLegendHeight = 18;
constexpr double kRadius = 3;
/// Of a letter in the title and in names, about; longer names are cut.
constexpr std::size_t kMostLetters = 62;

/// Colours that people with colour blindness tell apart (Okabe and Ito 2008).
constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                              "#e69f00", "#56b4e9", "#000000"};

std::string shortened(const std::string& text) {
  if (text.size() <= kMostLetters) return text;
  std::size_t end = kMostLetters - 1;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "…";
}

/// Puts pieces of a drawing one after the other.
class Drawing {
 public:
  void line(double x1, double y1, double x2, double y2, const char* style) {
    text_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1,
                         y1, x2, y2, style);
  }
  /// `anchor`: start, middle or end.
  void text(double x, double y, const char* anchor, const std::string& words,
            const std::string& more = "") {
    text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                         anchor, more, escaped_xml(printable(words)));
  }
  void dot(double x, double y, const char* colour, const std::string& title) {
    text_ += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"><title>{}</title></circle>\n", x,
        y, kRadius, colour, escaped_xml(printable(title)));
  }
  void path(const std::string& points, const char* colour) {
    text_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\"/>\n", points, colour);
  }
  void whisker(double x1, double y1, double x2, double y2, const char* colour) {
    line(x1, y1, x2, y2, fmt::format("stroke=\"{}\" stroke-opacity=\"0.5\"", colour).c_str());
  }
  [[nodiscard]] std::string finish(double width, double height) const {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"11\" "
        "fill=\"#1d2733\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{2}</svg>\n",
        width, height, text_);
  }

 private:
  std::string text_;
};

constexpr const char* kGrid = "stroke=\"#dde3e9\"";
constexpr const char* kReference = "stroke=\"#777\" stroke-dasharray=\"4 3\"";

struct DrawnRange {
  double low, high;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Of the values of all panels with their intervals, and of the reference.
DrawnRange range_of_values(const Chart& chart) {
  const double first = chart.reference.value_or(chart.panels.front().points.front().y);
  DrawnRange range{first, first};
  for (const ChartPanel& panel : chart.panels)
    for (const ChartPoint& point : panel.points) {
      range.add(point.y);
      if (!point.interval || !(point.interval->low <= point.interval->high)) continue;
      range.add(point.interval->low);
      range.add(point.interval->high);
    }
  return range;
}

/// "parapet (m) 0.8: 0.9123 (0.8900 to 0.9300)"
std::string title_of(const std::string& name, const ChartPoint& point) {
  std::string title = fmt::format("{}: {:.4f}", name, point.y);
  if (point.interval)
    title += fmt::format(" ({:.4f} to {:.4f})", point.interval->low, point.interval->high);
  return title;
}

/// A panel whose upper left corner is at (left, top).
void draw_lines(Drawing& drawing, const Chart& chart, const ChartPanel& panel, DrawnRange values,
                double left, double top) {
  const double right = left + kPanelWidth - kRight, bottom = top + kPanelHeight - kBottom;
  DrawnRange xs{panel.points.front().x, panel.points.front().x};
  for (const ChartPoint& point : panel.points) xs.add(point.x);
  const Axis x(xs.low, xs.high, left + kLeft, right, 4);
  const Axis y(values.low, values.high, bottom, top + kTop, 4);
  drawing.text(left + kLeft, top + kTop - 8, "start", panel.title, " font-weight=\"bold\"");
  for (const double tick : y.ticks()) {
    drawing.line(left + kLeft, y.at(tick), right, y.at(tick), kGrid);
    drawing.text(left + kLeft - 5, y.at(tick) + 4, "end", y.text(tick));
  }
  for (const double tick : x.ticks()) {
    drawing.line(x.at(tick), bottom, x.at(tick), bottom + 4, kGrid);
    drawing.text(x.at(tick), bottom + 15, "middle", x.text(tick));
  }
  drawing.text((left + kLeft + right) / 2, bottom + 30, "middle", panel.x_title);
  if (chart.reference)
    drawing.line(left + kLeft, y.at(*chart.reference), right, y.at(*chart.reference), kReference);
  std::string path;
  for (const ChartPoint& point : panel.points) {
    if (point.interval && point.interval->low <= point.interval->high)
      drawing.whisker(x.at(point.x), y.at(point.interval->low), x.at(point.x),
                      y.at(point.interval->high), kColours[0]);
    path += fmt::format("{:.1f},{:.1f} ", x.at(point.x), y.at(point.y));
  }
  path.pop_back();
  drawing.path(path, kColours[0]);
  for (const ChartPoint& point : panel.points)
    drawing.dot(x.at(point.x), y.at(point.y), kColours[0],
                title_of(fmt::format("{} {:.6g}", panel.x_title, point.x), point));
}

std::string svg_of_lines(const Chart& chart) {
  Drawing drawing;
  drawing.text(kRight, 20, "start", chart.title + ": " + chart.y_title, " font-size=\"14\"");
  const DrawnRange values = range_of_values(chart);
  const auto columns = std::min(static_cast<std::size_t>(kColumns), chart.panels.size());
  for (std::size_t i = 0; i < chart.panels.size(); ++i)
    draw_lines(drawing, chart, chart.panels[i], values,
               kPanelWidth * static_cast<double>(i % columns),
               kTitle + kPanelHeight * static_cast<double>(i / columns));
  const std::size_t rows = (chart.panels.size() + columns - 1) / columns;
  return drawing.finish(std::max(kPanelWidth * static_cast<double>(columns), 2 * kPanelWidth),
                        kTitle + kPanelHeight * static_cast<double>(rows));
}

/// Each once, in their order.
std::vector<std::string> words_of(const ChartPanel& panel, std::string ChartPoint::*member) {
  std::vector<std::string> words;
  for (const ChartPoint& point : panel.points)
    if (std::ranges::find(words, point.*member) == words.end()) words.push_back(point.*member);
  return words;
}

double index_in(const std::vector<std::string>& words, const std::string& word) {
  return static_cast<double>(std::ranges::find(words, word) - words.begin());
}

/// Of the longest, as it is drawn, with room beside it.
double width_of_names(const std::vector<std::string>& names) {
  std::size_t most = 0;
  for (const std::string& name : names) most = std::max(most, shortened(name).size());
  return 2 * kRight + kLetterWidth * static_cast<double>(most);
}

std::string svg_of_dots(const Chart& chart) {
  const ChartPanel& panel = chart.panels.front();
  const std::vector<std::string> names = words_of(panel, &ChartPoint::name);
  const std::vector<std::string> series = words_of(panel, &ChartPoint::series);
  const auto count = static_cast<double>(series.size());
  const double row = std::max(kRowHeight, 4 + 2 * (kRadius + 1) * count);
  const double legend = series.front().empty() ? 0 : kLegendHeight * count;
  const double top = kTitle + legend;
  const double bottom = top + row * static_cast<double>(names.size());
  const double left = width_of_names(names);
  const double right = left + kPlotWidth;
  const DrawnRange values = range_of_values(chart);
  const Axis x(values.low, values.high, left, right, 8);
  Drawing drawing;
  drawing.text(kRight, 20, "start", chart.title, " font-size=\"14\"");
  for (std::size_t i = 0; legend > 0 && i < series.size(); ++i) {
    const double y = kTitle + kLegendHeight * (static_cast<double>(i) + 0.3);
    drawing.dot(left + kRadius, y, kColours[i % kColours.size()], series[i]);
    drawing.text(left + 12, y + 4, "start", series[i]);
  }
  for (const double tick : x.ticks()) {
    drawing.line(x.at(tick), top, x.at(tick), bottom, kGrid);
    drawing.text(x.at(tick), bottom + 15, "middle", x.text(tick));
  }
  drawing.text((left + right) / 2, bottom + 30, "middle", panel.x_title);
  for (std::size_t i = 0; i < names.size(); ++i)
    drawing.text(left - 8, top + row * (static_cast<double>(i) + 0.5) + 4, "end",
                 shortened(names[i]));
  if (chart.reference)
    drawing.line(x.at(*chart.reference), top, x.at(*chart.reference), bottom, kReference);
  for (const ChartPoint& point : panel.points) {
    const double which = index_in(series, point.series);
    const double y = top + row * (index_in(names, point.name) + (which + 1) / (count + 1));
    const char* colour = kColours[static_cast<std::size_t>(which) % kColours.size()];
    if (point.interval && point.interval->low <= point.interval->high)
      drawing.whisker(x.at(point.interval->low), y, x.at(point.interval->high), y, colour);
    drawing.dot(
        x.at(point.y), y, colour,
        title_of(point.series.empty() ? point.name : point.name + ", " + point.series, point));
  }
  return drawing.finish(right + kRight, bottom + kBottom);
}

}  // namespace

std::string svg_of(const Chart& chart) {
  return chart.kind == Chart::Kind::lines ? svg_of_lines(chart) : svg_of_dots(chart);
}

}  // namespace oriel::report
