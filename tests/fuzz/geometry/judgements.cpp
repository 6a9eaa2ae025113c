#include "kernel/validate/validate.h"
#include "tests/fuzz/support/bodies.h"
#include "tests/fuzz/support/promises.h"
#include "tests/fuzz/support/retold.h"
#include "tests/fuzz/targets.h"
#include "tests/support/changed.h"

#include <fmt/format.h>

namespace oriel::fuzz {

namespace {

std::string first_of(const std::vector<Finding>& findings) {
  if (findings.empty()) return "valid";
  return fmt::format("{} {}", to_string(findings[0].code), findings[0].val3dity);
}

void check_retold(const std::vector<Finding>& findings, const Building& other, const char* how) {
  const std::vector<Finding> again = validate(other);
  promise(findings.empty() == again.empty(), "a body told differently is as valid",
          fmt::format("{}: {} / {}", how, first_of(findings), first_of(again)));
}

}  // namespace

/// validate: turning, moving and shuffling change no validity, of any body; nor does cutting into
/// triangles of a valid one.
void judgements(std::string_view input) {
  ByteSource bytes(input);
  const Body body = changed_body(bytes);
  const std::vector<Finding> findings = validate(body.building);
  if (body.is_valid) promise(findings.empty(), "a valid body is valid", first_of(findings));
  check_retold(findings, turned_by_right_angle(body.building), "turned");
  check_retold(findings, moved_by_metres(body.building), "moved");
  check_retold(findings, test::shuffled(body.building, 1), "shuffled");
  if (body.is_valid) check_retold(findings, cut_into_triangles(body.building), "in triangles");
  ValidateOptions surfaces;
  surfaces.primitive = ValidateOptions::Primitive::surfaces;
  (void)validate(body.building, surfaces);
}

}  // namespace oriel::fuzz
