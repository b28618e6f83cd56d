#include <nmm/base/exceptions.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <contact/detection/points.h>

namespace NMM
{
  namespace internal
  {
    void
    lobatto_rule(const unsigned int   n,
                 std::vector<double> &points,
                 std::vector<double> &weights)
    {
      const dealii::QGaussLobatto<1> rule(n);
      points.resize(n);
      for (unsigned int q = 0; q < n; ++q)
        points[q] = rule.point(q)[0];
      weights = rule.get_weights();
    }


    double
    cell_size(const ContactSurface::Edge &edge)
    {
      return 1. / std::sqrt(std::abs(dealii::determinant(edge.inverse)));
    }


    std::vector<double>
    corner_sizes(const ContactSurface &surface)
    {
      const auto         &edges = surface.edges();
      const unsigned int  n     = edges.size();
      std::vector<double> result(2 * n);
      double              mean    = 0.;
      unsigned int        n_cells = 0;
      for (unsigned int e = 0; e < n; ++e)
        if (!surface.is_rigid(e))
        {
          mean += cell_size(edges[e]);
          ++n_cells;
        }
      mean /= std::max(1U, n_cells);
      for (unsigned int e = 0; e < n; ++e)
        for (unsigned int end = 0; end < 2; ++end)
        {
          const double size = surface.is_rigid(e) ? mean : cell_size(edges[e]);
          double       length = edges[e].length;
          unsigned int at     = e;
          while (length < size)
          {
            const auto &edge = edges[at];
            const auto  kind = end == 0 ? edge.at_end : edge.at_start;
            at               = end == 0 ? edge.next : edge.previous;
            if (kind != ContactSurface::Corner::smooth || at == invalid_index ||
                at == e)
              break;
            length += edges[at].length;
          }
          result[2 * e + end] = std::min(size, length);
        }
      return result;
    }


    namespace
    {
      bool
      comes_before(const StickPlace &a, const StickPlace &b)
      {
        return a.s < b.s;
      }
    } // namespace


    std::vector<StickPlace> &
    StickPlaces::open(const unsigned int key)
    {
      if (key >= places_of.size())
        places_of.resize(key + 1);
      if (places_of[key].empty())
        keys.push_back(key);
      return places_of[key];
    }


    void
    StickPlaces::insert(const unsigned int key, const StickPlace &place)
    {
      auto      &places = open(key);
      const auto at =
        std::lower_bound(places.begin(), places.end(), place, comes_before);
      if (at != places.end() && at->s == place.s)
        *at = place;
      else
        places.insert(at, place);
    }


    void
    StickPlaces::clear()
    {
      for (const unsigned int key : keys)
        places_of[key].clear();
      keys.clear();
    }


    void
    StickPlaces::sort()
    {
      for (const unsigned int key : keys)
        std::sort(places_of[key].begin(), places_of[key].end(), comes_before);
    }


    bool
    find_stick_place(const std::vector<StickPlace> &places,
                     const double                   s,
                     StickPlace                    &result)
    {
      if (places.empty())
        return false;
      const auto after =
        std::lower_bound(places.begin(),
                         places.end(),
                         s,
                         [](const StickPlace &place, const double value) {
                           return place.s < value;
                         });
      if (after != places.end() && after->s == s)
      {
        result = *after;
        return true;
      }
      // Begin with the nearer place.
      const auto last  = places.end() - 1;
      const auto right = after == places.end() ? last : after;
      const auto left  = right == places.begin() ? right : right - 1;
      const bool is_left_nearer =
        std::abs(s - left->s) <= std::abs(right->s - s);
      const auto nearer = is_left_nearer ? left : right;
      const auto other  = is_left_nearer ? right : left;
      result            = *nearer;
      // The anchor is linear in s on a master with two places, and extrapolated beyond them.
      // Otherwise the change of the anchor along the face would appear as elastic slip.
      for (const auto &place : {nearer, other})
      {
        auto neighbor = place;
        if (nearer != other && nearer->edge == other->edge)
          neighbor = place == nearer ? other : nearer;
        else if (place != places.begin() && (place - 1)->edge == place->edge)
          neighbor = place - 1;
        else if (place != last && (place + 1)->edge == place->edge)
          neighbor = place + 1;
        if (neighbor == place)
          continue;
        result = *place;
        result.t +=
          (s - place->s) / (neighbor->s - place->s) * (neighbor->t - place->t);
        break;
      }
      result.s = s;
      if (left->s < s && s < right->s)
        result.slip = left->slip + (s - left->s) / (right->s - left->s) *
                                     (right->slip - left->slip);
      return true;
    }
  } // namespace internal


