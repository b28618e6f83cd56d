#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <support/contact_bars/overlap.h>
#include <vector>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      namespace bg  = boost::geometry;
      using Corner  = bg::model::d2::point_xy<double>;
      using Polygon = bg::model::polygon<Corner, /* clockwise = */ false>;

      /// The outer and inner boundaries of blocks at present, one after the other.
      std::vector<std::pair<unsigned int, Polygon>>
      boundaries(const ContactSurface &surface)
      {
        const auto       &edges = surface.edges();
        std::vector<bool> is_done(edges.size(), false);
        std::vector<std::pair<unsigned int, Polygon>> result;
        for (unsigned int first = 0; first < edges.size(); ++first)
        {
          if (is_done[first] || surface.is_rigid(first))
            continue;
          Polygon polygon;
          for (unsigned int e = first; e != invalid_index && !is_done[e];
               e              = edges[e].next)
          {
            is_done[e] = true;
            for (const double t : {0., 0.5})
            {
              const dealii::Point<2> x = surface.place(e, t).x;
              polygon.outer().emplace_back(x[0], x[1]);
            }
          }
          bg::correct(polygon);
          result.emplace_back(edges[first].body, std::move(polygon));
        }
        return result;
      }
    } // namespace


    double
    find_overlap(const ContactSurface &surface)
    {
      const auto blocks  = boundaries(surface);
      double     deepest = 0.;
      for (const auto &[body, polygon] : blocks)
        for (const Corner &x : polygon.outer())
        {
          for (const auto &[other, target] : blocks)
            if (other != body && bg::within(x, target))
            {
              bg::model::linestring<Corner> boundary(target.outer().begin(),
                                                     target.outer().end());
              deepest = std::max(deepest, bg::distance(x, boundary));
            }
          for (unsigned int e = 0; e < surface.edges().size(); ++e)
            if (surface.is_rigid(e))
            {
              const auto place = surface.place(e, 0.5);
              deepest          = std::max(deepest,
                                 (place.x - dealii::Point<2>(bg::get<0>(x),
                                                             bg::get<1>(x))) *
                                   place.normal());
            }
        }
      return deepest;
    }
  } // namespace ContactBars
} // namespace NMM
