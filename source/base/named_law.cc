#include <nmm/base/exceptions.h>
#include <nmm/base/named_law.h>

#include <sstream>

namespace NMM
{
  void
  check_law_value(const bool         is_good,
                  const std::string &name,
                  const double       value,
                  const std::string &where,
                  const std::string &remedy)
  {
    if (is_good)
      return;
    std::ostringstream text;
    text.precision(12);
    text << name << " is " << value;
    AssertThrow(false, InputError(text.str(), where, remedy));
  }
} // namespace NMM
