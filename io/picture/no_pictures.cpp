// What stands for the other files of this folder in a build without Cairo and Clipper.
#include "io/picture/picture.h"

namespace oriel {

Checked<std::string> picture(const std::vector<PicturePanel>& /*panels*/, PictureFormat /*format*/,
                             const PictureOptions& /*options*/) {
  Issue issue;
  issue.code = Code::E171;
  issue.sentence =
      "this build draws no pictures: it was made without Cairo and Clipper (ORIEL_PICTURES)";
  return {std::nullopt, {std::move(issue)}};
}

}  // namespace oriel
