#include "tests/support/grid_reference.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <tuple>

namespace oriel::test {

namespace {

using Cells = std::vector<char>;

/// An oriented plane: outward along +axis or -axis at the grid's line `line` of that axis.
struct GridPlane {
  int axis, sign, line;
  friend bool operator==(const GridPlane&, const GridPlane&) = default;
};

struct Part {
  Cells cells;
  std::int64_t new_area = 0, volume = 0;
};

/// A group of parts with the same planes, kind and value.
struct Cut {
  bool is_hole = false;
  std::vector<GridPlane> planes;
  std::int64_t old_area = 0;
  std::vector<Part> parts;
  [[nodiscard]] std::int64_t volume() const {
    std::int64_t sum = 0;
    for (const Part& p : parts) sum += p.volume;
    return sum;
  }
};

class GridSegmenter {
 public:
  explicit GridSegmenter(const std::vector<GridBox>& boxes) {
    for (std::size_t a = 0; a < 3; ++a) {
      for (const GridBox& box : boxes) lines_[a].insert(lines_[a].end(), {box.min[a], box.max[a]});
      std::ranges::sort(lines_[a]);
      lines_[a].erase(std::unique(lines_[a].begin(), lines_[a].end()), lines_[a].end());
      // One layer of cells around: the open.
      lines_[a].insert(lines_[a].begin(), lines_[a].front() - 1);
      lines_[a].push_back(lines_[a].back() + 1);
      size_[a] = static_cast<int>(lines_[a].size()) - 1;
    }
    body_.assign(count(), 0);
    for (const GridBox& box : boxes)
      for (std::size_t c = 0; c < count(); ++c)
        if (is_in(c, box)) body_[c] = box.is_added ? 1 : 0;
  }

  Reference run() {
    std::vector<Cells> lumps = pieces(body_);
    if (lumps.size() > 1) ++out_.inner;
    for (Cells& lump : lumps) split(std::move(lump));
    std::ranges::sort(out_.features);
    return out_;
  }

 private:
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
           static_cast<std::size_t>(size_[2]);
  }
  [[nodiscard]] std::array<int, 3> place(std::size_t c) const {
    const int i = static_cast<int>(c);
    return {i % size_[0], i / size_[0] % size_[1], i / size_[0] / size_[1]};
  }
  [[nodiscard]] std::size_t cell(const std::array<int, 3>& p) const {
    return static_cast<std::size_t>((p[2] * size_[1] + p[1]) * size_[0] + p[0]);
  }
  [[nodiscard]] std::int64_t width(std::size_t axis, int i) const {
    return lines_[axis][static_cast<std::size_t>(i) + 1] -
           lines_[axis][static_cast<std::size_t>(i)];
  }
  [[nodiscard]] bool is_in(std::size_t c, const GridBox& box) const {
    const auto p = place(c);
    for (std::size_t a = 0; a < 3; ++a) {
      const int low = lines_[a][static_cast<std::size_t>(p[a])];
      if (low < box.min[a] || low >= box.max[a]) return false;
    }
    return true;
  }
  [[nodiscard]] std::int64_t volume(std::size_t c) const {
    const auto p = place(c);
    return width(0, p[0]) * width(1, p[1]) * width(2, p[2]);
  }
  [[nodiscard]] std::int64_t face(std::size_t c, int axis) const {
    return volume(c) /
           width(static_cast<std::size_t>(axis), place(c)[static_cast<std::size_t>(axis)]);
  }
  /// The neighbour along an axis; nothing at the rim of the grid.
  [[nodiscard]] std::optional<std::size_t> next(std::size_t c, int axis, int sign) const {
    auto p = place(c);
    int& along = p[static_cast<std::size_t>(axis)];
    along += sign;
    if (along < 0 || along >= size_[static_cast<std::size_t>(axis)]) return std::nullopt;
    return cell(p);
  }
  template <class Visit>
  void for_each_neighbour(std::size_t c, Visit visit) const {
    for (int axis = 0; axis < 3; ++axis)
      for (const int sign : {1, -1})
        if (const auto n = next(c, axis, sign))
          visit(*n, GridPlane{axis, sign, line_of(c, axis, sign)});
  }
  /// The line between a cell and its neighbour.
  [[nodiscard]] int line_of(std::size_t c, int axis, int sign) const {
    return place(c)[static_cast<std::size_t>(axis)] + (sign > 0 ? 1 : 0);
  }
  [[nodiscard]] bool is_in_front(std::size_t c, const GridPlane& h) const {
    const int p = place(c)[static_cast<std::size_t>(h.axis)];
    return h.sign > 0 ? p >= h.line : p < h.line;
  }

