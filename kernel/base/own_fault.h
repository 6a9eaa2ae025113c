#pragma once

#include "kernel/base/issue.h"

#include <exception>

namespace oriel {

/// Reports an exception that is no error of the input: E507 where memory is used up, else E901.
Issue own_fault(const std::exception& fault);

/// True for the codes of own_fault: another run may end otherwise.
bool is_own_fault(const Issue& issue);

}  // namespace oriel
