#pragma once

// Goes into copies of the sources that tests/mutants/run.py makes, nowhere else.

namespace oriel_mutants {

/// The change that this process tries; what is below 0 is asked for on first use.
extern int chosen;

/// Whether to try a change: never in a run that notes which changes a test case reaches.
bool answer(int number);

inline bool is_on(int number) { return chosen == number || (chosen < 0 && answer(number)); }

/// Notes that a test case begins.
void begin_case(const char* name);

/// Notes that a test case ended, and whether it passed.
void end_case(double seconds, bool passed);

}  // namespace oriel_mutants

#define ORIEL_MUTANT(number) ::oriel_mutants::is_on(number)
