#include <nmm/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <geometry/piece_geometry.h>
#include <mechanics/bolt_path.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;

    namespace
    {
      /// A place where the path is cut.
      struct Cut
      {
        double   s = 0.;
        Point<2> x;
        /// Whether it is a corner of the path, and whether the displacement may jump.
        bool        may_jump = false;
        std::string curve;
      };


      std::vector<Cut>
      find_cuts(const PhysicalMesh          &physical_mesh,
                const std::vector<Point<2>> &path,
                const std::vector<double>   &further)
      {
        std::vector<Cut> cuts   = {{0., path[0], false, {}}};
        double           length = 0.;
        for (unsigned int i = 0; i + 1 < path.size(); ++i)
        {
          const double     of_part = path[i].distance(path[i + 1]);
          const CurvePiece part    = CurvePiece::segment(path[i], path[i + 1]);
          for (unsigned int p = 0; p < physical_mesh.pieces().size(); ++p)
          {
            const Curve &curve =
              physical_mesh.curves()[physical_mesh.piece_to_curve()[p]];
            const bool may_jump = curve.role != CurveRole::interface &&
                                  !(curve.role == CurveRole::joint &&
                                    curve.state == JointState::closed);
            for (const Point<2> &x : crossings(part, physical_mesh.pieces()[p]))
              cuts.push_back(
                {length + x.distance(path[i]), x, may_jump, curve.name});
          }
          for (const double s : further)
            if (s > length && s < length + of_part)
              cuts.push_back(
                {s,
                 path[i] + (s - length) / of_part * (path[i + 1] - path[i]),
                 false,
                 {}});
          length += of_part;
          cuts.push_back({length, path[i + 1], false, {}});
        }
        std::stable_sort(cuts.begin(),
                         cuts.end(),
                         [](const Cut &a, const Cut &b) { return a.s < b.s; });
        // rounding of crossings
        const double     tolerance = 1e-9 * length;
        std::vector<Cut> distinct  = {cuts[0]};
        for (const Cut &cut : cuts)
          if (cut.s > distinct.back().s + tolerance)
            distinct.push_back(cut);
          else if (cut.may_jump && !distinct.back().may_jump)
          {
            distinct.back().may_jump = true;
            distinct.back().curve    = cut.curve;
          }
        return distinct;
      }
    } // namespace


    namespace
    {
      /// @throws InputError for a path that runs along a curve between @p a and @p b, so that its side
      /// would be chosen by rounding.
      void
      check_side(const PhysicalMesh &mesh,
                 const Point<2>     &a,
                 const Point<2>     &b,
                 const std::string  &what)
      {
        constexpr double tolerance = 1e-6;
        for (unsigned int p = 0; p < mesh.pieces().size(); ++p)
          for (const double at : {0.25, 0.5, 0.75})
          {
            const Point<2> x = a + at * (b - a);
            if (x.distance(nearest_point(mesh.pieces()[p], x)) >
                tolerance * a.distance(b))
              break;
            AssertThrow(
              at < 0.7,
              InputError(what + " runs along '" +
                           mesh.curves()[mesh.piece_to_curve()[p]].name +
                           "', so that its side is not certain",
                         to_string(x),
                         "let its path cross the curve, or lie beside "
                         "it"));
          }
      }
    } // namespace


    std::vector<BoltStretch>
    cut_bolt_path(const ManifoldMesh          &mesh,
                  const std::vector<Point<2>> &path,
                  const std::vector<double>   &further,
                  const std::string           &what)
    {
      AssertThrow(path.size() >= 2,
                  InputError(what + " has fewer than two points",
                             "its path",
                             "give the points of its path from the head on"));
      for (unsigned int i = 0; i + 1 < path.size(); ++i)
        AssertThrow(path[i].distance(path[i + 1]) > 0.,
                    InputError(what + " has the same point twice in a row",
                               to_string(path[i]),
                               "give points that differ"));
      constexpr double       inside = 1e-6;
      const std::vector<Cut> cuts =
        find_cuts(mesh.physical_mesh(), path, further);
      std::vector<BoltStretch> result;
      unsigned int             block_before = invalid_index;
      for (unsigned int i = 0; i + 1 < cuts.size(); ++i)
      {
        const Point<2> &a = cuts[i].x, &b = cuts[i + 1].x;
        check_side(mesh.physical_mesh(), a, b, what);
        BoltStretch stretch;
        stretch.begin              = cuts[i].s;
        stretch.end                = cuts[i + 1].s;
        const unsigned int element = mesh.find_element(a + 0.5 * (b - a));
        stretch.is_in_rock         = element != invalid_index;
        const unsigned int block =
          stretch.is_in_rock ? mesh.block(element) : invalid_index;
        const bool both_in_rock =
          stretch.is_in_rock && i > 0 && result.back().is_in_rock;
        stretch.crosses =
          both_in_rock && (cuts[i].may_jump || block != block_before);
        stretch.continues = both_in_rock && !stretch.crosses;
        stretch.joint     = stretch.crosses ? cuts[i].curve : std::string();
        stretch.first     = stretch.continues ? a : a + inside * (b - a);
        stretch.last      = b - inside * (b - a);
        if (stretch.continues)
          result.back().last = a;
        block_before = block;
        result.push_back(stretch);
      }
      for (const bool is_head : {true, false})
        AssertThrow(
          (is_head ? result.front() : result.back()).is_in_rock,
          InputError(what + (is_head ? " begins" : " ends") +
                       " outside the rock",
                     to_string(is_head ? path.front() : path.back()),
                     "let its path begin and end in rock or on its surface"));
      return result;
    }


    std::vector<BoltBar::Element>
    make_elements(const BoltStretch &stretch,
                  const BarSection  &section,
                  const bool         is_bonded,
                  const bool         may_yield_first,
                  const bool         may_yield_last)
    {
      constexpr double per_decay = 5., of_decay = 2e-4, at_most = 0.1;
      constexpr double at_least = 4.;
      const double     length   = stretch.end - stretch.begin,
                   decay =
                     std::sqrt(section.stiffness / section.bond_stiffness);
      double n = at_least, tiny = 0.;
      if (is_bonded)
        n = std::max(n, per_decay * length / decay);
      if (is_bonded && std::isfinite(section.yield_force))
        tiny = std::min(of_decay * decay, at_most * length);
      if (std::isfinite(section.rupture_strain))
        n = std::max(n, length / section.gauge_length);
      std::vector<double> ends  = {stretch.begin};
      const double        first = stretch.begin + (may_yield_first ? tiny : 0.),
                   last         = stretch.end - (may_yield_last ? tiny : 0.);
      n                         = std::ceil(n);
      for (unsigned int e = 0; e <= n; ++e)
        if (const double s = first + e / n * (last - first); s > ends.back())
          ends.push_back(s);
      if (last < stretch.end)
        ends.push_back(stretch.end);
      std::vector<BoltBar::Element> elements;
      for (unsigned int e = 0; e + 1 < ends.size(); ++e)
      {
        const double size = ends[e + 1] - ends[e];
        elements.push_back(
          {ends[e],
           ends[e + 1],
           is_bonded,
           BoltBar::hardening * (size < 1.5 * tiny ? size / length : 1.)});
      }
      return elements;
    }
  } // namespace internal
} // namespace NMM
