#include "geometry/trimming.h"

#include "geometry/curve.h"
#include "geometry/loops.h"
#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Loops to which a joint may be confined, by name.
      std::set<unsigned int>
      loops_called(const std::string        &name,
                   const std::vector<Curve> &curves,
                   const unsigned int        first_region,
                   const Loops              &loops)
      {
        std::set<unsigned int> regions, domains;
        for (unsigned int c = 0; c < curves.size(); ++c)
          if (curves[c].name == name)
          {
            if (c >= first_region)
              regions.insert(loops.curve_to_loop[c]);
            else if (curves[c].role == CurveRole::boundary)
              domains.insert(loops.curve_to_loop[c]);
          }
        return regions.empty() ? domains : regions;
      }


      bool
      share_one(const std::vector<unsigned int> &a,
                const std::set<unsigned int>    &b)
      {
        return std::any_of(a.begin(), a.end(), [&](const unsigned int i) {
          return b.count(i) > 0;
        });
      }


      void
      check_confinement(const std::vector<Curve>                  &curves,
                        const std::vector<std::set<unsigned int>> &places)
      {
        for (unsigned int c = 0; c < places.size(); ++c)
          AssertThrow(curves[c].within.empty() || !places[c].empty(),
                      InputError(describe(curves[c]) + " is confined to '" +
                                   curves[c].within +
                                   "', which is neither a region nor the "
                                   "boundary of a domain",
                                 describe_place(curves[c], curves[c].start()),
                                 "name one that exists, or none for "
                                 "everywhere"));
      }
    } // namespace


    void
    merge_edges(Arrangement &arrangement)
    {
      const auto &traits       = *arrangement.geometry_traits();
      const auto  is_mergeable = traits.are_mergeable_2_object();
      const auto  merge        = traits.merge_2_object();
      for (auto v = arrangement.vertices_begin();
           v != arrangement.vertices_end();)
      {
        const auto vertex = v++;
        if (vertex->is_isolated() || vertex->degree() != 2)
          continue;
        auto                               e     = vertex->incident_halfedges();
        const Arrangement::Halfedge_handle first = e++;
        const Arrangement::Halfedge_handle second = e;
        if (first->source() == second->source() ||
            !is_mergeable(first->curve(), second->curve()))
          continue;
        Traits::X_monotone_curve_2 merged;
        merge(first->curve(), second->curve(), merged);
        arrangement.merge_edge(first, second->twin(), merged);
      }
    }


    void
    confine_joints(const std::vector<Curve>        &curves,
                   const std::vector<CurvePiece>   &pieces,
                   const std::vector<unsigned int> &piece_to_curve,
                   const std::vector<Curve>        &regions,
                   Arrangement                     &arrangement)
    {
      if (std::none_of(curves.begin(), curves.end(), [](const Curve &curve) {
            return !curve.within.empty();
          }))
        return;

      // The borders of regions are interfaces temporarily, because these may lie anywhere.
      std::vector<Curve>           all_curves         = curves;
      std::vector<CurvePiece>      all_pieces         = pieces;
      std::vector<unsigned int>    all_piece_to_curve = piece_to_curve;
      std::vector<Traits::Curve_2> borders;
      for (const Curve &region : regions)
      {
        if (std::none_of(curves.begin(), curves.end(), [&](const Curve &curve) {
              return curve.within == region.name;
            }))
          continue;
        for (const CurvePiece &piece : region.pieces)
        {
          borders.emplace_back(exact_curve(piece),
                               static_cast<Label>(all_pieces.size()));
          all_pieces.push_back(piece);
          all_piece_to_curve.push_back(all_curves.size());
        }
        all_curves.push_back(region);
        all_curves.back().role = CurveRole::interface;
        all_curves.back().material.clear();
      }
      const Loops                         loops = find_loops(all_curves);
      std::vector<std::set<unsigned int>> places(curves.size());
      for (unsigned int c = 0; c < curves.size(); ++c)
        if (!curves[c].within.empty())
          places[c] =
            loops_called(curves[c].within, all_curves, curves.size(), loops);
      check_confinement(curves, places);
      if (!borders.empty())
        CGAL::insert(arrangement, borders.begin(), borders.end());

      const LabelledFaces faces(
        arrangement, all_curves, all_pieces, all_piece_to_curve, loops);
      for (const LabelledFaces::Edge &edge : faces.edges())
      {
        const std::vector<unsigned int> &left = faces.faces()[edge.left].loops;
        const std::vector<unsigned int> &right =
          faces.faces()[edge.right].loops;
        Traits::X_monotone_curve_2 curve = edge.halfedge->curve();
        std::vector<Label>         gone;
        for (const Label label : curve.data())
        {
          const unsigned int c = all_piece_to_curve[label];
          if (c >= curves.size() ||
              (!curves[c].within.empty() && !share_one(left, places[c]) &&
               !share_one(right, places[c])))
            gone.push_back(label);
        }
        if (gone.empty())
          continue;
        for (const Label label : gone)
          curve.data().erase(label);
        if (curve.data().size() == 0)
          arrangement.remove_edge(edge.halfedge);
        else
          arrangement.modify_edge(edge.halfedge, curve);
      }
      merge_edges(arrangement);
    }


    DanglingEnds
    drop_ends(const std::vector<Curve> &curves,
              const LabelledFaces      &faces,
              Arrangement              &arrangement)
    {
      DanglingEnds                              result;
      std::vector<Arrangement::Halfedge_handle> gone;
      for (const LabelledFaces::Edge &edge : faces.edges())
      {
        const auto is_joint = [&](const unsigned int c) {
          return curves[c].role == CurveRole::joint;
        };
        if (edge.left != edge.right || !faces.is_solid(edge.left) ||
            !std::all_of(edge.curves.begin(), edge.curves.end(), is_joint))
          continue;
        const bool         is_dropped = std::all_of(edge.curves.begin(),
                                            edge.curves.end(),
                                            [&](const unsigned int c) {
                                              return curves[c].drops_ends;
                                            });
        const unsigned int n_tips = (edge.halfedge->source()->degree() == 1) +
                                    (edge.halfedge->target()->degree() == 1);
        const DirectedEdge geometry = faces.geometry(edge);
        const double       length   = internal::length(geometry);
        if (!is_dropped && edge.halfedge->source()->degree() == 1)
          result.tips.push_back(geometry.start);
        if (!is_dropped && edge.halfedge->target()->degree() == 1)
          result.tips.push_back(geometry.end);
        (is_dropped ? result.n_dropped : result.n_kept) += n_tips;
        (is_dropped ? result.length_dropped : result.length_kept) += length;
        if (is_dropped)
          gone.push_back(edge.halfedge);
      }
      for (const auto &halfedge : gone)
        arrangement.remove_edge(halfedge);
      if (!gone.empty())
        merge_edges(arrangement);
      return result;
    }
  } // namespace internal
} // namespace NMM
