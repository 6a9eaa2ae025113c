#pragma once

namespace oriel::cli {

/// From now on signals that end the program (Ctrl-C, a closed pipe or terminal) first delete the
/// temporary files of outputs that are not done. The program still ends by the signal: its exit
/// code is 128 + its number. A file that grows beyond its limit becomes a failed write.
void clean_up_on_signals();

}  // namespace oriel::cli
