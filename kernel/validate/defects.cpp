#include "kernel/validate/defects.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

struct DefectName {
  int number;
  std::string_view text;
};

constexpr std::array kNames{
    DefectName{101, "TOO_FEW_POINTS"},
    DefectName{102, "CONSECUTIVE_POINTS_SAME"},
    DefectName{103, "RING_NOT_CLOSED"},
    DefectName{104, "RING_SELF_INTERSECTION"},
    DefectName{201, "INTERSECTION_RINGS"},
    DefectName{202, "DUPLICATED_RINGS"},
    DefectName{203, "NON_PLANAR_POLYGON_DISTANCE_PLANE"},
    DefectName{204, "NON_PLANAR_POLYGON_NORMALS_DEVIATION"},
    DefectName{205, "POLYGON_INTERIOR_DISCONNECTED"},
    DefectName{206, "INNER_RING_OUTSIDE"},
    DefectName{207, "INNER_RINGS_NESTED"},
    DefectName{208, "ORIENTATION_RINGS_SAME"},
    DefectName{301, "TOO_FEW_POLYGONS"},
    DefectName{302, "SHELL_NOT_CLOSED"},
    DefectName{303, "NON_MANIFOLD_CASE"},
    DefectName{305, "MULTIPLE_CONNECTED_COMPONENTS"},
    DefectName{306, "SHELL_SELF_INTERSECTION"},
    DefectName{307, "POLYGON_WRONG_ORIENTATION"},
    DefectName{401, "INTERSECTION_SHELLS"},
    DefectName{402, "DUPLICATED_SHELLS"},
    DefectName{403, "INNER_SHELL_OUTSIDE"},
    DefectName{404, "SOLID_INTERIOR_DISCONNECTED"},
    DefectName{405, "WRONG_ORIENTATION_SHELL"},
    DefectName{501, "INTERSECTION_SOLIDS"},
    DefectName{502, "DUPLICATED_SOLIDS"},
    DefectName{503, "DISCONNECTED_SOLIDS"},
    DefectName{601, "BUILDINGPARTS_OVERLAP"},
    DefectName{902, "EMPTY_PRIMITIVE"},
};

}  // namespace

std::string_view val3dity_name(int number) {
  const auto found = std::ranges::find(kNames, number, &DefectName::number);
  return found == kNames.end() ? std::string_view() : found->text;
}

namespace detail {

namespace {

Code code_of(Defect defect) {
  switch (defect) {
    case Defect::empty:
      return Code::E313;
    case Defect::too_few_points:
      return Code::E311;
    case Defect::repeated_point:
      return Code::E312;
    case Defect::ring_crosses_itself:
      return Code::E341;
    case Defect::rings_cross:
      return Code::E342;
    case Defect::rings_alike:
      return Code::E343;
    case Defect::off_plane:
      return Code::E344;
    case Defect::folded:
      return Code::E345;
    case Defect::polygon_in_pieces:
      return Code::E346;
    case Defect::hole_outside:
      return Code::E347;
    case Defect::holes_nested:
      return Code::E348;
    case Defect::holes_turned:
      return Code::E349;
    case Defect::too_few_polygons:
      return Code::E301;
    case Defect::open_shell:
      return Code::E302;
    case Defect::many_at_edge:
      return Code::E303;
    case Defect::many_at_vertex:
      return Code::E350;
    case Defect::shell_in_pieces:
      return Code::E351;
    case Defect::shell_crosses_itself:
      return Code::E352;
    case Defect::polygon_turned:
      return Code::E308;
    case Defect::one_sided:
      return Code::E307;
    case Defect::shells_cross:
      return Code::E353;
    case Defect::shells_alike:
      return Code::E354;
    case Defect::cavity_outside:
      return Code::E305;
    case Defect::solid_in_pieces:
      return Code::E355;
    case Defect::shell_turned:
      return Code::E308;
    case Defect::solids_cross:
      return Code::E356;
    case Defect::solids_alike:
      return Code::E357;
    case Defect::solids_apart:
      return Code::E358;
    case Defect::parts_overlap:
      return Code::E359;
  }
  return Code::E901;
}

/// As of the code, which two defects share that have numbers of their own.
int val3dity_number_of(Defect defect) {
  return defect == Defect::shell_turned ? 405 : val3dity_number(code_of(defect));
}

std::string text_of(Vec3 p) { return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z); }

}  // namespace

void FindingList::add(Defect defect, const Subject& subject, std::string sentence,
                      const std::vector<int>& vertices) {
  Finding finding{code_of(defect),     val3dity_number_of(defect),
                  std::move(sentence), subject.body,
                  subject.shell,       subject.polygon,
                  subject.ring,        {}};
  for (const int vertex : vertices) finding.at_m.push_back(building_.place(vertex));
  if (finding.at_m.size() == 1) finding.sentence += " at " + text_of(finding.at_m[0]);
  if (finding.at_m.size() == 2)
    finding.sentence +=
        fmt::format(" at the edge {} to {}", text_of(finding.at_m[0]), text_of(finding.at_m[1]));
  findings_.push_back(std::move(finding));
}

}  // namespace detail

}  // namespace oriel