  /// Sets of cells that hang together over faces.
  [[nodiscard]] std::vector<Cells> pieces(const Cells& cells) const {
    std::vector<Cells> all;
    Cells left = cells;
    for (std::size_t start = 0; start < count(); ++start) {
      if (!left[start]) continue;
      Cells piece(count(), 0);
      std::vector<std::size_t> stack{start};
      left[start] = 0;
      while (!stack.empty()) {
        const std::size_t c = stack.back();
        stack.pop_back();
        piece[c] = 1;
        for_each_neighbour(c, [&](std::size_t n, const GridPlane&) {
          if (!left[n]) return;
          left[n] = 0;
          stack.push_back(n);
        });
      }
      all.push_back(std::move(piece));
    }
    return all;
  }

  [[nodiscard]] bool is_open(const Cells& piece) const {
    for (std::size_t c = 0; c < count(); ++c) {
      const auto p = place(c);
      for (std::size_t a = 0; a < 3; ++a)
        if (piece[c] && (p[a] == 0 || p[a] == size_[a] - 1)) return true;
    }
    return false;
  }

  [[nodiscard]] std::int64_t volume_of(const Cells& cells) const {
    std::int64_t sum = 0;
    for (std::size_t c = 0; c < count(); ++c) sum += cells[c] ? volume(c) : 0;
    return sum;
  }

  /// Full boxes are the convex bodies here.
  [[nodiscard]] bool is_convex(const Cells& cells) const {
    std::array<int, 3> low{size_[0], size_[1], size_[2]}, high{-1, -1, -1};
    for (std::size_t c = 0; c < count(); ++c)
      for (std::size_t a = 0; cells[c] && a < 3; ++a) {
        low[a] = std::min(low[a], place(c)[a]);
        high[a] = std::max(high[a], place(c)[a]);
      }
    for (std::size_t c = 0; c < count(); ++c) {
      const auto p = place(c);
      const bool is_inside = p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] &&
                             p[1] <= high[1] && p[2] >= low[2] && p[2] <= high[2];
      if (is_inside && !cells[c]) return false;
    }
    return true;
  }

