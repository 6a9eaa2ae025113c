#include "kernel/io/gpkg/crs_definition.h"

#include "kernel/io/files/proj_pointers.h"

#include <array>

namespace oriel::detail {

std::string crs_definition(const std::string& organization, int number) {
  const PjContextPointer context(proj_context_create());
  if (!context) return "undefined";
  proj_log_level(context.get(), PJ_LOG_NONE);
  const PjPointer crs(proj_create_from_database(context.get(), organization.c_str(),
                                                std::to_string(number).c_str(), PJ_CATEGORY_CRS, 0,
                                                nullptr));
  if (!crs) return "undefined";
  constexpr std::array<const char*, 2> kOptions{"MULTILINE=NO", nullptr};
  const char* text = proj_as_wkt(context.get(), crs.get(), PJ_WKT1_GDAL, kOptions.data());
  return text == nullptr ? "undefined" : text;
}

}  // namespace oriel::detail
