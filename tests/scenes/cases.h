#ifndef nmm_tests_scenes_cases_h
#define nmm_tests_scenes_cases_h

#include <string>

/// The folder of all cases, with a slash at its end.
const std::string cases_dir = NMM_SOURCE_DIR "/tests/scenes/";

#endif
