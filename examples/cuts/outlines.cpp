#include "examples/cuts/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

namespace oriel::cuts {
namespace {

double distance_to_line(Corner p, Corner a, Corner b) {
  const double x = b.first - a.first, y = b.second - a.second;
  const double length = std::hypot(x, y);
  const double px = p.first - a.first, py = p.second - a.second;
  return length > 0 ? std::abs(x * py - y * px) / length : std::hypot(px, py);
}

/// Adds the corners to keep after `first` up to and with `last` (Douglas and Peucker).
void simplify(const Outline& line, std::size_t first, std::size_t last, double tolerance,
              Outline& out) {
  std::size_t farthest = first;
  double most = tolerance;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = distance_to_line(line[i], line[first], line[last]);
    if (distance > most) {
      most = distance;
      farthest = i;
    }
  }
  if (farthest != first) {
    simplify(line, first, farthest, tolerance, out);
    simplify(line, farthest, last, tolerance, out);
  } else {
    out.push_back(line[last]);
  }
}

class Tracer {
 public:
  Tracer(const Image& image, double tolerance) : image_(image), tolerance_(tolerance) {}

  std::vector<std::vector<Outline>> run() {
    collect();
    std::vector<std::vector<Outline>> out(image_.surfaces.size() + 1);
    for (std::size_t label = 1; label < out.size(); ++label)
      while (!starts_[label].empty()) {
        Outline outline = smoothed(trace(starts_[label]));
        if (outline.size() > 2) out[label].push_back(std::move(outline));
      }
    return out;
  }

 private:
  /// The ends of the sides that start at a corner, the label on their right.
  using Sides = std::map<Corner, std::vector<Corner>>;

  void collect() {
    starts_.resize(image_.surfaces.size() + 1);
    for (int y = 0; y < image_.height; ++y)
      for (int x = 0; x < image_.width; ++x) {
        const int label = image_.label(x, y);
        if (label == 0) continue;
        Sides& sides = starts_[static_cast<std::size_t>(label)];
        if (image_.label(x, y - 1) != label) sides[{x, y}].emplace_back(x + 1, y);
        if (image_.label(x + 1, y) != label) sides[{x + 1, y}].emplace_back(x + 1, y + 1);
        if (image_.label(x, y + 1) != label) sides[{x + 1, y + 1}].emplace_back(x, y + 1);
        if (image_.label(x - 1, y) != label) sides[{x, y + 1}].emplace_back(x, y);
      }
  }

  static Outline trace(Sides& sides) {
    Outline outline;
    Corner at = sides.begin()->first;
    for (auto next = sides.begin(); next != sides.end(); next = sides.find(at)) {
      outline.push_back(at);
      at = next->second.back();
      next->second.pop_back();
      if (next->second.empty()) sides.erase(next);
    }
    return outline;
  }

  /// Three lines or more meet there.
  [[nodiscard]] bool is_fork(Corner c) const {
    const int a = image_.label(c.first - 1, c.second - 1), b = image_.label(c.first, c.second - 1);
    const int d = image_.label(c.first - 1, c.second), e = image_.label(c.first, c.second);
    return (a != b) + (b != e) + (e != d) + (d != a) > 2;
  }

  [[nodiscard]] Outline smoothed(Outline outline) const {
    const auto is_fork_here = [this](Corner c) { return is_fork(c); };
    auto start = std::ranges::find_if(outline, is_fork_here);
    if (start == outline.end()) start = std::ranges::min_element(outline);
    std::ranges::rotate(outline, start);
    outline.push_back(outline.front());
    Outline out;
    for (std::size_t first = 0, last = 1; last < outline.size(); ++last)
      if (last + 1 == outline.size() || is_fork(outline[last])) {
        add_stretch({outline.begin() + static_cast<std::ptrdiff_t>(first),
                     outline.begin() + static_cast<std::ptrdiff_t>(last) + 1},
                    out);
        first = last;
      }
    return out;
  }

  /// Smooths a stretch between forks, the same whichever way it is walked.
  void add_stretch(Outline line, Outline& out) const {
    if (line.front() == line.back()) {
      const auto farther = [&](Corner p, Corner q) {
        const auto square = [&](Corner c) {
          const int x = c.first - line[0].first, y = c.second - line[0].second;
          return x * x + y * y;
        };
        return std::pair(square(p), p) < std::pair(square(q), q);
      };
      const auto middle = std::ranges::max_element(line, farther);
      add_stretch({line.begin(), middle + 1}, out);
      add_stretch({middle, line.end()}, out);
      return;
    }
    const bool is_turned = line.back() < line.front();
    if (is_turned) std::ranges::reverse(line);
    Outline kept{line.front()};
    simplify(line, 0, line.size() - 1, tolerance_, kept);
    if (is_turned) std::ranges::reverse(kept);
    out.insert(out.end(), kept.begin(), kept.end() - 1);
  }

  const Image& image_;
  double tolerance_;
  std::vector<Sides> starts_;
};

}  // namespace

std::vector<std::vector<Outline>> outlines(const Image& image, double tolerance) {
  return Tracer(image, tolerance).run();
}

}  // namespace oriel::cuts
