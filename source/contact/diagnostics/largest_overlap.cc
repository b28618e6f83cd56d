// Overlap of bodies, computed independently of contact.
#include <nmm/contact/surface/surface.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <limits>

namespace NMM
{
  using dealii::Point;

  namespace
  {
    namespace bg        = boost::geometry;
    using PolygonVertex = bg::model::d2::point_xy<double>;
    using Polygon = bg::model::polygon<PolygonVertex, /* clockwise = */ false>;
    using Chain   = bg::model::linestring<PolygonVertex>;
    using BoundingBox = bg::model::box<PolygonVertex>;

    /// A closed part of a block's boundary, outer or inner.
    struct Ring
    {
      unsigned int body;
      Polygon      polygon;
      Chain        chain;
    };


    std::vector<Ring>
    rings_of_blocks(const ContactSurface &surface)
    {
      const auto       &edges = surface.edges();
      std::vector<bool> is_done(edges.size(), false);
      std::vector<Ring> result;
      for (unsigned int first = 0; first < edges.size(); ++first)
      {
        if (is_done[first] || surface.is_rigid(first) ||
            surface.is_absent(first))
          continue;
        Ring ring;
        ring.body = edges[first].body;
        for (unsigned int e = first; e != invalid_index && !is_done[e];
             e              = edges[e].next)
        {
          is_done[e] = true;
          for (const double t : {0., 0.5})
          {
            const Point<2> x = surface.place(e, t).x;
            ring.polygon.outer().emplace_back(x[0], x[1]);
          }
        }
        bg::correct(ring.polygon);
        ring.chain.assign(ring.polygon.outer().begin(),
                          ring.polygon.outer().end());
        result.push_back(std::move(ring));
      }
      return result;
    }
  } // namespace


  double
  ContactSurface::largest_overlap() const
  {
    const std::vector<Ring> rings = rings_of_blocks(*this);
    using Entry                   = std::pair<BoundingBox, unsigned int>;
    std::vector<Entry>                     boxes;
    std::vector<std::vector<unsigned int>> body_to_rings(n_blocks);
    for (unsigned int i = 0; i < rings.size(); ++i)
    {
      boxes.emplace_back(bg::return_envelope<BoundingBox>(rings[i].polygon), i);
      body_to_rings[rings[i].body].push_back(i);
    }
    const bg::index::rtree<Entry, bg::index::rstar<16>> tree(boxes);

    double                    deepest = 0.;
    std::vector<Entry>        found;
    std::vector<unsigned int> around;
    for (const Ring &ring : rings)
      for (const PolygonVertex &x : ring.polygon.outer())
      {
        // Find the bodies around the point: it is in their outer boundary and in none of their
        // inner ones.
        found.clear();
        tree.query(bg::index::intersects(x), std::back_inserter(found));
        around.clear();
        for (const auto &[box, i] : found)
          if (rings[i].body != ring.body && bg::within(x, rings[i].polygon))
            around.push_back(rings[i].body);
        for (const unsigned int body : around)
        {
          if (std::count(around.begin(), around.end(), body) % 2 == 0)
            continue;
          double depth = std::numeric_limits<double>::max();
          for (const unsigned int i : body_to_rings[body])
            depth = std::min(depth, bg::distance(x, rings[i].chain));
          deepest = std::max(deepest, depth);
        }
        for (unsigned int i = 0; i < rigid_obstacles.size(); ++i)
        {
          if (is_body_absent[n_blocks + i])
            continue;
          const Nearest nearest =
            nearest_of_obstacle(i, Point<2>(x.x(), x.y()));
          if (!nearest.is_open_end)
            deepest = std::max(deepest, -nearest.gap);
        }
      }
    return deepest;
  }
} // namespace NMM