  namespace
  {
    void
    check_value(const bool         is_good,
                const std::string &name,
                const double       value,
                const std::string &where,
                const std::string &remedy)
    {
      AssertThrow(is_good,
                  InputError(name + " is " + std::to_string(value),
                             where,
                             remedy));
    }
  } // namespace


  void
  ContactParameters::check() const
  {
    const std::string where = "the contact parameters";
    AssertThrow(law != nullptr,
                InputError("there is no law",
                           where,
                           "set ContactParameters::law"));
    law->check(where);
    for (const ContactPair &pair : pairs)
    {
      const std::string of_pair =
        where + " of \"" + pair.first + "\" and \"" + pair.second + "\"";
      AssertThrow(pair.law != nullptr,
                  InputError("there is no law",
                             of_pair,
                             "set ContactPair::law"));
      pair.law->check(of_pair);
    }
    check_value(penetration_tolerance >= 0.,
                "the penetration that is allowed",
                penetration_tolerance,
                where,
                "give a length, or 0 for the penalty method");
    check_value(penetration_tolerance == 0. ||
                  integration == ContactIntegration::length,
                "the penetration that is allowed",
                penetration_tolerance,
                where,
                "pressures on top of springs are functions along faces: "
                "integrate over lengths, or leave the tolerance out");
    check_value(reach >= 0., "the reach", reach, where, "give a length, or 0");
    check_value(n_points >= 2 && n_points <= 20,
                "the number of points",
                n_points,
                where,
                "give 2 to 20");
  }


  bool
  ContactParameters::transmit_shear() const
  {
    return law->transmits_shear() ||
           std::any_of(pairs.begin(), pairs.end(), [](const ContactPair &pair) {
             return pair.law->transmits_shear();
           });
  }


  bool
  ContactParameters::has_friction() const
  {
    return law->has_friction() ||
           std::any_of(pairs.begin(), pairs.end(), [](const ContactPair &pair) {
             return pair.law->has_friction();
           });
  }


  namespace internal
  {
    ContactLaws::ContactLaws(const ContactSurface    &surface,
                             const ContactParameters &parameters)
    {
      laws.push_back(parameters.law);
      for (const ContactPair &pair : parameters.pairs)
        laws.push_back(pair.law);
      if (laws.size() == 1)
        return;

      std::vector<std::string> names;
      for (unsigned int e = 0; e < surface.edges().size(); ++e)
      {
        const std::string name  = surface.name(e);
        const auto        found = std::find(names.begin(), names.end(), name);
        edge_names.push_back(found - names.begin());
        if (found == names.end())
          names.push_back(name);
      }
      n_names = names.size();
      law_of_names.assign(n_names * n_names, 0);
      const auto fits = [](const std::string &pattern,
                           const std::string &name) {
        return pattern.empty() || pattern == name;
      };
      for (unsigned int a = 0; a < n_names; ++a)
        for (unsigned int b = 0; b < n_names; ++b)
          for (unsigned int i = parameters.pairs.size(); i > 0; --i)
          {
            const ContactPair &pair = parameters.pairs[i - 1];
            if ((fits(pair.first, names[a]) && fits(pair.second, names[b])) ||
                (fits(pair.first, names[b]) && fits(pair.second, names[a])))
              law_of_names[a * n_names + b] = i;
          }
    }
  } // namespace internal
} // namespace NMM
