#include "kernel/base/own_fault.h"

#include <new>

namespace oriel {

Issue own_fault(const std::exception& fault) {
  Issue issue;
  const bool is_of_memory = dynamic_cast<const std::bad_alloc*>(&fault) != nullptr;
  issue.code = is_of_memory ? Code::E507 : Code::E901;
  issue.sentence = is_of_memory ? "memory is used up; more is needed for this"
                                : std::string("a fault of oriel's own: ") + fault.what();
  return issue;
}

bool is_own_fault(const Issue& issue) {
  return issue.code == Code::E507 || issue.code == Code::E901;
}

}  // namespace oriel
