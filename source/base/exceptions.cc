#include <nmm/base/exceptions.h>

#include <sstream>
#include <utility>

namespace NMM
{
  UserError::UserError(std::string what_happened,
                       std::string where,
                       std::string remedy)
    : what_happened(std::move(what_happened))
    , where(std::move(where))
    , remedy(std::move(remedy))
  {
  }


  void
  UserError::print_info(std::ostream &out) const
  {
    out << message() << '\n';
  }


  std::string
  UserError::message() const
  {
    std::string text = what_happened;
    if (!where.empty())
      text += ", at " + where;
    if (!remedy.empty())
      text += ": " + remedy;
    return text;
  }


  std::string
  to_string(const dealii::Point<2> &point)
  {
    std::ostringstream out;
    out.precision(12);
    out << '(' << point[0] << ", " << point[1] << ')';
    return out.str();
  }
} // namespace NMM
