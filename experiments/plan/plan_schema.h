#pragma once

#include <string>

namespace oriel {

/// A JSON Schema (draft 7) of experiments, from which editors complete keys and words. Every key
/// has a description. Every experiment that loads conforms to it; it knows nothing of units, params
/// and files: load_experiment does.
std::string experiment_schema();

}  // namespace oriel
