#include <nmm/output/csv_series.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <scene/cleaning_report.h>

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
        {Kind::removed_piece, "short piece removed"}};
    } // namespace


    std::string
    summarize(const std::vector<CleaningAction> &actions)
    {
      std::map<Kind, unsigned int> counts;
      for (const CleaningAction &action : actions)
        ++counts[action.kind];
      std::string list;
      for (const auto &[kind, number] : counts)
        list += (list.empty() ? "" : ", ") + std::to_string(number) + " " +
                names.at(kind);
      const auto largest = std::max_element(actions.begin(),
                                            actions.end(),
                                            [](const auto &a, const auto &b) {
                                              return a.distance < b.distance;
                                            });
      return std::to_string(actions.size()) + " change(s): " + list +
             "; the largest: " + largest->description() +
             "; a run lists all in cleaning.csv";
    }


    void
    write_table(const std::vector<CleaningAction> &actions, std::ostream &out)
    {
      out << "curve,change,from_x,from_y,to_x,to_y,distance\n"
          << std::setprecision(17);
      for (const CleaningAction &action : actions)
        out << quoted(action.curve) << ',' << names.at(action.kind) << ','
            << action.from[0] << ',' << action.from[1] << ',' << action.to[0]
            << ',' << action.to[1] << ',' << action.distance << '\n';
    }
  } // namespace internal
} // namespace NMM
