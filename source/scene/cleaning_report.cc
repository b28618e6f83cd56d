#include <nmm/output/csv_series.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <scene/cleaning_report.h>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using Kind = CleaningAction::Kind;

      const std::map<Kind, std::string> names = {
        {Kind::snapped_to_vertex, "snapped to a vertex"},
        {Kind::extended_to_curve, "moved onto a curve"},
        {Kind::trimmed_overshoot, "overshoot trimmed"},
        {Kind::removed_piece, "short piece removed"},
        {Kind::merged_block, "small block merged"}};
    } // namespace


    std::string
    summarize(const std::vector<CleaningAction> &actions)
    {
      std::map<Kind, unsigned int> counts;
      double                       merged_area = 0.;
      for (const CleaningAction &action : actions)
      {
        ++counts[action.kind];
        merged_area += action.area;
      }
      std::ostringstream text;
      text << actions.size() << " change(s): ";
      for (const auto &[kind, number] : counts)
      {
        text << (kind == counts.begin()->first ? "" : ", ") << number << ' '
             << names.at(kind);
        if (kind == Kind::merged_block)
          text << " (" << merged_area << " m^2)";
      }
      const auto largest =
        std::max_element(actions.begin(),
                         actions.end(),
                         [](const auto &a, const auto &b) {
                           return std::make_pair(a.area, a.distance) <
                                  std::make_pair(b.area, b.distance);
                         });
      text << "; the largest: " << largest->description()
           << "; a run lists all in cleaning.csv";
      return text.str();
    }


    void
    write_table(const std::vector<CleaningAction> &actions, std::ostream &out)
    {
      out << "curve,change,from_x,from_y,to_x,to_y,distance,area\n"
          << std::setprecision(17);
      for (const CleaningAction &action : actions)
        out << quoted(action.curve) << ',' << names.at(action.kind) << ','
            << action.from[0] << ',' << action.from[1] << ',' << action.to[0]
            << ',' << action.to[1] << ',' << action.distance << ','
            << action.area << '\n';
    }
  } // namespace internal
} // namespace NMM
