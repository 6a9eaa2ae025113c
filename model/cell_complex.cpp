#include "model/cell_complex.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

/// 0 for the outside.
std::size_t slot_of(CellId cell) { return cell.index() + 1; }

}  // namespace

CellComplex::CellComplex(std::vector<Vertex> vertices, std::vector<Face> faces,
                         std::size_t cell_count)
    : vertices_(std::move(vertices)), faces_(std::move(faces)), faces_of_(cell_count + 1) {
  for (int f = 0; f < std::ssize(faces_); ++f) {
    const Face& face = faces_[static_cast<std::size_t>(f)];
    for (const CellId side : {face.front, face.behind}) faces_of_[slot_of(side)].push_back({f});
  }
}

std::span<const FaceId> CellComplex::faces_of(CellId cell) const {
  if (slot_of(cell) >= faces_of_.size()) return {};
  return faces_of_[slot_of(cell)];
}

std::vector<Contact> CellComplex::neighbours(CellId cell) const {
  std::vector<Contact> contacts;
  for (const FaceId id : faces_of(cell)) {
    const Face& across = face(id);
    contacts.push_back({across.front == cell ? across.behind : across.front, across.area_m2});
  }
  std::ranges::stable_sort(contacts, {}, &Contact::cell);
  std::vector<Contact> sums;
  for (const Contact& contact : contacts) {
    if (sums.empty() || sums.back().cell != contact.cell) sums.push_back({contact.cell, 0});
    sums.back().area_m2 += contact.area_m2;
  }
  return sums;
}

double CellComplex::contact_area_m2(CellId a, CellId b) const {
  // Of the shorter list, so that a contact with the outside costs no more than the cell.
  if (faces_of(b).size() < faces_of(a).size()) std::swap(a, b);
  double area = 0;
  for (const FaceId id : faces_of(a)) {
    const Face& shared = face(id);
    if (a != b && (shared.front == b || shared.behind == b)) area += shared.area_m2;
  }
  return area;
}

std::vector<BoundaryFace> CellComplex::boundary(std::span<const CellId> cells) const {
  std::vector<char> is_in(faces_of_.size(), 0);
  for (const CellId cell : cells) is_in[slot_of(cell)] = 1;
  std::vector<BoundaryFace> boundary;
  for (const CellId cell : cells)
    for (const FaceId id : faces_of(cell)) {
      const bool has_front = is_in[slot_of(face(id).front)] != 0;
      const bool has_behind = is_in[slot_of(face(id).behind)] != 0;
      if (has_front != has_behind) boundary.push_back({id, has_front});
    }
  std::ranges::sort(boundary, {}, &BoundaryFace::face);
  boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
  return boundary;
}

double CellComplex::boundary_area_m2(std::span<const CellId> cells) const {
  double area = 0;
  for (const BoundaryFace& part : boundary(cells)) area += face(part.face).area_m2;
  return area;
}

std::size_t CellComplex::open_edge_count() const {
  std::map<std::tuple<CellId, int, int>, int> balance;
  for (const Face& face : faces_)
    for (const Loop& loop : face.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        const auto [low, high] = std::minmax(from, to);
        balance[{face.behind, low, high}] += from < to ? 1 : -1;
        balance[{face.front, low, high}] -= from < to ? 1 : -1;
      }
  return static_cast<std::size_t>(
      std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

std::vector<CellId> cells_of_sign(const Segmentation& segmentation, int sign) {
  std::vector<CellId> cells;
  for (int c = 0; c < std::ssize(segmentation.cells); ++c)
    if (segmentation.cells[static_cast<std::size_t>(c)].sign == sign) cells.push_back({c});
  return cells;
}

std::vector<CellId> cells_of(const Segmentation& segmentation, FeatureId feature) {
  // Parents come before what they contain.
  std::vector<char> is_in(segmentation.features.size() + 1, 0);
  const auto slot = [](FeatureId id) { return id.index() + 1; };  // 0 for the body
  is_in[slot(feature)] = 1;
  for (int f = 0; f < std::ssize(segmentation.features); ++f) {
    const FeatureId parent = segmentation.features[static_cast<std::size_t>(f)].parent;
    if (is_in[slot(parent)] != 0) is_in[slot({f})] = 1;
  }
  std::vector<CellId> cells;
  for (int c = 0; c < std::ssize(segmentation.cells); ++c)
    if (is_in[slot(segmentation.cells[static_cast<std::size_t>(c)].feature)] != 0)
      cells.push_back({c});
  return cells;
}

}  // namespace oriel
