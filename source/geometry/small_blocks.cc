#include "geometry/small_blocks.h"

#include "geometry/curve.h"
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Values that differ by less than this part count as equal [-].
      constexpr double equal = 1e-9;

      /// The number with 24 binary digits. Values that differ by rounding mostly give the same.
      double
      leading_digits(const double value)
      {
        int          exponent = 0;
        const double fraction = std::frexp(value, &exponent);
        return std::ldexp(std::round(std::ldexp(fraction, 24)), exponent - 24);
      }


      unsigned int
      root(std::vector<unsigned int> &parent, unsigned int i)
      {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      }


      /// The key of the largest value; of equal ones the first.
      unsigned int
      longest(const std::map<unsigned int, double> &lengths)
      {
        unsigned int best        = invalid_index;
        double       best_length = 0.;
        for (const auto &[key, length] : lengths)
          if (best == invalid_index || length > (1. + equal) * best_length)
          {
            best        = key;
            best_length = length;
          }
        return best;
      }
    } // namespace


    SmallBlocks::SmallBlocks(const LabelledFaces        &faces,
                             const std::vector<Curve>   &curves,
                             std::vector<PhysicalRegion> all_regions,
                             const double                limit,
                             const bool                  merges_slivers)
      : faces(faces)
      , curves(curves)
      , regions(std::move(all_regions))
      , limit(limit)
      , merges_slivers(merges_slivers)
      , region_parent(regions.size())
      , edge_vanishes(faces.edges().size(), false)
    {
      std::iota(region_parent.begin(), region_parent.end(), 0u);
      for (unsigned int r = 0; r < regions.size(); ++r)
      {
        const unsigned int b = regions[r].block;
        if (b >= areas.size())
        {
          areas.resize(b + 1, 0.);
          largest.resize(b + 1, r);
          is_sliver.resize(b + 1, true);
        }
        is_sliver[b] = is_sliver[b] && regions[r].is_sliver;
        areas[b] += regions[r].area;
        if (regions[r].area > regions[largest[b]].area)
          largest[b] = r;
      }
      block_parent.resize(areas.size());
      std::iota(block_parent.begin(), block_parent.end(), 0u);
      bool has_small = false;
      for (unsigned int b = 0; b < areas.size(); ++b)
        has_small = has_small || is_small(b);
      if (!has_small)
        return;
      collect_joints();
      merge_all();
      for (const JointEdge &joint : joints)
        edge_vanishes[joint.edge] = joint.is_gone && !joint.is_interface;
    }


    bool
    SmallBlocks::is_small(const unsigned int block) const
    {
      return areas[block] < limit || (merges_slivers && is_sliver[block]);
    }


    void
    SmallBlocks::collect_joints()
    {
      block_joints.resize(areas.size());
      for (unsigned int e = 0; e < faces.edges().size(); ++e)
      {
        const LabelledFaces::Edge &edge     = faces.edges()[e];
        const auto                 has_role = [&](const CurveRole role) {
          return std::any_of(edge.curves.begin(),
                             edge.curves.end(),
                             [&](const unsigned int c) {
                               return curves[c].role == role;
                             });
        };
        const unsigned int left  = edge.halfedge->face()->data().region;
        const unsigned int right = edge.halfedge->twin()->face()->data().region;
        if (left == invalid_index || right == invalid_index || left == right ||
            !has_role(CurveRole::joint) || has_role(CurveRole::boundary) ||
            has_role(CurveRole::hole))
          continue;
        for (const unsigned int r : {left, right})
          block_joints[regions[r].block].push_back(joints.size());
        joints.push_back({e,
                          left,
                          right,
                          length(faces.geometry(edge)),
                          has_role(CurveRole::interface)});
      }
    }


    void
    SmallBlocks::merge_all()
    {
      // The smallest block comes first; equal ones come from left to right.
      std::set<std::pair<double, unsigned int>> queue;
      for (unsigned int b = 0; b < areas.size(); ++b)
        if (is_small(b))
          queue.emplace(leading_digits(areas[b]), b);
      while (!queue.empty())
      {
        const unsigned int small = queue.begin()->second;
        queue.erase(queue.begin());
        const unsigned int other = neighbor(small);
        if (other == invalid_index)
        {
          if (areas[small] < limit)
            stranded.push_back(small);
          continue;
        }
        queue.erase({leading_digits(areas[other]), other});
        merge(small, other);
        if (is_small(other))
          queue.emplace(leading_digits(areas[other]), other);
      }
    }


    std::pair<unsigned int, unsigned int>
    SmallBlocks::sides(const JointEdge &joint, const unsigned int block) const
    {
      return this->block(joint.left) == block
               ? std::make_pair(joint.left, joint.right)
               : std::make_pair(joint.right, joint.left);
    }


    unsigned int
    SmallBlocks::neighbor(const unsigned int block) const
    {
      std::map<unsigned int, double> lengths;
      for (const unsigned int j : block_joints[block])
      {
        const unsigned int other = this->block(sides(joints[j], block).second);
        if (other != block)
          lengths[other] += joints[j].length;
      }
      return longest(lengths);
    }


    void
    SmallBlocks::merge(const unsigned int block, const unsigned int other)
    {
      CleaningAction action{CleaningAction::Kind::merged_block, "", {}, {}, 0.};
      action.area = areas[block];
      action.from = regions[largest[block]].inside;
      action.to   = regions[largest[other]].inside;
      std::map<unsigned int, double> lengths;
      for (const unsigned int j : block_joints[block])
      {
        const auto [inside, outside] = sides(joints[j], block);
        if (this->block(outside) != other)
          continue;
        action.distance += joints[j].length;
        lengths[faces.edges()[joints[j].edge].curves.front()] +=
          joints[j].length;
      }
      action.curve = curves[longest(lengths)].name;
      all_actions.push_back(action);

      unite_regions(block, other);
      block_parent[block] = other;
      areas[other] += areas[block];
      is_sliver[other] = is_sliver[other] && is_sliver[block];
      if (regions[largest[block]].area > regions[largest[other]].area)
        largest[other] = largest[block];
      block_joints[other].insert(block_joints[other].end(),
                                 block_joints[block].begin(),
                                 block_joints[block].end());
      block_joints[block].clear();
    }


    void
    SmallBlocks::unite_regions(const unsigned int block,
                               const unsigned int other)
    {
      std::vector<unsigned int>                              common;
      std::map<unsigned int, std::map<unsigned int, double>> lengths;
      for (const unsigned int j : block_joints[block])
      {
        const auto [inside, outside] = sides(joints[j], block);
        if (this->block(outside) != other)
          continue;
        common.push_back(j);
        if (!joints[j].is_interface)
          lengths[owner(inside)][owner(outside)] += joints[j].length;
      }
      for (const auto &[region, neighbors] : lengths)
        region_parent[region] = owner(longest(neighbors));
      for (const unsigned int j : common)
      {
        JointEdge &joint = joints[j];
        const auto [first, last] =
          std::minmax({owner(joint.left), owner(joint.right)});
        if (!joint.is_interface &&
            regions[first].material != regions[last].material)
          continue;
        joint.is_gone = true;
        if (!joint.is_interface)
          region_parent[last] = first;
      }
    }


    unsigned int
    SmallBlocks::owner(const unsigned int region) const
    {
      return root(region_parent, region);
    }


    unsigned int
    SmallBlocks::block(const unsigned int region) const
    {
      return root(block_parent, regions[region].block);
    }


    bool
    SmallBlocks::vanishes(const unsigned int edge) const
    {
      return edge_vanishes[edge];
    }


    const std::vector<CleaningAction> &
    SmallBlocks::actions() const
    {
      return all_actions;
    }


    std::string
    SmallBlocks::notice() const
    {
      constexpr std::size_t n_named = 10;
      if (stranded.empty())
        return "";
      std::ostringstream text;
      text << stranded.size()
           << (stranded.size() == 1 ? " block is" : " blocks are")
           << " smaller than " << limit
           << " m^2, but not merged, since no joint separates "
           << (stranded.size() == 1 ? "it" : "them") << " from another block: ";
      for (std::size_t i = 0; i < std::min(stranded.size(), n_named); ++i)
      {
        text << (i == 0 ? "" : ", ") << areas[stranded[i]] << " m^2 at "
             << to_string(regions[largest[stranded[i]]].inside);
      }
      if (stranded.size() > n_named)
        text << " and " << stranded.size() - n_named << " more";
      return text.str();
    }


    void
    SmallBlocks::find_new_tips(DanglingEnds &ends) const
    {
      std::map<const void *, unsigned int> n_removed;
      for (unsigned int e = 0; e < edge_vanishes.size(); ++e)
        if (edge_vanishes[e])
        {
          const auto &halfedge = faces.edges()[e].halfedge;
          ++n_removed[&*halfedge->source()];
          ++n_removed[&*halfedge->target()];
        }
      for (unsigned int e = 0; e < edge_vanishes.size(); ++e)
      {
        const LabelledFaces::Edge &edge = faces.edges()[e];
        if (edge_vanishes[e] || edge.left != edge.right ||
            !faces.is_solid(edge.left) ||
            curves[edge.curves.back()].role != CurveRole::joint)
          continue;
        const DirectedEdge geometry = faces.geometry(edge);
        for (const bool at_start : {true, false})
        {
          const auto vertex =
            at_start ? edge.halfedge->source() : edge.halfedge->target();
          const auto it = n_removed.find(&*vertex);
          if (it == n_removed.end() || vertex->degree() != it->second + 1)
            continue;
          ++ends.n_kept;
          ends.tips.push_back(at_start ? geometry.start : geometry.end);
        }
      }
    }


    void
    SmallBlocks::remove_joints(const std::vector<unsigned int> &piece_to_curve,
                               DanglingEnds                    &ends,
                               Arrangement &arrangement) const
    {
      find_new_tips(ends);
      for (const JointEdge &joint : joints)
      {
        const auto &halfedge = faces.edges()[joint.edge].halfedge;
        if (!joint.is_gone)
          continue;
        if (!joint.is_interface)
        {
          arrangement.remove_edge(halfedge);
          continue;
        }
        Traits::X_monotone_curve_2 curve = halfedge->curve();
        std::vector<Label>         gone;
        for (const Label label : curve.data())
          if (curves[piece_to_curve[label]].role == CurveRole::joint)
            gone.push_back(label);
        for (const Label label : gone)
          curve.data().erase(label);
        arrangement.modify_edge(halfedge, curve);
      }
    }
  } // namespace internal
} // namespace NMM