  /// Around some edge two cells are in and the two between them are not.
  [[nodiscard]] bool touches_itself(const Cells& cells) const {
    for (std::size_t c = 0; c < count(); ++c)
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        for (const int sign : {1, -1}) {
          const auto n = next(c, a, 1), m = next(c, b, sign);
          if (!n || !m) continue;
          const auto d = next(*n, b, sign);
          if (cells[c] && cells[*d] && !cells[*n] && !cells[*m]) return true;
          if (!cells[c] && !cells[*d] && cells[*n] && cells[*m]) return true;
        }
      }
    return false;
  }

  [[nodiscard]] std::vector<std::pair<GridPlane, std::int64_t>> planes_of(const Cells& body) const {
    std::map<std::tuple<int, int, int>, std::int64_t> areas;
    for (std::size_t c = 0; c < count(); ++c)
      if (body[c])
        for_each_neighbour(c, [&](std::size_t n, const GridPlane& h) {
          // z before y before x, then by offset: the order of the kernel's planes.
          if (!body[n]) areas[{-h.axis, h.line, -h.sign}] += face(c, h.axis);
        });
    std::vector<std::pair<GridPlane, std::int64_t>> planes;
    for (const auto& [key, area] : areas) {
      const auto& [axis, line, sign] = key;
      planes.push_back({{-axis, -sign, line}, area});
    }
    return planes;
  }

  void split(Cells body) {
    out_.is_degenerate |= touches_itself(body);
    take_out_cavities(body);
    while (!is_convex(body)) {
      const auto cut = best_cut(body);
      if (!cut) break;
      ++out_.inner;
      for (const Part& part : cut->parts) {
        out_.features.push_back({cut->is_hole, static_cast<int>(cut->planes.size()), part.new_area,
                                 cut->old_area, part.volume});
        for (std::size_t c = 0; c < count(); ++c)
          if (part.cells[c]) body[c] = cut->is_hole ? 1 : 0;
        split(part.cells);
      }
      out_.is_degenerate |= touches_itself(body);
      if (std::vector<Cells> rest = pieces(body); rest.size() > 1) {
        for (Cells& piece : rest) split(std::move(piece));
        return;
      }
    }
    ++out_.leaves;
  }

  void take_out_cavities(Cells& body) {
    Cells air(count());
    for (std::size_t c = 0; c < count(); ++c) air[c] = body[c] ? 0 : 1;
    bool has_any = false;
    for (Cells& piece : pieces(air)) {
      if (is_open(piece)) continue;
      has_any = true;
      for (std::size_t c = 0; c < count(); ++c) body[c] |= piece[c];
      out_.features.push_back({true, 0, 0, 0, volume_of(piece)});
      split(std::move(piece));
    }
    if (has_any) ++out_.inner;
  }

  [[nodiscard]] std::optional<Cut> best_cut(const Cells& body) const {
    const auto planes = planes_of(body);
    std::optional<Cut> best;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      keep_better(best, cut_of(body, {planes[i]}, false));
      keep_better(best, cut_of(body, {planes[i]}, true));
    }
    for (int order = 2; order <= 4 && !best; ++order) {
      std::vector<std::pair<GridPlane, std::int64_t>> set;
      try_sets(body, planes, 0, order, set, best);
    }
    return best;
  }

  void try_sets(const Cells& body, const std::vector<std::pair<GridPlane, std::int64_t>>& planes,
                std::size_t first, int order, std::vector<std::pair<GridPlane, std::int64_t>>& set,
                std::optional<Cut>& best) const {
    if (static_cast<int>(set.size()) == order) {
      keep_better(best, cut_of(body, set, true));
      return;
    }
    for (std::size_t i = first; i < planes.size(); ++i) {
      const auto has_normal = [&](const auto& p) {
        return p.first.axis == planes[i].first.axis && p.first.sign == planes[i].first.sign;
      };
      if (std::ranges::any_of(set, has_normal)) continue;
      set.push_back(planes[i]);
      try_sets(body, planes, i + 1, order, set, best);
      set.pop_back();
    }
  }

  /// The parts of least value that the planes cut, value below 1; nothing if there are none.
  [[nodiscard]] std::optional<Cut> cut_of(
      const Cells& body, const std::vector<std::pair<GridPlane, std::int64_t>>& set,
      bool is_hole) const {
    Cut cut{is_hole, {}, 0, {}};
    for (const auto& [plane, area] : set) {
      cut.planes.push_back(plane);
      cut.old_area += area;
    }
    Cells beyond(count());
    for (std::size_t c = 0; c < count(); ++c) {
      const auto is_before = [&](const GridPlane& h) { return is_in_front(c, h); };
      beyond[c] = is_hole ? !body[c] && std::ranges::none_of(cut.planes, is_before)
                          : body[c] && is_before(cut.planes[0]);
    }
    for (Cells& piece : pieces(beyond)) {
      if (is_hole && is_open(piece)) continue;
      Part part{std::move(piece), 0, 0};
      if (!measure(body, cut, part) || part.new_area >= cut.old_area) continue;
      if (!cut.parts.empty() && part.new_area > cut.parts[0].new_area) continue;
      if (!cut.parts.empty() && part.new_area < cut.parts[0].new_area) cut.parts.clear();
      cut.parts.push_back(std::move(part));
    }
    if (cut.parts.empty()) return std::nullopt;
    return cut;
  }

  /// Every plane carries a cap; a hole's wall lies in two planes or more.
  [[nodiscard]] bool measure(const Cells& body, const Cut& cut, Part& part) const {
    std::vector<std::int64_t> caps(cut.planes.size(), 0);
    std::vector<GridPlane> walls;
    for (std::size_t c = 0; c < count(); ++c) {
      if (!part.cells[c]) continue;
      for_each_neighbour(c, [&](std::size_t n, const GridPlane& h) {
        if (part.cells[n]) return;
        // A protrusion meets its plane from the front, a hole from behind.
        const GridPlane meant{h.axis, cut.is_hole ? h.sign : -h.sign, h.line};
        const auto plane = std::ranges::find(cut.planes, meant);
        if (plane != cut.planes.end() && (body[n] != 0) != cut.is_hole)
          caps[static_cast<std::size_t>(plane - cut.planes.begin())] += face(c, h.axis);
        else if (body[n] && std::ranges::find(walls, h) == walls.end())
          walls.push_back(h);
      });
    }
    for (const std::int64_t area : caps) {
      if (area == 0) return false;
      part.new_area += area;
    }
    part.volume = volume_of(part.cells);
    return !cut.is_hole || walls.size() >= 2;
  }

  /// Smaller value, then hole before protrusion, larger volume, planes by normal and offset.
  void keep_better(std::optional<Cut>& best, std::optional<Cut> cut) const {
    if (!cut) return;
    if (!best || is_better(*cut, *best)) best = std::move(cut);
  }

  [[nodiscard]] bool is_better(const Cut& p, const Cut& q) const {
    const std::int64_t left = p.parts[0].new_area * q.old_area,
                       right = q.parts[0].new_area * p.old_area;
    if (left != right) return left < right;
    if (p.is_hole != q.is_hole) return p.is_hole;
    if (p.volume() != q.volume()) return p.volume() > q.volume();
    const auto order = [&](const Cut& cut) {
      std::vector<std::array<int, 4>> keys;
      for (const GridPlane& h : cut.planes) {
        std::array<int, 4> key{0, 0, 0, 0};
        key[static_cast<std::size_t>(h.axis)] = h.sign;
        key[3] =
            h.sign * lines_[static_cast<std::size_t>(h.axis)][static_cast<std::size_t>(h.line)];
        keys.push_back(key);
      }
      return keys;
    };
    return order(p) > order(q);
  }

  std::array<std::vector<int>, 3> lines_;
  std::array<int, 3> size_{};
  Cells body_;
  Reference out_;
};

}  // namespace

Reference reference_of(const std::vector<GridBox>& boxes) { return GridSegmenter(boxes).run(); }

}  // namespace oriel::test
