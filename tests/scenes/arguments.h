#ifndef nmm_tests_scenes_arguments_h
#define nmm_tests_scenes_arguments_h

#include <string>
#include <vector>

/// Arguments of the driver.
using Arguments = std::vector<std::string>;

inline Arguments
operator+(Arguments a, const Arguments &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

#endif
