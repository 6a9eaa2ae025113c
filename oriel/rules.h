#pragma once

/// Rule packs and profiles: load_pack_file, format_pack_file, merge_pack_file,
/// describe_pack_file, load_profile_file and check_profile, and their tests (docs/rules.md); the
/// keys of each: pack_grammar, profile_grammar, test_grammar; packs with params at other values:
/// with_params; what packs can say: attribute_words, relation_words, operator_words; what the
/// documentation says of a code: page_of. What is wrong with a pack comes back as issues with
/// codes, all at once.
#include "interpret/pack/contents.h"         // IWYU pragma: export
#include "interpret/pack/pack_grammar.h"     // IWYU pragma: export
#include "interpret/pack/rule_base.h"        // IWYU pragma: export
#include "interpret/pack/starter.h"          // IWYU pragma: export
#include "interpret/pack/vocabulary.h"       // IWYU pragma: export
#include "interpret/params/with_params.h"    // IWYU pragma: export
#include "interpret/plan/profile.h"          // IWYU pragma: export
#include "interpret/plan/profile_grammar.h"  // IWYU pragma: export
#include "interpret/testing/rule_tests.h"    // IWYU pragma: export
#include "interpret/testing/test_grammar.h"  // IWYU pragma: export
#include "oriel/reference/code_page.h"       // IWYU pragma: export

namespace oriel {

/// Runs the tests in the file at `path`. Buildings that they name are read and segmented with the
/// tolerances as they are, not fitted to noise: tests say what features measure.
Checked<RuleTestReport> run_rule_tests(const std::string& path);

/// Draws the buildings of a test that failed, as they are labelled, as SVG
/// (docs/command.md#pictures); what is not as the test expects is marked. Without a value: what
/// picture() says, or E101 if the file of its buildings cannot be read. The features of the test
/// are not made by hand.
Checked<std::string> picture_of(const RuleTestReport& report, const RuleTestResult& test);

/// Returns a name for the file of such a picture, "rows-on-a-real-building": of the file of tests
/// and the test, in small letters, digits and hyphens. Several tests may have the same one.
std::string picture_name_of(const RuleTestReport& report, const RuleTestResult& test);

}  // namespace oriel
